import { describe, expect, it } from 'vitest'
import type { PlaybackClock } from '../../src/playback/clock'
import { ClockedArm } from '../../src/playback/clocked_arm'
import { Course } from '../../src/playback/course'
import { ShapedLink } from './shaped_link'

const RATE = 100
const FRAMES = 801
const DEG = Math.PI / 180
const DISPLAY = 1 / 72
const NAMES = ['a', 'b']
const ONE = ['a']

/** A smooth motion of two joints over 8 s, up to 90 degrees a second. */
function motion(): Course {
  const positions = new Float64Array(FRAMES * 2)
  for (let i = 0; i < FRAMES; i++) {
    const s = i / (FRAMES - 1)
    const smooth = s * s * s * (10 - 15 * s + 6 * s * s)
    positions[2 * i] = smooth * 6
    positions[2 * i + 1] = Math.sin(i / 60)
  }
  return new Course(RATE, 2, positions)
}

const number = (value: number | undefined): number => value ?? Number.NaN

interface State {
  readonly stamp: number
  readonly positions: readonly number[]
}

const frameOf = (course: Course, frame: number): readonly number[] => [
  course.positions[2 * frame] as number,
  course.positions[2 * frame + 1] as number,
]

describe('over a link with 10 % loss, 100 ms jitter and stalls of 150 to 300 ms', () => {
  const start = 1000
  const course = motion()
  const arm = new ClockedArm(NAMES)
  arm.setCourse(course)
  const link = new ShapedLink<State>(0.1, 0.1, [
    [start + 1.2, 0.15],
    [start + 3.1, 0.3],
    [start + 5.05, 0.22],
  ])
  const clocks = new ShapedLink<PlaybackClock>(0.1, 0, [[start + 3.1, 0.3]])
  const shown: { time: number; pose: number[] }[] = []
  const errors: number[] = []
  arm.take(NAMES, frameOf(course, 0), start - 0.2)
  // announced as the lab does: ahead of its stamp, then once a second
  clocks.send(start - 0.15, { stamp: start, position: 0, rate: 1 }, true)
  let frame = 0
  for (let time = start - 0.1; time < start + 7.9; time += DISPLAY / 8) {
    while (frame < FRAMES && start + frame / RATE <= time) {
      link.send(time, { stamp: start + frame / RATE, positions: frameOf(course, frame) })
      // at a frame's own time the pose is that of the source
      if (time > start + 0.4) {
        arm.sample(start + frame / RATE)
        const [a, b] = frameOf(course, frame) as [number, number]
        errors.push(
          Math.max(
            Math.abs(number(arm.positions[0]) - a),
            Math.abs(number(arm.positions[1]) - b),
          ) / DEG,
        )
      }
      frame++
    }
    for (const clock of clocks.arrived(time)) arm.setClock(clock, true)
    for (const { stamp, positions } of link.arrived(time)) arm.take(NAMES, positions, stamp, time)
    if (arm.sample(time)) shown.push({ time, pose: [...arm.positions] })
  }

  it('is at each frame time where the source is, within 0.01 degrees', () => {
    expect(errors.length).toBeGreaterThan(700)
    expect(Math.max(...errors)).toBeLessThan(0.01)
  })

  it('shows at every display instant what the source has then, once the start has settled', () => {
    const there = new Float64Array(2)
    let most = 0
    for (const { time, pose } of shown) {
      if (time < start + 0.4) continue
      course.sample(time - start, there)
      most = Math.max(
        most,
        Math.abs(number(pose[0]) - number(there[0])),
        Math.abs(number(pose[1]) - number(there[1])),
      )
    }
    expect(most / DEG).toBeLessThan(0.01)
    expect(arm.source).toBe('course')
  })

  it('never jumps: no step is larger than twice the fastest motion of the source', () => {
    let most = 0
    for (let i = 1; i < shown.length; i++) {
      for (const joint of [0, 1]) {
        most = Math.max(
          most,
          Math.abs(number(shown[i]?.pose[joint]) - number(shown[i - 1]?.pose[joint])),
        )
      }
    }
    const fastest = (6 * 1.875) / 8
    expect(most).toBeLessThan(2 * fastest * (DISPLAY / 8))
  })
})

describe('where the states contradict the course', () => {
  it('follows the states, eased, and returns when they agree again', () => {
    const course = new Course(100, 1, new Float64Array([0, 0, 0]))
    const arm = new ClockedArm(ONE)
    arm.setCourse(course)
    arm.setClock({ stamp: 10, position: 0, rate: 0 }, true)
    arm.sample(10)
    for (let i = 1; i <= 30; i++) arm.take(ONE, [0.5], 10 + i / 100)
    arm.sample(10.01)
    expect(arm.positions[0]).toBeLessThan(0.1)
    arm.sample(10.05)
    expect(arm.source).toBe('states')
    expect(arm.positions[0]).toBeLessThan(0.5)
    arm.sample(10.5)
    expect(arm.positions[0]).toBeCloseTo(0.5, 12)
    for (let i = 31; i <= 60; i++) arm.take(ONE, [0], 10 + i / 100)
    arm.sample(10.9)
    arm.sample(11.2)
    expect(arm.source).toBe('course')
    expect(arm.positions[0]).toBeCloseTo(0, 12)
  })

  it('one wrong state changes nothing', () => {
    const arm = new ClockedArm(ONE)
    arm.setCourse(new Course(100, 1, new Float64Array([0, 0])))
    arm.setClock({ stamp: 10, position: 0, rate: 0 }, true)
    arm.take(ONE, [1], 10.01)
    arm.sample(10.02)
    expect(arm.positions[0]).toBe(0)
  })
})

