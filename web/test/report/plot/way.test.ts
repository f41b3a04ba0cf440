import { expect, test } from 'vitest'
import { alongWay, wayOf } from '../../../src/report/plot/way'

// as test/unit/classroom/marks/test_ways.py has it
const WAY = wayOf('?gEaJA?qDA_N_H', 1)

test('a way is read as it was written', () => {
  expect(WAY).toEqual([
    [100, 177, 0],
    [100, 266, 0.5],
    [340, 410, 1],
  ])
  expect(wayOf('', 1)).toEqual([])
})

test('an instant is between the points of a way', () => {
  expect(alongWay(WAY, 0)).toEqual([100, 177, 0])
  expect(alongWay(WAY, 0.75)).toEqual([220, 338, 0.75])
  expect(alongWay(WAY, 2)).toEqual([340, 410, 2])
})
