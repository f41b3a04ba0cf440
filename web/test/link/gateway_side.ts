/** A gateway's end of the socket, for tests: it decodes the page's messages, and sends those of
 * the test. */

export const TOKEN = 'token-1'

export class GatewaySide {
  static last: GatewaySide
  static readonly all: GatewaySide[] = []
  binaryType = 'blob'
  readyState = 0
  onopen: (() => void) | null = null
  onmessage: ((event: { data: ArrayBuffer | string }) => void) | null = null
  onclose: ((event: { code: number; reason: string }) => void) | null = null
  readonly texts: Record<string, unknown>[] = []
  readonly calls: { key: string; request: number; payload: Uint8Array }[] = []
  readonly granted: number[] = []
  readonly received: number[] = []
  closedByPage = false
  private fragmentNumber = 0

  constructor(
    readonly url: string,
    readonly protocol: string,
  ) {
    GatewaySide.last = this
    GatewaySide.all.push(this)
  }

  /** Let the page connect, and welcome it. */
  open({ resumed = false, lab = 'open', token = TOKEN } = {}): this {
    this.readyState = 1
    this.onopen?.()
    this.text({ op: 'welcome', token, resumed })
    this.text({ op: 'lab', phase: lab, topics: {}, services: {}, latched: [] })
    return this
  }

  /** Take a message of the page. */
  send(data: string | Uint8Array): void {
    if (typeof data === 'string') {
      this.texts.push(JSON.parse(data) as Record<string, unknown>)
      return
    }
    const bytes = data.slice()
    const view = new DataView(bytes.buffer)
    const kind = view.getUint8(0)
    if (kind === 3) this.granted.push(view.getUint32(4, true))
    else if (kind === 4) this.received.push(view.getUint32(4, true))
    else {
      const behind = 12 + view.getUint16(2, true)
      this.calls.push({
        key: new TextDecoder().decode(bytes.subarray(12, behind)),
        request: view.getUint32(4, true),
        payload: bytes.subarray(behind),
      })
    }
  }

  close(): void {
    this.readyState = 3
    this.closedByPage = true
  }

  /** End the connection as a gateway, or the way to it, does. */
  end(code = 1006, reason = ''): void {
    this.readyState = 3
    this.onclose?.({ code, reason })
  }

  text(message: object): void {
    this.onmessage?.({ data: JSON.stringify(message) })
  }

  topic(id: number, key: string, { latched = false, each = false } = {}): void {
    this.text({ op: 'topic', id, key, type: '', latched, each })
  }

  batch(
    number: number,
    entries: readonly { topic: number; payload: Uint8Array; stamp?: number }[],
  ): void {
    const size = entries.reduce((sum, { payload }) => sum + padded(20 + payload.length), 8)
    const frame = new Uint8Array(size)
    const view = new DataView(frame.buffer)
    view.setUint8(0, 1)
    view.setUint16(2, entries.length, true)
    view.setUint32(4, number, true)
    let at = 8
    for (const { topic, payload, stamp = 1.5 } of entries) {
      head(view, at, topic, payload.length, stamp, 1)
      frame.set(payload, at + 20)
      at += padded(20 + payload.length)
    }
    this.onmessage?.({ data: frame.buffer })
  }

  /** Send a record in pieces of `size` bytes; begin at fragment `from`. */
  record(
    kind: number,
    about: number,
    payload: Uint8Array,
    { size = 8192, from = this.fragmentNumber + 1 } = {},
  ): void {
    const whole = new Uint8Array(20 + payload.length)
    head(new DataView(whole.buffer), 0, about, payload.length, 2.5, kind)
    whole.set(payload, 20)
    this.fragmentNumber = from - 1
    for (let at = 0; at < whole.length; at += size) {
      const piece = whole.subarray(at, at + size)
      const frame = new Uint8Array(8 + piece.length)
      const view = new DataView(frame.buffer)
      this.fragmentNumber++
      view.setUint8(0, 2)
      view.setUint8(1, at + size >= whole.length ? 1 : 0)
      view.setUint32(4, this.fragmentNumber, true)
      frame.set(piece, 8)
      this.onmessage?.({ data: frame.buffer })
    }
  }

  /** The newest text of an op. */
  sent(op: string): Record<string, unknown> | undefined {
    return this.texts.findLast((text) => text.op === op)
  }
}

function padded(size: number): number {
  return Math.ceil(size / 8) * 8
}

function head(
  view: DataView,
  at: number,
  about: number,
  length: number,
  stamp: number,
  last: number,
): void {
  view.setUint32(at, about, true)
  view.setUint32(at + 4, length, true)
  view.setFloat64(at + 8, stamp, true)
  view.setUint32(at + 16, last, true)
}
