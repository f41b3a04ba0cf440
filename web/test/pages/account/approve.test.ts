// @vitest-environment jsdom
import { expect, test } from 'vitest'
import { codeForm } from '../../../src/pages/account/approve'

test.each([
  ['BJVDMXDW', 'BJVD-MXDW'],
  ['bjvd mxdw', 'BJVD-MXDW'],
  ['BJVD-MXDW', 'BJVD-MXDW'],
  ['BJVD-M', 'BJVD-M'],
  ['', ''],
])('the code %s is shown as %s', (text, shown) => {
  expect(codeForm(text)).toBe(shown)
})
