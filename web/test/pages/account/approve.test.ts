// @vitest-environment jsdom
import { expect, test } from 'vitest'
import { codeForm, proposedRole } from '../../../src/pages/account/approve'

test.each([
  ['BJVDMXDW', 'BJVD-MXDW'],
  ['bjvd mxdw', 'BJVD-MXDW'],
  ['BJVD-MXDW', 'BJVD-MXDW'],
  ['BJVD-M', 'BJVD-M'],
  ['', ''],
])('the code %s is shown as %s', (text, shown) => {
  expect(codeForm(text)).toBe(shown)
})

test.each([
  ['instructor', true, 'operator'],
  ['student', true, 'student'],
  ['instructor', false, 'student'],
  ['display', false, 'display'],
] as const)('proposes to an %s, for a program %s, the role %s', (own, program, proposed) => {
  expect(proposedRole(own, program)).toBe(proposed)
})
