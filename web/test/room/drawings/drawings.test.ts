import { Color, Group, Matrix4, type Mesh, Vector3 } from 'three'
import { describe, expect, it, vi } from 'vitest'
import { Course } from '../../../src/playback/course'
import { Envelope } from '../../../src/room/drawings/envelope'
import { Reference } from '../../../src/room/drawings/reference'
import { speedColour, toolSpeeds } from '../../../src/room/drawings/tool_ribbon'
import { Chain } from '../../../src/scene/chain'
import type { SceneRobot } from '../../../src/scene/robot'

/** One joint about z, a tool 2 m out. */
function arm(): Chain {
  const joint = {
    rest: new Matrix4(),
    axis: new Vector3(0, 0, 1),
    prismatic: false,
    lower: -Math.PI,
    upper: Math.PI,
    place: 0,
  }
  return new Chain([joint], new Matrix4().makeTranslation(2, 0, 0))
}

describe('the path of the tool', () => {
  it('has its speed at each place', () => {
    // stands for a second, then turns by 0.5 rad in a second
    const course = new Course(1, 1, new Float64Array([0, 0, 0.5]))
    const { points, speeds, fastest } = toolSpeeds(arm(), course)
    expect(speeds[0]).toBe(0)
    expect(points.slice(0, 3)).toEqual(new Float32Array([2, 0, 0]))
    expect(fastest).toBeCloseTo(2 * 2 * Math.sin(0.25), 6)
  })

  it('is one colour from slow to fast, without leaving the ramp', () => {
    const slow = speedColour(0, new Color()).getHex()
    expect(speedColour(-1, new Color()).getHex()).toBe(slow)
    const fast = speedColour(1, new Color()).getHex()
    expect(speedColour(7, new Color()).getHex()).toBe(fast)
    expect(fast).not.toBe(slow)
  })
})

it('the envelope is found over several pictures, and never below the floor', () => {
  const base = new Group()
  const envelope = new Envelope(arm(), 1, base, 0)
  let pictures = 0
  while (envelope.update()) pictures++
  expect(pictures).toBeGreaterThan(5)
  const [mesh] = base.children as [Mesh]
  const places = mesh.geometry.getAttribute('position')
  const out = (i: number) => Math.hypot(places.getX(i), places.getY(i))
  let most = 0
  for (let i = 0; i < places.count; i++) {
    most = Math.max(most, out(i))
    expect(places.getZ(i)).toBeGreaterThanOrEqual(-1e-6)
  }
  // 2 m, and what corners between the directions stand out
  expect(most).toBeGreaterThan(1.999)
  expect(most).toBeLessThan(2.02)
  expect(envelope.update()).toBe(false)
})

it('a ghost says how far the robot is from another motion', () => {
  const ghost = { setPositions: vi.fn(), dispose: vi.fn() }
  const course = new Course(1, 1, new Float64Array([0, 1]))
  const reference = new Reference('wave@1', course, ghost as unknown as SceneRobot, arm(), [
    'turn',
  ])
  const robot = { angle: () => 0.25 } as unknown as SceneRobot
  reference.update(0.5, robot)
  expect(ghost.setPositions).toHaveBeenLastCalledWith(Float64Array.of(0.5))
  expect(reference.joints[0]).toBeCloseTo(-0.25)
  expect(reference.tool).toBeCloseTo(2 * 2 * Math.sin(0.125), 9)
  reference.update(0.25, robot)
  expect(reference.tool).toBeCloseTo(0, 9)
  expect(reference.most).toBeCloseTo(4 * Math.sin(0.125), 9)
})
