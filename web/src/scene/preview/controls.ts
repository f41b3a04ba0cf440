import { fixed, number } from '../../words/words'
import '../stage/scene.css'
import { BACKWARD_RATES, type Player, RATES } from '../../playback/player'
import type { SceneWords } from '../../words/words'

const ICONS = {
  play: 'M8 5.5v13l11-6.5z',
  pause: 'M7 5.5h3.6v13H7zM13.4 5.5H17v13h-3.6z',
} as const

/** Something at a place of a timeline. */
export interface TimeMark {
  /** s */
  readonly time: number
  readonly severity: 'info' | 'warning' | 'error'
  readonly words: string
}

/** By severity, on 24 x 24: an octagon, a triangle, a ring. */
const SIGNS = {
  error: 'M8.500 3h7L21 8.500v7L15.500 21h-7L3 15.500v-7z',
  warning: 'M12 3.500 21.500 20.500h-19z',
  info: 'M12 4a8 8 0 1 0 .01 0z',
} as const
/** To which a thumb goes while a motion plays: each is a layout of the page. */
const PLACES = 1000
const SVG = 'http://www.w3.org/2000/svg'

/** Play, a timeline, the time and the speed, for a player. */
export class Controls {
  readonly element = document.createElement('div')
  private readonly button = document.createElement('button')
  private readonly icon = document.createElementNS('http://www.w3.org/2000/svg', 'path')
  private readonly slider = document.createElement('input')
  private readonly track = document.createElement('span')
  private readonly marks = document.createElement('span')
  private readonly clock = document.createElement('output')
  private readonly speed = document.createElement('select')
  private readonly stopListening: () => void
  private shownTenth = -1
  private shownPlace = -1
  private scrubbing = false

  /** step: s, of the arrow keys on the timeline; rowAt: row of the file at a time. */
  constructor(
    private readonly player: Player,
    private readonly words: SceneWords,
    step: number,
    private readonly rowAt: (time: number) => number,
  ) {
    this.element.className = 'scene-controls'
    this.button.type = 'button'
    this.button.className = 'scene-play'
    const svg = document.createElementNS('http://www.w3.org/2000/svg', 'svg')
    svg.setAttribute('viewBox', '0 0 24 24')
    svg.setAttribute('aria-hidden', 'true')
    svg.append(this.icon)
    this.button.append(svg)
    this.button.addEventListener('click', () => {
      if (player.playing) player.pause()
      else player.play()
    })

    this.slider.type = 'range'
    this.slider.className = 'scene-time'
    this.slider.min = '0'
    this.slider.max = String(player.duration)
    this.slider.step = String(Math.max(step, player.duration / 5000))
    this.slider.setAttribute('aria-label', words.time)
    // A thumb that is dragged stays where the hand has it, wherever the player is meanwhile.
    this.slider.addEventListener('pointerdown', () => {
      this.scrubbing = true
    })
    this.slider.addEventListener('input', () => player.seek(Number(this.slider.value)))
    for (const end of ['pointerup', 'pointercancel', 'change', 'blur'])
      this.slider.addEventListener(end, () => {
        this.scrubbing = false
      })

    this.clock.className = 'scene-clock'
    // the timeline's own value is read when it is asked for
    this.clock.setAttribute('aria-live', 'off')
    this.speed.className = 'scene-speed'
    this.speed.setAttribute('aria-label', words.speed)
    for (const rate of player.kind === 'bag' ? RATES : [...RATES, ...BACKWARD_RATES]) {
      const option = document.createElement('option')
      option.value = String(rate)
      option.textContent = `${number(rate).replace('-', '\u2212')}×`
      this.speed.append(option)
    }
    this.speed.addEventListener('change', () => player.setRate(Number(this.speed.value)))
    this.track.className = 'scene-track'
    this.marks.className = 'scene-marks'
    this.track.append(this.slider, this.marks)
    this.element.append(this.track, this.button, this.clock, this.speed)
    this.stopListening = player.onChange(() => this.showState())
    this.showState()
    this.show(player.position())
  }

  /** Mark places on the timeline; a press on one seeks to it, if that is allowed. A list beside
   * the timeline has the same places for keyboards. */
  setMarks(marks: readonly TimeMark[]): void {
    const { duration } = this.player
    this.marks.replaceChildren(
      ...marks.map(({ time, severity, words }) => {
        const mark = document.createElement('button')
        mark.type = 'button'
        mark.tabIndex = -1
        mark.className = `scene-mark scene-mark-${severity}`
        mark.title = words
        mark.disabled = this.slider.disabled
        const share = duration > 0 ? Math.min(time / duration, 1) : 0
        mark.style.setProperty('--at', String(share))
        const svg = document.createElementNS(SVG, 'svg')
        svg.setAttribute('viewBox', '0 0 24 24')
        svg.setAttribute('aria-hidden', 'true')
        const sign = document.createElementNS(SVG, 'path')
        sign.setAttribute('d', SIGNS[severity])
        svg.append(sign)
        mark.append(svg)
        mark.addEventListener('click', () => this.player.seek(time))
        return mark
      }),
    )
  }

  /** Let it be used or only be looked at. */
  setEnabled(on: boolean): void {
    for (const each of [this.button, this.slider, this.speed]) each.disabled = !on
    for (const mark of this.marks.children) (mark as HTMLButtonElement).disabled = !on
  }

  /** Show a time; the text changes ten times a second at most. */
  show(time: number): void {
    const { playing, duration } = this.player
    const place = playing ? Math.round((time / duration) * PLACES) : -1
    if (!this.scrubbing && (!playing || place !== this.shownPlace))
      this.slider.value = String(time)
    this.shownPlace = this.scrubbing ? -1 : place
    const tenth = playing ? Math.round(time * 10) : -2 - time
    if (tenth === this.shownTenth) return
    this.shownTenth = tenth
    const text = fixed(time, 2)
    this.clock.textContent = `${text} / ${fixed(this.player.duration, 2)} s`
    this.slider.setAttribute('aria-valuetext', this.words.at(text, this.rowAt(time)))
  }

  showState(): void {
    const { playing } = this.player
    this.icon.setAttribute('d', playing ? ICONS.pause : ICONS.play)
    this.button.title = playing ? this.words.pause : this.words.play
    this.speed.value = String(this.player.rate)
    this.slider.max = String(this.player.duration)
    this.shownPlace = -1
  }

  dispose(): void {
    this.stopListening()
    this.element.remove()
  }
}
