import { expect, test } from 'vitest'
import { applied, fixLabel, optionLabels, robotMatters } from '../../../src/pages/motion/fixes'
import { words as de } from '../../../src/words/de'
import { en } from '../../../src/words/en'
import { finding } from '../../fake_api'

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

test.each([
  ['q(1:90, :)', 'Keep rows 1 to 90', 'Zeilen 1 bis 90 behalten'],
  ['q(:, 1:90)', 'Keep rows 1 to 90', 'Zeilen 1 bis 90 behalten'],
  ['s.q([1:89 91:201], :)', 'Leave out row 90', 'Zeile 90 weglassen'],
  ['q([1 3:89 93:201], :)', 'Leave out rows 2, 90 to 92', 'Zeilen 2, 90 bis 92 weglassen'],
  ['q(:, 2:7)', 'Keep rows 2 to 7', 'Zeilen 2 bis 7 behalten'],
])('a part of a matrix, %s, is said by its rows', (value, english, german) => {
  const fix = { option: 'variable', value, matlab: '' }
  expect(fixLabel(fix, en)).toBe(english)
  expect(fixLabel(fix, de)).toBe(german)
})

test('options that are off are not named', () => {
  expect(optionLabels({ unwrap: true, invert: false, columns: '' }, en)).toEqual([
    'Remove jumps by a full turn',
  ])
})

test('a unit has its name in a label, never the word of the option', () => {
  for (const words of [en, de]) {
    const labels = ['deg', 'rad', 'counts:4096'].map((value) =>
      fixLabel({ option: 'units', value, matlab: '' }, words),
    )
    for (const label of labels) expect(label).not.toMatch(/\b(deg|rad)\b|counts:/)
    expect(labels[2]).toContain('4096')
  }
})

test('another robot is offered only where it could help', () => {
  const result = (code: string, outcome: 'rejected' | 'accepted' = 'rejected') => ({
    outcome,
    code: '',
    message: '',
    diagnostics: [finding({ code })],
    candidates: [],
    trajectory: null,
    draft: null,
    motion: null,
  })
  expect(robotMatters(result('unsupported_format'))).toBe(false)
  expect(robotMatters(result('wrong_shape'))).toBe(true)
  expect(robotMatters(result('unsupported_format', 'accepted'))).toBe(true)
})