it('a scrub shows at once that it was heard, and is there within 120 ms', () => {
  const arm = new ClockedArm(ONE)
  arm.setCourse(new Course(10, 1, new Float64Array([0, 1, 2, 3])))
  arm.setClock({ stamp: 5, position: 0, rate: 0 }, true)
  arm.sample(5)
  arm.setClock({ stamp: 5.01, position: 0.2, rate: 0 }, true)
  arm.sample(5.03)
  expect(arm.positions[0]).toBeGreaterThan(0.3)
  arm.sample(5.13)
  expect(arm.positions[0]).toBeCloseTo(2, 12)
})

it('without a course it interpolates the states, and has no pose before the first', () => {
  const arm = new ClockedArm(ONE)
  expect(arm.sample(1)).toBe(false)
  arm.take(ONE, [0], 1)
  arm.take(ONE, [1], 1.1)
  arm.take(ONE, [9], 1.05) // overtaken: left out
  arm.sample(1.17)
  expect(arm.positions[0]).toBeCloseTo(0.5, 9)
  arm.sample(3)
  expect(arm.positions[0]).toBe(1)
})

it('a stream without a course is smooth over the same link, 0.12 s later', () => {
  const start = 500
  const arm = new ClockedArm(ONE)
  const link = new ShapedLink<number>(0.08, 0.1, [])
  const at = (time: number) => Math.sin(2 * time)
  let sent = 0
  let before = Number.NaN
  let most = 0
  let error = 0
  for (let time = start; time < start + 6; time += DISPLAY / 4) {
    for (; start + sent / 50 <= time; sent++) link.send(start + sent / 50, start + sent / 50)
    for (const stamp of link.arrived(time)) arm.take(ONE, [at(stamp)], stamp, time)
    if (!arm.sample(time) || time < start + 0.5) continue
    const now = number(arm.positions[0])
    error = Math.max(error, Math.abs(now - at(time - 0.12)))
    if (!Number.isNaN(before)) most = Math.max(most, Math.abs(now - before))
    before = now
  }
  // gaps of lost ones are longer than the delay now and then
  expect(error).toBeLessThan(0.1)
  expect(most, 'no step is larger than twice the fastest motion').toBeLessThan(DISPLAY)
})

it('states of another clock, as of a bag that is replayed, are taken as of when they came', () => {
  const arm = new ClockedArm(ONE)
  arm.take(ONE, [0], 10, 1000)
  arm.take(ONE, [1], 10.1, 1000.1)
  arm.sample(1000.17)
  expect(arm.positions[0]).toBeCloseTo(0.5, 9)
  // back to the bag's beginning
  arm.take(ONE, [0], 10, 1000.2)
  arm.sample(1000.4)
  expect(arm.positions[0]).toBe(0)
})

it('goes on after the clock of its source was set back', () => {
  const arm = new ClockedArm(ONE)
  arm.take(ONE, [0], 100)
  arm.take(ONE, [1], 50)
  arm.sample(51)
  expect(arm.positions[0]).toBe(1)
})

it.each([-600, 600])('is where the lab has it after its clock was set by %i s', (step) => {
  const course = motion()
  const arm = new ClockedArm(NAMES)
  const there = new Float64Array(2)
  const start = 1000
  const setAt = start + 3
  arm.setCourse(course)
  arm.setClock({ stamp: start, position: 0, rate: 1 }, true)
  let frame = 0
  let announced = false
  for (let steady = start; steady < start + 6; steady += DISPLAY) {
    const ahead = steady < setAt ? 0 : step
    // The page has the new time one exchange after the first message of the new clock.
    const time = steady + (steady < setAt + 0.03 ? 0 : step)
    if (ahead !== 0 && !announced) {
      announced = true
      arm.setClock({ stamp: start + step, position: 0, rate: 1 }, true)
    }
    for (; start + frame / RATE <= steady; frame++) {
      arm.take(NAMES, frameOf(course, frame), start + frame / RATE + ahead, time)
    }
    arm.sample(time)
    if (steady > setAt && steady < setAt + 0.3) continue
    course.sample(steady - start, there)
    expect(number(arm.positions[0])).toBeCloseTo(number(there[0]), 3)
    expect(number(arm.positions[1])).toBeCloseTo(number(there[1]), 3)
  }
})

it('knows whether another picture is due', () => {
  const arm = new ClockedArm(ONE)
  arm.setCourse(new Course(10, 1, new Float64Array([0, 1, 2])))
  arm.setClock({ stamp: 5, position: 0, rate: 1 }, true)
  arm.sample(5)
  expect(arm.moves(5)).toBe(true)
  arm.sample(5.21)
  expect(arm.moves(5.21)).toBe(false)
  arm.setCourse(null)
  arm.take(ONE, [2], 5.3)
  arm.sample(5.5)
  expect(arm.moves(5.5)).toBe(false)
  arm.take(ONE, [2], 5.6)
  arm.sample(5.7)
  expect(arm.moves(5.7), 'it stands').toBe(false)
  arm.take(ONE, [1.9], 5.8)
  expect(arm.moves(5.8)).toBe(true)
})

it('writes each pose into the same numbers', () => {
  const arm = new ClockedArm(ONE)
  const { positions } = arm
  arm.setCourse(new Course(10, 1, new Float64Array([0, 1, 2])))
  arm.setClock({ stamp: 5, position: 0, rate: 1 }, true)
  for (let i = 0; i < 5; i++) arm.sample(5 + i * 0.04)
  expect(arm.positions).toBe(positions)
  expect(positions[0]).toBeCloseTo(1.6, 9)
})
