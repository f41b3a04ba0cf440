import { expect, test } from 'vitest'
import { positionAt } from '../../src/playback/clock'

test('a clock at half speed moves half a second a second', () => {
  expect(positionAt({ stamp: 10, position: 2, rate: 0.5 }, 13)).toBe(3.5)
})

test('a clock whose stamp lies ahead stands until then', () => {
  expect(positionAt({ stamp: 10, position: 2, rate: 1 }, 9)).toBe(2)
})
