// @vitest-environment jsdom
import { render } from 'preact'
import { expect, test } from 'vitest'
import { RefusalReport } from '../../src/report/refusal'
import type { Diagnostic } from '../../src/words/diagnostic'

test('a file that was refused shows why once, and the points that a teacher gave', () => {
  const why = {
    code: 'x',
    severity: 'error',
    message: 'It is text.',
    remedy: '',
    fixes: [],
    values: {},
    first_row: 0,
  }
  const reason = why as unknown as Diagnostic
  const mark = { of: 2, passed: false, hidden: false, hint: '', time: null, found: reason }
  const tests = [
    { ...mark, name: 'Takes the cube', points: 1 },
    { ...mark, name: 'Ends at home', points: 0 },
  ]
  const marks = { points: 1, of: 4, tests, hints: ['See me'], note: reason }
  const refusal = {
    schema: 'mrlab.refusal.1',
    title: 'Ann: a.mat',
    findings: [reason],
    marks,
  } as const
  render(<RefusalReport refusal={refusal} />, document.body)
  expect(document.querySelector('h1')?.textContent).toBe('It is text.')
  expect([...document.querySelectorAll('th[scope=row]')].map((each) => each.textContent)).toEqual([
    'Takes the cube',
  ])
  expect(document.body.textContent).toContain('See me')
})
