import type { MessageReader, MessageWriter, ServiceType } from '../protocol/message_type'
import { type Told, ToldError } from '../words/diagnostic'

/** The pages' link to the lab: the gateway's socket, or a fake in tests. */
export interface Link {
  readonly status: LinkStatus
  onStatus(listener: (status: LinkStatus) => void): Unsubscribe
  /** Receive the messages of a key, such as `ur5e_1/joint_states`; `*` stands for one part.
   * A latched key delivers its newest message first. The message of a stream, such as joint states,
   * is reused by the next one: copy what is kept. Those of latched keys and events are yours. */
  subscribe<T>(
    key: string,
    type: MessageReader<T>,
    listener: (message: T, sample: Sample) => void,
  ): Unsubscribe
  /** Call a service, such as `ur5e_1/play`. Rejects with a LinkError. */
  call<Request, Response>(
    service: string,
    type: ServiceType<Request, Response>,
    request: Request,
    timeoutS?: number,
  ): Promise<Response>
  /** Publish a message on a topic that the lab receives, such as `latency/clients`; dropped while
   * lost, and while others wait to be sent. */
  publish<T>(key: string, type: MessageWriter<T>, message: T): void
  /** The present offer of the lab; empty while it is unreachable. */
  readonly offer: LabOffer
  onOffer(listener: (offer: LabOffer) => void): Unsubscribe
  /** Receive the deeds of others of this gateway: that they paused a robot or a system. */
  onDeed(listener: (deed: Deed) => void): Unsubscribe
  /** The lab's time now, s since the epoch, by the clock offset that the socket measures. */
  labTime(): number
  close(): void
}

export type Unsubscribe = () => void

export interface LinkStatus {
  readonly phase: 'connecting' | 'open' | 'lost' | 'refused'
  /** Why, in the language that was chosen then; empty while open. */
  readonly reason: string
  /** Round trip, s; NaN until measured. */
  readonly roundTrip: number
}

/** A deed of another person: the name, and the service, such as ur5e_1/pause. */
export interface Deed {
  readonly who: string
  readonly service: string
}

/** The offer of the lab: key -> type. latched: topics that deliver their newest message first. */
export interface LabOffer {
  readonly topics: Readonly<Record<string, string>>
  readonly services: Readonly<Record<string, string>>
  readonly latched: ReadonlySet<string>
}

export interface Sample {
  readonly key: string
  /** Lab time at which it was published, s; NaN: unknown. */
  readonly stamp: number
}

export class LinkError extends ToldError {
  override readonly name = 'LinkError'
  constructor(
    readonly kind: 'timeout' | 'no_service' | 'not_allowed' | 'lost' | 'refused',
    told: Told,
  ) {
    super(told)
  }
}
