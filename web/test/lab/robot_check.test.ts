import { afterEach, beforeEach, expect, test, vi } from 'vitest'
import { ApiError } from '../../src/api/api'
import type { Check } from '../../src/api/types'
import {
  counted,
  kindOf,
  marksOf,
  RobotCheck,
  RUNNING_MS,
  STALE_MS,
} from '../../src/lab/robot_check'
import { own } from '../../src/words/diagnostic'
import { en } from '../../src/words/en'
import { FOUND_CHECK, finding, NO_CHECK } from '../fake_api'

beforeEach(() => {
  vi.useFakeTimers()
})
afterEach(() => {
  vi.useRealTimers()
})

function api(...states: Partial<Check>[]) {
  const answer = async () => ({ ...NO_CHECK, ...(states.shift() ?? { state: 'done' as const }) })
  return { check: vi.fn(answer), startCheck: vi.fn(answer) }
}

test('a motion that is loaded is checked by itself, and asked for until it is done', async () => {
  const asked = api({ state: 'none' }, { state: 'waiting' }, { state: 'running' }, FOUND_CHECK)
  const check = new RobotCheck(asked, 'ur5e_1')
  await check.follow('quintic@3', true)
  expect(asked.startCheck).toHaveBeenCalledWith('ur5e_1', 'quintic@3')
  expect(check.check.value?.state).toBe('waiting')
  await vi.advanceTimersByTimeAsync(2 * RUNNING_MS)
  expect(check.check.value?.verdict).toBe('not_ready')
  await vi.advanceTimersByTimeAsync(STALE_MS - 1)
  expect(asked.check).toHaveBeenCalledTimes(3)
  await vi.advanceTimersByTimeAsync(1)
  expect(asked.check).toHaveBeenCalledTimes(4)
  check.dispose()
  await vi.advanceTimersByTimeAsync(10 * STALE_MS)
  expect(asked.check).toHaveBeenCalledTimes(4)
})

test('what was loaded before is not checked by itself', async () => {
  const asked = api({ state: 'none' })
  const check = new RobotCheck(asked, 'ur5e_1')
  await check.follow('quintic@3', false)
  expect(check.check.value).toBeNull()
  expect(asked.startCheck).not.toHaveBeenCalled()
})

test('an answer about what was loaded before is not taken for what is loaded now', async () => {
  let late: (check: Check) => void = () => undefined
  const first = new Promise<Check>((resolve) => {
    late = resolve
  })
  const ask = vi.fn(async (_robot: string, trajectory: string) =>
    trajectory === 'old@1'
      ? first
      : { ...NO_CHECK, state: 'failed' as const, problem: finding({ message: 'why' }) },
  )
  const check = new RobotCheck({ check: ask, startCheck: ask }, 'ur5e_1')
  const before = check.follow('old@1', true)
  await check.follow('new@1', true)
  late(FOUND_CHECK)
  await before
  expect(check.check.value?.problem?.message).toBe('why')
})

test('a refusal is said; a motion that this person may not see has no check', async () => {
  const refuse = (status: number) => async () => {
    throw new ApiError(status, '', own('too many checks'))
  }
  const busy = new RobotCheck({ check: refuse(429), startCheck: refuse(429) }, 'ur5e_1')
  await busy.follow('quintic@3', true)
  expect(busy.problem.value).toBe('too many checks')
  const hidden = new RobotCheck({ check: refuse(404), startCheck: refuse(404) }, 'ur5e_1')
  await hidden.follow('quintic@3', true)
  expect(hidden.problem.value).toBe('')
})

test('marks are the findings with an instant, in order and on the timeline', () => {
  expect(marksOf(FOUND_CHECK, 600).map(({ time }) => time)).toEqual([214, 420.5])
  expect(marksOf(FOUND_CHECK, 214.7).map(({ time }) => time)).toEqual([214])
  expect(marksOf(FOUND_CHECK, 213.8).map(({ time }) => time)).toEqual([213.8])
  expect(marksOf({ ...FOUND_CHECK, state: 'running' }, 600)).toEqual([])
  expect(marksOf(null, 600)).toEqual([])
  expect(counted(FOUND_CHECK)).toEqual({ refusing: 2, warning: 1 })
})

test('a code without words of its own is its own word', () => {
  expect(kindOf('collision', en)).toBe('Collision')
  expect(kindOf('quite_new', en)).toBe('quite new')
})
