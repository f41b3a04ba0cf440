import { describe, expect, test } from 'vitest'
import type { MessageType } from '../../src/link/link'
import * as builtinInterfaces from '../../src/protocol/builtin_interfaces'
import * as diagnosticMsgs from '../../src/protocol/diagnostic_msgs'
import * as geometryMsgs from '../../src/protocol/geometry_msgs'
import * as mrlabMsgs from '../../src/protocol/mrlab_msgs'
import * as sensorMsgs from '../../src/protocol/sensor_msgs'
import * as shapeMsgs from '../../src/protocol/shape_msgs'
import * as stdMsgs from '../../src/protocol/std_msgs'
import * as tf2Msgs from '../../src/protocol/tf2_msgs'
import vectors from './vectors.json'

interface Vector {
  values: unknown
  cdr: string
}

const packages = [
  builtinInterfaces,
  diagnosticMsgs,
  geometryMsgs,
  mrlabMsgs,
  sensorMsgs,
  shapeMsgs,
  stdMsgs,
  tf2Msgs,
]
const types = new Map<string, MessageType<object>>()
for (const module of packages) {
  for (const [name, value] of Object.entries(module)) {
    if (name.endsWith('Type') && 'decode' in value) {
      types.set((value as { name: string }).name, value as unknown as MessageType<object>)
    }
  }
}

/** Return what JSON has in place of a message. */
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

test('every type that has a vector has a codec, and the other way round', () => {
  expect([...types.keys()].sort()).toEqual(all.map(([name]) => name).sort())
})

describe.each(all)('%s', (name, [first, second]) => {
  const type = types.get(name) as MessageType<object>

  test('decodes what ROS encodes', () => {
    expect(plain(type.decode(bytesOf(first.cdr)))).toEqual(first.values)
  })

  test('decodes into a message that holds another one', () => {
    const message = type.decode(bytesOf(first.cdr))
    expect(type.decode(bytesOf(second.cdr), message)).toBe(message)
    expect(plain(message)).toEqual(second.values)
    expect(plain(type.decode(bytesOf(first.cdr), message))).toEqual(first.values)
  })

  test('encodes the same bytes', () => {
    const message = type.decode(bytesOf(second.cdr))
    expect(Buffer.from(type.encode(message)).toString('base64')).toBe(second.cdr)
  })

  test('a new message is what zeros decode to', () => {
    const fresh = type.create()
    expect(plain(type.decode(type.encode(fresh)))).toEqual(plain(fresh))
  })
})
