import type { MessageReader, MessageWriter, ServiceType } from '../protocol/message_type'
import { own, spoken, type Told } from '../words/diagnostic'
import { words } from '../words/words'
import { ClockOffset, exchange } from './clock_offset'
import {
  CLOSED_FOR_GOOD,
  type FrameReader,
  following,
  PROTOCOL,
  putFrame,
  RecordKind,
  readFrame,
  writeCredit,
  writeReceived,
} from './frames'
import {
  type Deed,
  type LabOffer,
  type Link,
  LinkError,
  type LinkStatus,
  type Sample,
  type Unsubscribe,
} from './link'
import { ReliableReceiver } from './reliable'
import { Services } from './services'
import { Topics } from './topics'

/** Batches under way at once: with more, data on a slow link is older. */
const BATCHES = 2
const TIMEOUT_S = 10
/** Bytes that may wait in the browser before messages are left out. */
const LONGEST_QUEUE = 4096
/** s: the gateway answers a ping at once; this long without a frame means that the way is
 * broken. */
const SILENCE_S = 4
/** s: a handshake may take so long at most. The first attempt has SILENCE_S, and each further one
 * twice the time of the one before: a slow network connects at last. */
const LONGEST_HANDSHAKE_S = 60
const PING_S = 1
/** s: a message whose stamp is farther from the lab's time was stamped by another clock, or the
 * lab's clock was set. */
const OTHER_CLOCK_S = 0.5
/** s between two pings from which on the page itself stood still, as while it builds a scene. */
const STALL_S = 2.5
/** s until the first and between later attempts to connect; each is drawn from its upper half. */
const RETRY_S = [0.25, 0.5, 1, 2, 4, 8]
const NOTHING: LabOffer = { topics: {}, services: {}, latched: new Set() }

export interface SocketOptions {
  /** Returns a WebSocket; tests put a fake here. */
  readonly open?: (url: string, protocol: string) => WebSocket
  /** A number from 0 to 1 that spreads the attempts of many pages. */
  readonly random?: () => number
}

/** Return the address of the gateway's socket for the page that is open. */
export function socketUrl(page: Location = location): string {
  return `${page.protocol === 'https:' ? 'wss' : 'ws'}://${page.host}/link`
}

/** Connect with the gateway, now and again after each loss. `close` ends it. */
export function openLink(url: string = socketUrl(), options: SocketOptions = {}): Link {
  return new SocketLink(url, options)
}

class SocketLink implements Link {
  private socket: WebSocket | null = null
  private current: LinkStatus = { phase: 'connecting', reason: '', roundTrip: Number.NaN }
  private currentOffer = NOTHING
  private readonly statusListeners = new Set<(status: LinkStatus) => void>()
  private readonly offerListeners = new Set<(offer: LabOffer) => void>()
  private readonly deedListeners = new Set<(deed: Deed) => void>()
  private readonly offset = new ClockOffset()
  private readonly records = new ReliableReceiver()
  private readonly services = new Services((frame) => this.send(frame))
  private readonly topics = new Topics(
    (id, key) =>
      this.sendText(key === null ? { op: 'unsubscribe', id } : { op: 'subscribe', id, key }),
    (key, error) => console.error(`a message of ${key} was left out: ${error.message}`),
  )
  private readonly reader: FrameReader
  private readonly small = new Uint8Array(8)
  private readonly smallView = new DataView(this.small.buffer)
  private token = ''
  private welcomed = false
  /** A ping is not answered yet. */
  private asking = false
  /** Why the gateway closes this socket. */
  private closing: Told | null = null
  private attempts = 0
  private batchNumber = 0
  private heardAt = 0
  private beatAt = 0
  private retry: ReturnType<typeof setTimeout> | undefined
  private beat: ReturnType<typeof setInterval> | undefined
  private readonly unwatch: () => void

  constructor(
    private readonly url: string,
    private readonly options: SocketOptions,
  ) {
    this.reader = {
      value: (topic, stamp, bytes, start, end) => {
        if (Math.abs(stamp - this.labTime()) > OTHER_CLOCK_S && !this.asking) this.ping()
        this.topics.deliver(topic, stamp, bytes, start, end)
      },
      batch: (number) => {
        this.batchNumber = number
        this.grant()
      },
      fragment: (number, last, data) => this.takeFragment(number, last, data),
    }
    this.unwatch = watchVisibility(() => this.onVisibility())
    this.connect()
  }

  get status(): LinkStatus {
    return this.current
  }

  get offer(): LabOffer {
    return this.currentOffer
  }

  onStatus(listener: (status: LinkStatus) => void): Unsubscribe {
    this.statusListeners.add(listener)
    return () => this.statusListeners.delete(listener)
  }

