import { afterEach, beforeEach, describe, expect, test, vi } from 'vitest'
import { RecordKind } from '../../src/link/frames'
import type { Link, LinkStatus } from '../../src/link/link'
import { openLink } from '../../src/link/socket'
import { CdrReader } from '../../src/protocol/cdr'
import {
  objectRemovedReader,
  type Robots,
  robotsReader,
  seekType,
  triggerType,
} from '../../src/protocol/mrlab_msgs'
import { type JointState, jointStateReader } from '../../src/protocol/sensor_msgs'
import {
  jointStatePayload,
  objectRemovedPayload,
  responsePayload,
  robotsPayload,
} from '../protocol/payloads'
import { GatewaySide, TOKEN } from './gateway_side'

const utf8 = new TextEncoder()
let link: Link
let statuses: LinkStatus[]

function joints(value: number): Uint8Array {
  return jointStatePayload(['a'], new Float64Array([value]))
}

beforeEach(() => {
  vi.useFakeTimers({
    toFake: ['setTimeout', 'clearTimeout', 'setInterval', 'clearInterval', 'performance'],
  })
  vi.stubGlobal('WebSocket', { OPEN: 1 })
  GatewaySide.all.length = 0
  statuses = []
  link = openLink('ws://lab/link', {
    open: (url, protocol) => new GatewaySide(url, protocol) as unknown as WebSocket,
    random: () => 1,
  })
  link.onStatus((status) => statuses.push(status))
})

afterEach(() => {
  link.close()
  vi.unstubAllGlobals()
  vi.useRealTimers()
})

describe('messages', () => {
  test('the page asks for its topics, and gives credit for two batches', () => {
    link.subscribe('*/joint_states', jointStateReader, () => {})
    const side = GatewaySide.last.open()
    expect(side.protocol).toBe('mrlab.1')
    expect(side.sent('hello')).toMatchObject({ subscriptions: { 1: '*/joint_states' }, token: '' })
    expect(side.granted).toEqual([2])
    expect(link.status.phase).toBe('open')
  })

  test('a batch is decoded, then the next one may come', () => {
    const got: [string, number, number][] = []
    link.subscribe('*/joint_states', jointStateReader, (message, sample) => {
      expect(side.granted.at(-1)).toBe(2)
      got.push([sample.key, sample.stamp, message.position[0] as number])
    })
    const side = GatewaySide.last.open()
    side.topic(5, 'ur5e_1/joint_states')
    side.topic(6, 'ur5e_2/joint_states')
    side.batch(1, [
      { topic: 5, payload: joints(1) },
      { topic: 6, payload: joints(2) },
    ])
    expect(got).toEqual([
      ['ur5e_1/joint_states', 1.5, 1],
      ['ur5e_2/joint_states', 1.5, 2],
    ])
    expect(side.granted.at(-1)).toBe(3)
  })

  test('a stream reuses its message, a state does not', () => {
    const streams: JointState[] = []
    const states: Robots[] = []
    link.subscribe('a/joint_states', jointStateReader, (message) => streams.push(message))
    link.subscribe('robots', robotsReader, (message) => states.push(message))
    const side = GatewaySide.last.open()
    side.topic(1, 'a/joint_states')
    side.topic(2, 'robots', { latched: true })
    const robots = robotsPayload()
    for (const number of [1, 2]) {
      side.batch(number, [
        { topic: 1, payload: joints(number) },
        { topic: 2, payload: robots },
      ])
    }
    expect(streams[0]).toBe(streams[1])
    expect(states[0]).not.toBe(states[1])
  })

  test('after the end of a subscription nothing comes', () => {
    let count = 0
    const stop = link.subscribe('a/joint_states', jointStateReader, () => count++)
    const side = GatewaySide.last.open()
    side.topic(1, 'a/joint_states')
    stop()
    side.batch(1, [{ topic: 1, payload: joints(1) }])
    expect(count).toBe(0)
    expect(side.sent('unsubscribe')).toEqual({ op: 'unsubscribe', id: 1 })
  })

  test('a message of another type is left out and the rest arrives', () => {
    const complain = vi.spyOn(console, 'error').mockImplementation(() => {})
    let count = 0
    link.subscribe('*/joint_states', jointStateReader, () => count++)
    const side = GatewaySide.last.open()
    side.topic(1, 'a/joint_states')
    side.topic(2, 'b/joint_states')
    side.batch(1, [
      { topic: 1, payload: new Uint8Array([0, 1, 0, 0, 9]) },
      { topic: 2, payload: joints(1) },
    ])
    expect(count).toBe(1)
    expect(complain).toHaveBeenCalledWith(expect.stringContaining('a/joint_states'))
    complain.mockRestore()
  })

  test('a frame that is cut off ends the connection, and another one begins', () => {
    const side = GatewaySide.last.open()
    side.onmessage?.({ data: new Uint8Array([1, 0, 1, 0, 1, 0, 0, 0, 9]).buffer })
    expect(side.closedByPage).toBe(true)
    expect(link.status.phase).toBe('lost')
    vi.advanceTimersByTime(250)
    expect(GatewaySide.all).toHaveLength(2)
  })
})

