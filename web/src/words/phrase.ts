/** Templates with typed values: `mrlab_ros/core/base/phrase.py` describes them. */
import { fixed, percent, significant } from './words'

export type Values = Readonly<Record<string, unknown>>

/** The words of a language around values: those of quantities that hold words. */
interface Joining {
  readonly and: string
  readonly or: string
  readonly row: string
  readonly rows: (first: string, last: string) => string
  /** States of the lab by name. */
  readonly states: Readonly<Record<string, string>>
}

interface Placeholder {
  readonly name: string
  readonly quantity: string
  readonly words: readonly string[]
}
type Part = string | Placeholder | Phrase
/** A parsed template: texts, placeholders, and parts that may be left out. */
export type Phrase = readonly Part[]

const TOKEN = /\{\{|\}\}|\[\[|\]\]|\{([a-z_]+)(?::([^{}]+))?\}|[[\]]/g
const DEGREES = 180 / Math.PI
const UNITS: Readonly<Record<string, string>> = {
  '': 'number',
  '1': 'number',
  '%': 'share',
  rad: 'angle',
  'rad/s': 'turn_rate',
  'rad/s^2': 'turn_acceleration',
  'rad/s^3': 'turn_jerk',
  m: 'length',
  'm/s': 'speed',
  s: 'time',
  Hz: 'rate',
  kg: 'mass',
  N: 'force',
  'N*m': 'moment',
}

/** Return the parsed template; throws if it is invalid. */
export function parse(template: string): Phrase {
  const stack: Part[][] = [[]]
  let end = 0
  const top = (): Part[] => stack[stack.length - 1] as Part[]
  for (const found of template.matchAll(TOKEN)) {
    if (found.index > end) top().push(template.slice(end, found.index))
    end = found.index + found[0].length
    const [sign, name, spec = 'text'] = found
    if (name !== undefined) {
      const [quantity = 'text', ...rest] = spec.split(' ')
      const words = rest.join(' ')
      top().push({ name, quantity, words: words === '' ? [] : words.split('|') })
    } else if (sign === '[') stack.push([])
    else if (sign === ']') {
      const inner = stack.pop()
      if (inner === undefined || stack.length === 0) throw new Error(`${template}: ] without [`)
      top().push(inner)
    } else top().push(sign.charAt(0))
  }
  if (stack.length > 1) throw new Error(`${template}: [ without ]`)
  if (end < template.length) top().push(template.slice(end))
  return top()
}

/** Return the placeholders of a phrase; optional: also those of parts that may be left out. */
export function placeholders(phrase: Phrase, optional = true): readonly Placeholder[] {
  return phrase.flatMap((part) => {
    if (typeof part === 'string') return []
    if ('quantity' in part) return [part]
    return optional ? placeholders(part) : []
  })
}

function isMissing(value: unknown): boolean {
  return (
    value === undefined ||
    value === null ||
    value === '' ||
    (Array.isArray(value) && value.length === 0)
  )
}

/** Words another diagnostic; whole: with its remedy. */
type Worded = (value: unknown, whole?: boolean) => string

/** Return the text of a phrase with these values. problem: words another diagnostic. */
export function fill(phrase: Phrase, values: Values, joining: Joining, problem: Worded): string {
  return phrase
    .map((part) => {
      if (typeof part === 'string') return part
      if ('quantity' in part) return shown(part, values, joining, problem)
      const missing = placeholders(part, false).some(({ name, quantity }) =>
        isMissing(quantity === 'text' ? values[name] : typed(values[name])),
      )
      return missing ? '' : fill(part, values, joining, problem)
    })
    .join('')
}

/** A value on the wire is a text; unless its quantity is one, the text is JSON. */
export function typed(value: unknown): unknown {
  if (typeof value !== 'string') return value
  try {
    return JSON.parse(value)
  } catch {
    return value
  }
}

function digits(value: number, count: number, unit: string): string {
  return `${fixed(value, count)}${unit}`
}

function length(value: number): string {
  if (Math.abs(value) >= 1) return digits(value, 2, ' m')
  return digits(value * 1e3, Math.abs(value) >= 0.01 ? 0 : 1, ' mm')
}

