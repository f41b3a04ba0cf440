import { describe, expect, it } from 'vitest'
import type { PackedArray } from '../../src/playback/motion'
import { type CheckFacts, distancesOf } from '../../src/report/check'

function packed(values: number[]): PackedArray {
  const bytes = new Uint8Array(Float64Array.from(values).buffer)
  return { dtype: 'float64', shape: [values.length], data: btoa(String.fromCharCode(...bytes)) }
}

const distance = (other: string) => ({
  robot: 'ur5e_1',
  part: 'wrist',
  kind: 'object',
  other,
  other_link: '',
  times: packed([0, 1]),
  values: packed([0.2, 0]),
})

describe('the plots of a check', () => {
  it('mark a collision in the curve of what is touched', () => {
    const touched = { robot: 'ur5e_1', kind: 'object', other: 'can_10', time: 1, end: null }
    const findings = [{ ...touched, severity: 'error' }] as unknown as CheckFacts['findings']
    const strips = distancesOf({
      distances: [distance('can_1'), distance('can_10')],
      findings,
      robots: [],
    })
    expect(strips.map(({ strip, marks }) => [strip.label, marks.length])).toEqual([
      ['Wrist to can_1', 0],
      ['Wrist to can_10', 1],
    ])
    expect([...(strips[0]?.strip.values ?? [])]).toEqual([200, 0])
  })
})
