// Generated from the message definitions by `make docs`.

import type { CdrReader, CdrWriter } from './cdr'

/** geometry_msgs/msg/Point */
export interface Point {
  x: number
  y: number
  z: number
}

export function createPoint(): Point {
  return {
    x: 0,
    y: 0,
    z: 0,
  }
}

export function readPoint(from: CdrReader, into: Point): void {
  into.x = from.float64()
  into.y = from.float64()
  into.z = from.float64()
}

export function writePoint(to: CdrWriter, message: Point): void {
  to.float64(message.x)
  to.float64(message.y)
  to.float64(message.z)
}

/** geometry_msgs/msg/Point32 */
export interface Point32 {
  x: number
  y: number
  z: number
}

export function createPoint32(): Point32 {
  return {
    x: 0,
    y: 0,
    z: 0,
  }
}

export function readPoint32(from: CdrReader, into: Point32): void {
  into.x = from.float32()
  into.y = from.float32()
  into.z = from.float32()
}

/** geometry_msgs/msg/Polygon */
export interface Polygon {
  points: Point32[]
}

export function createPolygon(): Polygon {
  return {
    points: [],
  }
}

export function readPolygon(from: CdrReader, into: Polygon): void {
  into.points = from.messages(into.points, createPoint32, readPoint32)
}

/** geometry_msgs/msg/Pose */
export interface Pose {
  position: Point
  orientation: Quaternion
}

export function createPose(): Pose {
  return {
    position: createPoint(),
    orientation: createQuaternion(),
  }
}

export function readPose(from: CdrReader, into: Pose): void {
  readPoint(from, into.position)
  readQuaternion(from, into.orientation)
}

export function writePose(to: CdrWriter, message: Pose): void {
  writePoint(to, message.position)
  writeQuaternion(to, message.orientation)
}

/** geometry_msgs/msg/Quaternion */
export interface Quaternion {
  x: number
  y: number
  z: number
  w: number
}

export function createQuaternion(): Quaternion {
  return {
    x: 0,
    y: 0,
    z: 0,
    w: 0,
  }
}

export function readQuaternion(from: CdrReader, into: Quaternion): void {
  into.x = from.float64()
  into.y = from.float64()
  into.z = from.float64()
  into.w = from.float64()
}

export function writeQuaternion(to: CdrWriter, message: Quaternion): void {
  to.float64(message.x)
  to.float64(message.y)
  to.float64(message.z)
  to.float64(message.w)
}

/** geometry_msgs/msg/Twist */
export interface Twist {
  linear: Vector3
  angular: Vector3
}

export function createTwist(): Twist {
  return {
    linear: createVector3(),
    angular: createVector3(),
  }
}

export function readTwist(from: CdrReader, into: Twist): void {
  readVector3(from, into.linear)
  readVector3(from, into.angular)
}

export function writeTwist(to: CdrWriter, message: Twist): void {
  writeVector3(to, message.linear)
  writeVector3(to, message.angular)
}

/** geometry_msgs/msg/Vector3 */
export interface Vector3 {
  x: number
  y: number
  z: number
}

export function createVector3(): Vector3 {
  return {
    x: 0,
    y: 0,
    z: 0,
  }
}

export function readVector3(from: CdrReader, into: Vector3): void {
  into.x = from.float64()
  into.y = from.float64()
  into.z = from.float64()
}

export function writeVector3(to: CdrWriter, message: Vector3): void {
  to.float64(message.x)
  to.float64(message.y)
  to.float64(message.z)
}
