import { describe, expect, test } from 'vitest'
import { CdrError, CdrReader } from '../../src/protocol/cdr'
import { PlaybackState, playbackStateReader } from '../../src/protocol/mrlab_msgs'
import { jointStateReader } from '../../src/protocol/sensor_msgs'
import { jointStatePayload } from './payloads'

const NAMES = ['shoulder', 'elbow', 'grün']
const payload = jointStatePayload(NAMES, new Float64Array([1.5, -2.25, 3]))

/** Return a payload at an offset into a buffer. */
function at(offset: number, payload: Uint8Array): Uint8Array {
  const whole = new Uint8Array(offset + payload.length)
  whole.set(payload, offset)
  return whole.subarray(offset)
}

describe('joint states', () => {
  test('at 4 mod 8 positions are a view, elsewhere a copy', () => {
    const aligned = at(4, payload)
    expect(jointStateReader.decode(aligned).position.buffer).toBe(aligned.buffer)
    const odd = at(3, payload)
    const copied = jointStateReader.decode(odd)
    expect(copied.position.buffer).not.toBe(odd.buffer)
    expect([...copied.position]).toEqual([1.5, -2.25, 3])
  })

  test('the same joints decode into the same names and arrays', () => {
    const kept = jointStateReader.decode(at(3, payload))
    const { name, position } = kept
    const before = [...name]
    const next = jointStatePayload(NAMES, new Float64Array([7, 8, 9]))
    jointStateReader.decode(at(4, next), kept)
    expect(kept.name).toBe(name)
    expect(kept.name).toEqual(before)
    expect(kept.position).toBe(position)
    expect([...kept.position]).toEqual([7, 8, 9])
  })

  test('many positions are copied in one go', () => {
    const many = new Float64Array(500).map((_, i) => i / 7)
    const long = jointStatePayload(NAMES, many)
    const kept = jointStateReader.create({ position: new Float64Array(500) })
    const { position } = kept
    jointStateReader.decode(at(4, long), kept)
    expect(kept.position).toBe(position)
    expect(kept.position).toEqual(many)
  })
})

test('big-endian numbers are read', () => {
  const bytes = new Uint8Array(12)
  new DataView(bytes.buffer).setFloat64(4, 1.5)
  expect(new CdrReader().open(bytes).float64()).toBe(1.5)
})

test('bytes behind the last field are left out', () => {
  const longer = new Uint8Array(payload.length + 8)
  longer.set(payload)
  expect(jointStateReader.decode(longer).name).toEqual(NAMES)
})

test('constants stand beside the interface', () => {
  const state: PlaybackState = playbackStateReader.create({ state: PlaybackState.PAUSED })
  expect(state.state).toBe(4)
})

describe('what is no message', () => {
  test('every cut is an error that names the type', () => {
    for (let length = 0; length < payload.length; length++) {
      expect(() => jointStateReader.decode(payload.slice(0, length))).toThrow(CdrError)
    }
    expect(() => jointStateReader.decode(payload.slice(0, 30))).toThrow(
      /30 bytes are no sensor_msgs\/msg\/JointState/,
    )
  })

  test('a length beyond the payload allocates nothing', () => {
    const wrong = payload.slice()
    new DataView(wrong.buffer).setUint32(20, 0xffffffff, true)
    expect(() => jointStateReader.decode(wrong)).toThrow(/cut off, or of another type/)
  })

  test('another header is named', () => {
    expect(() => jointStateReader.decode(new Uint8Array(12).fill(3))).toThrow(/begins with 3 3/)
  })
})
