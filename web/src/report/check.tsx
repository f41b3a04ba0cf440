import { OutcomeChip } from '../design/chip'
import { Icon } from '../design/icons'
import type { Mark, Strip } from '../design/plot/strip'
import type { PackedArray } from '../playback/motion'
import { unpack } from '../playback/motion'
import type { SessionDocument } from '../playback/session'
import type { MeshBytes } from '../scene/robot/meshes'
import type { Diagnostic } from '../words/diagnostic'
import { nameOfJoint, said, say } from '../words/diagnostic'
import { jointName, linkName, named, number, words } from '../words/words'
import { Findings, type Picture, Still, Table } from './findings'
import { Fold } from './fold'
import { type CheckMarks, Marks, STATES } from './marks'
import { Page } from './page'
import { PlayheadContext } from './plot/playhead'
import { type Plotted, StripPlot } from './plot/strip_plot'
import { Film, useSession } from './session'

/** What a check rehearsed and its result; `mrlab_ros/app/show/check.py` writes it. */
export interface CheckDocument extends SessionDocument {
  readonly schema: 'mrlab.check.1'
  readonly check: CheckFacts
}

/** The result of a check. */
export interface CheckFacts {
  readonly verdict: 'ready' | 'not_ready'
  readonly summary: Diagnostic
  readonly robots: readonly {
    readonly name: string
    readonly model: string
    readonly end_effector: string
    readonly hardware: readonly Condition[]
  }[]
  readonly findings: readonly CheckFinding[]
  readonly marks: CheckMarks | null
  readonly distances: readonly Distance[]
  readonly motions: readonly CheckedMotion[]
  readonly claim: Diagnostic
  /** Of the whole report; two that are equal have the same. */
  readonly hash: string
}

interface Condition {
  readonly condition: Diagnostic
  readonly state: 'ok' | 'not' | 'unknown'
  readonly found: Diagnostic
}

interface CheckFinding extends Diagnostic {
  readonly robot?: string
  /** A link or joint. */
  readonly link?: string
  /** s, from when to when; null or absent: no instant */
  readonly time?: number | null
  readonly end?: number | null
  readonly kind?: string
  readonly other?: string
}

interface Curve {
  readonly times: PackedArray
  readonly values: PackedArray
}

/** m, NaN: farther than is looked for. */
interface Distance extends Curve {
  readonly robot: string
  readonly part: string
  readonly kind: string
  readonly other: string
  readonly other_link: string
}

/** rad, m/s, and 0 singular to 1. */
interface CheckedMotion {
  readonly robot: string
  readonly joints: readonly {
    readonly name: string
    readonly lower: number
    readonly upper: number
  }[]
  readonly positions: Curve
  readonly speed: Curve
  readonly conditioning: Curve
}

const DEGREES = 180 / Math.PI

/** Return the marks of the findings that are meant, with their numbers. */
function marksOf(
  findings: readonly CheckFinding[],
  meant: (finding: CheckFinding) => boolean,
): Mark[] {
  return findings.flatMap((finding, i) => {
    const { time, end, severity } = finding
    if (time == null || !meant(finding)) return []
    return [{ number: i + 1, severity, from: time, to: end ?? time, strip: null }]
  })
}

function plotted(
  { times, values }: Curve,
  marks: readonly Mark[],
  strip: Omit<Strip, 'values' | 'compared'>,
  { scale = 1, column = 0, columns = 1 } = {},
): Plotted {
  const all = unpack(values)
  const shown = Float64Array.from(
    { length: all.length / columns },
    (_, row) => (all[row * columns + column] ?? Number.NaN) * scale,
  )
  return { times: unpack(times), marks, strip: { ...strip, values: shown, compared: null } }
}

const NO_LIMITS = { lower: null, upper: null }

/** Return a strip for each distance, with the marks of contacts. */
export function distancesOf({
  distances,
  findings,
  robots,
}: Pick<CheckFacts, 'distances' | 'findings' | 'robots'>): Plotted[] {
  const w = words.value.report
  return distances.map((one) => {
    const other =
      one.kind === 'self'
        ? w.itsOwn(linkName(one.other_link))
        : one.kind === 'robot' && one.other_link
          ? w.linkOf(linkName(one.other_link), one.other)
          : named(one.other)
    const name = w.distance(linkName(one.part), other)
    const marks = marksOf(
      findings,
      (found) => found.robot === one.robot && found.kind === one.kind && found.other === one.other,
    )
    const label = robots.length > 1 ? `${one.robot}: ${name}` : name
    const strip = { label, unit: 'mm', lower: 0, upper: null, colour: 0 }
    return plotted(one, marks, strip, { scale: 1000 })
  })
}

function toolOf(motion: CheckedMotion, findings: readonly CheckFinding[]): Plotted[] {
  const w = words.value.report
  const of = (...codes: readonly string[]) =>
    marksOf(findings, (found) => found.robot === motion.robot && codes.includes(found.code))
  return [
    plotted(motion.speed, of('misses_point', 'point_out_of_order'), {
      label: w.toolSpeed,
      unit: 'm/s',
      ...NO_LIMITS,
      colour: 0,
    }),
    plotted(motion.conditioning, of('near_singularity'), {
      label: w.conditioning,
      unit: '',
      lower: 0,
      upper: null,
      colour: 1,
    }),
  ]
}

