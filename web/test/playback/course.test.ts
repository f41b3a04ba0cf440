import { readFileSync } from 'node:fs'
import { describe, expect, test } from 'vitest'
import { positionAt } from '../../src/playback/clock'
import { Course, courseOf } from '../../src/playback/course'
import type { MotionDocument } from '../../src/playback/motion'

interface Vectors {
  clocks: { stamp: number; position: number; rate: number; now: number; at: number }[]
  courses: {
    frame_rate: number
    positions: number[][]
    gripper: number[]
    duration: number
    samples: { time: number; frame: number; positions: number[]; closed: boolean }[]
  }[]
}

// scripts/protocol/playback_vectors.py writes them from the Python code.
const vectors: Vectors = JSON.parse(
  readFileSync(new URL('vectors.json', import.meta.url), 'utf-8'),
)

function packed(
  dtype: 'float32' | 'float64' | 'uint32' | 'uint8',
  shape: number[],
  values: number[],
) {
  const kinds = {
    float32: Float32Array,
    float64: Float64Array,
    uint32: Uint32Array,
    uint8: Uint8Array,
  }
  const bytes = new Uint8Array(new kinds[dtype](values).buffer)
  return { dtype, shape, data: btoa(String.fromCharCode(...bytes)) }
}

describe('the same numbers as Python', () => {
  test('clocks', () => {
    for (const { now, at, ...clock } of vectors.clocks) expect(positionAt(clock, now)).toBe(at)
  })

  test.each(vectors.courses)('frames at $frame_rate Hz', (course) => {
    const found = new Course(
      course.frame_rate,
      2,
      Float64Array.from(course.positions.flat()),
      Uint8Array.from(course.gripper),
    )
    const positions = new Float64Array(2)
    expect(found.duration).toBe(course.duration)
    for (const sample of course.samples) {
      expect(found.sample(sample.time, positions)).toBe(sample.frame)
      for (const [i, expected] of sample.positions.entries()) {
        expect(positions[i]).toBeCloseTo(expected, 12)
      }
      expect(found.gripperAt(sample.time)).toBe(sample.closed)
    }
  })

  test.each(vectors.courses)('the same with times of their own, $frame_rate Hz', (course) => {
    const times = course.positions.map((_, i) => i / course.frame_rate)
    const found = new Course(
      course.frame_rate,
      2,
      Float64Array.from(course.positions.flat()),
      null,
      Float64Array.from(times),
    )
    const positions = new Float64Array(2)
    for (const sample of course.samples) {
      expect(found.sample(sample.time, positions)).toBe(sample.frame)
      for (const [i, expected] of sample.positions.entries()) {
        expect(positions[i]).toBeCloseTo(expected, 12)
      }
    }
  })
})

describe('chosen rows', () => {
  const course = new Course(
    10,
    1,
    Float32Array.from([0, 4, Number.NaN, 2]),
    null,
    Float64Array.from([0, 0.4, 0.5, 0.9]),
    Uint32Array.from([1, 5, 6, 10]),
  )

  test('stand at their own times', () => {
    const position = new Float64Array(1)
    course.sample(0.2, position)
    expect(position[0]).toBeCloseTo(2, 12)
    expect(course.frameAt(0.4)).toBe(1)
    expect(course.duration).toBe(0.9)
  })

  test('are found by their number, or the row before', () => {
    expect(course.timeOfRow(6)).toBe(0.5)
    expect(course.timeOfRow(9)).toBe(0.5)
    expect(course.timeOfRow(1)).toBe(0)
    expect(course.rowOf(3)).toBe(10)
  })

  test('a joint without a number stays where it was', () => {
    const position = new Float64Array(1)
    course.sample(0.5, position)
    expect(position[0]).toBe(4)
    course.sample(0.45, position)
    expect(position[0]).toBe(4)
  })
})

describe('documents', () => {
  const motion: MotionDocument = {
    schema: 'mrlab.motion.1',
    title: 't',
    verdict: 'accepted',
    message: '',
    robot: {
      model: 'r',
      product: 'UR5e',
      end_effector: '',
      urdf: '',
      joints: [
        { name: 'a', kind: 'revolute', lower: -1, upper: 1, velocity: 1 },
        { name: 'b', kind: 'revolute', lower: -1, upper: 1, velocity: 1 },
      ],
    },
    frame_rate: 10,
    times: null,
    rows: null,
    positions: packed('float32', [3, 2], [0, 1, 2, 3, 4, 5]),
    gripper: packed('uint8', [3], [0, 1, 1]),
    velocities: null,
    effort_proxies: null,
    findings: [],
    source: { file: '', variable: '', sha256: '' },
  }

  test('become frames', () => {
    const course = courseOf(motion)
    expect(course.frameCount).toBe(3)
    expect(course.gripperAt(0.1)).toBe(true)
  })

  test('whose bytes are too few are refused', () => {
    const short = { ...motion, positions: packed('float32', [4, 2], [0, 1, 2, 3]) }
    expect(() => courseOf(short)).toThrow('expected 4 x 2 of float32')
  })

  test('with another type of number are refused', () => {
    const other = { ...motion, gripper: packed('uint32', [3], [0, 1, 1]) }
    expect(() => courseOf(other)).toThrow(TypeError)
  })
})
