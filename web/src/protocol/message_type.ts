import { CdrError, CdrReader, CdrWriter } from './cdr'

/** Decodes the messages of a type. */
export interface MessageReader<T> {
  readonly name: string
  /** Return a message of zeros and empty texts, with `values` in it. */
  create(values?: Partial<T>): T
  /** Return the message. `into` is filled and returned if it is given, and its arrays are reused.
   * Numbers of a message without `into` may be views of the payload. start, end: of the message
   * in `payload`. */
  decode(payload: Uint8Array, into?: T, start?: number, end?: number): T
}

/** Encodes the messages of a type. */
export interface MessageWriter<T> {
  readonly name: string
  encode(message: T): Uint8Array
}

/** The codecs of a service, as its client uses them. */
export interface ServiceType<Request, Response> {
  readonly name: string
  readonly request: MessageWriter<Request>
  readonly response: MessageReader<Response>
}

const reader = new CdrReader()
const writer = new CdrWriter()

/** Return the decoder of a message type; `read` fills every field of `into`. */
export function messageReader<T extends object>(
  name: string,
  create: () => T,
  read: (from: CdrReader, into: T) => void,
): MessageReader<T> {
  return {
    name,
    create: (values) => (values === undefined ? create() : Object.assign(create(), values)),
    decode(payload, into = create(), start = 0, end = payload.byteLength) {
      try {
        read(reader.open(payload, start, end), into)
      } catch (error) {
        if (!(error instanceof CdrError)) throw error
        throw new CdrError(`${end - start} bytes are no ${name}: ${error.message}`)
      }
      return into
    },
  }
}

/** Return the encoder of a message type. */
export function messageWriter<T>(
  name: string,
  write: (to: CdrWriter, message: T) => void,
): MessageWriter<T> {
  return {
    name,
    encode(message) {
      write(writer.open(), message)
      return writer.payload()
    },
  }
}

/** Return the codecs of a service. */
export function serviceType<Request, Response extends object>(
  name: string,
  write: (to: CdrWriter, request: Request) => void,
  create: () => Response,
  read: (from: CdrReader, into: Response) => void,
): ServiceType<Request, Response> {
  return {
    name,
    request: messageWriter(`${name}_Request`, write),
    response: messageReader(`${name}_Response`, create, read),
  }
}
