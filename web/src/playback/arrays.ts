import type { PackedArray } from './motion'

type NumericArray = Float32Array | Float64Array | Uint32Array | Uint8Array

const KINDS = {
  float32: Float32Array,
  float64: Float64Array,
  uint32: Uint32Array,
  uint8: Uint8Array,
} as const

/** Return the numbers of a packed array, row by row. Throws a RangeError where the bytes and the
 * shape contradict each other. */
export function unpack(packed: PackedArray): NumericArray {
  const text = atob(packed.data)
  const bytes = new Uint8Array(text.length)
  for (let i = 0; i < text.length; i++) bytes[i] = text.charCodeAt(i)
  const Kind = KINDS[packed.dtype]
  const count = packed.shape.reduce((product, size) => product * size, 1)
  if (bytes.length !== count * Kind.BYTES_PER_ELEMENT) {
    throw new RangeError(
      `a packed array holds ${bytes.length} bytes; expected ${packed.shape.join(' x ')} of ` +
        `${packed.dtype}`,
    )
  }
  return new Kind(bytes.buffer)
}
