import { expect, test } from 'vitest'
import { changeAt, Track, within } from '../../src/playback/track'

function packed(values: number[], shape: number[]) {
  const bytes = new Uint8Array(Float32Array.from(values).buffer)
  return { dtype: 'float32' as const, shape, data: btoa(String.fromCharCode(...bytes)) }
}

const track = new Track({
  times: packed([1, 2, 4], [3]),
  values: packed([0, 10, 1, 20, 3, 40], [3, 2]),
})

test('values are linear between samples and hold at the ends', () => {
  const into = new Float64Array(2)
  for (const [time, ...expected] of [
    [0, 0, 10],
    [1.5, 0.5, 15],
    [3, 2, 30],
    [9, 3, 40],
    [2, 1, 20],
    [1, 0, 10],
  ]) {
    track.sample(time as number, into)
    expect([...into]).toEqual(expected)
  }
})

test('an empty track leaves what is there', () => {
  const empty = new Track({ times: packed([], [0]), values: packed([], [0, 0]) })
  const into = Float64Array.of(7)
  empty.sample(1, into)
  expect(into[0]).toBe(7)
})

test('a change holds until the next', () => {
  const changes = [
    [1, 'a'],
    [3, 'b'],
  ] as const
  expect(changeAt(changes, 0.5)).toBe('')
  expect(changeAt(changes, 1)).toBe('a')
  expect(changeAt(changes, 9)).toBe('b')
})

test('a robot is there within its spans, and always where nothing says', () => {
  const spans = [
    [0, 7],
    [9, null],
  ] as const
  expect([0, 6.9, 7, 8.9, 9, 1e6].map((time) => within(spans, time))).toEqual([
    true,
    true,
    false,
    false,
    true,
    true,
  ])
  expect(within([], 3)).toBe(true)
})
