// @vitest-environment jsdom
import { expect, test, vi } from 'vitest'
import { channelsOf, marksOf, stripsOf } from '../../../src/design/plot/channels'
import { sparkPaths } from '../../../src/design/plot/sparkline'
import { visibleRows } from '../../../src/design/virtual_list'
import { courseOf } from '../../../src/playback/course'
import { unpack } from '../../../src/playback/motion'
import { JOINT_LIMIT } from '../../fake_api'
import { fakeMotion } from '../../fake_motion'

vi.mock('uplot', () => ({ default: class {} }))
const { rangeOf } = await import('../../../src/design/plot/strip')

const STRIP = {
  label: '1 pan',
  unit: '°',
  values: Float64Array.of(0, 90),
  compared: null,
  lower: null,
  upper: null,
  colour: 0,
}

test('a limit near the line widens the axis, a far one does not', () => {
  expect(rangeOf({ ...STRIP, upper: 100 })[1]).toBeGreaterThan(100)
  expect(rangeOf({ ...STRIP, upper: 360 })[1]).toBeLessThan(120)
})

test('a line of which no sample is finite has an axis all the same', () => {
  expect(rangeOf({ ...STRIP, values: Float64Array.of(Number.NaN) })).toEqual([-1, 1])
})

test('angles are degrees with the limits of the joint', () => {
  const motion = fakeMotion({ verdict: 'accepted', message: '' })
  const elbow = stripsOf(motion, 'angles')[2]
  expect(elbow?.label).toBe('Elbow (J3)')
  expect(elbow?.values[0]).toBeCloseTo(89.95, 1)
  expect(elbow?.upper).toBeCloseTo(180)
})

test('the difference of two motions has no limits', () => {
  const motion = fakeMotion({ verdict: 'accepted', message: '' })
  const same = Float64Array.from(unpack(motion.positions))
  const [first] = stripsOf(motion, 'difference', same)
  expect(first?.compared).toBeNull()
  expect(first?.upper).toBeNull()
  expect(Math.max(...(first?.values ?? []))).toBe(0)
})

test('a motion that was refused has angles alone', () => {
  const motion = {
    ...fakeMotion({ verdict: 'refused', message: '' }),
    velocities: null,
    effort_proxies: null,
  }
  expect(channelsOf(motion)).toEqual(['angles'])
})

test('a finding is marked by its number in the strip of its joint, at the times of its rows', () => {
  const motion = fakeMotion({ verdict: 'refused', message: '' })
  const info = { ...JOINT_LIMIT, first_row: 0, joint: '' }
  const all = { ...JOINT_LIMIT, joint: '' }
  expect(marksOf([info, JOINT_LIMIT, all], motion.robot.joints, courseOf(motion))).toEqual([
    { number: 2, severity: 'error', from: 2.94, to: 3.44, strip: 2 },
    { number: 3, severity: 'error', from: 2.94, to: 3.44, strip: null },
  ])
})

test('a sparkline has a line a column, with gaps where a number is missing', () => {
  const preview = { variable: 'q', rows: [1, 2, 3], columns: 2, values: [0, 1, null, 1, 1, 1] }
  expect(sparkPaths(preview)).toEqual(['M0.0 29.0M100.0 1.0', 'M0.0 1.0L50.0 1.0L100.0 1.0'])
})

test('of ten thousand rows those near the window exist', () => {
  expect(visibleRows(-300, 900, 76, 10_000)).toEqual([0, 16])
  expect(visibleRows(76_000, 900, 76, 10_000)).toEqual([992, 1020])
  expect(visibleRows(0, 900, 76, 3)).toEqual([0, 3])
  expect(visibleRows(1e9, 900, 76, 3)).toEqual([3, 3])
})
