// Generated from the message definitions by `make docs`.

import type { CdrReader } from './cdr'
import { type MessageReader, messageReader } from './message_type'
import { type Header, createHeader, readHeader } from './std_msgs'

/** diagnostic_msgs/msg/DiagnosticArray */
export interface DiagnosticArray {
  header: Header
  status: DiagnosticStatus[]
}

export function createDiagnosticArray(): DiagnosticArray {
  return {
    header: createHeader(),
    status: [],
  }
}

export function readDiagnosticArray(from: CdrReader, into: DiagnosticArray): void {
  readHeader(from, into.header)
  into.status = from.messages(into.status, createDiagnosticStatus, readDiagnosticStatus)
}

export const diagnosticArrayReader: MessageReader<DiagnosticArray> = /* @__PURE__ */ messageReader(
  'diagnostic_msgs/msg/DiagnosticArray',
  createDiagnosticArray,
  readDiagnosticArray,
)

/** diagnostic_msgs/msg/DiagnosticStatus */
export interface DiagnosticStatus {
  level: number
  name: string
  message: string
  hardware_id: string
  values: KeyValue[]
}

export const DiagnosticStatus = {
  OK: 0,
  WARN: 1,
  ERROR: 2,
  STALE: 3,
} as const

export function createDiagnosticStatus(): DiagnosticStatus {
  return {
    level: 0,
    name: '',
    message: '',
    hardware_id: '',
    values: [],
  }
}

export function readDiagnosticStatus(from: CdrReader, into: DiagnosticStatus): void {
  into.level = from.uint8()
  into.name = from.string(into.name)
  into.message = from.string(into.message)
  into.hardware_id = from.string(into.hardware_id)
  into.values = from.messages(into.values, createKeyValue, readKeyValue)
}

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