  onOffer(listener: (offer: LabOffer) => void): Unsubscribe {
    this.offerListeners.add(listener)
    return () => this.offerListeners.delete(listener)
  }

  onDeed(listener: (deed: Deed) => void): Unsubscribe {
    this.deedListeners.add(listener)
    return () => this.deedListeners.delete(listener)
  }

  subscribe<T>(
    key: string,
    type: MessageReader<T>,
    listener: (message: T, sample: Sample) => void,
  ): Unsubscribe {
    return this.topics.subscribe(key, type, listener)
  }

  call<Request, Response>(
    service: string,
    type: ServiceType<Request, Response>,
    request: Request,
    timeoutS = TIMEOUT_S,
  ): Promise<Response> {
    if (this.current.phase === 'refused') {
      return Promise.reject(new LinkError('lost', own(this.current.reason)))
    }
    return this.services.call(service, type.request, type.response, request, timeoutS)
  }

  publish<T>(key: string, type: MessageWriter<T>, message: T): void {
    // On a slow way the newest of the next moment is better than one that waits behind others.
    if ((this.socket?.bufferedAmount ?? 0) > LONGEST_QUEUE) return
    this.send(putFrame(key, type.encode(message)))
  }

  labTime(): number {
    const now = ownTime()
    const offset = this.offset.offset(now)
    return Number.isNaN(offset) ? now : now + offset
  }

  close(): void {
    this.unwatch()
    this.drop()
    clearTimeout(this.retry)
    const { closed } = words.value.link
    this.services.lose(closed)
    this.setStatus('lost', closed)
  }

  private connect(): void {
    const open = this.options.open ?? ((url, protocol) => new WebSocket(url, protocol))
    const socket = open(this.url, PROTOCOL)
    socket.binaryType = 'arraybuffer'
    this.socket = socket
    this.welcomed = this.asking = false
    this.closing = null
    this.batchNumber = 0
    this.heardAt = this.beatAt = ownTime()
    // Ignore late events of a replaced socket.
    const own = (act: () => void) => () => {
      if (this.socket === socket) act()
    }
    socket.onopen = own(() => this.sayHello())
    socket.onmessage = (event) => {
      if (this.socket === socket) this.onMessage(event.data as ArrayBuffer | string)
    }
    socket.onclose = (event) => {
      if (this.socket === socket) this.onClose(event.code, event.reason)
    }
    clearInterval(this.beat)
    this.beat = setInterval(() => this.onBeat(), PING_S * 1000)
  }

  private sayHello(): void {
    this.heardAt = ownTime()
    const hello = {
      op: 'hello',
      token: this.token,
      received: this.records.received,
      subscriptions: this.topics.wanted,
      hidden: isHidden(),
    }
    this.socket?.send(JSON.stringify(hello))
    this.grant()
    this.ping()
  }

  private onMessage(data: ArrayBuffer | string): void {
    this.heardAt = ownTime()
    try {
      if (typeof data === 'string') this.onText(JSON.parse(data) as Text)
      else readFrame(data, this.reader)
    } catch (error) {
      this.lose(words.value.link.unreadable((error as Error).message))
    }
  }

  private onText(text: Text): void {
    switch (text.op) {
      case 'welcome':
        this.onWelcome(text.token, text.resumed)
        break
      case 'topic':
        this.topics.announce(text.id, text.key, !text.latched && !text.each)
        break
      case 'lab':
        this.onLab(text)
        break
      case 'pong':
        this.asking = false
        this.offset.add(exchange(text.asked, text.came, text.answered, ownTime()))
        this.setStatus(this.current.phase, this.current.reason)
        break
      case 'refused':
        console.error(`${text.key}: ${text.message}`)
        break
      case 'closing':
        this.closing = text.diagnostic
        break
      case 'did':
        for (const listener of this.deedListeners) listener(text)
        break
    }
  }

  private onWelcome(token: string, resumed: boolean): void {
    if (!resumed) {
      // New session: the outcome of pending calls is unknown.
      if (this.token !== '') {
        this.services.lose(words.value.link.answerLost, { sentOnly: true })
      }
      this.records.clear()
      this.topics.forget()
      this.offset.clear()
    }
    this.token = token
    this.welcomed = true
    this.attempts = 0
    this.services.resend()
  }

  private onLab(text: Extract<Text, { op: 'lab' }>): void {
    this.setOffer({ ...text, latched: new Set(text.latched) })
    if (text.phase === 'open') this.setStatus('open', '')
    else this.setStatus('lost', words.value.link.labAway)
  }

