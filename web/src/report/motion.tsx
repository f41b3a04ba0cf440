import { useSignal } from '@preact/signals'
import { useEffect, useMemo, useRef } from 'preact/hooks'
import { OutcomeChip } from '../design/chip'
import { channelsOf, marksOf, stripsOf, timesOf } from '../design/plot/channels'
import { courseOf } from '../playback/course'
import type { MotionDocument } from '../playback/motion'
import { createMotionPreview, type MotionPreview } from '../scene/preview/preview'
import { type MeshBytes, MeshLibrary } from '../scene/robot/meshes'
import { reducedMotion } from '../scene/stage/theme'
import { nameOfJoint, said } from '../words/diagnostic'
import { named, number, words } from '../words/words'
import { Findings, type Picture, rowsOf, Still } from './findings'
import { Fold } from './fold'
import { type CheckMarks, Marks } from './marks'
import { Page } from './page'
import { type Playhead, PlayheadContext } from './plot/playhead'
import { StripPlot } from './plot/strip_plot'

/** A motion; one that was handed in and refused has the marks of a rubric. */
export interface MarkedMotion extends MotionDocument {
  readonly marks?: CheckMarks
}

interface MotionReportProps {
  readonly motion: MarkedMotion
  readonly meshes: MeshBytes
  readonly pictures: readonly Picture[]
}

const OUTCOMES = { accepted: 'accepted', refused: 'rejected', ambiguous: 'ambiguous' } as const

function titleOf({ verdict, findings, title, robot }: MotionDocument): string {
  const cause = findings.find(({ severity }) => severity === 'error') ?? findings[0]
  if (verdict === 'accepted' || cause === undefined) {
    return words.value.report.fits(title, robot.product || robot.model)
  }
  return said(cause, robot.joints)
}

/** The report of a converted motion. */
export function MotionReport({ motion, meshes, pictures }: MotionReportProps) {
  const w = words.value
  const view = useRef<HTMLElement>(null)
  const preview = useRef<MotionPreview | null>(null)
  const time = useSignal(0)
  const selected = useSignal(0)
  const course = useMemo(() => courseOf(motion), [motion])
  const times = useMemo(() => timesOf(course), [course])
  const marks = useMemo(
    () => marksOf(motion.findings, motion.robot.joints, course),
    [motion, course],
  )
  const playhead = useMemo<Playhead>(
    () => ({ time, selected, seek: (to) => preview.current?.seek(to) }),
    [time, selected],
  )
  const show = (chosen: number) => {
    selected.value = chosen
    preview.current?.select(chosen)
  }
  useEffect(() => {
    if (view.current === null) return
    const poster = pictures[0]?.source
    const made = createMotionPreview(view.current, motion, {
      meshes: new MeshLibrary(meshes),
      words: words.value.scene,
      ...(poster === undefined ? {} : { poster }),
    })
    preview.current = made
    made.onTime((now) => {
      time.value = now
    })
    made.onSelect((chosen) => {
      selected.value = chosen
    })
    const first = motion.findings.findIndex((one) => one.severity === 'error' && one.first_row > 0)
    if (motion.verdict === 'refused' && first >= 0) show(first + 1)
    else if (!reducedMotion()) made.ready.then(() => made.play())
    made.ready.then(() => {
      document.documentElement.dataset.ready = 'true'
    })
    return () => made.dispose()
  }, [])

  const { robot, source, findings, marks: points } = motion
  return (
    <PlayheadContext.Provider value={playhead}>
      <Page
        sheet
        chip={
          <>
            <OutcomeChip
              outcome={OUTCOMES[motion.verdict]}
              doubted={findings.some(({ severity }) => severity !== 'info')}
            />
            {points && <span class="second small">{motion.title}</span>}
          </>
        }
        title={titleOf(motion)}
        facts={[
          source.file,
          robot.end_effector
            ? w.report.with(robot.product || robot.model, named(robot.end_effector))
            : robot.product || robot.model,
          w.trajectories.lengthOf(
            number(course.duration, 2, 2),
            course.rowOf(course.frameCount - 1),
            number(motion.frame_rate, 2),
          ),
        ]}
        foot={[
          w.report.of(source.variable, source.file),
          source.sha256 && <span title={source.sha256}>sha256 {source.sha256.slice(0, 12)}</span>,
        ]}
      >
        <div
          class={`report-top${findings.some(({ severity }) => severity !== 'info') ? ' beside' : ''}`}
        >
          <section class="report-view" id="view" ref={view} aria-label={w.report.view} />
          <Still pictures={pictures} />
          <Findings
            title={w.upload.findings(findings.length)}
            findings={findings}
            joints={robot.joints}
            where={(one) =>
              [one.variable, nameOfJoint(one, robot.joints), rowsOf(one)]
                .filter(Boolean)
                .join(' · ')
            }
            placed={(one) => one.first_row > 0}
            onShow={show}
          />
        </div>
        {points && <Marks marks={points} />}
        <div class="report-folds">
          {channelsOf(motion).map((channel, i) => (
            <Fold
              key={channel}
              title={w.plots.channels[channel]}
              facts={channel === 'proxies' && w.plots.proxyNote}
              open={i === 0}
            >
              <div class="report-strips">
                {stripsOf(motion, channel).map((strip, joint) => (
                  <StripPlot
                    key={strip.label}
                    strip={strip}
                    times={times}
                    marks={
                      channel === 'angles'
                        ? marks.filter((mark) => mark.strip === null || mark.strip === joint)
                        : []
                    }
                    begin={0}
                    duration={course.duration}
                  />
                ))}
              </div>
            </Fold>
          ))}
        </div>
      </Page>
    </PlayheadContext.Provider>
  )
}
