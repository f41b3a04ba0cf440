import type { MessageReader, MessageWriter } from '../protocol/message_type'
import { own, type Told } from '../words/diagnostic'
import { words } from '../words/words'
import { callFrame } from './frames'
import { LinkError } from './link'

/** s that the page waits beyond the time-out, in which the gateway answers it itself. */
const GRACE_S = 2
const KINDS: Record<string, LinkError['kind']> = {
  timeout: 'timeout',
  no_service: 'no_service',
  not_allowed: 'not_allowed',
  refused: 'refused',
  too_many: 'refused',
}
const text = new TextDecoder()

interface PendingCall {
  readonly frame: Uint8Array<ArrayBuffer>
  sent: boolean
  readonly timer: ReturnType<typeof setTimeout>
  resolve(payload: Uint8Array): void
  reject(error: LinkError): void
}

/** The requests that wait for their responses; they survive a reconnect. */
export class Services {
  private readonly pending = new Map<number, PendingCall>()
  private next = 1

  /** send: returns whether the frame went out. */
  constructor(private readonly send: (frame: Uint8Array<ArrayBuffer>) => boolean) {}

  /** Send a request and return its response. Rejects with a LinkError. */
  call<Request, Response>(
    service: string,
    request: MessageWriter<Request>,
    response: MessageReader<Response>,
    message: Request,
    timeoutS: number,
  ): Promise<Response> {
    const number = this.next++
    const frame = callFrame(service, request.encode(message), number, timeoutS)
    const answer = new Promise<Response>((resolve, reject) => {
      const timer = setTimeout(
        () => {
          this.pending.delete(number)
          reject(new LinkError('timeout', own(words.value.link.timeout(service, timeoutS))))
        },
        (timeoutS + GRACE_S) * 1000,
      )
      this.pending.set(number, {
        frame,
        sent: this.send(frame),
        timer,
        reject,
        resolve: (payload) => {
          try {
            resolve(response.decode(payload))
          } catch (error) {
            const why = words.value.link.unreadable((error as Error).message)
            reject(new LinkError('refused', own(`${service}: ${why}`)))
          }
        },
      })
    })
    return answer
  }

  /** Take a response; ignore one that is no longer awaited. */
  respond(request: number, payload: Uint8Array): void {
    this.take(request)?.resolve(payload)
  }

  /** Take why a request has no response. */
  fail(request: number, payload: Uint8Array): void {
    const { code, message, diagnostic } = JSON.parse(text.decode(payload)) as {
      code: string
      message: string
      diagnostic?: Told
    }
    this.take(request)?.reject(new LinkError(KINDS[code] ?? 'refused', diagnostic ?? own(message)))
  }

  /** Repeat the requests without a response: the gateway executes none twice. */
  resend(): void {
    for (const call of this.pending.values()) call.sent = this.send(call.frame) || call.sent
  }

  /** Reject the pending calls, or only those that were sent. */
  lose(message: string, { sentOnly = false } = {}): void {
    for (const [number, { sent }] of [...this.pending]) {
      if (sent || !sentOnly) this.take(number)?.reject(new LinkError('lost', own(message)))
    }
  }

  private take(request: number): PendingCall | undefined {
    const call = this.pending.get(request)
    this.pending.delete(request)
    if (call !== undefined) clearTimeout(call.timer)
    return call
  }
}
