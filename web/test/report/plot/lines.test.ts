// @vitest-environment jsdom
import { describe, expect, it } from 'vitest'
import { envelope, indexAt, polylines } from '../../../src/report/plot/lines'
import { amount, spanOf } from '../../../src/report/plot/strip_plot'

const strip = (values: number[], lower: number | null = null, upper: number | null = null) => ({
  label: 'a',
  unit: '°',
  values: Float64Array.from(values),
  compared: null,
  lower,
  upper,
  colour: 0,
})

describe('lines of a plot', () => {
  it('keep the peaks of many values', () => {
    const values = Float64Array.from({ length: 100_000 }, (_, i) => Math.sin(i / 1000))
    values[54_321] = 9
    const kept = envelope(values)
    expect(kept.length).toBeLessThan(600)
    expect(kept).toContain(54_321)
    expect([kept[0], kept.at(-1)]).toEqual([0, 99_999])
  })

  it('begin anew after a gap', () => {
    const values = [1, 2, Number.NaN, 4]
    const lines = polylines(
      envelope(values),
      (i) => i,
      (i) => values[i] ?? 0,
    )
    expect(lines).toEqual(['0.0,1.0 1.0,2.0', '3.0,4.0'])
  })

  it('are read at the last sample that is not later', () => {
    expect([0, 1, 1.5, 9].map((time) => indexAt([1, 2, 3], time))).toEqual([0, 0, 0, 2])
  })
})

describe('the range of a plot', () => {
  it('has a limit that is near and no far one', () => {
    const [low, high] = spanOf(strip([0, 100], -500, 120))
    expect(high).toBeGreaterThan(120)
    expect(low).toBeGreaterThan(-20)
  })

  it('shows what rests in the middle, without trembling', () => {
    const [low, high] = spanOf(strip([90, 90.0001]))
    expect(high - low).toBeGreaterThanOrEqual(10)
    expect((low + high) / 2).toBeCloseTo(90, 1)
  })

  it('is something where nothing is known', () => {
    expect(spanOf(strip([Number.NaN]))).toEqual([0, 1])
  })

  it('says a value with its unit', () => {
    expect([amount(12.34, '°'), amount(0.5, 'm/s'), amount(Number.NaN, 'mm')]).toEqual([
      '12.3°',
      '0.50 m/s',
      '–',
    ])
  })
})
