import { effect, signal } from '@preact/signals'
import { setContrast } from '../panels/pen'
import type { RoomStage } from '../scene/stage'
import type { Visit } from './visit'

/** Exposure of each level of brightness. */
const BRIGHTNESS = [0.5, 0.75, 1] as const
const PREFIX = 'mrlab.room.'

/** A switch that the browser remembers. */
export class Switch {
  private readonly on = signal(false)

  /** usually: its default. */
  constructor(
    private readonly key: string,
    usually = false,
  ) {
    const kept = localStorage.getItem(PREFIX + key)
    this.on.value = kept === null ? usually : kept === 'yes'
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

/** One of three levels that the browser remembers: 0 is the least. */
export class Level {
  private readonly at = signal(2)

  /** usually: its default. */
  constructor(
    private readonly key: string,
    usually = 2,
  ) {
    const kept = Number.parseInt(localStorage.getItem(PREFIX + key) ?? '', 10)
    this.at.value = kept >= 0 && kept <= 2 ? kept : usually
  }

  get value(): number {
    return this.at.value
  }

  /** Go to the next level, from the last to the first. */
  next(): void {
    this.at.value = (this.at.value + 1) % 3
    localStorage.setItem(PREFIX + this.key, String(this.at.value))
  }
}

/** A person's settings, kept in the browser. */
export class Settings {
  readonly leftHanded = new Switch('left')
  readonly seated = new Switch('seated')
  readonly largeText = new Switch('large_text')
  readonly contrast = new Switch('contrast', matchMedia('(prefers-contrast: more)').matches)
  readonly still = new Switch('still', matchMedia('(prefers-reduced-motion: reduce)').matches)
  /** True if what happens is written low in the view. */
  readonly captions = new Switch('captions')
  /** True if real things hide robots and objects behind them. */
  readonly occlusion = new Switch('occlusion', true)
  /** The light of the real room, few of whose headsets estimate it. */
  readonly brightness = new Level('brightness')
  readonly warmth = new Level('warmth', 0)
  /** True once the tour was taken or skipped. */
  readonly toured = new Switch('toured')
}

/** Return the persistent id of this headset or browser, which its other pages share. */
export function deviceId(): string {
  const key = `${PREFIX}device`
  const kept = localStorage.getItem(key)
  if (kept !== null && /^[0-9a-f]{12}$/.test(kept)) return kept
  const made = randomId(6)
  localStorage.setItem(key, made)
  return made
}

/** Return `bytes` random bytes in hexadecimal; works without HTTPS too. */
export function randomId(bytes: number): string {
  const values = crypto.getRandomValues(new Uint8Array(bytes))
  return [...values].map((value) => value.toString(16).padStart(2, '0')).join('')
}

/** Apply the settings to the room whenever they change; returns a function that ends it. repaint:
 * all panels. */
export function applySettings(
  settings: Settings,
  visit: Visit,
  stage: Pick<RoomStage, 'setLight'>,
  repaint: () => void,
): () => void {
  const undo = [
    effect(() => {
      setContrast(settings.contrast.value)
      repaint()
    }),
    effect(() => visit.seat(settings.seated.value)),
    effect(() => visit.hide(settings.occlusion.value)),
    effect(() => {
      const { brightness, warmth } = settings
      stage.setLight(BRIGHTNESS[brightness.value] ?? 1, warmth.value / 2)
    }),
  ]
  return () => {
    for (const each of undo) each()
  }
}
