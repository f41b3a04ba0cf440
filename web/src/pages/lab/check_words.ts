import type { Words } from '../../words/en'

/** Return what kind of finding a code of a check or a rubric means, in words. */
export function kindOf(code: string, { check }: Pick<Words, 'check'>): string {
  const kinds: Readonly<Record<string, string>> = check.kinds
  return kinds[code] ?? code.replaceAll('_', ' ')
}
