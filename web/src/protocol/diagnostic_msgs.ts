// Generated from the message definitions by `make docs`.

import type { CdrReader } from './cdr'

/** diagnostic_msgs/msg/KeyValue */
export interface KeyValue {
  key: string
  value: string
}

export function createKeyValue(): KeyValue {
  return {
    key: '',
    value: '',
  }
}

export function readKeyValue(from: CdrReader, into: KeyValue): void {
  into.key = from.string(into.key)
  into.value = from.string(into.value)
}
