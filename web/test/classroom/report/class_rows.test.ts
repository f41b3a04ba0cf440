import { describe, expect, it } from 'vitest'
import type { ClassStudent } from '../../../src/classroom/class_document'
import { isShown, sorted } from '../../../src/classroom/report/class_rows'

const said = { code: '', message: '' } as ClassStudent['said']
const mark = (points: number, passed = false) => ({ points, passed, time: null, found: said })

function row(change: Partial<ClassStudent>): ClassStudent {
  return {
    key: 'a',
    name: 'Doe, Jane',
    identifier: '12345',
    file: 'run.mat',
    late: false,
    marked: true,
    points: 1,
    of: 1,
    duration: 1,
    marks: [mark(1, true)],
    notes: [],
    page: null,
    path: '',
    said,
    ...change,
  }
}

const NOBODY: ReadonlySet<string> = new Set()

describe('rows of a class', () => {
  it.each([
    ['', '', true],
    [' Jane ', '', true],
    ['123', '', true],
    ['max', '', false],
    ['', 'lost', false],
    ['', 'unchecked', false],
    ['', 'late', false],
    ['', 'alike', false],
  ] as const)('a row with all points, for %j and %j: %j', (text, filter, shown) => {
    expect(isShown(row({}), text, filter, NOBODY)).toBe(shown)
  })

  it.each(['lost', 'unchecked', 'late', 'alike'] as const)('shows who is %s', (filter) => {
    const one = row({ marks: [mark(0)], marked: false, late: true })
    expect(isShown(one, '', filter, new Set(['a']))).toBe(true)
    expect(isShown(one, 'max', filter, new Set(['a']))).toBe(false)
  })

  it('sorts points as numbers, names by their language, and leaves equal ones in place', () => {
    const keys = (rows: readonly ClassStudent[]) => rows.map(({ key }) => key).join('')
    const points = [10, 9, 9.5, 9].map((value, i) =>
      row({ key: 'abcd'[i] ?? '', points: value, marks: [mark(-value)] }),
    )
    expect(keys(sorted(points, 'points', true))).toBe('acbd')
    expect(keys(sorted(points, 'points', false))).toBe('bdca')
    expect(keys(sorted(points, 0, false))).toBe('acbd')
    const names = ['zoe', 'änne', 'bert', 'run 10', 'run 9'].map((name, i) =>
      row({ key: 'abcde'[i] ?? '', name }),
    )
    expect(keys(sorted(names, 'name', false))).toBe('bceda')
  })
})