/** From 100 s on as minutes or hours: 2:05.3 min, 1:02:05 h. */
function duration(value: number): string {
  if (value < 99.995) return digits(value, 2, ' s')
  const tenths = Math.round(value * 10)
  const two = (count: number): string => String(count).padStart(2, '0')
  if (tenths < 36_000) {
    const seconds = (tenths % 600) / 10
    return `${Math.floor(tenths / 600)}:${seconds < 10 ? '0' : ''}${fixed(seconds, 1)} min`
  }
  const whole = Math.round(value)
  return `${Math.floor(whole / 3600)}:${two(Math.floor(whole / 60) % 60)}:${two(whole % 60)} h`
}

function bytes(value: number): string {
  for (const [scale, unit] of [
    [1e9, ' GB'],
    [1e6, ' MB'],
    [1e3, ' kB'],
  ] as const) {
    if (Math.abs(value) >= scale) return measured(value / scale, 3, unit)
  }
  return digits(value, 0, ' B')
}

function measured(value: number, count: number, unit: string): string {
  return `${significant(value, count)}${unit}`
}

function chosen(value: unknown, words: readonly string[]): string {
  const word = words.find((each) => each.startsWith(`${value}=`) || each === value)
  return word === undefined ? String(value) : word.slice(word.indexOf('=') + 1)
}

function joined(names: unknown, words: readonly string[], last: string): string {
  const list: readonly unknown[] = Array.isArray(names) ? names : [names]
  const texts = list.map((name) =>
    typeof name === 'number' ? significant(name, 10) : chosen(name, words),
  )
  // after numbers with a decimal comma a comma would not part them
  const comma = list.some((name, i) => typeof name === 'number' && texts[i]?.includes(','))
  return texts.length < 2
    ? texts.join('')
    : `${texts.slice(0, -1).join(comma ? '; ' : ', ')} ${last} ${texts[texts.length - 1]}`
}

function shown(
  { name, quantity, words }: Placeholder,
  values: Values,
  joining: Joining,
  problem: Worded,
): string {
  if (quantity === 'text') return String(values[name] ?? '')
  const value = typed(values[name])
  const of = quantity === 'measure' ? (UNITS[String(values.unit ?? '')] ?? 'number') : quantity
  const figure = Number(value)
  switch (of) {
    case 'integer':
      return digits(figure, 0, '')
    case 'number':
      return measured(figure, 4, '')
    case 'exact':
      return measured(figure, 10, '')
    case 'angle':
      return digits(figure * DEGREES, 1, '°')
    case 'fine_angle':
      return digits(figure * DEGREES, 2, '°')
    case 'turn_rate':
      return digits(figure * DEGREES, 1, '°/s')
    case 'turn_acceleration':
      return digits(figure * DEGREES, 0, '°/s²')
    case 'turn_jerk':
      return digits(figure * DEGREES, 0, '°/s³')
    case 'length':
      return length(figure)
    case 'speed':
      return digits(figure, 2, ' m/s')
    case 'time':
      return digits(figure, 2, ' s')
    case 'duration':
      return duration(figure)
    case 'rate':
      return measured(figure, 4, ' Hz')
    case 'share':
      return percent(figure)
    case 'mass':
      return measured(figure, 3, ' kg')
    case 'force':
      return measured(figure, 3, ' N')
    case 'moment':
      return measured(figure, 3, ' N*m')
    case 'bytes':
      return bytes(figure)
    case 'position': {
      const axes = (value as readonly number[]).map((v, i) => `${'xyz'[i]} ${digits(v, 3, '')}`)
      return `${axes.join(' ')} m`
    }
    case 'count': {
      const word = words[figure === 1 ? 0 : 1]
      return word === undefined ? digits(figure, 0, '') : `${digits(figure, 0, '')} ${word}`
    }
    case 'rows': {
      const [first = 0, last = 0] = value as readonly number[]
      return last <= first ? `${joining.row} ${first}` : joining.rows(`${first}`, `${last}`)
    }
    case 'list':
      return joined(value, words, joining.and)
    case 'either':
      return joined(value, words, joining.or)
    case 'state':
      return joining.states[String(value)] ?? String(value)
    case 'choice':
      return chosen(value, words)
    case 'problem':
      return problem(value).replace(/\.$/, '')
    case 'problems':
      return (value as readonly unknown[]).map((each) => `\n  ${problem(each, true)}`).join('')
    case 'reasons':
      return (value as readonly unknown[])
        .map((each) => problem(each).replace(/\.$/, ''))
        .join('; ')
    default:
      throw new Error(`there is no quantity ${quantity}`)
  }
}
