/** Round numbers and moments along an axis. */
import { number } from '../../words/words'

// From here on an axis of time shows minutes and hours, s.
const LONG = 100
const HOUR = 3600
// Allowed distances between two marks, s.
const STEPS = [1, 2, 5, 10, 20, 30, 60, 120, 300, 600, 1200, 1800].concat(
  [1, 2, 6, 12, 24, 24 * 7, 24 * 365].map((hours) => hours * HOUR),
)

function multiples(step: number, low: number, high: number): number[] {
  const found: number[] = []
  for (let n = Math.ceil(low / step - 1e-9); n * step <= high + step * 1e-9; n++) {
    found.push(n * step)
  }
  return found
}

/** Return the smallest of 1, 2, 2.5, 5 and 10 times a power of ten that is not below `least`. */
export function roundStep(least: number): number {
  const power = 10 ** Math.floor(Math.log10(least))
  return ([1, 2, 2.5, 5].find((factor) => factor * power >= least * 0.999) ?? 10) * power
}

/** Return round numbers from `low` to `high`, about `most` of them. */
export function ticks(low: number, high: number, most = 3): number[] {
  return high > low ? multiples(roundStep((high - low) / most), low, high) : [low]
}

/** Return moments on an axis of time with their texts, s. */
export function moments(begin: number, end: number, most: number): [number, string][] {
  if (end < LONG) {
    return ticks(begin, end, most).map((time, i) => [
      time,
      i === 0 ? `${number(time, 3)} s` : number(time, 3),
    ])
  }
  const step = STEPS.find((each) => (end - begin) / each <= most) ?? HOUR
  const times = multiples(step, begin, end)
  const long = (times.at(-1) ?? 0) >= HOUR
  return times.map((time, i) => [time, `${clock(time, long)}${i > 0 ? '' : long ? ' h' : ' min'}`])
}

/** Return 2:05 of 125 s, with hours 0:02:05. */
export function clock(seconds: number, hours: boolean): string {
  const whole = Math.round(seconds)
  const two = (value: number) => String(value).padStart(2, '0')
  const minutes = Math.floor(whole / 60)
  if (!hours) return `${minutes}:${two(whole % 60)}`
  return `${Math.floor(minutes / 60)}:${two(minutes % 60)}:${two(whole % 60)}`
}

/** Return a duration or moment as a person reads it: 2.05 s, 2:05 min, 1:02:05 h. */
export function lasting(seconds: number): string {
  if (seconds < LONG) return `${number(seconds, 2, 2)} s`
  return seconds < HOUR ? `${clock(seconds, false)} min` : `${clock(seconds, true)} h`
}
