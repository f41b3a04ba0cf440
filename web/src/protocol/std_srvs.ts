// Generated from the message definitions by scripts/generate_docs.py.

import type { MessageType, ServiceType } from '../link/link'
import { type CdrReader, type CdrWriter, messageType } from './cdr'

/** std_srvs/srv/Empty_Request */
export type EmptyRequest = Record<string, never>

export function createEmptyRequest(): EmptyRequest {
  return {}
}

export function readEmptyRequest(from: CdrReader, _: EmptyRequest): void {
  from.uint8()
}

export function writeEmptyRequest(to: CdrWriter, _: EmptyRequest): void {
  to.uint8(0)
}

export const emptyRequestType: MessageType<EmptyRequest> = /* @__PURE__ */ messageType(
  'std_srvs/srv/Empty_Request',
  createEmptyRequest,
  readEmptyRequest,
  writeEmptyRequest,
)

/** std_srvs/srv/Empty_Response */
export type EmptyResponse = Record<string, never>

export function createEmptyResponse(): EmptyResponse {
  return {}
}

export function readEmptyResponse(from: CdrReader, _: EmptyResponse): void {
  from.uint8()
}

export function writeEmptyResponse(to: CdrWriter, _: EmptyResponse): void {
  to.uint8(0)
}

export const emptyResponseType: MessageType<EmptyResponse> = /* @__PURE__ */ messageType(
  'std_srvs/srv/Empty_Response',
  createEmptyResponse,
  readEmptyResponse,
  writeEmptyResponse,
)

/** std_srvs/srv/SetBool_Request */
export interface SetBoolRequest {
  data: boolean
}

export function createSetBoolRequest(): SetBoolRequest {
  return {
    data: false,
  }
}

export function readSetBoolRequest(from: CdrReader, into: SetBoolRequest): void {
  into.data = from.bool()
}

export function writeSetBoolRequest(to: CdrWriter, message: SetBoolRequest): void {
  to.bool(message.data)
}

export const setBoolRequestType: MessageType<SetBoolRequest> = /* @__PURE__ */ messageType(
  'std_srvs/srv/SetBool_Request',
  createSetBoolRequest,
  readSetBoolRequest,
  writeSetBoolRequest,
)

/** std_srvs/srv/SetBool_Response */
export interface SetBoolResponse {
  success: boolean
  message: string
}

export function createSetBoolResponse(): SetBoolResponse {
  return {
    success: false,
    message: '',
  }
}

export function readSetBoolResponse(from: CdrReader, into: SetBoolResponse): void {
  into.success = from.bool()
  into.message = from.string(into.message)
}

export function writeSetBoolResponse(to: CdrWriter, message: SetBoolResponse): void {
  to.bool(message.success)
  to.string(message.message)
}

export const setBoolResponseType: MessageType<SetBoolResponse> = /* @__PURE__ */ messageType(
  'std_srvs/srv/SetBool_Response',
  createSetBoolResponse,
  readSetBoolResponse,
  writeSetBoolResponse,
)

/** std_srvs/srv/Trigger_Request */
export type TriggerRequest = Record<string, never>

export function createTriggerRequest(): TriggerRequest {
  return {}
}

export function readTriggerRequest(from: CdrReader, _: TriggerRequest): void {
  from.uint8()
}

export function writeTriggerRequest(to: CdrWriter, _: TriggerRequest): void {
  to.uint8(0)
}

export const triggerRequestType: MessageType<TriggerRequest> = /* @__PURE__ */ messageType(
  'std_srvs/srv/Trigger_Request',
  createTriggerRequest,
  readTriggerRequest,
  writeTriggerRequest,
)

/** std_srvs/srv/Trigger_Response */
export interface TriggerResponse {
  success: boolean
  message: string
}

export function createTriggerResponse(): TriggerResponse {
  return {
    success: false,
    message: '',
  }
}

export function readTriggerResponse(from: CdrReader, into: TriggerResponse): void {
  into.success = from.bool()
  into.message = from.string(into.message)
}

export function writeTriggerResponse(to: CdrWriter, message: TriggerResponse): void {
  to.bool(message.success)
  to.string(message.message)
}

export const triggerResponseType: MessageType<TriggerResponse> = /* @__PURE__ */ messageType(
  'std_srvs/srv/Trigger_Response',
  createTriggerResponse,
  readTriggerResponse,
  writeTriggerResponse,
)

export const emptyType: ServiceType<EmptyRequest, EmptyResponse> = {
  name: 'std_srvs/srv/Empty',
  request: emptyRequestType,
  response: emptyResponseType,
}

export const setBoolType: ServiceType<SetBoolRequest, SetBoolResponse> = {
  name: 'std_srvs/srv/SetBool',
  request: setBoolRequestType,
  response: setBoolResponseType,
}

export const triggerType: ServiceType<TriggerRequest, TriggerResponse> = {
  name: 'std_srvs/srv/Trigger',
  request: triggerRequestType,
  response: triggerResponseType,
}
