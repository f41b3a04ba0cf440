import type { MessageReader } from '../protocol/message_type'
import type { Sample, Unsubscribe } from './link'

interface Subscription {
  readonly number: number
  readonly expression: string
  readonly pattern: RegExp
  readonly type: MessageReader<unknown>
  readonly listener: (message: unknown, sample: Sample) => void
}

/** A topic as the gateway announced it. */
interface Topic {
  readonly key: string
  /** Messages of a stream reuse one object; those of states and events are the listeners' own. */
  readonly reuses: boolean
  readonly sample: { readonly key: string; stamp: number }
  kinds: Kind[]
}

/** The listeners of a topic that want one type: a message is decoded once for them. */
interface Kind {
  readonly type: MessageReader<unknown>
  message: unknown
  readonly listeners: Subscription['listener'][]
}

/** The subscriptions of a page, and the topics that the gateway numbers. */
export class Topics {
  private readonly subscriptions = new Map<number, Subscription>()
  private readonly byNumber = new Map<number, Topic>()
  private next = 1

  /** changed: called when a subscription begins (with its key expression) or ends (null). */
  constructor(
    private readonly changed: (number: number, expression: string | null) => void,
    private readonly failed: (key: string, error: Error) => void,
  ) {}

  subscribe<T>(
    expression: string,
    type: MessageReader<T>,
    listener: (message: T, sample: Sample) => void,
  ): Unsubscribe {
    const number = this.next++
    this.subscriptions.set(number, {
      number,
      expression,
      pattern: patternOf(expression),
      type: type as MessageReader<unknown>,
      listener: listener as Subscription['listener'],
    })
    this.route()
    this.changed(number, expression)
    return () => {
      if (!this.subscriptions.delete(number)) return
      this.route()
      this.changed(number, null)
    }
  }

  /** The subscriptions, number -> key expression. */
  get wanted(): Record<string, string> {
    const wanted: Record<string, string> = {}
    for (const each of this.subscriptions.values()) wanted[each.number] = each.expression
    return wanted
  }

  announce(number: number, key: string, reuses: boolean): void {
    const topic: Topic = { key, reuses, sample: { key, stamp: Number.NaN }, kinds: [] }
    this.byNumber.set(number, topic)
    this.routeOne(topic)
  }

  /** Decode a message and give it to its listeners; one of an unknown topic is left out. */
  deliver(number: number, stamp: number, bytes: Uint8Array, start: number, end: number): void {
    const topic = this.byNumber.get(number)
    if (topic === undefined) return
    topic.sample.stamp = stamp
    for (const kind of topic.kinds) {
      let message: unknown
      try {
        message = kind.type.decode(bytes, topic.reuses ? kind.message : undefined, start, end)
      } catch (error) {
        this.failed(topic.key, error as Error)
        continue
      }
      if (topic.reuses) kind.message = message
      for (const listener of kind.listeners) listener(message, topic.sample)
    }
  }

  /** Forget the topics: another gateway has other numbers. */
  forget(): void {
    this.byNumber.clear()
  }

  private route(): void {
    for (const topic of this.byNumber.values()) this.routeOne(topic)
  }

  private routeOne(topic: Topic): void {
    const kinds: Kind[] = []
    for (const { pattern, type, listener } of this.subscriptions.values()) {
      if (!pattern.test(`/${topic.key}`)) continue
      const kind = kinds.find((each) => each.type === type)
      if (kind !== undefined) kind.listeners.push(listener)
      else kinds.push({ type, message: undefined, listeners: [listener] })
    }
    topic.kinds = kinds
  }
}

/** Return the pattern of a key expression, for keys with a leading slash: `*` is one part, `**`
 * any. */
export function patternOf(expression: string): RegExp {
  const parts = expression.split('/').map((part) => {
    if (part === '*') return '/[^/]+'
    return part === '**' ? '(?:/[^/]+)*' : `/${part.replace(/[.*+?^${}()|[\]\\]/g, '\\$&')}`
  })
  return new RegExp(`^${parts.join('')}$`)
}
