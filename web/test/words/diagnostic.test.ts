// @vitest-environment jsdom
import { afterEach, describe, expect, test } from 'vitest'
import { say, sentence, spoken, type Told, ToldError } from '../../src/words/diagnostic'
import { parse, placeholders } from '../../src/words/phrase'
import { type LanguageFile, languageName, languages, setLanguage } from '../../src/words/words'
import codes from './codes.json'

interface Declared {
  readonly text: string
  readonly remedy: string
  readonly values: Readonly<Record<string, unknown>>
  readonly en: readonly string[]
}

const CODES = codes as unknown as Readonly<Record<string, Declared>>
const FILES = import.meta.glob<LanguageFile>(['../../src/words/??.ts', '!../../src/words/en.ts'], {
  eager: true,
})

/** Return the placeholders of a template, such as `rows:rows`; the words of a choice by their
 * keys. */
function placesOf(template: string): readonly string[] {
  const found = placeholders(parse(template)).map(({ name, quantity, words }) => {
    const keys = quantity === 'choice' ? words.map((word) => word.replace(/=.*/, '')) : []
    return [name, quantity, ...keys.sort()].join(':')
  })
  return [...new Set(found)].sort()
}

/** Return the values as messages carry them: texts as they are, all else as JSON. */
function onTheWire(values: Declared['values']) {
  return Object.entries(values).map(([key, value]) => ({
    key,
    value: typeof value === 'string' ? value : JSON.stringify(value),
  }))
}

function toldOf(code: string, { values, en: [message = '', remedy = ''] }: Declared): Told {
  return { code, message, remedy, values }
}

afterEach(() => setLanguage('en', false))

test('English is said as it came', () => {
  for (const [code, declared] of Object.entries(CODES)) {
    const { message, remedy } = say(toldOf(code, declared))
    expect([message, remedy], code).toEqual(declared.en)
  }
})

test.each(Object.entries(FILES))('%s names no code and no value that is not there', (_, file) => {
  for (const [code, [text, remedy = '']] of Object.entries(file.diagnostics)) {
    const declared = CODES[code]
    expect(declared, `${code} is no code of the lab`).toBeDefined()
    if (declared === undefined) continue
    expect(placesOf(text), code).toEqual(placesOf(declared.text))
    expect(placesOf(remedy), code).toEqual(placesOf(declared.remedy))
    expect(remedy === '', `${code}: the remedy`).toBe(declared.remedy === '')
  }
})

test.each(Object.entries(FILES))(
  '%s says every code that it has, in its words',
  async (path, file) => {
    await setLanguage(path.slice(-5, -3), false)
    for (const [code, [text, remedy = '']] of Object.entries(file.diagnostics)) {
      const declared = CODES[code]
      if (declared === undefined) continue
      const told = toldOf(code, declared)
      const said = say(told)
      expect(said.message, code).not.toBe('')
      const all = `${said.message}${said.remedy}`
      expect(all, code).not.toMatch(/undefined|\[object/)
      if (!/\{\{|\}\}/.test(`${text}${remedy}`)) expect(all, code).not.toMatch(/[{}]/)
      if (!text.includes('NaN')) expect(said.message, code).not.toMatch(/NaN/)
      // a text of values alone, such as `{topic}: {joints:list}`, is the same in each language
      if (text !== declared.text) expect(said.message, code).not.toBe(told.message)
      expect(say({ ...told, values: onTheWire(declared.values) }), code).toEqual(said)
    }
  },
)

test.each(Object.entries(FILES))('%s has every code', (_, file) => {
  const missing = Object.keys(CODES).filter((code) => !Object.hasOwn(file.diagnostics, code))
  expect(missing).toEqual([])
})

test('a language is found by its file', () => {
  expect(languages()).toEqual(['en', ...Object.keys(FILES).map((path) => path.slice(-5, -3))])
  expect(languages().map(languageName)).toContain('Deutsch')
})

describe('in German', () => {
  const full: Told = {
    code: 'quota_full',
    message: 'Your files take 1.5 MB of 2 GB and this one does not fit.',
    remedy: 'Uploads are removed after some days.',
    values: { used: 1_500_000, most: 2e9 },
  }

  test('numbers have the sign of the language', async () => {
    await setLanguage('de', false)
    expect(say(full)).toEqual({
      message: 'Deine Dateien belegen 1,5 MB von 2 GB, und diese passt nicht mehr dazu.',
      remedy: 'Hochgeladenes wird nach einigen Tagen entfernt.',
    })
  })

  test.each([
    ['another diagnostic', full, /\(Deine Dateien belegen 1,5 MB[^.]*dazu\)/],
    ['one over the wire', JSON.stringify(full), /\(Deine Dateien belegen 1,5 MB[^.]*dazu\)/],
    ['what a library said', 'disk quota exceeded', /\(disk quota exceeded\)/],
  ])('a value may be %s', async (_, why, expected) => {
    await setLanguage('de', false)
    const told = { code: 'store_failed', message: 'x', values: { store: 's3://b', why } }
    expect(say(told).message).toMatch(expected)
  })

  test('the remedy of an inner diagnostic follows the sentence', async () => {
    await setLanguage('de', false)
    const told = { code: 'store_failed', message: 'x', values: { store: 's3://b', why: full } }
    expect(say(told).remedy).toMatch(/^Hochgeladenes wird nach einigen Tagen entfernt\. Versuche/)
  })

  test('a code without German, and values of another version, stay English', async () => {
    await setLanguage('de', false)
    for (const code of ['', 'no_such_code', 'toString']) {
      expect(say({ code, message: 'It failed.' })).toEqual({ message: 'It failed.', remedy: '' })
    }
    expect(say({ ...full, values: { used: 1 } }).message).toBe(full.message)
  })

  test('an error is said as its diagnostic, another one as it is', async () => {
    await setLanguage('de', false)
    expect(sentence(new ToldError(full))).toBe(spoken(full))
    expect(sentence(new Error('no WebGL'))).toBe('no WebGL')
    expect(sentence('no')).toBe('no')
  })
})