  private takeFragment(number: number, last: boolean, data: Uint8Array): void {
    const record = this.records.take(number, last, data)
    writeReceived(this.smallView, this.records.received)
    this.send(this.small)
    if (record === null) return
    const { kind, about, stamp, payload } = record
    if (kind === RecordKind.RESPONSE) this.services.respond(about, payload)
    else if (kind === RecordKind.ERROR) this.services.fail(about, payload)
    else this.topics.deliver(about, stamp, payload, 0, payload.byteLength)
  }

  /** Let the gateway send further batches; a hidden page takes none. */
  private grant(): void {
    if (isHidden()) return
    writeCredit(this.smallView, following(this.batchNumber, BATCHES))
    this.socket?.send(this.small)
  }

  private onBeat(): void {
    const now = ownTime()
    // Messages that arrived while the page was frozen are read after this.
    if (now - this.beatAt > STALL_S) this.heardAt = now
    this.beatAt = now
    const patience = this.welcomed
      ? SILENCE_S
      : Math.min(SILENCE_S * 2 ** this.attempts, LONGEST_HANDSHAKE_S)
    if (!isHidden() && now - this.heardAt > patience) {
      this.lose(words.value.link.silent(patience))
    } else this.ping()
  }

  private ping(): void {
    this.asking = true
    this.sendText({ op: 'ping', asked: ownTime() })
  }

  private onVisibility(): void {
    this.heardAt = ownTime()
    this.sendText({ op: isHidden() ? 'hidden' : 'visible' })
    if (!isHidden() && this.socket?.readyState === WebSocket.OPEN) {
      this.grant()
      this.ping()
    }
  }

  private onClose(code: number, text: string): void {
    const reason = this.closing === null ? text : spoken(this.closing)
    if (CLOSED_FOR_GOOD.includes(code)) {
      this.drop()
      this.setOffer(NOTHING)
      this.services.lose(reason)
      this.setStatus('refused', reason)
    } else this.lose(reason || words.value.link.gone)
  }

  /** Leave the socket and try again later. */
  private lose(reason: string): void {
    this.drop()
    this.setOffer(NOTHING)
    this.setStatus('lost', reason)
    const longest = RETRY_S[Math.min(this.attempts, RETRY_S.length - 1)] as number
    this.attempts++
    const random = this.options.random ?? Math.random
    clearTimeout(this.retry)
    this.retry = setTimeout(() => this.connect(), longest * (0.5 + random() / 2) * 1000)
  }

  private drop(): void {
    const socket = this.socket
    this.socket = null
    this.welcomed = false
    clearInterval(this.beat)
    socket?.close()
  }

  /** Send a frame; while there is no socket it is left out, and requests are sent again later. */
  private send(frame: Uint8Array<ArrayBuffer>): boolean {
    if (!this.welcomed || this.socket?.readyState !== WebSocket.OPEN) return false
    this.socket.send(frame)
    return true
  }

  private sendText(message: object): void {
    if (this.socket?.readyState === WebSocket.OPEN) this.socket.send(JSON.stringify(message))
  }

  private setStatus(phase: LinkStatus['phase'], reason: string): void {
    const roundTrip = this.offset.roundTrip
    const { current } = this
    if (
      current.phase === phase &&
      current.reason === reason &&
      Object.is(current.roundTrip, roundTrip)
    ) {
      return
    }
    this.current = { phase, reason, roundTrip }
    for (const listener of this.statusListeners) listener(this.current)
  }

  private setOffer(offer: LabOffer): void {
    if (offer === this.currentOffer) return
    this.currentOffer = offer
    for (const listener of this.offerListeners) listener(offer)
  }
}

/** The text frames of the gateway. */
type Text =
  | { op: 'welcome'; token: string; resumed: boolean }
  | { op: 'topic'; id: number; key: string; type: string; latched: boolean; each: boolean }
  | {
      op: 'lab'
      phase: string
      topics: Record<string, string>
      services: Record<string, string>
      latched: string[]
    }
  | { op: 'pong'; asked: number; came: number; answered: number }
  | { op: 'refused'; key: string; code: string; message: string }
  | { op: 'closing'; code: number; diagnostic: Told }
  | { op: 'did'; who: string; service: string }

/** Return this machine's time, s since 1970; it never jumps while the page lives. */
function ownTime(): number {
  return (performance.timeOrigin + performance.now()) / 1000
}

function isHidden(): boolean {
  return typeof document !== 'undefined' && document.visibilityState === 'hidden'
}

function watchVisibility(changed: () => void): () => void {
  if (typeof document === 'undefined') return () => {}
  document.addEventListener('visibilitychange', changed)
  return () => document.removeEventListener('visibilitychange', changed)
}
