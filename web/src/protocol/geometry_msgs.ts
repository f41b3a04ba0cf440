// Generated from the message definitions by `make docs`.

import type { MessageType } from '../link/link'
import { type CdrReader, type CdrWriter, messageType } from './cdr'
import { type Header, createHeader, readHeader, writeHeader } from './std_msgs'

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

export const pointType: MessageType<Point> = /* @__PURE__ */ messageType(
  'geometry_msgs/msg/Point',
  createPoint,
  readPoint,
  writePoint,
)

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

export function writePoint32(to: CdrWriter, message: Point32): void {
  to.float32(message.x)
  to.float32(message.y)
  to.float32(message.z)
}

export const point32Type: MessageType<Point32> = /* @__PURE__ */ messageType(
  'geometry_msgs/msg/Point32',
  createPoint32,
  readPoint32,
  writePoint32,
)

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

export function writePolygon(to: CdrWriter, message: Polygon): void {
  to.messages(message.points, writePoint32)
}

export const polygonType: MessageType<Polygon> = /* @__PURE__ */ messageType(
  'geometry_msgs/msg/Polygon',
  createPolygon,
  readPolygon,
  writePolygon,
)

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

export const poseType: MessageType<Pose> = /* @__PURE__ */ messageType(
  'geometry_msgs/msg/Pose',
  createPose,
  readPose,
  writePose,
)

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

export const quaternionType: MessageType<Quaternion> = /* @__PURE__ */ messageType(
  'geometry_msgs/msg/Quaternion',
  createQuaternion,
  readQuaternion,
  writeQuaternion,
)

/** geometry_msgs/msg/Transform */
export interface Transform {
  translation: Vector3
  rotation: Quaternion
}

export function createTransform(): Transform {
  return {
    translation: createVector3(),
    rotation: createQuaternion(),
  }
}

export function readTransform(from: CdrReader, into: Transform): void {
  readVector3(from, into.translation)
  readQuaternion(from, into.rotation)
}

export function writeTransform(to: CdrWriter, message: Transform): void {
  writeVector3(to, message.translation)
  writeQuaternion(to, message.rotation)
}

export const transformType: MessageType<Transform> = /* @__PURE__ */ messageType(
  'geometry_msgs/msg/Transform',
  createTransform,
  readTransform,
  writeTransform,
)

/** geometry_msgs/msg/TransformStamped */
export interface TransformStamped {
  header: Header
  child_frame_id: string
  transform: Transform
}

export function createTransformStamped(): TransformStamped {
  return {
    header: createHeader(),
    child_frame_id: '',
    transform: createTransform(),
  }
}

export function readTransformStamped(from: CdrReader, into: TransformStamped): void {
  readHeader(from, into.header)
  into.child_frame_id = from.string(into.child_frame_id)
  readTransform(from, into.transform)
}

export function writeTransformStamped(to: CdrWriter, message: TransformStamped): void {
  writeHeader(to, message.header)
  to.string(message.child_frame_id)
  writeTransform(to, message.transform)
}

export const transformStampedType: MessageType<TransformStamped> = /* @__PURE__ */ messageType(
  'geometry_msgs/msg/TransformStamped',
  createTransformStamped,
  readTransformStamped,
  writeTransformStamped,
)

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

export const twistType: MessageType<Twist> = /* @__PURE__ */ messageType(
  'geometry_msgs/msg/Twist',
  createTwist,
  readTwist,
  writeTwist,
)

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

export const vector3Type: MessageType<Vector3> = /* @__PURE__ */ messageType(
  'geometry_msgs/msg/Vector3',
  createVector3,
  readVector3,
  writeVector3,
)
