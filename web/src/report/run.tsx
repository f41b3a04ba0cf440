import { useContext, useMemo } from 'preact/hooks'
import type { Mark, Strip } from '../design/plot/strip'
import { unpack } from '../playback/motion'
import type { MeasuredSeries, RunCurves, SessionRun } from '../playback/session'
import { say } from '../words/diagnostic'
import { jointName, number, words } from '../words/words'
import { Table } from './findings'
import { lasting } from './plot/axis'
import { indexAt } from './plot/lines'
import { PlayheadContext } from './plot/playhead'
import { amount, StripPlot } from './plot/strip_plot'
import { ToolPath } from './plot/tool_path'

const DEGREES = 180 / Math.PI
// Below this a run followed its reference, rad or m: rounding.
const FOLLOWED = 1e-4

/** A time that leads there. */
export function Go({
  time,
  label,
  children,
}: {
  time: number
  label?: string
  children?: preact.ComponentChildren
}) {
  const { seek } = useContext(PlayheadContext)
  return (
    <button type="button" class="go" aria-label={label} onClick={() => seek(time)}>
      {children ?? lasting(time)}
    </button>
  )
}

function scaleOf(prismatic: boolean): { unit: string; scale: number } {
  return prismatic ? { unit: 'mm', scale: 1000 } : { unit: '°', scale: DEGREES }
}

function column(values: ArrayLike<number>, index: number, count: number, scale: number) {
  return Float64Array.from(
    { length: values.length / count },
    (_, row) => (values[row * count + index] ?? Number.NaN) * scale,
  )
}

/** Return a strip for each joint of a run. */
function stripsOf(run: SessionRun, curves: RunCurves): Strip[] {
  const count = run.joints.length
  const joints = unpack(curves.joints)
  const expected = curves.expected && unpack(curves.expected)
  return run.joints.map((joint, index) => {
    const { unit, scale } = scaleOf(joint.prismatic)
    return {
      label: jointName(joint.name, index),
      unit,
      values: column(joints, index, count, scale),
      compared: expected && column(expected, index, count, scale),
      lower: joint.lower === null ? null : joint.lower * scale,
      upper: joint.upper === null ? null : joint.upper * scale,
      colour: index,
    }
  })
}

/** A run: the path of its tool, its figures, its events, its joints. */
export function RunView({ run, curves }: { run: SessionRun; curves: RunCurves }) {
  const times = useMemo(() => unpack(curves.times), [curves])
  const strips = useMemo(() => stripsOf(run, curves), [run, curves])
  const marks: Mark[] = run.actions.flatMap(({ time, said }, i) =>
    time <= run.end
      ? [{ number: i + 1, severity: said.severity, from: time, to: time, strip: null }]
      : [],
  )
  const tool = curves.tool && (unpack(curves.tool) as Float32Array)
  const spots = run.actions.flatMap(({ time, said }, i) => {
    const row = indexAt(times, time)
    const [x = Number.NaN, y = 0, z = 0] = tool?.subarray(3 * row, 3 * row + 3) ?? []
    const place: [number, number, number] = [x, y, z]
    return Number.isFinite(x) ? [{ number: i + 1, severity: said.severity, place }] : []
  })
  return (
    <>
      <div class="run-motion">
        {tool && (
          <ToolPath
            path={tool}
            reference={curves.expected_tool && (unpack(curves.expected_tool) as Float32Array)}
            spots={spots}
          />
        )}
        <div class="run-said">
          <Figures run={run} />
          {run.actions.length > 0 && (
            <ol class="actions">
              {run.actions.map(({ time, said }, i) => (
                <li key={`${time} ${said.code}`} class={`tone-${said.severity}`}>
                  <span class="finding-number">{i + 1}</span>
                  <span>
                    <Go time={time} /> {say(said).message}
                  </span>
                </li>
              ))}
            </ol>
          )}
        </div>
      </div>
      <div class="report-strips">
        {strips.map((strip) => (
          <StripPlot
            key={strip.label}
            strip={strip}
            times={times}
            marks={marks}
            begin={run.start}
            duration={Math.max(run.end - run.start, 1e-3)}
          />
        ))}
      </div>
    </>
  )
}

