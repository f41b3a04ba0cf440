import { THEMES } from '../../design/tokens'

type Theme = {
  readonly [key in keyof typeof THEMES.dark]: (typeof THEMES.dark)[key] extends readonly string[]
    ? readonly string[]
    : Readonly<Record<keyof (typeof THEMES.dark)[key], string>>
}

export const FONT = 'system-ui, -apple-system, "Segoe UI", Roboto, "Liberation Sans", sans-serif'
/** Texels a mm: 1 mm is 3.8 arc minutes at 0.9 m, more than a headset shows. */
export const TEXELS = 2
/** Heights of text, mm. read: a sentence on a panel of the scene, which is shrunk to 0.6: it is 1.0
 * degree there, and small is 0.7. */
export const TEXT = { head: 30, read: 27, body: 22, small: 19 } as const
/** Height of a button, and the gap between two, mm. */
export const HIT = 60
export const GAP = 12
/** Side of the button that closes a panel, mm. */
export const CLOSE = 44
/** Share of its size that a line too long for its place keeps. */
const SMALLEST = 0.8

/** The room is read before white walls and dark desks alike: the panels are dark in every theme. */
export let PANEL_THEME: Theme = THEMES.dark

const CONTRAST: Theme = {
  ...THEMES.dark,
  colours: {
    ...THEMES.dark.colours,
    page: '#000000',
    card: '#000000',
    ink: '#FFFFFF',
    second: '#FFFFFF',
    border: '#FFFFFF',
    hairline: '#FFFFFF',
    accent: '#FFE600',
    on_accent: '#000000',
  },
}

/** Paint panels in black and white, or as usual; painted panels must be repainted. */
export function setContrast(high: boolean): void {
  PANEL_THEME = high ? CONTRAST : THEMES.dark
}

/** A part of a panel that can be pressed, mm from the left top corner. */
export interface Zone {
  readonly x: number
  readonly y: number
  readonly width: number
  readonly height: number
  /** Name of the zone, for tests, and to keep its hover across a repaint. */
  readonly id: string
  readonly enabled: boolean
  /** share: position of the press or drag across it, 0 to 1; final: it was released. */
  press(share: number, final: boolean): void
  /** Follows a drag; otherwise it acts once, on a release above it. */
  readonly drags: boolean
}

interface ButtonLook {
  readonly primary?: boolean
  readonly chosen?: boolean
  readonly enabled?: boolean
  readonly small?: boolean
  readonly picture?: CanvasImageSource | null
  /** A tick before the words: it is on. */
  readonly tick?: boolean
}

type Ink = 'ink' | 'second' | 'accent' | 'border'

/** Draws a panel in mm, and collects its zones. */
export class Pen {
  readonly zones: Zone[] = []

  constructor(
    readonly context: CanvasRenderingContext2D,
    readonly width: number,
    readonly height: number,
    private readonly hovered: string,
    private readonly pressed: string,
  ) {
    context.setTransform(TEXELS, 0, 0, TEXELS, 0, 0)
    context.clearRect(0, 0, width, height)
    context.fillStyle = PANEL_THEME.colours.card
    context.strokeStyle = PANEL_THEME.colours.border
    context.lineWidth = 2
    context.beginPath()
    context.roundRect(1, 1, width - 2, height - 2, 22)
    context.fill()
    context.stroke()
  }

  /** Write one line, cut with … if it is longer than `most`; return its width, mm. */
  text(
    x: number,
    y: number,
    words: string,
    size: number = TEXT.body,
    most = this.width - x - 24,
    ink: Ink | string = 'ink',
    weight = 400,
    align: CanvasTextAlign = 'left',
  ): number {
    const { context } = this
    context.font = `${weight} ${size}px ${FONT}`
    context.fillStyle = this.colour(ink)
    context.textAlign = align
    context.textBaseline = 'middle'
    let shown = words
    let wide = context.measureText(shown).width
    if (wide > most) {
      // other languages have longer words: smaller first, then cut
      context.font = `${weight} ${Math.max(most / wide, SMALLEST) * size}px ${FONT}`
      wide = context.measureText(shown).width
    }
    while (shown.length > 1 && wide > most) {
      shown = `${shown.slice(0, -2).trimEnd()}…`
      wide = context.measureText(shown).width
    }
    context.fillText(shown, x, y)
    return wide
  }

  /** Write several lines from `y` on; return the place below them. */
  lines(
    x: number,
    y: number,
    words: string,
    size: number = TEXT.body,
    most = this.width - 2 * x,
    ink: Ink | string = 'ink',
    rows = 4,
  ): number {
    const { context } = this
    context.font = `400 ${size}px ${FONT}`
    let line = ''
    let row = 0
    let at = y
    const put = (text: string) => {
      this.text(x, at, text, size, most, ink)
      at += size * 1.32
      row++
    }
    for (const word of words.split(' ')) {
      const longer = line === '' ? word : `${line} ${word}`
      if (context.measureText(longer).width <= most || line === '') line = longer
      else {
        if (row >= rows - 1) {
          line = longer
          continue
        }
        put(line)
        line = word
      }
    }
    if (line !== '') put(line)
    return at
  }

