/** The binary frames of the socket; docs/link.md has every byte. The same as
 * `mrlab_ros/gateway/link/frames.py`. */

export const PROTOCOL = 'mrlab.1'

const ToClient = { VALUES: 1, FRAGMENT: 2 } as const
const ToGateway = { CALL: 1, PUT: 2, CREDIT: 3, RECEIVED: 4 } as const
export const RecordKind = { MESSAGE: 1, VALUE: 2, RESPONSE: 3, ERROR: 4 } as const

/** Close codes of the gateway after which a page does not reconnect automatically. */
export const CLOSED_FOR_GOOD: readonly number[] = [4001, 4003, 4029]

const HEAD = 8
const ENTRY = 20
const LAST_FRAGMENT = 1
const RANGE = 2 ** 32
const utf8 = new TextEncoder()

/** A frame that the page cannot read: gateway and page differ, or the connection is broken. */
class FrameError extends Error {
  override readonly name = 'FrameError'
}

/** Receives the content of a frame. `start` and `end` are of the payload in `bytes`. */
export interface FrameReader {
  value(topic: number, stamp: number, bytes: Uint8Array, start: number, end: number): void
  batch(number: number): void
  fragment(number: number, last: boolean, data: Uint8Array): void
}

/** Give the content of a frame of the gateway to `reader`. Throws FrameError. */
export function readFrame(frame: ArrayBuffer, reader: FrameReader): void {
  if (frame.byteLength < HEAD) throw new FrameError(`a frame has ${frame.byteLength} bytes`)
  const view = new DataView(frame)
  const bytes = new Uint8Array(frame)
  const kind = view.getUint8(0)
  const number = view.getUint32(4, true)
  if (kind === ToClient.FRAGMENT) {
    const last = (view.getUint8(1) & LAST_FRAGMENT) !== 0
    reader.fragment(number, last, bytes.subarray(HEAD))
    return
  }
  if (kind !== ToClient.VALUES) throw new FrameError(`a frame begins with ${kind}`)
  const count = view.getUint16(2, true)
  let at = HEAD
  for (let i = 0; i < count; i++) {
    const start = at + ENTRY
    const end = start <= frame.byteLength ? start + view.getUint32(at + 4, true) : start
    if (end > frame.byteLength) throw new FrameError(`entry ${i} of a batch is cut off`)
    reader.value(view.getUint32(at, true), view.getFloat64(at + 8, true), bytes, start, end)
    at = (end + 7) & ~7
  }
  reader.batch(number)
}

/** A record of the lossless channel; `payload` begins at 4 mod 8 of its buffer. */
export interface LinkRecord {
  readonly kind: number
  /** Its topic, or its request. */
  readonly about: number
  readonly stamp: number
  readonly payload: Uint8Array
}

/** Read a whole record, which begins at a multiple of 8 of its buffer. */
export function readRecord(bytes: Uint8Array): LinkRecord {
  if (bytes.byteLength < ENTRY) throw new FrameError(`a record has ${bytes.byteLength} bytes`)
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength)
  const length = view.getUint32(4, true)
  if (ENTRY + length > bytes.byteLength) throw new FrameError('a record is cut off')
  return {
    kind: view.getUint32(16, true),
    about: view.getUint32(0, true),
    stamp: view.getFloat64(8, true),
    payload: bytes.subarray(ENTRY, ENTRY + length),
  }
}

/** Return the frame of a service's request. */
export function callFrame(
  key: string,
  payload: Uint8Array,
  request: number,
  timeoutS: number,
): Uint8Array<ArrayBuffer> {
  return keyed(ToGateway.CALL, key, payload, request, Math.ceil(timeoutS * 1000))
}

/** Return the frame of a message for a topic that the lab receives. */
export function putFrame(key: string, payload: Uint8Array): Uint8Array<ArrayBuffer> {
  return keyed(ToGateway.PUT, key, payload, 0, 0)
}

/** Write "batches up to `number` may be sent" into the 8 bytes of `frame`. */
export function writeCredit(frame: DataView, number: number): void {
  frame.setUint8(0, ToGateway.CREDIT)
  frame.setUint32(4, number, true)
}

/** Write "fragments up to `number` are here" into the 8 bytes of `frame`. */
export function writeReceived(frame: DataView, number: number): void {
  frame.setUint8(0, ToGateway.RECEIVED)
  frame.setUint32(4, number, true)
}

/** Return the number behind another; both have 32 bits. */
export function following(number: number, by = 1): number {
  return (number + by) % RANGE
}

/** Return the distance from one number to another, negative if it is behind. */
export function ahead(number: number, of: number): number {
  return ((number - of + RANGE + RANGE / 2) % RANGE) - RANGE / 2
}

function keyed(
  kind: number,
  key: string,
  payload: Uint8Array,
  request: number,
  timeoutMs: number,
): Uint8Array<ArrayBuffer> {
  const name = utf8.encode(key)
  const frame = new Uint8Array(12 + name.length + payload.length)
  const view = new DataView(frame.buffer)
  view.setUint8(0, kind)
  view.setUint16(2, name.length, true)
  view.setUint32(4, request, true)
  view.setUint32(8, timeoutMs, true)
  frame.set(name, 12)
  frame.set(payload, 12 + name.length)
  return frame
}
