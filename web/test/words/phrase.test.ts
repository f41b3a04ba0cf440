// @vitest-environment jsdom
import { expect, test } from 'vitest'
import cases from '../../../test/unit/core/base/phrases.json'
import { fill, parse } from '../../src/words/phrase'
import { setLanguage } from '../../src/words/words'

const JOINING = {
  de: {
    and: 'und',
    or: 'oder',
    row: 'Zeile',
    rows: (a: string, b: string) => `Zeilen ${a} bis ${b}`,
    states: { PLAYING: 'läuft' },
  },
  en: {
    and: 'and',
    or: 'or',
    row: 'row',
    rows: (a: string, b: string) => `rows ${a} to ${b}`,
    states: {},
  },
} as const

for (const language of ['de', 'en'] as const) {
  test.each(cases)(`${language}: $template`, async (each) => {
    await setLanguage(language, false)
    const values = each.values as Record<string, unknown>
    expect(fill(parse(each.template), values, JOINING[language], String)).toBe(each[language])
    const wire = Object.entries(values).map(([name, value]) => [
      name,
      typeof value === 'string' ? value : JSON.stringify(value),
    ])
    expect(fill(parse(each.template), Object.fromEntries(wire), JOINING[language], String)).toBe(
      each[language],
    )
  })
}

test.each(['a]', '[a'])('%s is no template', (template) => {
  expect(() => parse(template)).toThrow()
})
