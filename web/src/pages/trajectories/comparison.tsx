import { useMemo } from 'preact/hooks'
import { Button } from '../../design/button'
import { Icon } from '../../design/icons'
import { courseOf } from '../../playback/course'
import { type MotionDocument, sameJoints } from '../../playback/motion'
import { jointName, number, words } from '../../words/words'
import { shortName } from './catalogue'
import { type Deviation, delayOf, largestDeviation } from './deviation'

const DEGREES = 180 / Math.PI
/** What reads as 0.00, in degrees or mm: the same motion at another rate. */
const LEAST_SHOWN = 0.005
/** Share of their deviation that is left of motions that are alike but for a delay. */
const ALIKE = 0.5

interface ComparisonProps {
  id: string
  other: string
  motion: MotionDocument
  otherMotion: MotionDocument
  onClose: () => void
}

function nameOf({ robot }: MotionDocument): string {
  return robot.product || robot.model
}

/** Return what is said of two motions. */
export function inWords(motion: MotionDocument, otherMotion: MotionDocument): string {
  const w = words.value.trajectories
  const { joints } = motion.robot
  if (!sameJoints(motion, otherMotion)) return w.otherJoints(nameOf(motion), nameOf(otherMotion))
  const [course, other] = [courseOf(motion), courseOf(otherMotion)]
  const far = ({ joint, amount }: Deviation): [number, string] =>
    joints[joint]?.kind === 'prismatic' ? [amount * 1000, ' mm'] : [amount * DEGREES, '°']
  const inText = (found: Deviation) => {
    const [amount, unit] = far(found)
    const name = jointName(joints[found.joint]?.name ?? '', found.joint)
    return w.deviation(name, `${number(amount, 2)}${unit}`, number(found.time, 2), found.row)
  }
  const largest = largestDeviation(course, other)
  if (largest === null || far(largest)[0] < LEAST_SHOWN) return w.same
  const delay = delayOf(course, other)
  const left = largestDeviation(course, other, delay)
  // A measured motion begins when somebody began to capture it.
  if (left === null || left.amount > largest.amount * ALIKE) return inText(largest)
  return `${inText(largest)} ${w.delayed(number(delay, 3), inText(left))}`
}

/** Return the deviation of two motions, in words. */
export function Comparison({ id, other, motion, otherMotion, onClose }: ComparisonProps) {
  const w = words.value.trajectories
  const text = useMemo(() => inWords(motion, otherMotion), [motion, otherMotion, words.value])
  return (
    <section class="card stack-8 comparison" aria-labelledby="comparison">
      <div class="dialog-head">
        <h2 id="comparison">{w.comparison}</h2>
        <Button look="quiet" icon="close" label={w.endComparison} onClick={onClose} />
      </div>
      <p class="comparison-legend small">
        <span>
          <i class="line-solid" /> {shortName(id)}
        </span>
        <span>
          <i class="line-dashed" /> {shortName(other)}
        </span>
      </p>
      <p class="comparison-result">
        <Icon name="compare" />
        {text}
      </p>
    </section>
  )
}