describe('the lossless channel', () => {
  test('a record in pieces is put together and acknowledged', () => {
    const names: string[] = []
    link.subscribe('objects/removed', objectRemovedReader, ({ name }) => names.push(name))
    const side = GatewaySide.last.open()
    side.topic(3, 'objects/removed', { each: true })
    const name = 'x'.repeat(300)
    const payload = objectRemovedPayload(name)
    side.record(RecordKind.MESSAGE, 3, payload, { size: 100 })
    expect(names).toEqual([name])
    expect(side.received).toEqual([1, 2, 3, 4])
  })

  test('what comes twice after a reconnect counts once', () => {
    const names: string[] = []
    link.subscribe('objects/removed', objectRemovedReader, ({ name }) => names.push(name))
    const event = objectRemovedPayload
    const first = GatewaySide.last.open()
    first.topic(3, 'objects/removed', { each: true })
    first.record(RecordKind.MESSAGE, 3, event('a'))
    first.end()
    vi.advanceTimersByTime(250)
    const second = GatewaySide.last.open({ resumed: true })
    expect(second.sent('hello')).toMatchObject({ token: TOKEN, received: 1 })
    second.record(RecordKind.MESSAGE, 3, event('a'), { from: 1 })
    second.record(RecordKind.MESSAGE, 3, event('b'))
    expect(names).toEqual(['a', 'b'])
  })
})

describe('services', () => {
  test('answers find their requests in any order', async () => {
    const side = GatewaySide.last.open()
    const play = link.call('a/play', triggerType, {})
    const seek = link.call('a/seek', seekType, { position: 2 })
    expect(side.calls.map(({ key }) => key)).toEqual(['a/play', 'a/seek'])
    expect(new CdrReader().open(side.calls[1]?.payload as Uint8Array).float64()).toBe(2)
    side.record(RecordKind.RESPONSE, 2, responsePayload(true, 'seek'))
    side.record(RecordKind.RESPONSE, 1, responsePayload(true, 'play'))
    expect((await play).message).toBe('play')
    expect((await seek).message).toBe('seek')
  })

  test.each([
    [{ code: 'may_not_call', message: 'As a display you may not.', values: { key: 'a/play' } }],
    [undefined],
  ])('an error has its kind and what is to be said of it', async (diagnostic) => {
    const side = GatewaySide.last.open()
    const play = link.call('a/play', triggerType, {})
    const error = { code: 'not_allowed', message: 'your role may not', diagnostic }
    side.record(RecordKind.ERROR, 1, utf8.encode(JSON.stringify(error)))
    await expect(play).rejects.toMatchObject({
      name: 'LinkError',
      kind: 'not_allowed',
      told: diagnostic ?? { code: '', message: 'your role may not' },
    })
  })

  test('without any answer it times out', async () => {
    GatewaySide.last.open()
    const play = link.call('a/play', triggerType, {}, 3)
    const rejected = expect(play).rejects.toMatchObject({ kind: 'timeout' })
    vi.advanceTimersByTime(6000)
    await rejected
  })

  test('a request without an answer is sent again to the same gateway', async () => {
    const first = GatewaySide.last.open()
    const play = link.call('a/play', triggerType, {})
    first.end()
    vi.advanceTimersByTime(250)
    const second = GatewaySide.last.open({ resumed: true })
    expect(second.calls).toMatchObject([{ key: 'a/play', request: 1 }])
    second.record(RecordKind.RESPONSE, 1, responsePayload(true, ''))
    expect((await play).success).toBe(true)
  })

  test('another gateway gets what was never sent, and nothing that was', async () => {
    const first = GatewaySide.last.open()
    const sent = link.call('a/play', triggerType, {})
    const lost = expect(sent).rejects.toMatchObject({ kind: 'lost' })
    first.end()
    link.call('a/stop', triggerType, {}).catch(() => {})
    vi.advanceTimersByTime(250)
    const second = GatewaySide.last.open({ token: 'token-2' })
    await lost
    expect(second.calls.map(({ key }) => key)).toEqual(['a/stop'])
  })
})

