import type { Target } from './pointer'

/** The targets of all pointers. A pointer must forget a target that is removed. */
export class Targets {
  readonly all: Target[] = []

  /** forget: called with each target that is removed. */
  constructor(private readonly forget: (target: Target) => void) {}

  add(target: Target): void {
    this.all.push(target)
  }

  remove(target: Target): void {
    const index = this.all.indexOf(target)
    if (index < 0) return
    this.all.splice(index, 1)
    this.forget(target)
  }
}
