// Generated from the message definitions by `make docs`.

import type { MessageType } from '../link/link'
import { type CdrReader, type CdrWriter, messageType } from './cdr'
import { type Time, createTime, readTime, writeTime } from './builtin_interfaces'

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

export function writeColorRGBA(to: CdrWriter, message: ColorRGBA): void {
  to.float32(message.r)
  to.float32(message.g)
  to.float32(message.b)
  to.float32(message.a)
}

export const colorRGBAType: MessageType<ColorRGBA> = /* @__PURE__ */ messageType(
  'std_msgs/msg/ColorRGBA',
  createColorRGBA,
  readColorRGBA,
  writeColorRGBA,
)

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

export const headerType: MessageType<Header> = /* @__PURE__ */ messageType(
  'std_msgs/msg/Header',
  createHeader,
  readHeader,
  writeHeader,
)

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

export function writeString(to: CdrWriter, message: String): void {
  to.string(message.data)
}

export const stringType: MessageType<String> = /* @__PURE__ */ messageType(
  'std_msgs/msg/String',
  createString,
  readString,
  writeString,
)
