import { signal } from '@preact/signals'

const PREFIX = 'mrlab.room.'

/** A switch that the browser remembers. */
export class Switch {
  private readonly on = signal(false)

  constructor(private readonly key: string) {
    this.on.value = localStorage.getItem(PREFIX + key) === 'yes'
  }

  get value(): boolean {
    return this.on.value
  }

  set value(on: boolean) {
    this.on.value = on
    localStorage.setItem(PREFIX + this.key, on ? 'yes' : 'no')
  }

  toggle(): void {
    this.value = !this.value
  }
}

/** What a person chose for their own eyes and hands; kept in the browser. */
export class Settings {
  readonly leftHanded = new Switch('left')
}
