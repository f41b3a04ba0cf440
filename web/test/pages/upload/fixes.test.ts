import { expect, test } from 'vitest'
import { applied, fixLabel, optionLabels } from '../../../src/pages/upload/fixes'
import { de } from '../../../src/words/de'
import { en } from '../../../src/words/en'

test.each([
  ['unwrap', 'true', { unwrap: true }],
  ['invert', 'false', { invert: false }],
  ['frame_rate', '250', { frame_rate: 250 }],
  ['columns', '2:7', { columns: '2:7' }],
  ['units', 'deg', { units: 'deg' }],
])('%s = %s', (option, value, expected) => {
  expect(applied({}, { option, value, matlab: '' })).toEqual(expected)
})

test.each([
  ['', ''],
  ['frame_rate', 'fast'],
  ['frame_rate', ''],
  ['columns', ''],
  ['path', '/etc/passwd'],
  ['owner', 'eve'],
])('no button applies %s = %s', (option, value) => {
  expect(applied({}, { option, value, matlab: '' })).toBeNull()
})

test('other options stay as they are', () => {
  const fix = { option: 'units', value: 'deg', matlab: '' }
  expect(applied({ variable: 'q' }, fix)).toEqual({ variable: 'q', units: 'deg' })
})

test('a button says what it does in each language', () => {
  const fix = { option: 'columns', value: '2:7', matlab: '' }
  expect(fixLabel(fix, en)).toBe('Take the columns 2:7')
  expect(fixLabel(fix, de)).toBe('Die Spalten 2:7 nehmen')
})

test('options that are off are not named', () => {
  expect(optionLabels({ unwrap: true, invert: false, columns: '' }, en)).toEqual([
    'Remove jumps by a full turn',
  ])
})
