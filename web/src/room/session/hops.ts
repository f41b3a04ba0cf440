import type { LinkStatus } from '../../link/link'
import { sentence } from '../../words/diagnostic'
import type { Words } from '../../words/en'
import type { Ability } from './features'

/** s within which a running lab publishes its robots. */
const SILENCE_S = 6

/** The state of each hop between the lab's robots and a person's eyes. */
export interface Way {
  readonly ability: Ability | null
  readonly link: LinkStatus
  /** s since the link opened; NaN: it is not open. */
  readonly openFor: number
  /** True once the lab has published its robots; and their number. */
  readonly known: boolean
  readonly robots: number
  /** The processes of the lab that do not run, or run again since a short while, in words. */
  readonly outages: readonly string[]
  /** The files of meshes that could not be read. */
  readonly troubles: readonly string[]
}

/** A hop that failed or is not ready: its problem, and the remedy. */
export interface Hop {
  readonly id: 'headset' | 'gateway' | 'lab' | 'process' | 'robots' | 'meshes'
  readonly severity: 'info' | 'warning' | 'error'
  readonly words: string
}

/** Return the problems between the lab and the eyes, the first hop first; empty: none. Hops behind
 * one that failed are unknown and left out. */
export function hopsOf(way: Way, words: Words['room']): Hop[] {
  const found: Hop[] = []
  const hindrance = way.ability?.hindrance ?? ''
  if (hindrance !== '') {
    const severity = hindrance === 'no_https' ? 'warning' : 'info'
    found.push({ id: 'headset', severity, words: words.hindrances[hindrance] })
  }
  const { phase, reason } = way.link
  if (phase !== 'open') {
    const text = phase === 'connecting' ? words.hops.connecting : words.hops[phase](reason)
    const severity = phase === 'connecting' ? 'info' : 'error'
    found.push({ id: 'gateway', severity, words: text })
    return found
  }
  if (!way.known) {
    if (way.openFor > SILENCE_S) {
      found.push({ id: 'lab', severity: 'error', words: words.hops.silent })
    }
    return found
  }
  for (const words of way.outages) found.push({ id: 'process', severity: 'warning', words })
  if (way.robots === 0) found.push({ id: 'robots', severity: 'info', words: words.empty })
  if (way.troubles.length > 0) {
    found.push({
      id: 'meshes',
      severity: 'warning',
      words: words.missing(way.troubles.join(', ')),
    })
  }
  return found
}

/** Return the reason for which a headset refused a session, for its person. */
export function refusalOf(error: unknown, words: Words['room']): string {
  const name = error instanceof Error ? error.name : ''
  if (name === 'NotAllowedError' || name === 'SecurityError') {
    return words.refusedEntry(words.permission)
  }
  if (name === 'NotSupportedError') return words.refusedEntry(words.noFloor)
  if (name === 'InvalidStateError') return words.refusedEntry(words.busy)
  return words.refusedEntry(sentence(error))
}
