import type { Ray, Vector3 } from 'three'
import { beforeEach, describe, expect, it } from 'vitest'
import {
  type Hit,
  RayPointer,
  type Signal,
  type Target,
  TouchPointer,
} from '../../../src/room/input/pointer'

/** A face at z, which spans x and y from -1 to 1. */
class Wall implements Target {
  readonly heard: string[] = []
  constructor(
    readonly z: number,
    readonly grabbable = false,
  ) {}
  cast(ray: Ray, hit: Hit): boolean {
    const distance = (this.z - ray.origin.z) / ray.direction.z
    ray.at(distance, hit.point)
    hit.distance = distance
    return distance > 0 && Math.abs(hit.point.x) < 1
  }
  reaches(point: Vector3): boolean {
    return this.grabbable && Math.abs(point.z - this.z) < 0.07
  }
  face(point: Vector3, hit: Hit): number {
    hit.u = point.x
    return Math.abs(point.x) < 1 ? point.z - this.z : Number.NaN
  }
  on(signal: Signal): void {
    this.heard.push(signal.kind)
  }
}

const moves = (wall: Wall) => wall.heard.filter((kind) => kind !== 'move')

describe('a ray', () => {
  let near: Wall
  let far: Wall
  let pointer: RayPointer

  beforeEach(() => {
    near = new Wall(-1)
    far = new Wall(-2)
    pointer = new RayPointer('ray', 'right')
    pointer.ray.origin.set(0, 0, 0)
    pointer.ray.direction.set(0, 0, -1)
  })

  it('points at the nearest', () => {
    pointer.aim(0, true, [far, near])
    expect(pointer.hovered).toBe(near)
    expect(pointer.hit.distance).toBe(1)
    expect(far.heard).toEqual([])
  })

  it('belongs to what it pressed until it lets go, wherever it points', () => {
    pointer.aim(0, true, [near, far])
    pointer.press('select')
    pointer.ray.origin.x = 5
    pointer.aim(0.1, true, [near, far])
    pointer.release('grip')
    pointer.release('select')
    pointer.aim(0.2, true, [near, far])
    expect(moves(near)).toEqual(['enter', 'down', 'up', 'leave'])
  })

  it('takes what the hand is at before what the ray meets', () => {
    const held = new Wall(-2, true)
    pointer.place.set(0, 0, -1.98)
    pointer.aim(0, true, [near, held])
    expect(pointer.hovered).toBe(held)
  })

  it('that is lost in a drag freezes, goes on when it is back, and lets go after half a second', () => {
    pointer.aim(0, true, [near])
    pointer.press('select')
    const before = near.heard.length
    pointer.aim(0.1, false, [near])
    pointer.aim(0.3, false, [near])
    expect(near.heard.length).toBe(before)
    pointer.aim(0.4, true, [near])
    expect(near.heard.at(-1)).toBe('move')
    pointer.aim(0.5, false, [near])
    pointer.aim(1.1, false, [near])
    expect(moves(near).slice(-2)).toEqual(['cancel', 'leave'])
    pointer.release('select')
    expect(near.heard.at(-1)).toBe('leave')
  })

  it('is blind while the finger touches', () => {
    pointer.aim(0, true, [near], true)
    expect(pointer.hovered).toBeNull()
  })
})

describe('a fingertip', () => {
  let wall: Wall
  let finger: TouchPointer
  let now: number
  const at = (z: number, seconds = 0.1) => {
    now += seconds
    finger.place.set(0, 0, z)
    finger.aim(now, true, [wall])
  }

  beforeEach(() => {
    wall = new Wall(0)
    finger = new TouchPointer('touch', 'right')
    now = 0
  })

  it('hovers from 15 cm on until it is 20 cm away', () => {
    at(0.17)
    expect(finger.hovered).toBeNull()
    at(0.14)
    expect(finger.hovered).toBe(wall)
    at(0.18)
    expect(finger.hovered).toBe(wall)
    at(0.21)
    expect(finger.hovered).toBeNull()
  })

  it('presses once although it trembles', () => {
    at(0.05)
    at(0.004)
    at(0.006)
    at(0.004)
    at(0.02)
    expect(moves(wall)).toEqual(['enter', 'down', 'up'])
  })

  it('does not press again within a quarter of a second', () => {
    at(0.05)
    at(0.002)
    at(0.02, 0.05)
    at(0.002, 0.05)
    expect(moves(wall)).toEqual(['enter', 'down', 'up'])
    at(0.02)
    at(0.002, 0.2)
    expect(moves(wall).at(-1)).toBe('down')
  })

  it('from behind presses nothing', () => {
    at(-0.05)
    at(0.003)
    at(-0.003)
    expect(moves(wall)).toEqual(['enter'])
  })
})
