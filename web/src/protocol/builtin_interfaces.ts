// Generated from the message definitions by `make docs`.

import type { MessageType } from '../link/link'
import { type CdrReader, type CdrWriter, messageType } from './cdr'

/** builtin_interfaces/msg/Time */
export interface Time {
  sec: number
  nanosec: number
}

export function createTime(): Time {
  return {
    sec: 0,
    nanosec: 0,
  }
}

export function readTime(from: CdrReader, into: Time): void {
  into.sec = from.int32()
  into.nanosec = from.uint32()
}

export function writeTime(to: CdrWriter, message: Time): void {
  to.int32(message.sec)
  to.uint32(message.nanosec)
}

export const timeType: MessageType<Time> = /* @__PURE__ */ messageType(
  'builtin_interfaces/msg/Time',
  createTime,
  readTime,
  writeTime,
)
