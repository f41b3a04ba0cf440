import { type Signal, useSignal } from '@preact/signals'
import { useEffect, useMemo, useRef, useState } from 'preact/hooks'
import { Segments } from '../../design/field'
import { Notice } from '../../design/notice'
import {
  type Channel,
  channelsOf,
  marksOf,
  positionsAt,
  stripsOf,
  timesOf,
} from '../../design/plot/channels'
import { Strips } from '../../design/plot/strips'
import { courseOf } from '../../playback/course'
import { type MotionDocument, sameJoints } from '../../playback/motion'
import type { MotionPreview } from '../../scene/preview/preview'
import { language, words } from '../../words/words'
import './motion.css'

interface MotionViewProps {
  motion: MotionDocument
  /** A second motion of the same robot: dashed in the plots, a ghost in 3D. */
  compared?: MotionDocument | null
  /** What the ghost is, on the scene; empty: nothing. */
  note?: string
  /** Number of the finding that is shown, from 1; 0: none. */
  selected: Signal<number>
}

/** A motion in 3D and as plots, at the same time and with the same numbers of findings. */
export function MotionView({ motion, compared = null, note = '', selected }: MotionViewProps) {
  const w = words.value.plots
  const time = useSignal(0)
  const host = useRef<HTMLDivElement>(null)
  const preview = useRef<MotionPreview | null>(null)
  const [wanted, setChannel] = useState<Channel>('angles')
  const [failed, setFailed] = useState(false)
  const course = useMemo(() => courseOf(motion), [motion])
  const comparable = compared !== null && sameJoints(motion, compared)
  const channels = useMemo(
    () => [...channelsOf(motion), ...(comparable && note === '' ? (['difference'] as const) : [])],
    [motion, comparable, note],
  )
  const channel = channels.includes(wanted) ? wanted : 'angles'
  const newest = useRef({ motion, selected })
  newest.current = { motion, selected }
  const times = useMemo(() => timesOf(course), [course])
  const strips = useMemo(() => {
    const other =
      compared && comparable && (channel === 'angles' || channel === 'difference')
        ? positionsAt(course, courseOf(compared))
        : null
    return stripsOf(motion, channel, other)
  }, [motion, compared, comparable, channel, course, words.value])
  const marks = useMemo(
    () => marksOf(motion.findings, motion.robot.joints, course),
    [motion, course],
  )

  useEffect(() => {
    let here = true
    let dispose = () => {}
    import('../../scene/preview/preview')
      .then(async ({ createMotionPreview }) => {
        const element = host.current
        if (!here || element === null) return
        const made = createMotionPreview(element, newest.current.motion, {
          words: words.value.scene,
        })
        const stopTime = made.onTime((now) => {
          time.value = now
        })
        const stopSelect = made.onSelect((number) => {
          newest.current.selected.value = number
        })
        preview.current = made
        made.compare(ghost.current)
        made.select(newest.current.selected.peek())
        dispose = () => {
          stopTime()
          stopSelect()
          made.dispose()
          preview.current = null
        }
      })
      .catch((problem: unknown) => {
        console.error(problem)
        if (here) setFailed(true)
      })
    return () => {
      here = false
      dispose()
    }
  }, [motion.robot.urdf, language.value])
  const ghost = useRef<MotionDocument | null>(null)
  ghost.current = comparable ? compared : null
  // Another motion of the same robot takes the place of the one before: the view stays.
  useEffect(() => preview.current?.show(motion), [motion])
  useEffect(() => preview.current?.compare(ghost.current), [motion, ghost.current])

  const focused = motion.findings[selected.value - 1]?.joint
  const focus = motion.robot.joints.findIndex(({ name }) => name === focused)

  const seek = (to: number) => {
    if (preview.current) preview.current.seek(to)
    else time.value = to
  }
  useEffect(() => {
    const number = selected.value
    const row = motion.findings[number - 1]?.first_row ?? 0
    if (row === 0) return
    if (preview.current) preview.current.select(number)
    else time.value = course.timeOfRow(row)
  }, [motion, selected.value])

  return (
    <div class="motion-view">
      <div class="motion-scene">
        <div class="motion-host" ref={host} />
        <p class="motion-note small" role="status">
          {note}
        </p>
      </div>
      {failed && (
        <Notice severity="warning">
          <p>{w.noScene}</p>
        </Notice>
      )}
      <section class="card motion-plots" aria-label={w.title}>
        <div class="motion-channels">
          {channels.length > 1 && (
            <Segments<Channel>
              label={w.title}
              value={channel}
              onChange={setChannel}
              options={channels.map((each) => [each, w.channels[each]] as const)}
            />
          )}
          {channel === 'proxies' && <p class="small second">{w.proxyNote}</p>}
        </div>
        <Strips
          times={times}
          strips={strips}
          marks={marks}
          rowOf={(index) => course.rowOf(index)}
          indexAt={(at) => course.frameAt(at)}
          time={time}
          focus={focus < 0 ? null : focus}
          onSeek={seek}
        />
      </section>
    </div>
  )
}
