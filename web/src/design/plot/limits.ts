import type uPlot from 'uplot'
import { fixed } from '../../words/words'
import type { Theme } from '../theme'

export const FONT = '13px system-ui, -apple-system, "Segoe UI", Roboto, sans-serif'
const TEXT = 15 // height of a label of a limit, CSS pixels

/** The limits of a line, in the unit that is shown; null: it has none. */
export interface Limits {
  readonly lower: number | null
  readonly upper: number | null
  /** As shown, such as deg. */
  readonly unit: string
}

export interface LimitWords {
  /** Such as "limit 180". */
  limit(value: string): string
  /** Such as "limits -180 and 180". */
  limits(low: string, high: string): string
}

function hatch(colour: string, ratio: number): CanvasPattern | null {
  const size = Math.round(7 * ratio)
  const tile = document.createElement('canvas')
  tile.width = size
  tile.height = size
  const context = tile.getContext('2d')
  if (context === null) return null
  context.strokeStyle = colour
  context.lineWidth = ratio
  context.beginPath()
  for (const shift of [-size, 0, size]) {
    context.moveTo(shift, size)
    context.lineTo(shift + size, 0)
  }
  context.stroke()
  return context.createPattern(tile, 'repeat')
}

/** Hatch the ranges beyond the limits, and label the limits. */
export function drawForbidden(plot: uPlot, line: Limits, theme: Theme, words: LimitWords): void {
  const { ctx, bbox } = plot
  const ratio = devicePixelRatio
  const colour = theme.states.COLLISION_HALT
  const pattern = hatch(colour, ratio)
  const bottom = bbox.top + bbox.height
  ctx.save()
  ctx.beginPath()
  ctx.rect(bbox.left, bbox.top, bbox.width, bbox.height)
  ctx.clip()
  ctx.font = FONT.replace('13', String(13 * ratio))
  const label = (text: string, y: number) => {
    // On a patch of the card, so that neither hatching nor line crosses the letters.
    const width = ctx.measureText(text).width
    ctx.globalAlpha = 0.85
    ctx.fillStyle = theme.colours.card
    ctx.fillRect(bbox.left + 4 * ratio, y, width + 8 * ratio, TEXT * ratio)
    ctx.globalAlpha = 1
    ctx.fillStyle = colour
    ctx.textBaseline = 'top'
    ctx.fillText(text, bbox.left + 8 * ratio, y + ratio)
  }
  const places: number[] = []
  for (const [limit, above] of [
    [line.upper, true],
    [line.lower, false],
  ] as const) {
    if (limit === null) continue
    const y = plot.valToPos(limit, 'y', true)
    if (y <= bbox.top || y >= bottom) continue
    const [from, height] = above ? [bbox.top, y - bbox.top] : [y, bottom - y]
    ctx.globalAlpha = 0.7
    if (pattern) ctx.fillStyle = pattern
    ctx.fillRect(bbox.left, from, bbox.width, height)
    ctx.globalAlpha = 1
    ctx.strokeStyle = colour
    ctx.lineWidth = 1.25 * ratio
    ctx.beginPath()
    ctx.moveTo(bbox.left, y)
    ctx.lineTo(bbox.left + bbox.width, y)
    ctx.stroke()
    places.push(y)
  }
  const { upper, lower } = line
  const [top, low] = places
  if (top !== undefined && low !== undefined && low - top < 2 * TEXT * ratio) {
    // too near to each other for a label each
    const middle = (top + low - TEXT * ratio) / 2
    label(words.limits(fixed(lower ?? 0, 0), fixed(upper ?? 0, 0)), middle)
    ctx.restore()
    return
  }
  for (const [limit, above] of [
    [upper, true],
    [lower, false],
  ] as const) {
    if (limit === null) continue
    const y = plot.valToPos(limit, 'y', true)
    const text = words.limit(fixed(limit, 0))
    if (y > bbox.top && y < bottom) label(text, above ? y + 3 * ratio : y - 17 * ratio)
  }
  ctx.restore()
}
