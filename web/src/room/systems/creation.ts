/** Robots that are touched in order, to become a system. */
export class Creation {
  private readonly names: string[] = []
  private active = false

  /** changed: something of it is to be painted. */
  constructor(private readonly changed: () => void) {}

  get on(): boolean {
    return this.active
  }

  /** The robots in order of touch; empty while it is off. */
  get picked(): readonly string[] {
    return this.names
  }

  begin(): void {
    this.active = true
    this.names.length = 0
    this.changed()
  }

  end(): void {
    this.active = false
    this.names.length = 0
    this.changed()
  }

  /** Forget removed robots. */
  keep(here: (name: string) => boolean): void {
    const left = this.names.filter(here)
    if (left.length === this.names.length) return
    this.names.splice(0, this.names.length, ...left)
    this.changed()
  }

  /** Append a touched robot, or remove it again. */
  touch(name: string): void {
    if (!this.active) return
    const index = this.names.indexOf(name)
    if (index >= 0) this.names.splice(index, 1)
    else this.names.push(name)
    this.changed()
  }
}
