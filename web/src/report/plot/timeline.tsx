import { useContext, useEffect, useRef } from 'preact/hooks'
import { STATE_NAMES, type StateName } from '../../design/tokens'
import type { RobotFacts, SessionRun, Span } from '../../playback/session'
import { number, words } from '../../words/words'
import { moments } from './axis'
import { PlayheadContext } from './playhead'

// A row is drawn in units of its own for the width of a page, of a tablet or paper, of a phone.
const WIDTHS = { wide: 1280, middle: 760, narrow: 360 } as const
type Width = keyof typeof WIDTHS
const LEFT = 8
const RIGHT = 12
// Heights: collisions are above the bar, held objects below it.
const ROW = 38
const TOP = 10
const BAR = 20
const AXIS = 24
const LETTER = 7.4
const PADDING = 12
// A state that lasts less than this share of the session is not seen.
const VISIBLE = 1 / 800
const MOVING = ['PLAYING', 'ADJUSTING']
const HOLDING = 'HOLDING'

/** Return the word for a state, such as PLAYING. */
export function stateWord(label: string): string {
  const known = STATE_NAMES.find((name) => name === label)
  return known === undefined ? label : words.value.states[known satisfies StateName]
}

function classOf(label: string): string {
  return `state-${label.toLowerCase().replace('_', '-')}`
}

/** Return the states; neighbours at rest that differ only in the loaded motion are one. */
export function joined(spans: readonly Span[]): Span[] {
  const found: Span[] = []
  for (const span of spans) {
    const before = found.at(-1)
    if (before?.label === span.label && !MOVING.includes(span.label)) {
      found[found.length - 1] = { ...before, end: span.end }
    } else found.push(span)
  }
  return found
}

/** Return the possible labels of a bar, the longest first: of a run its number and its
 * trajectory. */
function textsOf(span: Span, runs: readonly SessionRun[]): string[] {
  if (!MOVING.includes(span.label)) return [stateWord(span.label)]
  const middle = (span.start + span.end) / 2
  const run = runs.find(({ start, end }) => start <= middle && middle <= end)?.number
  return run === undefined
    ? [span.detail, stateWord(span.label)]
    : [`${run} · ${span.detail}`, String(run)]
}

interface TimelineProps {
  readonly robots: readonly RobotFacts[]
  readonly runs: readonly SessionRun[]
  /** s */
  readonly duration: number
}

/** A row for each robot: its states, held objects and collisions; and the legend of the colours. */
export function Timeline({ robots, runs, duration }: TimelineProps) {
  const w = words.value.report
  const shown = robots.filter(({ states }) => states.length > 0)
  const silent = robots.filter(({ states }) => states.length === 0)
  const kinds = Object.keys(WIDTHS) as Width[]
  return (
    <>
      {shown.map((robot) => (
        <section key={robot.name} class="states-row">
          <h3>
            {robot.name} {robot.model && <span class="second">{robot.model}</span>}
          </h3>
          {kinds.map((kind) => (
            <Row
              key={kind}
              kind={kind}
              robot={robot}
              runs={runs.filter((run) => run.robot === robot.name)}
              duration={duration}
            />
          ))}
        </section>
      ))}
      {shown.length > 0 &&
        kinds.map((kind) => (
          <svg
            key={kind}
            class={`states ${kind}`}
            viewBox={`0 0 ${WIDTHS[kind]} ${AXIS}`}
            aria-hidden="true"
          >
            {moments(0, duration, Math.max(WIDTHS[kind] / 90, 3)).map(([time, text]) => (
              <text key={time} class="moment" x={place(time, duration, kind)} y={15}>
                {text}
              </text>
            ))}
          </svg>
        ))}
      {shown.length > 0 && <Keys robots={shown} duration={duration} />}
      {silent.length > 0 && (
        <p class="second small">{w.withoutRun(silent.map(({ name }) => name).join(', '))}</p>
      )}
    </>
  )
}

function place(time: number, duration: number, kind: Width): number {
  const share = duration > 0 ? Math.min(Math.max(time / duration, 0), 1) : 0
  return LEFT + share * (WIDTHS[kind] - LEFT - RIGHT)
}

interface RowProps {
  readonly kind: Width
  readonly robot: RobotFacts
  readonly runs: readonly SessionRun[]
  readonly duration: number
}

