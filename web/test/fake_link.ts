import {
  type Deed,
  type LabOffer,
  type Link,
  LinkError,
  type LinkStatus,
  type Sample,
  type Unsubscribe,
} from '../src/link/link'
import { patternOf } from '../src/link/topics'
import type { MessageReader, MessageWriter, ServiceType } from '../src/protocol/message_type'
import { own } from '../src/words/diagnostic'

type Answer = (request: unknown) => unknown

/** A link without a gateway, for tests and demos: messages and answers are set by hand. A listener
 * gets a copy of its own. */
export class FakeLink implements Link {
  status: LinkStatus = { phase: 'open', reason: '', roundTrip: 0.001 }
  offer: LabOffer = { topics: {}, services: {}, latched: new Set() }
  /** Lab time, s; null: this machine's. */
  time: number | null = null
  /** Every call so far. */
  readonly calls: { service: string; request: unknown }[] = []
  /** Every published message so far. */
  readonly published: { key: string; message: unknown }[] = []
  private readonly statusListeners = new Set<(status: LinkStatus) => void>()
  private readonly offerListeners = new Set<(offer: LabOffer) => void>()
  private readonly deedListeners = new Set<(deed: Deed) => void>()
  private readonly subscriptions = new Set<{
    pattern: RegExp
    listener: (message: unknown, sample: Sample) => void
  }>()
  private readonly newest = new Map<string, { message: unknown; stamp: number }>()
  private readonly answers = new Map<string, Answer>()

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

  /** Deliver a deed of another person. */
  did(deed: Deed): void {
    for (const listener of this.deedListeners) listener(deed)
  }

  subscribe<T>(
    key: string,
    _type: MessageReader<T>,
    listener: (message: T, sample: Sample) => void,
  ): Unsubscribe {
    const subscription = {
      pattern: patternOf(key),
      listener: listener as (message: unknown, sample: Sample) => void,
    }
    this.subscriptions.add(subscription)
    for (const [each, { message, stamp }] of this.newest) {
      if (subscription.pattern.test(`/${each}`))
        subscription.listener(structuredClone(message), { key: each, stamp })
    }
    return () => this.subscriptions.delete(subscription)
  }

  async call<Request, Response>(
    service: string,
    type: ServiceType<Request, Response>,
    request: Request,
  ): Promise<Response> {
    const answer = this.answers.get(service)
    if (answer === undefined) throw new LinkError('no_service', own(`nobody answers ${service}`))
    type.request.encode(request)
    const arrived = structuredClone(request)
    this.calls.push({ service, request: arrived })
    const response = (await answer(arrived)) as Partial<Response>
    return structuredClone(type.response.create(response))
  }

  publish<T>(key: string, _type: MessageWriter<T>, message: T): void {
    this.published.push({ key, message })
  }

  labTime(): number {
    return this.time ?? Date.now() / 1000
  }

  close(): void {
    this.setStatus('lost', 'closed')
  }

  /** Deliver a message to the subscribers; `latched`: also to later ones. */
  deliver<T>(
    key: string,
    type: MessageReader<T>,
    message: Partial<T>,
    { latched = false, stamp = this.labTime() } = {},
  ): void {
    const whole = type.create(message)
    if (latched) this.newest.set(key, { message: whole, stamp })
    for (const { pattern, listener } of this.subscriptions) {
      if (pattern.test(`/${key}`)) listener(structuredClone(whole), { key, stamp })
    }
  }

  /** Answer a service: return the response's fields, or throw a LinkError. */
  answer<Request, Response>(
    service: string,
    _type: ServiceType<Request, Response>,
    answer: (request: Request) => Partial<Response> | Promise<Partial<Response>>,
  ): void {
    this.answers.set(service, answer as Answer)
  }

  setStatus(phase: LinkStatus['phase'], reason = ''): void {
    this.status = { phase, reason, roundTrip: this.status.roundTrip }
    for (const listener of this.statusListeners) listener(this.status)
  }

  setOffer(offer: Partial<LabOffer>): void {
    this.offer = { ...this.offer, ...offer }
    for (const listener of this.offerListeners) listener(this.offer)
  }
}