function jointsOf(motion: CheckedMotion, findings: readonly CheckFinding[]): Plotted[] {
  return motion.joints.map(({ name, lower, upper }, column) => {
    const marks = marksOf(
      findings,
      (found) => found.robot === motion.robot && found.joint === name,
    )
    const strip = {
      label: jointName(name, column),
      unit: '°',
      lower: lower * DEGREES,
      upper: upper * DEGREES,
      colour: column,
    }
    const columns = motion.joints.length
    return plotted(motion.positions, marks, strip, { scale: DEGREES, column, columns })
  })
}

/** The report of a check. */
export function CheckReport({
  session,
  meshes,
  pictures,
}: {
  session: CheckDocument
  meshes: MeshBytes
  pictures: readonly Picture[]
}) {
  const w = words.value.report
  const { check } = session
  const { findings, robots, motions, marks } = check
  const several = robots.length > 1
  const instants = findings.flatMap((one) =>
    one.time == null ? [] : [{ time: one.time, severity: one.severity, words: say(one).message }],
  )
  const worst = findings.findIndex((one) => one.severity === 'error' && one.time != null)
  const { view, shown, playhead } = useSession(
    session,
    meshes,
    instants,
    worst < 0 ? null : { number: worst + 1, time: findings[worst]?.time ?? 0 },
  )
  const show = (chosen: number) => {
    playhead.selected.value = chosen
    playhead.seek(findings[chosen - 1]?.time ?? 0)
  }
  const jointsOfRobot = ({ robot }: CheckFinding) =>
    motions.find((motion) => motion.robot === robot)?.joints
  const grave = findings.find(({ severity }) => severity === 'error')
  const of = (name: string, robot: string) => (several ? w.linkOf(name, robot) : name)
  const groups: [string, Plotted[]][] = [
    [w.distances, distancesOf(check)],
    ...motions.flatMap((motion): [string, Plotted[]][] => [
      [of(w.tool, motion.robot), toolOf(motion, findings)],
      [of(w.joints, motion.robot), jointsOf(motion, findings)],
    ]),
  ]
  return (
    <PlayheadContext.Provider value={playhead}>
      <Page
        sheet
        chip={
          <>
            <OutcomeChip
              outcome={check.verdict === 'ready' ? 'accepted' : 'rejected'}
              doubted={findings.some(({ severity }) => severity !== 'info')}
            />
            <span class="second small">{session.title}</span>
          </>
        }
        title={grave ? said(grave, jointsOfRobot(grave)) : say(check.summary).message}
        facts={[
          ...robots.map(({ model, end_effector }) =>
            end_effector ? w.with(model, named(end_effector)) : model,
          ),
          `${number(session.duration, 2, 2)} s`,
          grave && several && grave.robot,
        ]}
        foot={[
          say(check.claim).message,
          <span key="hash" title={check.hash}>
            {w.hash(check.hash.slice(0, 12))}
          </span>,
        ]}
      >
        <div class={`report-top${findings.length > 0 ? ' beside' : ''}`}>
          <section class="report-view" id="view" ref={view} aria-label={w.view} />
          {pictures.length > 0 ? (
            <Still pictures={pictures} />
          ) : (
            <Film shown={shown} times={instants.map(({ time }) => time)} />
          )}
          <Findings
            title={words.value.upload.findings(findings.length)}
            findings={findings}
            where={(one) =>
              [
                one.time == null ? '' : `${number(one.time, 2, 2)} s`,
                several && one.robot,
                one.link ? linkName(one.link) : nameOfJoint(one, jointsOfRobot(one)),
              ]
                .filter(Boolean)
                .join(' · ')
            }
            placed={(one) => one.time != null}
            onShow={show}
          />
        </div>
        {marks && <Marks marks={marks} />}
        <div class="report-folds">
          {robots.map(({ name, hardware }) => (
            <Hardware
              key={name}
              title={several ? `${w.hardware}: ${name}` : w.hardware}
              rows={hardware}
            />
          ))}
          {groups.map(
            ([title, strips], i) =>
              strips.length > 0 && (
                <Fold key={title} title={title} open={i < 2}>
                  <div class="report-strips">
                    {strips.map((each) => (
                      <StripPlot
                        key={each.strip.label}
                        {...each}
                        begin={0}
                        duration={session.duration}
                      />
                    ))}
                  </div>
                </Fold>
              ),
          )}
        </div>
      </Page>
    </PlayheadContext.Provider>
  )
}

function Hardware({ title, rows }: { title: string; rows: readonly Condition[] }) {
  const w = words.value.report
  return (
    <Table name="hardware" title={title} heads={[]}>
      {rows.map(({ condition, state, found }) => {
        const [icon, kind] = STATES[state]
        return (
          <tr key={condition.message}>
            <td>
              <span class={`result result-${kind}`}>
                <Icon name={icon} />
                {w.states[state]}
              </span>
            </td>
            <th scope="row">{say(condition).message}</th>
            <td>{say(found).message}</td>
          </tr>
        )
      })}
    </Table>
  )
}