  button(
    id: string,
    x: number,
    y: number,
    width: number,
    words: string,
    act: () => void,
    {
      primary = false,
      chosen = false,
      enabled = true,
      small = false,
      tick = false,
    }: ButtonLook = {},
    height = HIT,
  ): void {
    this.face(id, x, y, width, height, { primary, chosen, enabled })
    const ink = !enabled
      ? PANEL_THEME.colours.border
      : primary
        ? PANEL_THEME.colours.on_accent
        : PANEL_THEME.colours.ink
    const size = small ? TEXT.small : TEXT.body
    const shown = tick ? `✓ ${words}` : words
    this.text(x + width / 2, y + height / 2 + 1, shown, size, width - 14, ink, 600, 'center')
    this.zone({
      id,
      x,
      y,
      width,
      height,
      enabled,
      drags: false,
      press: (_, final) => final && act(),
    })
  }

  /** A zone over a whole height from the left: the hover frames it. */
  whole(id: string, width: number, height: number, act: () => void): void {
    if (id === this.hovered || id === this.pressed) {
      this.face(id, 4, 4, width - 8, height - 8, { enabled: true })
    }
    const press = (_: number, final: boolean) => final && act()
    this.zone({ id, x: 0, y: 0, width, height, enabled: true, drags: false, press })
  }

  /** A card with a picture above its words. */
  card(
    id: string,
    x: number,
    y: number,
    width: number,
    height: number,
    words: string,
    note: string,
    picture: CanvasImageSource | null,
    act: () => void,
    look: Pick<ButtonLook, 'chosen'> = {},
  ): void {
    this.face(id, x, y, width, height, { ...look, enabled: true })
    const side = height - 66
    if (picture !== null) {
      this.context.drawImage(picture, x + (width - side) / 2, y + 6, side, side)
    }
    this.text(x + width / 2, y + height - 44, words, TEXT.small, width - 12, 'ink', 600, 'center')
    this.text(
      x + width / 2,
      y + height - 20,
      note,
      TEXT.small,
      width - 12,
      'second',
      400,
      'center',
    )
    this.zone({
      id,
      x,
      y,
      width,
      height,
      enabled: true,
      drags: false,
      press: (_, final) => final && act(),
    })
  }

  /** The button at the right top corner that makes a chip of a panel. right: its right edge, mm. */
  close(right: number, act: () => void): void {
    this.button('close', right - CLOSE, 36 - CLOSE / 2, CLOSE, '–', act, {}, CLOSE)
  }

  /** A pill with a word; filled for a warning. */
  chip(right: number, y: number, words: string, colour: string, filled: boolean): void {
    const { context } = this
    context.font = `600 ${TEXT.small}px ${FONT}`
    const width = context.measureText(words).width + 28
    context.beginPath()
    context.roundRect(right - width, y - 17, width, 34, 17)
    context.lineWidth = 2.5
    context.strokeStyle = colour
    context.fillStyle = colour
    if (filled) context.fill()
    context.stroke()
    const ink = filled ? PANEL_THEME.colours.on_halt : colour
    this.text(right - width / 2, y + 1, words, TEXT.small, width, ink, 600, 'center')
  }

  /** A filled box with rounded corners. */
  box(x: number, y: number, width: number, height: number, colour: string): void {
    const { context } = this
    context.beginPath()
    context.roundRect(x, y, width, height, 12)
    context.fillStyle = colour
    context.fill()
  }

  zone(zone: Zone): void {
    this.zones.push(zone)
  }

  colour(ink: Ink | string): string {
    return ink in PANEL_THEME.colours
      ? PANEL_THEME.colours[ink as keyof typeof PANEL_THEME.colours]
      : ink
  }

  private face(
    id: string,
    x: number,
    y: number,
    width: number,
    height: number,
    { primary = false, chosen = false, enabled = true }: ButtonLook,
  ): void {
    const { context } = this
    const { colours } = PANEL_THEME
    context.beginPath()
    context.roundRect(x, y, width, height, 12)
    context.fillStyle = !enabled ? colours.card : primary ? colours.accent : colours.page
    if (enabled && id === this.pressed) context.fillStyle = colours.border
    else if (enabled && id === this.hovered && !primary) context.fillStyle = colours.hairline
    context.fill()
    const strong = enabled && (chosen || id === this.hovered)
    context.lineWidth = strong ? 4 : 2
    context.strokeStyle = strong ? colours.accent : colours.hairline
    if (primary && id === this.hovered) context.strokeStyle = colours.ink
    context.stroke()
  }
}
