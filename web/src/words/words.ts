import { computed, signal } from '@preact/signals'
import { en, type Words } from './en'

export type Language = 'en' | 'de'
export const LANGUAGES = { en: 'English', de: 'Deutsch' } as const satisfies Record<
  Language,
  string
>

const KEY = 'mrlab.language'
const loaded = signal<{ readonly language: Language; readonly words: Words }>({
  language: 'en',
  words: en,
})

/** The words of the language that is chosen. */
export const words = computed(() => loaded.value.words)
export const language = computed(() => loaded.value.language)

/** Return the language that was chosen here before, else the first of the browser's that there is. */
export function preferredLanguage(): Language {
  const wanted = [localStorage.getItem(KEY), ...navigator.languages.map((tag) => tag.slice(0, 2))]
  return wanted.find((tag): tag is Language => tag === 'en' || tag === 'de') ?? 'en'
}

export async function setLanguage(next: Language, keep = true): Promise<void> {
  const chosen = next === 'de' ? (await import('./de')).de : en
  if (keep) localStorage.setItem(KEY, next)
  document.documentElement.lang = next
  loaded.value = { language: next, words: chosen }
}

/** The person's own kind of the language, such as en-GB: dates and numbers differ. */
const locale = computed(
  () => navigator.languages.find((tag) => tag.startsWith(language.value)) ?? language.value,
)

/** Return a number in the language's own way, with `least` to `digits` digits behind the comma. */
export function number(value: number, digits = 2, least = 0): string {
  const rounded = Number(value.toFixed(Math.min(digits, 12)))
  return (rounded === 0 ? 0 : value).toLocaleString(locale.value, {
    minimumFractionDigits: least,
    maximumFractionDigits: digits,
  })
}

/** Return a date and time, s since the epoch, in the language's own way. */
export function dateTime(seconds: number): string {
  return new Date(seconds * 1000).toLocaleString(locale.value, {
    dateStyle: 'medium',
    timeStyle: 'short',
  })
}

/** Return a size in kB or MB. */
export function fileSize(bytes: number): string {
  return bytes < 1e6 ? `${number(bytes / 1e3, 0)} kB` : `${number(bytes / 1e6, 1)} MB`
}
