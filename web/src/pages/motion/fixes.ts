import type { Conversion, ConvertOptions, Fix } from '../../api/types'
import type { Words } from '../../words/en'

const SWITCHES = ['transpose', 'degrees', 'unwrap', 'resample', 'invert'] as const
const TEXTS = ['variable', 'columns', 'join', 'gripper', 'units'] as const
type Switch = (typeof SWITCHES)[number]
type Text = (typeof TEXTS)[number]

function isSwitch(option: string): option is Switch {
  return (SWITCHES as readonly string[]).includes(option)
}
function isText(option: string): option is Text {
  return (TEXTS as readonly string[]).includes(option)
}

/** Return the options with a fix applied; null: no button can apply it. */
export function applied(options: ConvertOptions, { option, value }: Fix): ConvertOptions | null {
  if (isSwitch(option)) return { ...options, [option]: value === 'true' }
  if (option === 'frame_rate') {
    const rate = Number(value)
    return Number.isFinite(rate) && value !== '' ? { ...options, frame_rate: rate } : null
  }
  if (isText(option)) return value === '' ? null : { ...options, [option]: value }
  return null
}

/** The rows of a part such as q(2:9, :), or its columns where samples are columns. */
const PART = /\((?:(\S[^()]*), :|:, (\S[^()]*))\)$/

/** Return the rows between those of a list such as [1:89 91:201]. */
function rowsBetween(list: string): string[] {
  const pieces = list.split(' ').map((piece) => piece.split(':').map(Number))
  return pieces.slice(1).map(([first = 0], index) => {
    const [from, to] = [(pieces[index]?.at(-1) ?? 0) + 1, first - 1]
    return from === to ? String(from) : `${from}:${to}`
  })
}

/** Return the label of a fix's button. variable: that the finding is about; a file without names
 * has one of the lab's own. */
export function fixLabel({ option, value }: Fix, words: Words, variable = ''): string {
  const [, rows, columns] = (option === 'variable' && PART.exec(value)) || []
  const part = rows ?? columns ?? ''
  if (part.startsWith('[')) return words.fixes.leaveOut(rowsBetween(part.slice(1, -1)))
  const [first, last] = part.split(':')
  if (first && last) return words.fixes.keepRows(first, last)
  if (option === 'variable' && value === variable) return words.fixes.allTheSame
  const label = words.fixes[option as keyof Words['fixes']] as
    | ((value: string) => string)
    | undefined
  return label === undefined ? `${option} = ${value}` : label(value)
}

/** Return the options that are set, as short texts. */
export function optionLabels(options: ConvertOptions, words: Words): string[] {
  return Object.entries(options)
    .filter(([, value]) => value !== undefined && value !== false && value !== '')
    .map(([option, value]) => fixLabel({ option, value: String(value), matlab: '' }, words))
}

/** Codes that no other robot mends: the file cannot be read, or holds no motion. */
const OF_THE_FILE = new Set([
  'missing',
  'unsupported_format',
  'unreadable',
  'bad_table',
  'converter_failed',
  'reader_died',
  'readers_disagree',
  'too_large',
  'too_slow',
  'never_filled',
  'empty',
  'single_sample',
  'not_real',
  'wrong_class',
  'unsupported_object',
])

/** Return whether another robot could make the file acceptable. */
export function robotMatters(conversion: Conversion): boolean {
  if (conversion.outcome !== 'rejected' || conversion.motion !== null) return true
  return !conversion.diagnostics.some(
    ({ code, severity }) => severity === 'error' && OF_THE_FILE.has(code),
  )
}
