/** A diagnostic as JSON and messages carry it; see core/base/diagnostic.py. */
import { fill, type Phrase, parse, placeholders, typed, type Values } from './phrase'
import { jointName, linkName, templates, words } from './words'

export interface Fix {
  readonly option: string
  readonly value: string
  readonly matlab: string
  /** A command line of a shell. */
  readonly command?: string
}

export interface Diagnostic {
  readonly severity: 'info' | 'warning' | 'error'
  readonly code: string
  /** In English, for readers without the code's text. */
  readonly message: string
  readonly remedy: string
  readonly variable: string
  readonly where: string
  /** Rows of the workspace's matrix, from 1; 0: none. */
  readonly first_row: number
  readonly last_row: number
  /** Joint's name; empty: none. */
  readonly joint: string
  readonly value: number | null
  readonly limit: number | null
  readonly unit: string
  readonly values: Readonly<Record<string, unknown>>
  readonly fixes: readonly Fix[]
}

/** A text that exists in each language: of a finding, an error, a service's response, a state. */
export interface Told {
  readonly code: string
  /** In English. */
  readonly message: string
  readonly remedy?: string
  /** By name; in messages a list, in which all but texts is JSON. */
  readonly values?: Values | readonly { readonly key: string; readonly value: string }[]
}

/** An error with its diagnostic. */
export class ToldError extends Error {
  override readonly name: string = 'ToldError'
  constructor(readonly told: Told) {
    super(told.message)
  }
}

/** Return the diagnostic of an error of a page itself, already in the reader's language. */
export function own(message: string): Told {
  return { code: '', message }
}

/** Return the text of a diagnostic in the chosen language; in English if it has none. */
export function say(told: Told): { readonly message: string; readonly remedy: string } {
  const { message, remedy = '' } = told
  const found = Object.hasOwn(templates.value, told.code) ? templates.value[told.code] : undefined
  if (found === undefined) return { message, remedy }
  const values = byName(told.values)
  const [text, advice] = [parsed(found[0]), parsed(found[1] ?? '')]
  const missing = [...placeholders(text, false), ...placeholders(advice, false)].some(
    ({ name }) => values[name] === undefined || values[name] === null,
  )
  // A diagnostic of another version of the lab may have other values.
  if (missing) return { message, remedy }
  const filled = (phrase: Phrase) => fill(phrase, values, words.value.joining, nested)
  const remedies = [...innerRemedies(text, values), ...innerRemedies(advice, values)]
  const all = new Set([...remedies, filled(advice)].filter(Boolean))
  return { message: filled(text), remedy: [...all].join(' ') }
}

/** Return the remedies of the diagnostics within a sentence, which follow it. */
function innerRemedies(phrase: Phrase, values: Values): readonly string[] {
  return placeholders(phrase).flatMap(({ name, quantity }) => {
    if (quantity !== 'problem' && quantity !== 'reasons') return []
    return [typed(values[name])].flat().map((each) => (isTold(each) ? say(each).remedy : ''))
  })
}

/** Return the same as one text. */
export function spoken(told: Told): string {
  const { message, remedy } = say(told)
  if (remedy === '' || message === '') return message + remedy
  // The line of a list has no full stop.
  return `${message}${/[.:!?]$/.test(message) ? '' : '.'} ${remedy}`
}

/** Return the sentence for anything that was thrown. */
export function sentence(error: unknown): string {
  if (error instanceof ToldError) return spoken(error.told)
  return error instanceof Error ? error.message : String(error)
}

function byName(values: Told['values']): Values {
  if (!isList(values)) return values ?? {}
  return Object.fromEntries(values.map(({ key, value }) => [key, value]))
}

function isList(values: Told['values']): values is Extract<Told['values'], readonly unknown[]> {
  return Array.isArray(values)
}

const known = new Map<string, Phrase>()

function parsed(template: string): Phrase {
  const found = known.get(template) ?? parse(template)
  known.set(template, found)
  return found
}

/** Return the text of a value that is another diagnostic, or a text of a library. */
function nested(value: unknown, whole = false): string {
  if (!isTold(value)) return String(value)
  return whole ? spoken(value) : say(value).message
}

/** Return whether a value is a text that exists in each language. */
export function isTold(value: unknown): value is Told {
  return typeof value === 'object' && value !== null && 'code' in value && 'message' in value
}

type Joints = readonly { readonly name: string }[] | undefined

/** Return the name for people of the joint of a finding; joints: of the robot, in its order. */
export function nameOfJoint({ joint }: Diagnostic, joints: Joints): string {
  const index = joints?.findIndex(({ name }) => name === joint) ?? -1
  return index < 0 ? joint : jointName(joint, index)
}

/** Return the message of a finding with the names of joint and link for people. */
export function said(finding: Diagnostic, joints: Joints): string {
  const { message } = say(finding)
  if (finding.joint) return message.replaceAll(finding.joint, nameOfJoint(finding, joints))
  const { link } = finding.values
  return typeof link === 'string' && link ? message.replaceAll(link, linkName(link)) : message
}
