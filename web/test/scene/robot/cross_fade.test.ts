import { expect, test } from 'vitest'
import { CrossFade } from '../../../src/scene/robot/cross_fade'

const steps = (fade: CrossFade, ...seen: (readonly [distance: number, now: number])[]) =>
  seen.map(([distance, now]) => [fade.step(distance, now), Math.round(fade.share * 1000) / 1000])

const fading = (seconds = 0.25) => new CrossFade(4, 0.1, () => seconds)

test('what is far at first is far at once', () => {
  expect(steps(fading(), [5, 0], [5, 0.016])).toEqual([
    [false, 1],
    [false, 1],
  ])
})

test('both are shown while one dissolves into the other, and no longer', () => {
  expect(steps(fading(), [3, 0], [4, 1], [4.5, 1.1], [9, 1.25], [9, 60])).toEqual([
    [false, 0],
    [true, 0],
    [true, 0.4],
    [false, 1],
    [false, 1],
  ])
})

test('at the border it stays as it was', () => {
  const seen = [3, 3.9, 4.1, 3.7, 3.61, 3.59, 3.7, 3.99]
  const fade = fading(0)
  const shares = seen.map((distance, i) => {
    fade.step(distance, i)
    return fade.share
  })
  expect(shares).toEqual([0, 0, 1, 1, 1, 0, 0, 0])
})

test('one that turns back goes on from where it is', () => {
  const fade = fading()
  expect(steps(fade, [3, 0], [5, 1], [5, 1.1], [3, 1.1], [3, 1.15], [3, 1.21])).toEqual([
    [false, 0],
    [true, 0],
    [true, 0.4],
    [true, 0.4],
    [true, 0.2],
    [false, 0],
  ])
})

test('a machine that draws a picture a second shows both in one picture', () => {
  expect(steps(fading(), [3, 0], [5, 1], [5, 2])).toEqual([
    [false, 0],
    [true, 0],
    [false, 1],
  ])
})

test('it can be ended, and asked to change at once', () => {
  const fade = fading()
  steps(fade, [3, 0], [5, 1])
  fade.end()
  expect(fade.share).toBe(1)
  expect(steps(fade, [5, 1.01])).toEqual([[false, 1]])
  expect(steps(fading(0), [3, 0], [5, 1])).toEqual([
    [false, 0],
    [false, 1],
  ])
})
