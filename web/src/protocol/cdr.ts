/** Reads and writes CDR as ROS does: a 4-byte header, then values aligned from behind it. */

/** A payload that is not the message it should be. */
export class CdrError extends Error {
  override readonly name = 'CdrError'
}

/** Values of a sequence from this number on are copied through a view, fewer one by one. */
const MANY = 48
const HEADER = 4
const HOST_IS_LITTLE = new Uint8Array(new Uint16Array([1]).buffer)[0] === 1
const utf8 = new TextDecoder()
const toUtf8 = new TextEncoder()

type Numbers =
  | Float64Array
  | Float32Array
  | Int32Array
  | Uint32Array
  | Int16Array
  | Uint16Array
  | Int8Array
  | Uint8Array
  | BigInt64Array
  | BigUint64Array

interface NumbersClass<T> {
  readonly BYTES_PER_ELEMENT: number
  new (length: number): T
  new (buffer: ArrayBufferLike, byteOffset: number, length: number): T
}

/** A cursor in a payload. One reads many payloads, one after another. */
export class CdrReader {
  /** Of the whole buffer that the payload lies in; payloads of one batch share it. */
  private view: DataView = new DataView(new ArrayBuffer(0))
  private bytes: Uint8Array = new Uint8Array(this.view.buffer)
  private little = true
  /** The byte behind the header, which alignment counts from. All three count in `view`. */
  private origin = 0
  private at = 0
  private end = 0

  /** Begin with another payload: the bytes from `start` to `end` of `batch`. */
  open(batch: Uint8Array, start = 0, end = batch.byteLength): this {
    if (end - start < HEADER) {
      throw new CdrError(`${end - start} bytes are no CDR: its header has ${HEADER}`)
    }
    const kind = batch[start + 1] as number
    if (batch[start] !== 0 || kind > 1) {
      throw new CdrError(`the CDR header begins with ${batch[start]} ${kind}, not with 0 0 or 0 1`)
    }
    if (this.view.buffer !== batch.buffer) {
      this.view = new DataView(batch.buffer)
      this.bytes = new Uint8Array(batch.buffer)
    }
    this.little = kind === 1
    this.origin = batch.byteOffset + start + HEADER
    this.at = this.origin
    this.end = batch.byteOffset + end
    return this
  }

  bool(): boolean {
    return this.view.getUint8(this.aligned(1)) !== 0
  }

  uint8(): number {
    return this.view.getUint8(this.aligned(1))
  }

  int8(): number {
    return this.view.getInt8(this.aligned(1))
  }

  uint16(): number {
    return this.view.getUint16(this.aligned(2), this.little)
  }

  int16(): number {
    return this.view.getInt16(this.aligned(2), this.little)
  }

  uint32(): number {
    return this.view.getUint32(this.aligned(4), this.little)
  }

  int32(): number {
    return this.view.getInt32(this.aligned(4), this.little)
  }

  float32(): number {
    return this.view.getFloat32(this.aligned(4), this.little)
  }

  float64(): number {
    return this.view.getFloat64(this.aligned(8), this.little)
  }

  uint64(): bigint {
    return this.view.getBigUint64(this.aligned(8), this.little)
  }

  int64(): bigint {
    return this.view.getBigInt64(this.aligned(8), this.little)
  }

  /** Return the next text: `known` itself if it is equal, so that nothing is allocated. */
  string(known: string): string {
    const size = this.uint32()
    const from = this.aligned(1, size)
    // The last byte is a zero.
    const length = size === 0 ? 0 : size - 1
    return this.same(known, from, length) ? known : this.text(from, length)
  }

  strings(known: string[], fixed = -1): string[] {
    const count = this.count(fixed, 4)
    const found = known.length === count ? known : new Array<string>(count).fill('')
    for (let i = 0; i < count; i++) {
      const before = found[i] as string
      const text = this.string(before)
      if (text !== before) found[i] = text
    }
    return found
  }

  bools(known: boolean[], fixed = -1): boolean[] {
    const count = this.count(fixed, 1)
    const found = known.length === count ? known : new Array<boolean>(count)
    for (let i = 0; i < count; i++) found[i] = this.bool()
    return found
  }

  float64s(known: Float64Array, fixed = -1): Float64Array {
    const count = this.count(fixed, 8)
    if (known.length !== count || count >= MANY || count === 0) {
      return this.numbers(known, count, Float64Array, this.float64)
    }
    let at = this.aligned(8, count)
    for (let i = 0; i < count; i++, at += 8) known[i] = this.view.getFloat64(at, this.little)
    return known
  }

