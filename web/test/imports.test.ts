import { readdirSync, readFileSync, statSync } from 'node:fs'
import { dirname, join, relative, sep } from 'node:path'
import { fileURLToPath } from 'node:url'
import { describe, expect, test } from 'vitest'

const SRC = fileURLToPath(new URL('../src', import.meta.url))
const TEST = dirname(fileURLToPath(import.meta.url))
// Types as well: modules that name each other's types cannot be understood one by one.
const IMPORT = /\bfrom '(\.[^']+)'|\bimport\(?\s*'(\.[^']+)'/g

/** The parts of a folder, the highest first, and the parts that each may import. A part is a folder
 * or a file; a part imports none above it. */
type Layers = Readonly<Record<string, string>>

const PARTS: Readonly<Record<string, Layers>> = {
  src: {
    main: 'api app design shell words',
    app: 'api classroom design pages room shell words',
    show_3d: 'reports show',
    show_flat: 'flat_reports show',
    show: 'design flat_reports report scene words',
    reports: 'flat_reports report',
    flat_reports: 'classroom report',
    classroom: 'api design lab link pages playback protocol report room shell words',
    pages: 'api design lab link playback protocol scene shell words',
    room: 'api design lab link playback protocol scene shell words',
    lab: 'api design link playback protocol scene words',
    report: 'design playback scene words',
    scene: 'design playback words',
    shell: 'api design words',
    design: 'api playback words',
    api: 'playback words',
    link: 'protocol words',
    playback: 'words',
    protocol: '',
    words: '',
  },
  pages: {
    lab: 'motion trajectories',
    people: 'account motion',
    upload: 'motion trajectories',
    account: 'motion',
    trajectories: 'motion',
    motion: '',
  },
  room: {
    page: 'board ports room session',
    room: 'board follow handles input latency layout panels people place robots scene session systems tour wiring',
    wiring: 'board handles latency panels place ports robots scene session systems tour',
    follow: 'board handles ports robots session systems',
    tour: 'board input latency panels ports robots scene session',
    board: 'latency layout panels people place ports scene session systems',
    robots: 'handles input layout panels place ports scene',
    handles: 'grab input panels place ports scene',
    latency: 'panels ports',
    session: 'input panels place scene',
    systems: 'input layout panels ports',
    grab: 'place',
    layout: 'panels ports',
    panels: 'input ports',
    input: 'scene',
    place: 'people ports scene',
    people: 'ports scene',
    ports: '',
    scene: '',
  },
  scene: {
    preview: 'lab robot stage',
    lab: 'robot stage',
    robot: 'stage',
    stage: '',
  },
}
/** Most lines of a module, and most modules of a folder. */
const MOST_LINES = 450
const MOST_MODULES = 14
/** Tables, whose lines are rows. */
const TABLES = /^(words\/(de|en)|protocol\/\w+_(msgs|interfaces))\.ts$/
/** Tests of several modules. */
const ACROSS = new Set(['imports', 'sentences', 'protocol/codecs'])

function modules(): string[] {
  const names = readdirSync(SRC, { recursive: true, encoding: 'utf-8' })
  return names.filter((name) => /\.tsx?$/.test(name)).map((name) => join(SRC, name))
}

function isFile(path: string): boolean {
  return statSync(path, { throwIfNoEntry: false })?.isFile() ?? false
}

function fileOf(path: string): string | undefined {
  return [path, `${path}.ts`, `${path}.tsx`].find(isFile)
}

function importsOf(module: string): string[] {
  const found = readFileSync(module, 'utf-8').matchAll(IMPORT)
  return [...found].flatMap(([, named, bare]) => {
    return fileOf(join(dirname(module), named ?? bare ?? '')) ?? []
  })
}

const GRAPH = new Map(modules().map((module) => [module, importsOf(module)]))

/** Return the part of a folder that holds a file; empty: none does. */
function partOf(file: string, folder: string): string {
  const inside = relative(folder, file)
  if (inside.startsWith('..')) return ''
  return (inside.split(sep)[0] ?? '').replace(/\.(tsx?|css)$/, '')
}

/** Return a circle of imports that begins at a module; null: there is none. */
function circleFrom(
  module: string,
  path: readonly string[],
  done: Set<string>,
): readonly string[] | null {
  if (path.includes(module)) return [...path.slice(path.indexOf(module)), module]
  if (done.has(module)) return null
  for (const next of GRAPH.get(module) ?? []) {
    const circle = circleFrom(next, [...path, module], done)
    if (circle !== null) return circle
  }
  done.add(module)
  return null
}

test('no module imports itself by way of others', () => {
  expect([...GRAPH.values()].flat().length).toBeGreaterThan(GRAPH.size)
  const done = new Set<string>()
  for (const module of GRAPH.keys()) {
    const circle = circleFrom(module, [], done) ?? []
    expect(circle.map((name) => relative(SRC, name))).toEqual([])
  }
})

describe.each(Object.entries(PARTS))('the parts of %s', (name, layers) => {
  const folder = name === 'src' ? SRC : join(SRC, name)
  const order = Object.keys(layers)

  test('import what the table allows, and nothing else', () => {
    const found = Object.fromEntries(order.map((part) => [part, new Set<string>()]))
    for (const [module, imports] of GRAPH) {
      const part = partOf(module, folder)
      if (part === '') continue
      expect(order, relative(SRC, module)).toContain(part)
      for (const other of imports.map((each) => partOf(each, folder))) {
        if (other !== '' && other !== part) found[part]?.add(other)
      }
    }
    const sorted = Object.entries(found).map(([part, to]) => [part, [...to].sort().join(' ')])
    expect(Object.fromEntries(sorted)).toEqual(layers)
  })

  test('import none above them', () => {
    order.forEach((part, i) => {
      const allowed = (layers[part] ?? '').split(' ').filter(Boolean)
      expect(order.slice(i + 1), part).toEqual(expect.arrayContaining(allowed))
    })
  })
})

test('a module can be read in one sitting, a folder seen at a glance', () => {
  const folders = new Map<string, number>()
  for (const module of GRAPH.keys()) {
    const folder = dirname(relative(SRC, module))
    folders.set(folder, (folders.get(folder) ?? 0) + 1)
    const lines = readFileSync(module, 'utf-8').split('\n').length
    if (!TABLES.test(relative(SRC, module))) {
      expect(lines, relative(SRC, module)).toBeLessThanOrEqual(MOST_LINES)
    }
  }
  for (const [folder, count] of folders) {
    expect(count, folder).toBeLessThanOrEqual(MOST_MODULES)
  }
})

test('a test has the place and the name of the module that it tests', () => {
  const names = readdirSync(TEST, { recursive: true, encoding: 'utf-8' })
  for (const name of names.filter((each) => each.endsWith('.test.ts'))) {
    const module = name.replace(/\.test\.ts$/, '')
    if (!ACROSS.has(module)) expect(fileOf(join(SRC, module)), name).toBeDefined()
  }
})
