import type { Vector3 } from 'three'

/** About 0.1 s of frames. */
const SAMPLES = 8
/** m/s: a hand that is lost jumps, no throw is faster. */
const FASTEST = 6
/** s */
const SHORTEST = 1e-3

/** The newest places of a carried object. */
interface Trace {
  readonly times: Float64Array
  readonly places: Float64Array
  count: number
}

export function newTrace(): Trace {
  return { times: new Float64Array(SAMPLES), places: new Float64Array(SAMPLES * 3), count: 0 }
}

/** Add a place. now: s. */
export function trace(into: Trace, now: number, place: Vector3): void {
  const sample = into.count++ % SAMPLES
  into.times[sample] = now
  place.toArray(into.places, sample * 3)
}

/** Write the velocity at which an object leaves the hand, m/s; zero before the trace is full. */
export function velocityOf({ times, places, count }: Trace, into: Vector3): Vector3 {
  if (count < SAMPLES) return into.set(0, 0, 0)
  const newest = (count - 1) % SAMPLES
  const oldest = count % SAMPLES
  const time = Math.max((times[newest] as number) - (times[oldest] as number), SHORTEST)
  const speed = (axis: number) =>
    ((places[newest * 3 + axis] as number) - (places[oldest * 3 + axis] as number)) / time
  return into.set(speed(0), speed(1), speed(2)).clampLength(0, FASTEST)
}
