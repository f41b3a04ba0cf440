// Generated from the message definitions by `make docs`.

import type { CdrReader } from './cdr'
import { type MessageReader, messageReader } from './message_type'
import { type Header, createHeader, readHeader } from './std_msgs'

/** sensor_msgs/msg/JointState */
export interface JointState {
  header: Header
  name: string[]
  position: Float64Array
  velocity: Float64Array
  effort: Float64Array
}

export function createJointState(): JointState {
  return {
    header: createHeader(),
    name: [],
    position: new Float64Array(0),
    velocity: new Float64Array(0),
    effort: new Float64Array(0),
  }
}

export function readJointState(from: CdrReader, into: JointState): void {
  readHeader(from, into.header)
  into.name = from.strings(into.name)
  into.position = from.float64s(into.position)
  into.velocity = from.float64s(into.velocity)
  into.effort = from.float64s(into.effort)
}

export const jointStateReader: MessageReader<JointState> = /* @__PURE__ */ messageReader(
  'sensor_msgs/msg/JointState',
  createJointState,
  readJointState,
)