function Row({ kind, robot, runs, duration }: RowProps) {
  const w = words.value.report
  const playhead = useContext(PlayheadContext)
  const line = useRef<SVGLineElement>(null)
  const row = useRef<SVGSVGElement>(null)
  const x = (time: number) => place(time, duration, kind)
  useEffect(
    () =>
      playhead.time.subscribe((now) => {
        line.current?.setAttribute('x1', String(x(now)))
        line.current?.setAttribute('x2', String(x(now)))
      }),
    [duration],
  )
  const seek = (event: PointerEvent) => {
    const box = row.current?.getBoundingClientRect()
    if (box === undefined) return
    const at = ((event.clientX - box.left) / box.width) * WIDTHS[kind] - LEFT
    playhead.seek(Math.min(Math.max(at / (WIDTHS[kind] - LEFT - RIGHT), 0), 1) * duration)
  }
  const span = ({ start, end }: Span) => `${number(start, 2, 2)} – ${number(end, 2, 2)} s`
  return (
    <svg
      ref={row}
      class={`states ${kind}`}
      viewBox={`0 0 ${WIDTHS[kind]} ${ROW}`}
      role="img"
      aria-label={w.statesOf(robot.name)}
      onPointerDown={(event) => {
        row.current?.setPointerCapture(event.pointerId)
        seek(event)
      }}
      onPointerMove={(event) => event.buttons > 0 && seek(event)}
    >
      {joined(robot.states).map((state) => {
        const left = x(state.start)
        const width = Math.max(x(state.end) - left, 0.8)
        const text = textsOf(state, runs).find((one) => width > LETTER * one.length + PADDING)
        return (
          <g key={state.start}>
            <rect class={classOf(state.label)} x={left} y={TOP} width={width} height={BAR} rx="2">
              <title>{`${stateWord(state.label)}, ${span(state)}`}</title>
            </rect>
            {text && (
              <text class="in-bar" x={left + width / 2} y={TOP + BAR / 2 + 4}>
                {text}
              </text>
            )}
          </g>
        )
      })}
      {robot.grasps
        .filter(({ label }) => label === HOLDING)
        .map((grasp) => (
          <rect
            key={grasp.start}
            class="held"
            x={x(grasp.start)}
            y={TOP + BAR + 2}
            width={Math.max(x(grasp.end) - x(grasp.start), 0.8)}
            height="5"
            rx="2"
          >
            <title>{`${words.value.lab.holds(grasp.detail)}, ${span(grasp)}`}</title>
          </rect>
        ))}
      {robot.collisions.map(({ time, link, other }) => (
        <path key={time} class="hit" d={`M${x(time) - 5} 0h10l-5 9z`}>
          <title>{`${w.touches(link, other)}, ${number(time, 2, 2)} s`}</title>
        </path>
      ))}
      <line ref={line} class="playhead" y1="0" y2={ROW} />
    </svg>
  )
}

/** The legend of the colours and signs that occur. */
function Keys({ robots, duration }: { robots: readonly RobotFacts[]; duration: number }) {
  const w = words.value.report
  const labels = new Set(
    robots.flatMap(({ states }) =>
      states.filter(({ start, end }) => end - start > duration * VISIBLE).map((one) => one.label),
    ),
  )
  const held = robots.some(({ grasps }) => grasps.some(({ label }) => label === HOLDING))
  const hit = robots.some(({ collisions }) => collisions.length > 0)
  return (
    <p class="keys">
      {[...labels].map((label) => (
        <Key key={label} text={stateWord(label)}>
          <rect class={classOf(label)} width="12" height="12" rx="2" />
        </Key>
      ))}
      {held && (
        <Key text={w.holding}>
          <rect class="held" y="4" width="12" height="5" rx="2" />
        </Key>
      )}
      {hit && (
        <Key text={w.collision}>
          <path class="hit" d="M1 2h10l-5 9z" />
        </Key>
      )}
    </p>
  )
}

export function Key({ text, children }: { text: string; children: preact.ComponentChildren }) {
  return (
    <span>
      <svg class="key" viewBox="0 0 12 12" aria-hidden="true">
        {children}
      </svg>
      {text}
    </span>
  )
}
