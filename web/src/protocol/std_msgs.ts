// Generated from the message definitions by `make docs`.

import { type Time, createTime, readTime, writeTime } from './builtin_interfaces'
import type { CdrReader, CdrWriter } from './cdr'
import { type MessageReader, messageReader } from './message_type'

/** std_msgs/msg/ColorRGBA */
export interface ColorRGBA {
  r: number
  g: number
  b: number
  a: number
}

export function createColorRGBA(): ColorRGBA {
  return {
    r: 0,
    g: 0,
    b: 0,
    a: 0,
  }
}

export function readColorRGBA(from: CdrReader, into: ColorRGBA): void {
  into.r = from.float32()
  into.g = from.float32()
  into.b = from.float32()
  into.a = from.float32()
}

/** std_msgs/msg/Header */
export interface Header {
  stamp: Time
  frame_id: string
}

export function createHeader(): Header {
  return {
    stamp: createTime(),
    frame_id: '',
  }
}

export function readHeader(from: CdrReader, into: Header): void {
  readTime(from, into.stamp)
  into.frame_id = from.string(into.frame_id)
}

export function writeHeader(to: CdrWriter, message: Header): void {
  writeTime(to, message.stamp)
  to.string(message.frame_id)
}

/** std_msgs/msg/String */
export interface String {
  data: string
}

export function createString(): String {
  return {
    data: '',
  }
}

export function readString(from: CdrReader, into: String): void {
  into.data = from.string(into.data)
}

export const stringReader: MessageReader<String> = /* @__PURE__ */ messageReader(
  'std_msgs/msg/String',
  createString,
  readString,
)
