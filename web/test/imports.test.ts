import { readdirSync, readFileSync, statSync } from 'node:fs'
import { dirname, join, relative } from 'node:path'
import { fileURLToPath } from 'node:url'
import { expect, test } from 'vitest'

const SRC = fileURLToPath(new URL('../src', import.meta.url))
// of types as well: modules that name each other's types cannot be understood one by one
const IMPORT = /\bfrom '(\.[^']+)'|\bimport\(?\s*'(\.[^']+)'/g

function modules(): string[] {
  const names = readdirSync(SRC, { recursive: true, encoding: 'utf-8' })
  return names.filter((name) => /\.tsx?$/.test(name)).map((name) => join(SRC, name))
}

function fileOf(path: string): string | undefined {
  const candidates = [path, `${path}.ts`, `${path}.tsx`]
  return candidates.find((name) => statSync(name, { throwIfNoEntry: false })?.isFile())
}

function importsOf(module: string): string[] {
  const found = readFileSync(module, 'utf-8').matchAll(IMPORT)
  return [...found].flatMap(([, named, bare]) => {
    return fileOf(join(dirname(module), named ?? bare ?? '')) ?? []
  })
}

/** Return a circle of imports that begins at a module; null: there is none. */
function circleFrom(
  module: string,
  graph: ReadonlyMap<string, readonly string[]>,
  path: readonly string[],
  done: Set<string>,
): readonly string[] | null {
  if (path.includes(module)) return [...path.slice(path.indexOf(module)), module]
  if (done.has(module)) return null
  for (const next of graph.get(module) ?? []) {
    const circle = circleFrom(next, graph, [...path, module], done)
    if (circle !== null) return circle
  }
  done.add(module)
  return null
}

test('no module imports itself by way of others', () => {
  const graph = new Map(modules().map((module) => [module, importsOf(module)]))
  expect([...graph.values()].flat().length).toBeGreaterThan(graph.size)
  const done = new Set<string>()
  for (const module of graph.keys()) {
    const circle = circleFrom(module, graph, [], done) ?? []
    expect(circle.map((name) => relative(SRC, name))).toEqual([])
  }
})
