import { effect } from '@preact/signals'
import type { Submission } from '../api/types'
import { order } from '../lab/commands'
import type { LabFollower } from '../lab/follower'
import { loadTrajectoryType } from '../protocol/mrlab_msgs'
import { BOARD_WIDTH, BOTTOM, EDGE, type Tab, type TabPorts, TOP } from '../room/board/board'
import { GAP, HIT, PANEL_THEME, type Pen, TEXT } from '../room/panels/pen'
import type { Drawings } from '../room/scene/drawings'
import { say, sentence, spoken } from '../words/diagnostic'
import { number } from '../words/words'
import { type Lesson, SUBMISSION } from './lesson'

const MOST_MARKS = 6
const MOST_ROBOTS = 3
const STEP = 190
const ROW = 34
const POINTS = 400
const WORDS = 420

/** Stepping through a class: each submission is a ghost beside the solution, at a robot that plays
 * the solution. */
export function classTab(
  ports: TabPorts,
  follower: LabFollower,
  drawings: Drawings,
  lesson: Lesson,
): Tab {
  const { steps } = lesson
  const w = ports.words.grades
  let asked = false
  /** The robot at which the class is; empty: none is chosen. */
  let at = ''
  const show = () => {
    const current = steps.current.value
    if (at === '' || current === null) return
    drawings.compare(at, current.motion ? `${SUBMISSION}${current.key}` : '')
  }
  const step = (by: number) => () => {
    if (steps.step(by) !== '') show()
  }
  const begin = (robot: string, solution: Submission | null) => async () => {
    at = robot
    show()
    if (solution === null || !solution.motion) {
      ports.say(w.noReference)
      return
    }
    try {
      const id = await lesson.publish(solution)
      await order(ports, `${robot}/load`, loadTrajectoryType, { id })
    } catch (error) {
      ports.say(sentence(error))
    }
  }
  const leave = () => {
    drawings.compare(at, '')
    at = ''
  }

  function drawRobots(pen: Pen, y: number, model: string): void {
    const fit = follower.robots.value.filter(({ robot }) => robot.model === model)
    if (fit.length === 0) pen.lines(EDGE, y - 40, w.noRobot(model), TEXT.body)
    else pen.text(EDGE, y - 30, w.choose, TEXT.body)
    const width = (BOARD_WIDTH - 2 * EDGE - (MOST_ROBOTS - 1) * GAP) / MOST_ROBOTS
    const solution = steps.graded.value?.reference ?? null
    fit.slice(0, MOST_ROBOTS).forEach(({ robot: { name } }, i) => {
      const x = EDGE + i * (width + GAP)
      pen.button(`class ${name}`, x, y, width, name, begin(name, solution), { primary: i === 0 })
    })
  }

  function drawMarks(pen: Pen, y: number, { marks, motion, found }: Submission): void {
    const missed = PANEL_THEME.states.PAUSED
    if (!motion) pen.lines(EDGE, y, spoken(found), TEXT.small, undefined, missed, 2)
    const top = motion ? y : y + 2 * ROW
    // Lost points come first if not all fit.
    const lost = marks.filter(({ passed }) => !passed)
    const shown = [...lost, ...marks.filter(({ passed }) => passed)].slice(0, MOST_MARKS)
    shown.forEach((mark, i) => {
      const row = top + i * ROW
      const ink = mark.passed ? 'second' : missed
      const sign = mark.passed ? '✓' : mark.points > 0 ? '△' : '✕'
      const points = `${number(mark.points)} / ${number(mark.of)}`
      pen.text(EDGE, row, `${sign} ${mark.name}`, TEXT.small, POINTS - 100, ink, 600)
      pen.text(EDGE + POINTS, row, points, TEXT.small, 90, ink, 600, 'right')
      const width = BOARD_WIDTH - 2 * EDGE - WORDS
      pen.text(EDGE + WORDS, row, say(mark.found).message, TEXT.small, width, 'second')
    })
  }

  function read(): void {
    asked = true
    void steps.load()
    effect(() => {
      if (steps.graded.value !== null || steps.problem.value !== '') ports.repaintBoard()
    })
  }

  return {
    id: 'class',
    words: ports.words.nav.grades,
    draw: (pen) => {
      if (!asked) read()
      const graded = steps.graded.value
      const current = steps.current.value
      if (graded === null || current === null) {
        const text = steps.problem.value || (graded === null ? ports.words.loading : w.none)
        pen.lines(EDGE, TOP + 6, text, TEXT.body, undefined, 'second', 3)
        return
      }
      const { name, points, of } = current
      const right = BOARD_WIDTH - EDGE
      pen.text(EDGE, TOP + 6, name, TEXT.head, right - EDGE - 440, 'ink', 700)
      const place = w.place(steps.place.value + 1, steps.submissions.value.length)
      const total = `${w.points(number(points), number(of))} · ${place}`
      pen.text(right, TOP + 6, total, TEXT.body, 420, 'ink', 600, 'right')
      drawMarks(pen, TOP + 52, current)
      const y = BOTTOM - HIT
      if (at === '') {
        drawRobots(pen, y, graded.robot)
        return
      }
      const [before, after] = [steps.has(-1), steps.has(1)]
      pen.button('class_previous', EDGE, y, STEP, w.previous, step(-1), { enabled: before })
      const next = { primary: true, enabled: after }
      pen.button('class_next', EDGE + STEP + GAP, y, STEP, w.next, step(1), next)
      pen.button('class_leave', right - 260, y, 260, w.leave, leave, { small: true })
    },
  }
}
