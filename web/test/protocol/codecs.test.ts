import { describe, expect, test } from 'vitest'
import type { MessageReader, MessageWriter, ServiceType } from '../../src/protocol/message_type'
import vectors from './vectors.json'

interface Vector {
  values: unknown
  cdr: string
}

type Codec = MessageReader<object> | MessageWriter<object> | ServiceType<object, object>

const files = import.meta.glob<Record<string, unknown>>(
  ['../../src/protocol/*_msgs.ts', '../../src/protocol/*_interfaces.ts'],
  { eager: true },
)
const readers = new Map<string, MessageReader<object>>()
const writers = new Map<string, MessageWriter<object>>()
for (const value of Object.values(files).flatMap((file) => Object.values(file))) {
  if (typeof value === 'object' && value !== null && 'name' in value) take(value as Codec)
}

function take(codec: Codec): void {
  if ('decode' in codec) readers.set(codec.name, codec)
  else if ('encode' in codec) writers.set(codec.name, codec)
  else [codec.request, codec.response].forEach(take)
}

/** Return the JSON of a message. */
function plain(value: unknown): unknown {
  if (typeof value === 'bigint') return value.toString()
  if (Array.isArray(value)) return value.map(plain)
  if (ArrayBuffer.isView(value)) return Array.from(value as unknown as number[], plain)
  if (typeof value !== 'object' || value === null) return value
  return Object.fromEntries(Object.entries(value).map(([key, each]) => [key, plain(each)]))
}

/** Return a payload at an offset of 4 mod 8, as in a batch. */
function bytesOf(base64: string): Uint8Array {
  const raw = Buffer.from(base64, 'base64')
  const padded = new Uint8Array(4 + raw.length)
  padded.set(raw, 4)
  return padded.subarray(4)
}

const all = Object.entries(vectors as unknown as Record<string, [Vector, Vector]>)

function vectorsOf(codecs: ReadonlyMap<string, unknown>): [string, [Vector, Vector]][] {
  return all.filter(([name]) => codecs.has(name))
}

test('every type that has a vector has a codec, and the other way round', () => {
  const names = new Set([...readers.keys(), ...writers.keys()])
  expect([...names].sort()).toEqual(all.map(([name]) => name).sort())
})

describe.each(vectorsOf(readers))('%s', (name, [first, second]) => {
  const type = readers.get(name) as MessageReader<object>

  test('decodes what ROS encodes', () => {
    expect(plain(type.decode(bytesOf(first.cdr)))).toEqual(first.values)
  })

  test('decodes into a message that holds another one', () => {
    const message = type.decode(bytesOf(first.cdr))
    expect(type.decode(bytesOf(second.cdr), message)).toBe(message)
    expect(plain(message)).toEqual(second.values)
    expect(plain(type.decode(bytesOf(first.cdr), message))).toEqual(first.values)
  })
})

test.each(vectorsOf(writers))('%s encodes the same bytes', (name, pair) => {
  const type = writers.get(name) as MessageWriter<object>
  for (const { values, cdr } of pair) {
    expect(Buffer.from(type.encode(values as object)).toString('base64')).toBe(cdr)
  }
})
