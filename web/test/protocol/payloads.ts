import { CdrWriter } from '../../src/protocol/cdr'

const writer = new CdrWriter()

/** Return joint states as a lab sends them; no velocities and no efforts. */
export function jointStatePayload(name: string[], position: Float64Array): Uint8Array {
  const to = writer.open()
  header(to)
  to.strings(name)
  to.float64s(position)
  to.float64s(new Float64Array(0))
  to.float64s(new Float64Array(0))
  return to.payload()
}

/** Return an object that the lab removed. */
export function objectRemovedPayload(name: string): Uint8Array {
  const to = writer.open()
  header(to)
  for (const each of [name, '', '', '']) to.string(each)
  to.uint32(0)
  return to.payload()
}

/** Return the response of a service without results of its own. */
export function responsePayload(success: boolean, message: string): Uint8Array {
  const to = writer.open()
  to.bool(success)
  to.string(message)
  to.string('')
  to.uint32(0)
  return to.payload()
}

/** Return a lab without robots. */
export function robotsPayload(): Uint8Array {
  const to = writer.open()
  header(to)
  to.uint32(0)
  to.string('')
  return to.payload()
}

function header(to: CdrWriter): void {
  to.int32(0)
  to.uint32(0)
  to.string('')
}
