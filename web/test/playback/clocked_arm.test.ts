import { describe, expect, it } from 'vitest'
import type { PlaybackClock } from '../../src/playback/clock'
import { ClockedArm } from '../../src/playback/clocked_arm'
import { Course } from '../../src/playback/course'
import { ShapedLink } from './shaped_link'

const RATE = 100
const FRAMES = 801
const DEG = Math.PI / 180
const DISPLAY = 1 / 72

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
  const arm = new ClockedArm(2)
  arm.setCourse(course)
  const link = new ShapedLink<State>(0.1, 0.1, [
    [start + 1.2, 0.15],
    [start + 3.1, 0.3],
    [start + 5.05, 0.22],
  ])
  const clocks = new ShapedLink<PlaybackClock>(0.1, 0, [[start + 3.1, 0.3]])
  const into = new Float64Array(2)
  const shown: { time: number; pose: number[] }[] = []
  const errors: number[] = []
  arm.takeState(start - 0.2, frameOf(course, 0))
  // announced as the lab does: ahead of its stamp, then once a second
  clocks.send(start - 0.15, { stamp: start, position: 0, rate: 1 }, true)
  let frame = 0
  for (let time = start - 0.1; time < start + 7.9; time += DISPLAY / 8) {
    while (frame < FRAMES && start + frame / RATE <= time) {
      link.send(time, { stamp: start + frame / RATE, positions: frameOf(course, frame) })
      // at a frame's own time the pose is that of the source
      if (time > start + 0.4) {
        arm.sample(start + frame / RATE, into)
        const [a, b] = frameOf(course, frame) as [number, number]
        errors.push(Math.max(Math.abs(number(into[0]) - a), Math.abs(number(into[1]) - b)) / DEG)
      }
      frame++
    }
    for (const clock of clocks.arrived(time)) arm.setClock(clock, true)
    for (const { stamp, positions } of link.arrived(time)) arm.takeState(stamp, positions)
    if (arm.sample(time, into)) shown.push({ time, pose: [...into] })
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
    const arm = new ClockedArm(1)
    const into = new Float64Array(1)
    arm.setCourse(course)
    arm.setClock({ stamp: 10, position: 0, rate: 0 }, true)
    arm.sample(10, into)
    for (let i = 1; i <= 30; i++) arm.takeState(10 + i / 100, [0.5])
    arm.sample(10.01, into)
    expect(into[0]).toBeLessThan(0.1)
    arm.sample(10.05, into)
    expect(arm.source).toBe('states')
    expect(into[0]).toBeLessThan(0.5)
    arm.sample(10.5, into)
    expect(into[0]).toBeCloseTo(0.5, 12)
    for (let i = 31; i <= 60; i++) arm.takeState(10 + i / 100, [0])
    arm.sample(10.9, into)
    arm.sample(11.2, into)
    expect(arm.source).toBe('course')
    expect(into[0]).toBeCloseTo(0, 12)
  })

  it('one wrong state changes nothing', () => {
    const arm = new ClockedArm(1)
    const into = new Float64Array(1)
    arm.setCourse(new Course(100, 1, new Float64Array([0, 0])))
    arm.setClock({ stamp: 10, position: 0, rate: 0 }, true)
    arm.takeState(10.01, [1])
    arm.sample(10.02, into)
    expect(into[0]).toBe(0)
  })
})

it('a scrub shows at once that it was heard, and is there within 120 ms', () => {
  const arm = new ClockedArm(1)
  const into = new Float64Array(1)
  arm.setCourse(new Course(10, 1, new Float64Array([0, 1, 2, 3])))
  arm.setClock({ stamp: 5, position: 0, rate: 0 }, true)
  arm.sample(5, into)
  arm.setClock({ stamp: 5.01, position: 0.2, rate: 0 }, true)
  arm.sample(5.03, into)
  expect(into[0]).toBeGreaterThan(0.3)
  arm.sample(5.13, into)
  expect(into[0]).toBeCloseTo(2, 12)
})

it('without a course it interpolates the states, and has no pose before the first', () => {
  const arm = new ClockedArm(1)
  const into = new Float64Array(1)
  expect(arm.sample(1, into)).toBe(false)
  arm.takeState(1, [0])
  arm.takeState(1.1, [1])
  arm.takeState(1.05, [9]) // overtaken: left out
  arm.sample(1.17, into)
  expect(into[0]).toBeCloseTo(0.5, 9)
  arm.sample(3, into)
  expect(into[0]).toBe(1)
})
