import { expect, it } from 'vitest'
import { joined } from '../../../src/report/plot/timeline'

it('draws states that differ in what is loaded alone as one bar, and each run for itself', () => {
  const span = (start: number, label: string, detail = '') => ({
    start,
    end: start + 1,
    label,
    detail,
  })
  const bars = joined([
    span(0, 'IDLE'),
    span(1, 'READY', 'a'),
    span(2, 'READY', 'b'),
    span(3, 'PLAYING', 'b'),
    span(4, 'PLAYING', 'c'),
  ])
  expect(bars.map(({ start, end, label }) => [start, end, label])).toEqual([
    [0, 1, 'IDLE'],
    [1, 3, 'READY'],
    [3, 4, 'PLAYING'],
    [4, 5, 'PLAYING'],
  ])
})
