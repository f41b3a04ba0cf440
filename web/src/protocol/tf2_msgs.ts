// Generated from the message definitions by `make docs`.

import type { MessageType } from '../link/link'
import { type CdrReader, type CdrWriter, messageType } from './cdr'
import { type TransformStamped, createTransformStamped, readTransformStamped, writeTransformStamped } from './geometry_msgs'

/** tf2_msgs/msg/TFMessage */
export interface TFMessage {
  transforms: TransformStamped[]
}

export function createTFMessage(): TFMessage {
  return {
    transforms: [],
  }
}

export function readTFMessage(from: CdrReader, into: TFMessage): void {
  into.transforms = from.messages(into.transforms, createTransformStamped, readTransformStamped)
}

export function writeTFMessage(to: CdrWriter, message: TFMessage): void {
  to.messages(message.transforms, writeTransformStamped)
}

export const tFMessageType: MessageType<TFMessage> = /* @__PURE__ */ messageType(
  'tf2_msgs/msg/TFMessage',
  createTFMessage,
  readTFMessage,
  writeTFMessage,
)
