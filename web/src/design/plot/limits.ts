import type uPlot from 'uplot'
import { fixed } from '../../words/words'
import type { Theme } from '../theme'

export const FONT = '13px system-ui, -apple-system, "Segoe UI", Roboto, sans-serif'
const TEXT = 15 // height of a label of a limit, CSS pixels

/** The limits of a line, in the unit that is shown; null: it has none. */
export interface Limits {
  readonly lower: number | null
  readonly upper: number | null
  /** As shown, such as °. */
  readonly unit: string
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

/** Hatch the ranges beyond the limits; name the limits in the gutter right of the curves, those
 * that the axis does not reach with an arrow. */
export function drawForbidden(plot: uPlot, line: Limits, theme: Theme): void {
  const { ctx, bbox } = plot
  const ratio = devicePixelRatio
  const colour = theme.states.COLLISION_HALT
  const pattern = hatch(colour, ratio)
  const right = bbox.left + bbox.width
  const bottom = bbox.top + bbox.height
  const half = (TEXT / 2) * ratio
  ctx.save()
  ctx.font = FONT.replace('13', String(13 * ratio))
  ctx.textBaseline = 'middle'
  ctx.lineWidth = 1.25 * ratio
  ctx.strokeStyle = colour
  let taken = bbox.top - half
  for (const [limit, above] of [
    [line.upper, true],
    [line.lower, false],
  ] as const) {
    if (limit === null) continue
    const y = plot.valToPos(limit, 'y', true)
    const far = y <= bbox.top || y >= bottom
    if (!far) {
      ctx.globalAlpha = 0.7
      if (pattern) ctx.fillStyle = pattern
      ctx.fillRect(bbox.left, above ? bbox.top : y, bbox.width, above ? y - bbox.top : bottom - y)
      ctx.globalAlpha = 1
      ctx.setLineDash([6 * ratio, 3 * ratio])
      ctx.beginPath()
      ctx.moveTo(bbox.left, y)
      ctx.lineTo(right, y)
      ctx.stroke()
    }
    const place = Math.max(Math.min(Math.max(y, bbox.top + half), bottom - half), taken + 2 * half)
    taken = place
    const text = `${fixed(limit, 0)}${line.unit === 'mm' ? ' mm' : line.unit}`
    ctx.fillStyle = far ? theme.colours.second : colour
    ctx.fillText(`${far ? (above ? '↑ ' : '↓ ') : ''}${text}`, right + 6 * ratio, place)
  }
  ctx.restore()
}
