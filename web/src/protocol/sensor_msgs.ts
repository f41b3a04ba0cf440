// Generated from the message definitions by `make docs`.

import type { MessageType } from '../link/link'
import { type CdrReader, type CdrWriter, messageType } from './cdr'
import { type Header, createHeader, readHeader, writeHeader } from './std_msgs'

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

export function writeJointState(to: CdrWriter, message: JointState): void {
  writeHeader(to, message.header)
  to.strings(message.name)
  to.float64s(message.position)
  to.float64s(message.velocity)
  to.float64s(message.effort)
}

export const jointStateType: MessageType<JointState> = /* @__PURE__ */ messageType(
  'sensor_msgs/msg/JointState',
  createJointState,
  readJointState,
  writeJointState,
)
