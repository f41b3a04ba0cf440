import { expect, test } from 'vitest'
import { instantOf } from '../../src/report/instant'

test('a fragment with an instant opens the page there, any other one does not', () => {
  expect(instantOf('#t=3.2', 7.6)).toBe(3.2)
  expect(instantOf('#t=99', 7.6)).toBe(7.6)
  for (const other of ['', '#', '#t=', '#t=-1', '#t=1e3', '#findings']) {
    expect(instantOf(other, 7.6)).toBeNull()
  }
})
