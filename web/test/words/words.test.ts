import { expect, test } from 'vitest'
import { words as de } from '../../src/words/de'
import { en } from '../../src/words/en'

type Tree = { readonly [key: string]: unknown }

function leaves(tree: Tree, path = ''): [string, unknown][] {
  return Object.entries(tree).flatMap(([key, value]) =>
    typeof value === 'object' && value !== null
      ? leaves(value as Tree, `${path}${key}.`)
      : [[path + key, value] as [string, unknown]],
  )
}

test('both languages say the same things, and nothing is empty', () => {
  const german = new Map(leaves(de))
  for (const [path, value] of leaves(en)) {
    expect(typeof german.get(path), path).toBe(typeof value)
    expect(value, path).not.toBe('')
    expect(german.get(path), path).not.toBe('')
  }
})