function Figures({ run }: { run: SessionRun }) {
  const w = words.value.report
  const { figures, deviation } = run
  const rows: [string, string, number | null][] = []
  if (run.length > 0) {
    const speeds = run.speeds.filter((speed) => speed !== 0).map((speed) => `${number(speed)}×`)
    const played = `${number(run.position, 2, 2)} / ${number(run.length, 2, 2)} s`
    rows.push([w.played, [played, ...speeds].join(', '), null])
  }
  if (figures?.way != null) rows.push([w.way, `${number(figures.way, 3)} m`, null])
  if (figures?.fastest != null) {
    rows.push([w.fastest, `${number(figures.fastest, 3)} m/s`, figures.fastest_at])
  }
  const at = (joint: string) =>
    jointName(
      joint,
      run.joints.findIndex(({ name }) => name === joint),
    )
  const value = (of: number, prismatic: boolean) => {
    const { unit, scale } = scaleOf(prismatic)
    return amount(of * scale, unit)
  }
  if (figures?.near) {
    const { room, prismatic, joint, time } = figures.near
    rows.push([w.nearestLimit, `${value(room, prismatic)}, ${at(joint)}`, time])
  }
  if (deviation) {
    const { reference, most, prismatic, joint, time, tool } = deviation
    rows.push([w.reference, reference, null])
    if (most < FOLLOWED) rows.push([w.deviation, '0', null])
    else rows.push([w.deviation, `${value(most, prismatic)}, ${at(joint)}`, time])
    if (tool !== null && most >= FOLLOWED) {
      rows.push([w.deviationOfTool, amount(tool * 1000, 'mm'), null])
    }
  }
  return (
    <dl class="run-figures">
      {rows.map(([name, text, time]) => (
        <div key={name}>
          <dt>{name}</dt>
          <dd>
            {text} {time !== null && <Go time={time} />}
          </dd>
        </div>
      ))}
    </dl>
  )
}

/** The unit and factor in which a series is shown. */
function shownIn({ quantity }: MeasuredSeries) {
  return { unit: quantity === 'tracking' ? 'mrad' : 'ms', scale: 1000 }
}

/** Measurements of the lab itself: a table, and a strip for each. */
export function Technical({
  series,
  counts,
  duration,
}: {
  series: readonly MeasuredSeries[]
  counts: readonly (readonly [string, string])[]
  duration: number
}) {
  const w = words.value.report
  const nameOf = ({ quantity, hop }: MeasuredSeries) =>
    hop === null ? w.quantities[quantity] : w.hop(w.hops[hop.ends] ?? hop.ends, hop.observer)
  const owner = (robot: string) => robot || w.allTopics
  return (
    <>
      <Table name="technical" title="" heads={[w.robot, w.quantity, w.median, '95 %', w.most]}>
        {counts.map(([robot, text]) => (
          <tr key={robot}>
            <td>{robot}</td>
            <td>{w.jointStates}</td>
            <td colSpan={3}>{text}</td>
          </tr>
        ))}
        {series.map((one) => {
          const { unit, scale } = shownIn(one)
          return (
            <tr key={`${one.robot} ${nameOf(one)}`}>
              <td>{owner(one.robot)}</td>
              <td>{nameOf(one)}</td>
              {[one.p50, one.p95, one.max].map((value, i) => (
                <td class="figure" key={i}>
                  {`${number(value * scale, 3)} ${unit}`}
                </td>
              ))}
            </tr>
          )
        })}
      </Table>
      <div class="report-strips">
        {series.map((one) => {
          if (one.curve === null) return null
          const { unit, scale } = shownIn(one)
          const strip: Strip = {
            label: `${owner(one.robot)}: ${nameOf(one)}`,
            unit,
            values: Float64Array.from(unpack(one.curve.values), (value) => value * scale),
            compared: null,
            lower: null,
            upper: null,
            colour: 0,
          }
          return (
            <StripPlot
              key={strip.label}
              strip={strip}
              times={unpack(one.curve.times)}
              marks={[]}
              begin={0}
              duration={duration}
            />
          )
        })}
      </div>
    </>
  )
}