  float32s(known: Float32Array, fixed = -1): Float32Array {
    return this.numbers(known, this.count(fixed, 4), Float32Array, this.float32)
  }

  int32s(known: Int32Array, fixed = -1): Int32Array {
    return this.numbers(known, this.count(fixed, 4), Int32Array, this.int32)
  }

  uint32s(known: Uint32Array, fixed = -1): Uint32Array {
    return this.numbers(known, this.count(fixed, 4), Uint32Array, this.uint32)
  }

  int16s(known: Int16Array, fixed = -1): Int16Array {
    return this.numbers(known, this.count(fixed, 2), Int16Array, this.int16)
  }

  uint16s(known: Uint16Array, fixed = -1): Uint16Array {
    return this.numbers(known, this.count(fixed, 2), Uint16Array, this.uint16)
  }

  int8s(known: Int8Array, fixed = -1): Int8Array {
    return this.numbers(known, this.count(fixed, 1), Int8Array, this.int8)
  }

  uint8s(known: Uint8Array, fixed = -1): Uint8Array {
    return this.numbers(known, this.count(fixed, 1), Uint8Array, this.uint8)
  }

  int64s(known: BigInt64Array, fixed = -1): BigInt64Array {
    return this.numbers(known, this.count(fixed, 8), BigInt64Array, this.int64)
  }

  uint64s(known: BigUint64Array, fixed = -1): BigUint64Array {
    return this.numbers(known, this.count(fixed, 8), BigUint64Array, this.uint64)
  }

  /** Read messages into those of `known`, which then has as many as the sequence. */
  messages<T>(
    known: T[],
    create: () => T,
    read: (from: CdrReader, into: T) => void,
    fixed = -1,
  ): T[] {
    const count = this.count(fixed, 1)
    if (known.length > count) known.length = count
    for (let i = 0; i < count; i++) {
      const message = known[i] ?? create()
      read(this, message)
      known[i] = message
    }
    return known
  }

  /** Return where `count` values of `size` bytes begin, and go behind them. */
  private aligned(size: number, count = 1): number {
    const at = this.at + ((this.origin - this.at) & (size - 1))
    const behind = at + size * count
    if (behind > this.end) this.fail(behind - at)
    this.at = behind
    return at
  }

  /** Return a sequence's length; of a fixed array that is `fixed`. */
  private count(fixed: number, least: number): number {
    if (fixed >= 0) return fixed
    const count = this.uint32()
    if (this.at + count * least > this.end) this.fail(count * least)
    return count
  }

  private fail(size: number): never {
    throw new CdrError(
      `a value of ${size} bytes begins ${this.at - this.origin} bytes behind the header, and ` +
        `${this.end - this.at} are left: the message is cut off, or of another type`,
    )
  }

  /** Read numbers: a view of the payload where none are kept and it is aligned, else a copy. */
  private numbers<T extends Numbers>(
    known: T,
    count: number,
    kind: NumbersClass<T>,
    one: () => number | bigint,
  ): T {
    // An empty sequence has no padding.
    if (count === 0) return known.length === 0 ? known : new kind(0)
    const size = kind.BYTES_PER_ELEMENT
    const at = this.aligned(size, count)
    const kept = known.length === count
    const foreign = size > 1 && (at % size !== 0 || !HOST_IS_LITTLE || !this.little)
    if (foreign || (kept && count < MANY)) {
      const copy = kept ? known : new kind(count)
      this.at = at
      for (let i = 0; i < count; i++) copy[i] = one.call(this)
      return copy
    }
    const view = new kind(this.view.buffer, at, count)
    if (!kept) return view
    ;(known as { set(from: T): void }).set(view)
    return known
  }

  private same(known: string, from: number, length: number): boolean {
    if (known.length !== length) return false
    for (let i = 0; i < length; i++) {
      const code = this.bytes[from + i] as number
      if (code > 127 || known.charCodeAt(i) !== code) return false
    }
    return true
  }

  private text(from: number, length: number): string {
    if (length === 0) return ''
    if (length > 24) return utf8.decode(this.bytes.subarray(from, from + length))
    let text = ''
    for (let i = 0; i < length; i++) {
      const code = this.bytes[from + i] as number
      if (code > 127) return utf8.decode(this.bytes.subarray(from, from + length))
      text += String.fromCharCode(code)
    }
    return text
  }
}

/** Writes little-endian CDR. */
export class CdrWriter {
  private bytes = new Uint8Array(256)
  private view = new DataView(this.bytes.buffer)
  private at = HEADER

  /** Begin a new payload. */
  open(): this {
    this.bytes.fill(0, 0, this.at)
    this.bytes[1] = 1
    this.at = HEADER
    return this
  }

