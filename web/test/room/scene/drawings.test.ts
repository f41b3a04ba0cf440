import { Color, Group, Matrix4, type Mesh, Vector3 } from 'three'
import { describe, expect, it, vi } from 'vitest'
import { Course } from '../../../src/playback/course'
import { Envelope } from '../../../src/room/scene/envelope'
import { Reference } from '../../../src/room/scene/reference'
import { speedColour, toolSpeeds } from '../../../src/room/scene/tool_ribbon'
import { Chain } from '../../../src/scene/robot/chain'
import type { SceneRobot } from '../../../src/scene/robot/robot'

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
    // At rest for a second, then a turn by 0.5 rad in a second.
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
  // 2 m, and the overhang of corners between the directions
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

it('finds how far an arm of six joints reaches, all around', () => {
  // lengths and twists of a UR5e
  const links = [
    [0, 0, 0.1625, Math.PI / 2],
    [-0.425, 0, 0, 0],
    [-0.3922, 0, 0, 0],
    [0, 0, 0.1333, Math.PI / 2],
    [0, 0, 0.0997, -Math.PI / 2],
    [0, 0, 0.0996, 0],
  ] as const
  let before = new Matrix4()
  const joints = links.map(([x, y, z, twist], place) => {
    const rest = before
    before = new Matrix4().makeTranslation(x, y, z).multiply(new Matrix4().makeRotationX(twist))
    const limit = 2 * Math.PI
    return {
      rest,
      axis: new Vector3(0, 0, 1),
      prismatic: false,
      lower: -limit,
      upper: limit,
      place,
    }
  })
  const base = new Group()
  const envelope = new Envelope(new Chain(joints, before), 6, base, -9)
  while (envelope.update());
  const places = (base.children[0] as Mesh).geometry.getAttribute('position')
  let least = 9
  let most = 0
  for (let i = 10 * 40; i < 11 * 40; i++) {
    const out = Math.hypot(places.getX(i), places.getY(i))
    least = Math.min(least, out)
    most = Math.max(most, out)
  }
  // half way up: its 0.82 m and the wrist's offsets; its first joint turns all around
  expect(least).toBeGreaterThan(0.9)
  expect(most).toBeLessThan(1.05)
  expect(most - least).toBeLessThan(0.03)
})
