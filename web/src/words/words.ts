import { computed, signal } from '@preact/signals'
import { en, type Words } from './en'

/** Texts of the lab by code: templates of the text and of the remedy (phrase.ts). */
export type Templates = Readonly<Record<string, readonly [text: string, remedy?: string]>>

/** The exports of a language's file, whose name is the language's code, such as de.ts. */
export interface LanguageFile {
  readonly words: Words
  readonly diagnostics: Templates
}

const KEY = 'mrlab.language'
const ENGLISH: LanguageFile = { words: en, diagnostics: {} }
const loaded = signal<LanguageFile & { readonly language: string }>({ language: 'en', ...ENGLISH })

/** The words of the language that is chosen. */
export const words = computed(() => loaded.value.words)
/** Texts of the lab in that language; none in English, in which they arrive. */
export const templates = computed(() => loaded.value.diagnostics)
export const language = computed(() => loaded.value.language)

/** Return the files of the languages beside English, by code. A call: tests without Vite have
 * none. */
function files(): ReadonlyMap<string, () => Promise<LanguageFile>> {
  const found = import.meta.glob<LanguageFile>(['./??.ts', '!./en.ts'])
  return new Map(Object.entries(found).map(([path, load]) => [path.slice(2, 4), load]))
}

/** Return the codes of the languages that there are. */
export function languages(): readonly string[] {
  return ['en', ...files().keys()]
}

/** Return the name of a language in itself, such as Deutsch. */
export function languageName(code: string): string {
  const name = new Intl.DisplayNames([code], { type: 'language' }).of(code) ?? code
  return name.charAt(0).toLocaleUpperCase(code) + name.slice(1)
}

/** Return the language that was chosen here before, else the first of the browser's that there
 * is. */
export function preferredLanguage(): string {
  const wanted = [localStorage.getItem(KEY), ...navigator.languages.map((tag) => tag.slice(0, 2))]
  const known = languages()
  return wanted.find((tag): tag is string => tag !== null && known.includes(tag)) ?? 'en'
}

/** Choose a language; English if the language is unknown. */
export async function setLanguage(next: string, keep = true): Promise<void> {
  const load = files().get(next)
  const file = load === undefined ? ENGLISH : await load()
  const code = load === undefined ? 'en' : next
  if (keep) localStorage.setItem(KEY, code)
  document.documentElement.lang = code
  loaded.value = { language: code, words: file.words, diagnostics: file.diagnostics }
}

/** Return what the language calls what the lab ships and the local user; else the name itself. */
export function named(id: string, name = id): string {
  const own = words.value.names
  return Object.hasOwn(own, id) ? (own[id] ?? name) : name
}

/** Return a joint's name for people, such as "Elbow (J3)", "Joint 3" or "A1"; place: along the
 * arm, from 0. */
export function jointName(name: string, place: number): string {
  const number = String(place + 1)
  const bare = name.split('_').filter((part) => part !== 'joint')
  const text = named(name, bare.join(' '))
  if (text === '' || text === number) return words.value.plots.joint(number)
  const capital = text.charAt(0).toLocaleUpperCase() + text.slice(1)
  return capital === `A${number}` ? capital : `${capital} (J${number})`
}

/** Return a link's name for people, such as "Wrist 2", where it has one. */
export function linkName(name: string): string {
  const bare = name.split('_').filter((part) => part !== 'link')
  const text = named(name, named(name.replace(/link$/, 'joint'), bare.join(' ')))
  if (!/\p{L}{2}/u.test(text)) return name
  return text.charAt(0).toLocaleUpperCase() + text.slice(1)
}

/** The person's own kind of the language, such as en-GB: dates and numbers differ. */
const locale = computed(
  () => navigator.languages.find((tag) => tag.startsWith(language.value)) ?? language.value,
)

const formats = new Map<string, Intl.NumberFormat>()

/** Return a number with as many digits behind the decimal sign, without groups of thousands. */
export function fixed(value: number, digits: number): string {
  const key = `${locale.value} ${digits}`
  let format = formats.get(key)
  if (format === undefined) {
    format = new Intl.NumberFormat(locale.value, {
      minimumFractionDigits: digits,
      maximumFractionDigits: digits,
      useGrouping: false,
    })
    formats.set(key, format)
  }
  return format.format(Number(value.toFixed(digits)) === 0 ? 0 : value)
}

/** Return a number in the language's own way, with `least` to `digits` digits behind the comma. */
export function number(value: number, digits = 2, least = 0): string {
  const rounded = Number(value.toFixed(Math.min(digits, 12)))
  return (rounded === 0 ? 0 : value).toLocaleString(locale.value, {
    minimumFractionDigits: least,
    maximumFractionDigits: digits,
  })
}

/** Return a number with `digits` significant digits, without groups of thousands. */
export function significant(value: number, digits: number): string {
  return value.toLocaleString(locale.value, {
    maximumSignificantDigits: digits,
    useGrouping: false,
  })
}

/** Return a share, 0 to 1, with the sign of percent as the language sets it: 63% or 63\u00a0%. */
export function percent(share: number): string {
  return share.toLocaleString(locale.value, { style: 'percent' })
}

/** Return a date and time, s since the epoch, in the language's own way. */
export function dateTime(seconds: number): string {
  return new Date(seconds * 1000).toLocaleString(locale.value, {
    dateStyle: 'medium',
    timeStyle: 'short',
  })
}

/** Return a time of day to the second, s since the epoch, in the language's own way. */
export function timeOfDay(seconds: number): string {
  return new Date(seconds * 1000).toLocaleTimeString(locale.value, { timeStyle: 'medium' })
}

/** Return a size in kB or MB. */
export function fileSize(bytes: number): string {
  return bytes < 1e6 ? `${number(bytes / 1e3, 0)} kB` : `${number(bytes / 1e6, 1)} MB`
}

/** The words of the 3D view. */
export type SceneWords = Words['scene']