  /** Return a copy of the payload. */
  payload(): Uint8Array {
    return this.bytes.slice(0, this.at)
  }

  bool(value: boolean): void {
    const at = this.place(1)
    this.view.setUint8(at, value ? 1 : 0)
  }

  uint8(value: number): void {
    const at = this.place(1)
    this.view.setUint8(at, value)
  }

  int8(value: number): void {
    const at = this.place(1)
    this.view.setInt8(at, value)
  }

  uint16(value: number): void {
    const at = this.place(2)
    this.view.setUint16(at, value, true)
  }

  int16(value: number): void {
    const at = this.place(2)
    this.view.setInt16(at, value, true)
  }

  uint32(value: number): void {
    const at = this.place(4)
    this.view.setUint32(at, value, true)
  }

  int32(value: number): void {
    const at = this.place(4)
    this.view.setInt32(at, value, true)
  }

  float32(value: number): void {
    const at = this.place(4)
    this.view.setFloat32(at, value, true)
  }

  float64(value: number): void {
    const at = this.place(8)
    this.view.setFloat64(at, value, true)
  }

  uint64(value: bigint): void {
    const at = this.place(8)
    this.view.setBigUint64(at, value, true)
  }

  int64(value: bigint): void {
    const at = this.place(8)
    this.view.setBigInt64(at, value, true)
  }

  string(value: string): void {
    const text = toUtf8.encode(value)
    this.uint32(text.length + 1)
    const at = this.place(1, text.length + 1)
    this.bytes.set(text, at)
    this.bytes[at + text.length] = 0
  }

  strings(values: readonly string[], fixed = -1): void {
    this.count(values.length, fixed)
    for (const value of values) this.string(value)
  }

  bools(values: readonly boolean[], fixed = -1): void {
    this.count(values.length, fixed)
    for (const value of values) this.bool(value)
  }

  float64s(values: Float64Array, fixed = -1): void {
    this.count(values.length, fixed)
    for (let i = 0; i < values.length; i++) this.float64(values[i] as number)
  }

  float32s(values: Float32Array, fixed = -1): void {
    this.count(values.length, fixed)
    for (let i = 0; i < values.length; i++) this.float32(values[i] as number)
  }

  int32s(values: Int32Array, fixed = -1): void {
    this.count(values.length, fixed)
    for (let i = 0; i < values.length; i++) this.int32(values[i] as number)
  }

  uint32s(values: Uint32Array, fixed = -1): void {
    this.count(values.length, fixed)
    for (let i = 0; i < values.length; i++) this.uint32(values[i] as number)
  }

  int16s(values: Int16Array, fixed = -1): void {
    this.count(values.length, fixed)
    for (let i = 0; i < values.length; i++) this.int16(values[i] as number)
  }

  uint16s(values: Uint16Array, fixed = -1): void {
    this.count(values.length, fixed)
    for (let i = 0; i < values.length; i++) this.uint16(values[i] as number)
  }

  int8s(values: Int8Array, fixed = -1): void {
    this.count(values.length, fixed)
    for (let i = 0; i < values.length; i++) this.int8(values[i] as number)
  }

  uint8s(values: Uint8Array, fixed = -1): void {
    this.count(values.length, fixed)
    this.bytes.set(values, this.place(1, values.length))
  }

  int64s(values: BigInt64Array, fixed = -1): void {
    this.count(values.length, fixed)
    for (let i = 0; i < values.length; i++) this.int64(values[i] as bigint)
  }

  uint64s(values: BigUint64Array, fixed = -1): void {
    this.count(values.length, fixed)
    for (let i = 0; i < values.length; i++) this.uint64(values[i] as bigint)
  }

  messages<T>(values: readonly T[], write: (to: CdrWriter, message: T) => void, fixed = -1): void {
    this.count(values.length, fixed)
    for (const value of values) write(this, value)
  }

  private count(length: number, fixed: number): void {
    if (fixed < 0) this.uint32(length)
    else if (length !== fixed) {
      throw new CdrError(`an array of ${length} values was given where ${fixed} belong`)
    }
  }

  /** Return where `count` values of `size` bytes begin, and go behind them. */
  private place(size: number, count = 1): number {
    const from = this.at - HEADER
    const at = from + ((size - (from % size)) % size) + HEADER
    const end = at + size * count
    if (end > this.bytes.length) {
      const larger = new Uint8Array(Math.max(end, 2 * this.bytes.length))
      larger.set(this.bytes.subarray(0, this.at))
      this.bytes = larger
      this.view = new DataView(larger.buffer)
    }
    this.at = end
    return at
  }
}
