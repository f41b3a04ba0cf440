import { Ray, Vector3 } from 'three'

/** s after which a hand out of view, whose pose is a guess, releases a target; until then the
 * target stands still. */
const LOST_S = 0.5
/** m: a fingertip hovers from HOVER_IN on until it is farther than HOVER_OUT. */
const HOVER_IN = 0.15
const HOVER_OUT = 0.2
/** m: distances at which a fingertip presses and releases. */
const PRESS = 0.005
const RELEASE = 0.009
/** s between two presses of one finger. */
const COOLDOWN_S = 0.25

/** The point at which a pointer meets a target. */
export interface Hit {
  /** m from the pointer's origin */
  distance: number
  /** in the scene, m */
  readonly point: Vector3
  /** m from the left and from the top, on a panel */
  u: number
  v: number
}

export function newHit(): Hit {
  return { distance: Number.POSITIVE_INFINITY, point: new Vector3(), u: 0, v: 0 }
}

/** select: trigger, pinch, touch or the left mouse button; grip: the squeeze or the right one. */
export type Button = 'select' | 'grip'

/** down and up bracket a capture, in which every move goes to the target, hit or not; cancel ends
 * it without an effect. */
export type Signal =
  | { readonly kind: 'enter' | 'leave' | 'move' | 'cancel'; readonly pointer: Pointer }
  | { readonly kind: 'down' | 'up'; readonly pointer: Pointer; readonly button: Button }

/** Something that pointers can point at: a panel, a robot's base, an object. */
export interface Target {
  /** Return whether the ray meets it; if so, fill `hit`. */
  cast(ray: Ray, hit: Hit): boolean
  /** Return whether a hand at `point` can take hold of it. */
  reaches?(point: Vector3): boolean
  /** Return the distance of a fingertip in front of its face, m, and fill u and v; NaN: not before
   * it. */
  face?(point: Vector3, hit: Hit): number
  on(signal: Signal): void
}

type PointerKind = 'mouse' | 'ray' | 'touch'
export type Hand = 'left' | 'right' | 'none'

/** A pointer and its target. A pressed target captures the pointer until the release. */
export abstract class Pointer {
  readonly hit: Hit = newHit()
  hovered: Target | null = null
  captured: Target | null = null
  /** The place at which it holds things: grip, pinch or fingertip; for a mouse the origin of its
   * ray. */
  readonly place = new Vector3()
  readonly ray = new Ray()
  /** Of the wrist about the ray, rad, to the left; 0: it has none. */
  roll = 0
  tracked = false
  protected lostAt = Number.NaN
  private readonly tried: Hit = newHit()

  constructor(
    readonly kind: PointerKind,
    readonly hand: Hand,
  ) {}

  /** Release everything: the pointer is gone. */
  drop(): void {
    this.captured?.on({ kind: 'cancel', pointer: this })
    this.captured = null
    this.hover(null)
    this.tracked = false
  }

  /** Forget a removed target. */
  forget(target: Target): void {
    if (this.captured === target) this.captured = null
    if (this.hovered === target) this.hovered = null
  }

  protected hover(target: Target | null): void {
    if (target === this.hovered) return
    const before = this.hovered
    this.hovered = target
    before?.on({ kind: 'leave', pointer: this })
    target?.on({ kind: 'enter', pointer: this })
  }

  /** Freeze while it is not tracked; return whether it is to be left alone. */
  protected lose(now: number, tracked: boolean): boolean {
    this.tracked = tracked
    if (tracked) {
      this.lostAt = Number.NaN
      return false
    }
    if (Number.isNaN(this.lostAt)) this.lostAt = now
    if (this.captured === null) this.hover(null)
    else if (now - this.lostAt > LOST_S) this.drop()
    return true
  }

  protected take(from: Hit): void {
    this.hit.distance = from.distance
    this.hit.point.copy(from.point)
    this.hit.u = from.u
    this.hit.v = from.v
  }

  protected attempt(): Hit {
    this.tried.distance = Number.POSITIVE_INFINITY
    return this.tried
  }
}

/** Points from afar: a mouse, a controller's ray or that of a hand. */
export class RayPointer extends Pointer {
  private button: Button | null = null

  /** Point; now: s. tracked: false while the device only guesses. Call after ray and place are
   * set. */
  aim(now: number, tracked: boolean, targets: readonly Target[], hidden = false): void {
    if (this.lose(now, tracked)) return
    if (this.captured !== null) {
      const hit = this.attempt()
      if (this.captured.cast(this.ray, hit)) this.take(hit)
      this.captured.on({ kind: 'move', pointer: this })
      return
    }
    let nearest: Target | null = null
    this.hit.distance = Number.POSITIVE_INFINITY
    if (!hidden) {
      for (const target of targets) {
        const hit = this.attempt()
        if (!target.cast(this.ray, hit) || hit.distance >= this.hit.distance) continue
        this.take(hit)
        nearest = target
      }
      // A target within reach of the hand goes before one that the ray meets.
      for (const target of targets) if (target.reaches?.(this.place)) nearest = target
    }
    this.hover(nearest)
    nearest?.on({ kind: 'move', pointer: this })
  }

  press(button: Button): void {
    if (this.captured !== null || this.hovered === null) return
    this.button = button
    this.captured = this.hovered
    this.captured.on({ kind: 'down', pointer: this, button })
  }

  release(button: Button): void {
    if (this.captured === null || button !== this.button) return
    const target = this.captured
    this.captured = null
    target.on({ kind: 'up', pointer: this, button })
  }
}

/** A fingertip on panels: it hovers before a face, presses through it, and releases a little in
 * front of the pressing distance, so that a trembling finger does not press twice. */
export class TouchPointer extends Pointer {
  private before = Number.NaN
  private pressedAt = Number.NEGATIVE_INFINITY

  /** Move the fingertip, which is `place`. */
  aim(now: number, tracked: boolean, targets: readonly Target[]): void {
    if (this.lose(now, tracked)) {
      this.before = Number.NaN
      return
    }
    const target = this.captured ?? this.nearest(targets)
    if (target === null) {
      this.before = Number.NaN
      this.hover(null)
      return
    }
    if (target !== this.hovered) this.before = Number.NaN
    const distance = target.face?.(this.place, this.hit) ?? Number.NaN
    this.hover(target)
    if (this.captured !== null) {
      if (Number.isNaN(distance) || distance > RELEASE) {
        this.captured = null
        target.on({ kind: 'up', pointer: this, button: 'select' })
      } else target.on({ kind: 'move', pointer: this })
    } else {
      target.on({ kind: 'move', pointer: this })
      // Only from the front: a finger that comes from behind presses nothing.
      const crosses = this.before > PRESS && distance <= PRESS
      if (crosses && now - this.pressedAt > COOLDOWN_S) {
        this.pressedAt = now
        this.captured = target
        target.on({ kind: 'down', pointer: this, button: 'select' })
      }
    }
    this.before = distance
  }

  private nearest(targets: readonly Target[]): Target | null {
    let found: Target | null = null
    let least = Number.POSITIVE_INFINITY
    for (const target of targets) {
      const distance = target.face?.(this.place, this.attempt()) ?? Number.NaN
      const reach = target === this.hovered ? HOVER_OUT : HOVER_IN
      if (Number.isNaN(distance) || Math.abs(distance) > reach) continue
      if (Math.abs(distance) >= least) continue
      least = Math.abs(distance)
      found = target
    }
    return found
  }
}
