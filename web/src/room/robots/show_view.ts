import { Color } from 'three'
import { fits } from '../../lab/catalogue'
import type { RobotView } from '../../lab/followed_robot'
import { fixed } from '../../words/words'
import type { Choice } from '../panels/paged_list'
import { GAP, HIT, type Pen, TEXT } from '../panels/pen'
import type { Catalogue, Speech } from '../ports'
import type { Drawings } from '../scene/drawings'
import { speedColour } from '../scene/tool_ribbon'

const STRIPES = 48
const DEG = 180 / Math.PI
const colour = new Color()

/** Draw the switches of a robot's drawings: its tool's path, its reach, another motion. */
export function drawShow(
  pen: Pen,
  edge: number,
  ports: Speech,
  drawings: Drawings,
  { robot }: RobotView,
  actions: { readonly compare: () => void; readonly back: () => void },
): void {
  const w = ports.words.room
  const half = (pen.width - 2 * edge - GAP) / 2
  const right = edge + half + GAP
  const { name } = robot
  const toggle = (what: 'path' | 'reach') => () => drawings.toggle(name, what)
  const top = 84
  pen.button('path', edge, top, half, w.toolPath, toggle('path'), {
    chosen: drawings.has(name, 'path'),
  })
  pen.button('reach', right, top, half, w.reach, toggle('reach'), {
    chosen: drawings.has(name, 'reach'),
  })
  const fastest = drawings.fastest(name)
  if (!Number.isNaN(fastest)) drawLegend(pen, edge, top + HIT + 26, half, fastest, w.speed)
  const compared = drawings.comparedWith(name)
  const y = top + HIT + 68
  const words = compared === '' ? w.compare : w.comparedWith(compared)
  pen.button('compare', edge, y, pen.width - 2 * edge, words, actions.compare, {
    chosen: compared !== '',
  })
  const reference = drawings.reference(name)
  if (reference !== null) {
    const { tool, most } = reference
    const mm = w.apart(fixed(tool * 1000, 1), fixed(most * 1000, 1))
    pen.text(edge, y + HIT + 30, mm, TEXT.body, undefined, 'ink', 600)
    reference.jointNames.forEach((joint, i) => {
      const x = edge + (i % 2) * (half + GAP)
      const row = y + HIT + 64 + Math.floor(i / 2) * 28
      const deg = Math.round((reference.joints[i] as number) * DEG * 100) / 100
      const off = `${fixed(deg === 0 ? 0 : deg, 2)}°`
      const ink = i === reference.worst() ? 'ink' : 'second'
      pen.text(x, row, joint, TEXT.small, half - 110, ink)
      pen.text(x + half, row, off, TEXT.small, 100, ink, 600, 'right')
    })
  } else if (compared !== '') pen.text(edge, y + HIT + 30, ports.words.loading, TEXT.small)
  else pen.lines(edge, y + HIT + 30, w.compareHint, TEXT.small, undefined, 'second', 3)
  pen.button('back', edge, pen.height - HIT - 20, 190, w.back, actions.back)
}

/** Return the motions that a robot can be compared with: those that fit it, and their earlier
 * versions. */
export function comparable(ports: Speech & Catalogue, { robot, playback }: RobotView): Choice[] {
  const w = ports.words.room
  const found: Choice[] = [{ id: '', words: w.noGhost, note: '' }]
  for (const info of ports.trajectories) {
    if (!fits(info, robot)) continue
    const { id, version } = info
    const loaded = playback?.trajectory_id === id ? playback.trajectory_version : 0
    if (loaded !== version) found.push({ id: `${id}@${version}`, words: id, note: '' })
    if (version > 1) {
      const earlier = `${id}@${version - 1}`
      if (loaded !== version - 1) found.push({ id: earlier, words: id, note: w.earlier })
    }
  }
  return found
}

function drawLegend(
  pen: Pen,
  x: number,
  y: number,
  width: number,
  fastest: number,
  words: (fastest: string) => string,
): void {
  const bar = width * 0.55
  for (let i = 0; i < STRIPES; i++) {
    pen.context.fillStyle = speedColour(i / (STRIPES - 1), colour).getStyle()
    pen.context.fillRect(x + (i * bar) / STRIPES, y - 7, bar / STRIPES + 0.5, 14)
  }
  pen.text(x + bar + GAP, y, words(fixed(fastest, 2)), TEXT.small, 2 * width - bar, 'second')
}
