import { readdirSync, readFileSync } from 'node:fs'
import { join } from 'node:path'
import { fileURLToPath } from 'node:url'
import { parseSync } from 'vite'
import { expect, test } from 'vitest'

const SRC = fileURLToPath(new URL('../src', import.meta.url))
// Fields that hold texts for people.
const TEXTS = new Set(['message', 'remedy', 'reason'])
const METHODS = new Set([
  'includes',
  'startsWith',
  'endsWith',
  'indexOf',
  'match',
  'matchAll',
  'replace',
  'replaceAll',
  'search',
  'split',
  'slice',
  'substring',
])

interface Node {
  readonly type: string
  readonly start: number
  readonly end: number
  readonly [key: string]: unknown
}

function isNode(value: unknown): value is Node {
  return typeof value === 'object' && value !== null && 'type' in value
}

/** Return the name of a property that is read, such as message of a.b.message. */
function member(node: unknown): string | undefined {
  if (!isNode(node) || node.type !== 'MemberExpression') return undefined
  return isNode(node.property) ? String(node.property.name) : undefined
}

function isText(node: unknown): boolean {
  return TEXTS.has(member(node) ?? '')
}

function isWritten(node: unknown): boolean {
  return (
    isNode(node) && node.type === 'Literal' && typeof node.value === 'string' && node.value !== ''
  )
}

/** Say whether a text for people is compared with one, searched, cut or replaced here. */
function isRead(node: Node): boolean {
  const { left, right, callee } = node
  if (node.type === 'BinaryExpression' && /^[!=]==?$/.test(String(node.operator))) {
    return (isText(left) && isWritten(right)) || (isWritten(left) && isText(right))
  }
  if (node.type !== 'CallExpression' || !isNode(callee)) return false
  const name = member(callee) ?? ''
  const given = node.arguments as unknown[]
  return (
    (METHODS.has(name) && isText(callee.object)) ||
    (['test', 'exec'].includes(name) && given.some(isText))
  )
}

function readsOf(name: string, source: string): string[] {
  const found: string[] = []
  const visit = (value: unknown): void => {
    if (Array.isArray(value)) value.forEach(visit)
    else if (isNode(value)) {
      if (isRead(value)) {
        const line = source.slice(0, value.start).split('\n').length
        found.push(`${name}:${line}: ${source.slice(value.start, value.end)}`)
      }
      Object.values(value).forEach(visit)
    }
  }
  const { program, errors } = parseSync(name, source)
  expect(errors, name).toEqual([])
  visit(program)
  return found
}

test('no code reads a sentence', () => {
  const names = readdirSync(SRC, { recursive: true, encoding: 'utf-8' })
  const modules = names.filter((name) => /\.tsx?$/.test(name))
  expect(modules.length).toBeGreaterThan(100)
  const found = modules.flatMap((name) => readsOf(name, readFileSync(join(SRC, name), 'utf-8')))
  expect(found).toEqual([])
})

test('a read is found', () => {
  const source = `a.message === 'x'
b.reason.startsWith('y')
;/z/.test(c.remedy)
d.message === ''
`
  expect(readsOf('x.ts', source)).toHaveLength(3)
})
