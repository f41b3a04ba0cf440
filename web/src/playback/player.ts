import { type PlaybackClock, positionAt } from './clock'

/** Speeds that a person may choose, 1 is the declared one; the range is that of the lab. */
export const RATES = [0.1, 0.25, 0.5, 1, 2, 4] as const
/** The same backwards; a bag is replayed forwards alone. */
export const BACKWARD_RATES = [-0.25, -0.5, -1, -2, -4] as const

/** Return the next faster or slower of the chosen speeds; step: 1 or -1. */
export function rateAfter(rate: number, step: number): number {
  const index = RATES.findIndex((each) => each >= rate - 1e-9)
  return RATES[Math.min(Math.max(index + step, 0), RATES.length - 1)] ?? rate
}

/** A player with a timeline: of a live robot, a bag or a motion. */
export interface Player {
  readonly kind: 'live' | 'bag' | 'motion'
  /** s */
  readonly duration: number
  readonly playing: boolean
  readonly rate: number
  /** Return the place on the timeline now, s, from 0 to duration. */
  position(): number
  play(): void
  pause(): void
  /** s */
  seek(position: number): void
  setRate(rate: number): void
  /** Be called after each change of clock: play, pause, seek, rate, end. */
  onChange(listener: () => void): () => void
}

/** The commands of a player: services of a playback, a system or the recorder. */
export interface Commands {
  play(): void
  pause(): void
  seek(position: number): void
  setRate(rate: number): void
}

function within(position: number, duration: number): number {
  return Math.min(Math.max(position, 0), duration)
}

/** Return whether a clock that is at `position` still has a way to go. */
function goesOn(rate: number, position: number, duration: number): boolean {
  return rate > 0 ? position < duration : rate < 0 && position > 0
}

class Listeners {
  private readonly known = new Set<() => void>()

  add(listener: () => void): () => void {
    this.known.add(listener)
    return () => this.known.delete(listener)
  }

  call(): void {
    for (const listener of this.known) listener()
  }
}

/** Plays a local motion. now: s of any steady clock. */
export class MotionPlayer implements Player {
  readonly kind = 'motion'
  private clock: PlaybackClock
  private chosen = 1
  private readonly listeners = new Listeners()

  constructor(
    readonly duration: number,
    private readonly now: () => number,
  ) {
    this.clock = { stamp: now(), position: 0, rate: 0 }
  }

  get playing(): boolean {
    return goesOn(this.clock.rate, this.position(), this.duration)
  }

  get rate(): number {
    return this.chosen
  }

  position(): number {
    return within(positionAt(this.clock, this.now()), this.duration)
  }

  /** From the end it starts over; backwards, from the start at the end. */
  play(): void {
    const position = this.position()
    const begin = this.chosen < 0 ? this.duration : 0
    this.retake(goesOn(this.chosen, position, this.duration) ? position : begin, this.chosen)
  }

  pause(): void {
    this.retake(this.position(), 0)
  }

  seek(position: number): void {
    const playing = this.playing
    this.retake(within(position, this.duration), playing ? this.chosen : 0)
  }

  setRate(rate: number): void {
    const playing = this.playing
    this.chosen = rate
    this.retake(this.position(), playing ? rate : 0)
  }

  onChange(listener: () => void): () => void {
    return this.listeners.add(listener)
  }

  private retake(position: number, rate: number): void {
    this.clock = { stamp: this.now(), position, rate }
    this.listeners.call()
  }
}

/** Follows a clock that is kept elsewhere: that of a robot in the lab, or of a bag's replay. */
export class RemotePlayer implements Player {
  duration = 0
  rate = 1
  private clock: PlaybackClock = { stamp: 0, position: 0, rate: 0 }
  /** Lab time at which it was held; null: it runs. */
  private heldAt: number | null = null
  private readonly listeners = new Listeners()

  constructor(
    readonly kind: 'live' | 'bag',
    private readonly labTime: () => number,
    private readonly commands: Commands,
  ) {}

  get playing(): boolean {
    return this.heldAt === null && goesOn(this.clock.rate, this.position(), this.duration)
  }

  position(): number {
    return within(positionAt(this.clock, this.heldAt ?? this.labTime()), this.duration)
  }

  /** Hold the clock while the link is lost; false: continue. */
  hold(on: boolean): void {
    if (on === (this.heldAt !== null)) return
    this.heldAt = on ? this.labTime() : null
    this.listeners.call()
  }

  /** Take over the lab's clock, duration, s, and chosen rate. */
  follow(clock: PlaybackClock, duration: number, rate: number): void {
    const { stamp, position, rate: speed } = this.clock
    const same =
      stamp === clock.stamp &&
      position === clock.position &&
      speed === clock.rate &&
      duration === this.duration &&
      rate === this.rate
    if (same) return
    this.clock = { stamp: clock.stamp, position: clock.position, rate: clock.rate }
    this.duration = duration
    this.rate = rate
    this.listeners.call()
  }

  play(): void {
    this.commands.play()
  }

  pause(): void {
    this.commands.pause()
  }

  seek(position: number): void {
    this.commands.seek(within(position, this.duration))
  }

  setRate(rate: number): void {
    this.commands.setRate(rate)
  }

  onChange(listener: () => void): () => void {
    return this.listeners.add(listener)
  }
}
