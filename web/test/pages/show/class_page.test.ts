import { describe, expect, it } from 'vitest'
import { isShown, order, type RowFacts } from '../../../src/pages/show/class_page'

const ROW: RowFacts = {
  name: 'doe, jane 12345',
  lost: false,
  checked: true,
  late: false,
  alike: false,
}

describe('rows of a class', () => {
  it.each([
    ['', '', true],
    ['jane', '', true],
    ['123', '', true],
    ['max', '', false],
    ['', 'lost', false],
    ['', 'unchecked', false],
    ['', 'late', false],
    ['', 'alike', false],
  ] as const)('a row with all points, for %j and %j: %j', (text, filter, shown) => {
    expect(isShown(ROW, text, filter)).toBe(shown)
  })

  it.each(['lost', 'unchecked', 'late', 'alike'] as const)('shows who is %s', (filter) => {
    const row = { ...ROW, lost: true, checked: false, late: true, alike: true }
    expect(isShown(row, '', filter)).toBe(true)
    expect(isShown(row, 'max', filter)).toBe(false)
  })

  it('sorts numbers as numbers, names by their language, and leaves equal ones in place', () => {
    expect(order([10, 9, 9.5, 9], true)).toEqual([0, 2, 1, 3])
    expect(order([10, 9, 9.5, 9], false)).toEqual([1, 3, 2, 0])
    expect(order(['zoe', 'änne', 'bert', 'run 10', 'run 9'], false)).toEqual([1, 2, 4, 3, 0])
  })
})
