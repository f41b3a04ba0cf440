import type { Target } from './pointer'

/** The targets of all pointers. A pointer must forget a target that is removed. */
export class Targets {
  /** Those that pointers meet now. */
  readonly all: Target[] = []
  /** The others, while only some are met. */
  private readonly aside: Target[] = []
  private met: (target: Target) => boolean = () => true

  /** forget: called with each target that is removed. */
  constructor(private readonly forget: (target: Target) => void) {}

  add(target: Target): void {
    const list = this.met(target) ? this.all : this.aside
    list.push(target)
  }

  remove(target: Target): void {
    if (drop(this.aside, target)) return
    if (drop(this.all, target)) this.forget(target)
  }

  /** Let pointers meet only some targets, until `widen`. */
  narrow(met: (target: Target) => boolean): void {
    this.met = met
    for (const target of this.all.filter((each) => !met(each))) {
      this.remove(target)
      this.aside.push(target)
    }
  }

  widen(): void {
    this.met = () => true
    this.all.push(...this.aside.splice(0))
  }
}

function drop(list: Target[], target: Target): boolean {
  const index = list.indexOf(target)
  if (index >= 0) list.splice(index, 1)
  return index >= 0
}
