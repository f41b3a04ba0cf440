import { type Signal, signal } from '@preact/signals'
import { createContext } from 'preact'

/** The one time that all of a report shows, and the finding that is chosen. */
export interface Playhead {
  /** s */
  readonly time: Signal<number>
  /** Number of a finding, from 1; 0: none. */
  readonly selected: Signal<number>
  /** Seek to a time, s, and pause. */
  seek(time: number): void
}

export const PlayheadContext = createContext<Playhead>({
  time: signal(0),
  selected: signal(0),
  seek: () => {},
})
