// Generated from the message definitions by `make docs`.

import type { MessageType } from '../link/link'
import { type CdrReader, type CdrWriter, messageType } from './cdr'
import { type Header, createHeader, readHeader, writeHeader } from './std_msgs'

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

export function writeDiagnosticArray(to: CdrWriter, message: DiagnosticArray): void {
  writeHeader(to, message.header)
  to.messages(message.status, writeDiagnosticStatus)
}

export const diagnosticArrayType: MessageType<DiagnosticArray> = /* @__PURE__ */ messageType(
  'diagnostic_msgs/msg/DiagnosticArray',
  createDiagnosticArray,
  readDiagnosticArray,
  writeDiagnosticArray,
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

export function writeDiagnosticStatus(to: CdrWriter, message: DiagnosticStatus): void {
  to.uint8(message.level)
  to.string(message.name)
  to.string(message.message)
  to.string(message.hardware_id)
  to.messages(message.values, writeKeyValue)
}

export const diagnosticStatusType: MessageType<DiagnosticStatus> = /* @__PURE__ */ messageType(
  'diagnostic_msgs/msg/DiagnosticStatus',
  createDiagnosticStatus,
  readDiagnosticStatus,
  writeDiagnosticStatus,
)

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

export function writeKeyValue(to: CdrWriter, message: KeyValue): void {
  to.string(message.key)
  to.string(message.value)
}

export const keyValueType: MessageType<KeyValue> = /* @__PURE__ */ messageType(
  'diagnostic_msgs/msg/KeyValue',
  createKeyValue,
  readKeyValue,
  writeKeyValue,
)
