// @vitest-environment jsdom
import { describe, expect, it } from 'vitest'
import { lasting, moments, roundStep, ticks } from '../../../src/report/plot/axis'

const texts = (begin: number, end: number, most: number) =>
  moments(begin, end, most).map(([, text]) => text)

describe('axes', () => {
  it('marks round numbers', () => {
    expect(ticks(-1, 1, 3)).toEqual([-1, 0, 1])
    expect(ticks(0.07, 0.31, 3)).toEqual([0.1, 0.2, expect.closeTo(0.3)])
    expect(ticks(5, 5)).toEqual([5])
    expect(roundStep(0.0021)).toBeCloseTo(0.0025)
  })

  it('says seconds of what is short, minutes and hours of what is long', () => {
    expect(texts(2, 4, 4)).toEqual(['2 s', '2.5', '3', '3.5', '4'])
    expect(texts(0, 150, 6)).toEqual(['0:00 min', '0:30', '1:00', '1:30', '2:00', '2:30'])
    expect(texts(0, 7200, 3)).toEqual(['0:00:00 h', '1:00:00', '2:00:00'])
  })

  it('says how long something took', () => {
    expect([7.6, 125.4, 3725].map(lasting)).toEqual(['7.60 s', '2:05 min', '1:02:05 h'])
  })
})
