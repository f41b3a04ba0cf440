// Generated from the message definitions by `make docs`.

import type { CdrReader, CdrWriter } from './cdr'

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
