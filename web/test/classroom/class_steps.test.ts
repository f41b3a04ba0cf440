// @vitest-environment jsdom
import { expect, test, vi } from 'vitest'
import type { ClassRun } from '../../src/api/class_types'
import type { GradedClass, Submission } from '../../src/api/types'
import {
  ClassSteps,
  numbersOf,
  ordered,
  publishedName,
  REFERENCE,
  stepOf,
} from '../../src/classroom/class_steps'
import { keyOfPath } from '../../src/classroom/page'
import { finding, NO_CLASS } from '../fake_api'
import { fakeMotion } from '../fake_motion'

function submission(key: string, points: number, more: Partial<Submission> = {}): Submission {
  const lost = {
    change: null,
    second: null,
    points: 0,
    of: 1,
    found: finding({}),
    hint: '',
    hidden: false,
    bonus: false,
    time: null,
  }
  return {
    key,
    name: key,
    points,
    of: 3,
    found: finding({}),
    duration: 1,
    robot: 'ur5e',
    tool: '',
    motion: true,
    late: false,
    comment: '',
    marks: [
      { ...lost, name: 'a', passed: false },
      { ...lost, name: 'b', passed: true, points: 1 },
      { ...lost, name: 'c', passed: false },
    ],
    ...more,
  }
}

const CLASS: GradedClass = {
  ...NO_CLASS,
  marked: true,
  submissions: [
    submission('anna', 3),
    submission('ben', 1),
    submission('cleo', 0),
    submission('dan', 1),
  ],
  reference: submission(REFERENCE, 3),
}

function stepsOf(graded: GradedClass) {
  let shown = graded
  const motion = vi.fn(async (_url: string) => fakeMotion({ verdict: 'accepted', message: '' }))
  const steps = new ClassSteps({
    gradedClass: async () => shown,
    motion,
    classSource: async () => {},
    classDo: async () => {},
  })
  const shows = (other: GradedClass) => {
    shown = other
  }
  return { steps, motion, shows }
}

test('a class is stepped through from its first to its last, and no further', async () => {
  const { steps } = stepsOf(CLASS)
  expect(steps.step(1)).toBe('')
  await steps.load()
  expect(steps.current.value?.key).toBe('anna')
  expect(steps.step(-1)).toBe('')
  expect([1, 1, 1, 1].map((by) => steps.step(by))).toEqual(['ben', 'cleo', 'dan', ''])
  expect(steps.current.value?.key).toBe('dan')
  expect([steps.place.value, steps.has(1), steps.has(-1)]).toEqual([3, false, true])
})

test('another order keeps who is shown', async () => {
  const { steps } = stepsOf(CLASS)
  await steps.load()
  steps.choose('ben')
  steps.order.value = 'points'
  expect(steps.submissions.value.map(({ key }) => key)).toEqual(['cleo', 'ben', 'dan', 'anna'])
  expect(steps.current.value?.key).toBe('ben')
  expect(steps.step(1)).toBe('dan')
  expect(ordered(CLASS.submissions, 'class')).toBe(CLASS.submissions)
})

test('who is not in the class any more leaves the first', async () => {
  const { steps } = stepsOf(CLASS)
  await steps.load()
  steps.choose('nobody')
  expect(steps.current.value?.key).toBe('anna')
})

test('the next motion is fetched ahead, the solution once, and few are kept', async () => {
  const { steps, motion } = stepsOf(CLASS)
  await steps.load()
  await steps.motion(REFERENCE)
  steps.prepare()
  expect(motion).toHaveBeenLastCalledWith('/api/class/ben/motion')
  for (let i = 0; i < 9; i++) await steps.motion(`s${i}`)
  await steps.motion(REFERENCE)
  expect(motion).toHaveBeenCalledTimes(11)
  await steps.motion('ben')
  expect(motion).toHaveBeenCalledTimes(12)
})

test('a run after which other marks hold brings its motions', async () => {
  const run = (how: ClassRun['how'], running: boolean) => ({
    ...CLASS,
    desk: { ...CLASS.desk, run: { how, running, done: 0, all: 0, problem: null, notes: [] } },
  })
  const { steps, motion, shows } = stepsOf(CLASS)
  for (const how of ['propose', 'hold'] as const)
    for (const running of [true, false]) {
      shows(run(how, running))
      await steps.load()
      await steps.motion('anna')
      expect([steps.runs.value, motion.mock.calls.length]).toEqual(
        how === 'hold' && !running ? [1, 2] : [0, 1],
      )
    }
})

test('n and p step where nobody types', () => {
  const at = (tag: string) => document.createElement(tag)
  const none = { ctrlKey: false, metaKey: false, altKey: false }
  expect(stepOf({ ...none, key: 'n', target: at('button') })).toBe(1)
  expect(stepOf({ ...none, key: 'p', target: null })).toBe(-1)
  expect(stepOf({ ...none, key: 'x', target: null })).toBe(0)
  expect(stepOf({ ...none, key: 'n', target: at('textarea') })).toBe(0)
  expect(stepOf({ ...none, key: 'n', ctrlKey: true, target: null })).toBe(0)
  expect(stepOf({ ...none, key: 'n', target: at('input') })).toBe(0)
})

test('lost tests are the first findings of a motion, in their order', () => {
  expect(numbersOf(submission('anna', 1))).toEqual([1, 0, 2])
})

test('keys are in addresses and names of trajectories', () => {
  expect(keyOfPath('/class/m%C3%BCller%20b')).toBe('müller b')
  expect(keyOfPath('/class')).toBe('')
  expect(keyOfPath('/class/%')).toBe('')
  expect(publishedName('Müller_12345 (b)')).toBe('class_m_ller_12345_b')
})

test('the desk opens where something is to be done, and stays as its teacher leaves it', async () => {
  const { steps: marked } = stepsOf(CLASS)
  await marked.load()
  expect(marked.deskOpen.value).toBe(false)

  const graded = { ...CLASS, marked: false }
  const { steps } = stepsOf(graded)
  await steps.load()
  expect(steps.deskOpen.value).toBe(true)
  graded.marked = true
  await steps.load()
  expect(steps.deskOpen.value).toBe(true)
  steps.deskOpen.value = false
  await steps.load()
  expect(steps.deskOpen.value).toBe(false)
})
