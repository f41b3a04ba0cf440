import { Group, Quaternion, Vector3 } from 'three'
import { describe, expect, it } from 'vitest'
import type { Pose } from '../../../src/protocol/geometry_msgs'
import {
  poseInWorld,
  ROS_TO_XR,
  stand,
  upright,
  vectorToRos,
} from '../../../src/room/scene/frames'

const AXES = [
  { ros: [1, 0, 0], xr: [0, 0, -1], name: 'forwards' },
  { ros: [0, 1, 0], xr: [-1, 0, 0], name: 'left' },
  { ros: [0, 0, 1], xr: [0, 1, 0], name: 'up' },
] as const

function headingOf({ orientation: q }: Pose): number {
  return Math.atan2(2 * (q.w * q.z + q.x * q.y), 1 - 2 * (q.y * q.y + q.z * q.z))
}

function world(): Group {
  const group = new Group()
  stand(group)
  group.updateMatrixWorld(true)
  return group
}

const values = ({ x, y, z }: { x: number; y: number; z: number }) => [x, y, z]
const close = (found: number[], expected: readonly number[]) =>
  expected.forEach((value, i) => {
    expect(found[i]).toBeCloseTo(value, 12)
  })

describe('axes', () => {
  it.each(AXES)('$name is $name in both', ({ ros, xr }) => {
    close(values(vectorToRos(new Vector3(...xr), new Vector3())), ros)
    close(values(new Vector3(...ros).applyQuaternion(ROS_TO_XR as Quaternion)), xr)
    close(values(world().localToWorld(new Vector3(...ros))), xr)
  })
})

describe('a pose of a tracked thing', () => {
  it('of a head that looks ahead from 1.6 m is x forwards', () => {
    const pose = poseInWorld(world(), new Vector3(0.2, 1.6, 0), new Quaternion())
    close(values(pose.position), [0, -0.2, 1.6])
    close(Object.values(pose.orientation), [0, 0, 0, 1])
  })

  it('of a head that looks left points along y', () => {
    const left = new Quaternion().setFromAxisAngle(new Vector3(0, 1, 0), Math.PI / 2)
    expect(headingOf(poseInWorld(world(), new Vector3(), left))).toBeCloseTo(Math.PI / 2, 12)
  })

  it('of a plane on a wall has its normal along z', () => {
    // WebXR: a plane's y is its normal; here it points back at the viewer, along the scene's z
    const wall = new Quaternion().setFromAxisAngle(new Vector3(1, 0, 0), Math.PI / 2)
    const { orientation: q } = poseInWorld(world(), new Vector3(0, 1, -2), wall)
    const normal = new Vector3(0, 0, 1).applyQuaternion(new Quaternion(q.x, q.y, q.z, q.w))
    close(values(normal), [-1, 0, 0])
  })

  it('stays the same in the lab when the anchor moves with it', () => {
    const anchor = new Group()
    const lab = new Group()
    stand(lab)
    anchor.add(lab)
    anchor.position.set(1, 0.4, -3)
    anchor.rotation.y = 0.7
    anchor.updateMatrixWorld(true)
    const there = lab.localToWorld(new Vector3(0.5, -1, 0.25))
    const pose = poseInWorld(lab, there, anchor.quaternion.clone())
    close(values(pose.position), [0.5, -1, 0.25])
    expect(headingOf(pose)).toBeCloseTo(0, 12)
  })
})

describe('an upright pose', () => {
  it.each([-3, -1, 0, 0.4, 3.1])('has the heading that was asked for: %s', (heading) => {
    expect(headingOf(upright(1, 2, 3, heading))).toBeCloseTo(heading, 12)
  })
})