describe('the connection', () => {
  test('silence is noticed within 5 s and what the lab offered is cleared', () => {
    const side = GatewaySide.last.open()
    side.text({ op: 'lab', phase: 'open', topics: { robots: 'x' }, services: {}, latched: [] })
    expect(link.offer.topics).toEqual({ robots: 'x' })
    vi.advanceTimersByTime(5000)
    expect(link.status.phase).toBe('lost')
    expect(link.offer.topics).toEqual({})
    expect(side.closedByPage).toBe(true)
  })

  test('a handshake of 6 s connects at the second attempt', () => {
    const shake = () => {
      const side = GatewaySide.last
      setTimeout(() => !side.closedByPage && side.open(), 6000)
    }
    shake()
    vi.advanceTimersByTime(5250)
    expect(GatewaySide.all).toHaveLength(2)
    expect(link.status.phase).toBe('lost')
    shake()
    vi.advanceTimersByTime(6000)
    expect(GatewaySide.all).toHaveLength(2)
    expect(link.status.phase).toBe('open')
  })

  test('a page that stood still itself does not take that for silence', () => {
    const side = GatewaySide.last.open()
    vi.advanceTimersByTime(3000)
    const { now } = performance
    vi.spyOn(performance, 'now').mockImplementation(() => now.call(performance) + 6000)
    vi.advanceTimersByTime(1000)
    expect(link.status.phase).toBe('open')
    expect(side.closedByPage).toBe(false)
    vi.advanceTimersByTime(5000)
    expect(link.status.phase).toBe('lost')
    vi.restoreAllMocks()
  })

  test('pongs keep it alive and give the lab time', () => {
    const side = GatewaySide.last.open()
    for (let i = 0; i < 20; i++) {
      const asked = side.sent('ping')?.asked as number
      side.text({ op: 'pong', asked, came: asked + 100, answered: asked + 100 })
      vi.advanceTimersByTime(1000)
    }
    expect(link.status.phase).toBe('open')
    const own = (performance.timeOrigin + performance.now()) / 1000
    expect(link.labTime() - own).toBeCloseTo(100, 3)
    expect(link.status.roundTrip).toBeCloseTo(0, 3)
  })

  test.each([-600, 600])('it asks for the time at once after a step of %i s', (step) => {
    link.subscribe('*/joint_states', jointStateReader, () => {})
    const side = GatewaySide.last.open()
    side.topic(7, 'a/joint_states')
    let ahead = 0
    const own = () => (performance.timeOrigin + performance.now()) / 1000
    const message = () => side.batch(1, [{ topic: 7, payload: joints(1), stamp: own() + ahead }])
    const pings = () => side.texts.filter(({ op }) => op === 'ping').length
    const answer = () => {
      const asked = side.sent('ping')?.asked as number
      side.text({ op: 'pong', asked, came: asked + ahead, answered: asked + ahead })
    }
    answer()
    const before = pings()
    message()
    expect(pings()).toBe(before)
    ahead = step
    message()
    message()
    expect(pings(), 'one question until it is answered').toBe(before + 1)
    answer()
    expect(link.labTime() - own()).toBeCloseTo(step, 3)
    message()
    expect(pings()).toBe(before + 1)
  })

  test('attempts grow apart, and a success begins anew', () => {
    for (const wait of [250, 500, 1000, 2000, 4000, 8000, 8000]) {
      GatewaySide.last.end()
      vi.advanceTimersByTime(wait - 1)
      const before = GatewaySide.all.length
      vi.advanceTimersByTime(1)
      expect(GatewaySide.all.length).toBe(before + 1)
    }
    GatewaySide.last.open().end()
    vi.advanceTimersByTime(250)
    expect(GatewaySide.all).toHaveLength(9)
  })

  test('what an old socket does late concerns nobody', () => {
    const first = GatewaySide.last.open()
    first.end()
    vi.advanceTimersByTime(250)
    GatewaySide.last.open({ resumed: true })
    first.end(4003, 'late')
    first.text({ op: 'lab', phase: 'lost', topics: {}, services: {}, latched: [] })
    expect(link.status.phase).toBe('open')
  })

  test.each([4001, 4003, 4029])('a close with %i is for good and says why', (code) => {
    const rejected = expect(link.call('a/play', triggerType, {})).rejects.toMatchObject({
      kind: 'lost',
    })
    GatewaySide.last.open().end(code, 'reload the page')
    vi.advanceTimersByTime(60_000)
    expect(GatewaySide.all).toHaveLength(1)
    expect(link.status).toMatchObject({ phase: 'refused', reason: 'reload the page' })
    return rejected
  })

  test('a gateway says in a frame why it closes, where it has more room', () => {
    const side = GatewaySide.last.open()
    const diagnostic = { code: 'x', message: 'Nobody is in.', remedy: 'Sign in.', values: {} }
    side.text({ op: 'closing', code: 4003, diagnostic })
    side.end(4003, 'Nobody is')
    expect(link.status).toMatchObject({ phase: 'refused', reason: 'Nobody is in. Sign in.' })
  })

  test('a gateway without its lab says so', () => {
    GatewaySide.last.open({ lab: 'lost' })
    expect(link.status).toMatchObject({ phase: 'lost' })
    expect(link.status.reason).toContain('the lab is not')
    GatewaySide.last.text({ op: 'lab', phase: 'open', topics: {}, services: {}, latched: [] })
    expect(link.status.phase).toBe('open')
    expect(statuses.map(({ phase }) => phase)).toEqual(['lost', 'open'])
  })
})

describe('a hidden page', () => {
  let visibility = 'visible'
  const listeners = new Set<() => void>()

  beforeEach(() => {
    link.close()
    visibility = 'visible'
    vi.stubGlobal('document', {
      get visibilityState() {
        return visibility
      },
      addEventListener: (_: string, listener: () => void) => listeners.add(listener),
      removeEventListener: (_: string, listener: () => void) => listeners.delete(listener),
    })
    link = openLink('ws://lab/link', {
      open: (url, protocol) => new GatewaySide(url, protocol) as unknown as WebSocket,
    })
  })

  function show(state: string): void {
    visibility = state
    for (const listener of listeners) listener()
  }

  test('gives no credit, and takes a snapshot when it is seen again', () => {
    const side = GatewaySide.last.open()
    show('hidden')
    side.batch(1, [])
    side.batch(2, [])
    expect(side.granted).toEqual([2])
    expect(side.sent('hidden')).toBeDefined()
    vi.advanceTimersByTime(60_000)
    expect(link.status.phase).toBe('open')
    show('visible')
    expect(side.granted).toEqual([2, 4])
  })
})
