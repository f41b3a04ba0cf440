// Generated from the message definitions by `make docs`.

import type { MessageType } from '../link/link'
import { type CdrReader, type CdrWriter, messageType } from './cdr'
import { type Polygon, createPolygon, readPolygon, writePolygon } from './geometry_msgs'

/** shape_msgs/msg/SolidPrimitive */
export interface SolidPrimitive {
  type: number
  dimensions: Float64Array
  polygon: Polygon
}

export const SolidPrimitive = {
  BOX: 1,
  SPHERE: 2,
  CYLINDER: 3,
  CONE: 4,
  PRISM: 5,
  BOX_X: 0,
  BOX_Y: 1,
  BOX_Z: 2,
  SPHERE_RADIUS: 0,
  CYLINDER_HEIGHT: 0,
  CYLINDER_RADIUS: 1,
  CONE_HEIGHT: 0,
  CONE_RADIUS: 1,
  PRISM_HEIGHT: 0,
} as const

export function createSolidPrimitive(): SolidPrimitive {
  return {
    type: 0,
    dimensions: new Float64Array(0),
    polygon: createPolygon(),
  }
}

export function readSolidPrimitive(from: CdrReader, into: SolidPrimitive): void {
  into.type = from.uint8()
  into.dimensions = from.float64s(into.dimensions)
  readPolygon(from, into.polygon)
}

export function writeSolidPrimitive(to: CdrWriter, message: SolidPrimitive): void {
  to.uint8(message.type)
  to.float64s(message.dimensions)
  writePolygon(to, message.polygon)
}

export const solidPrimitiveType: MessageType<SolidPrimitive> = /* @__PURE__ */ messageType(
  'shape_msgs/msg/SolidPrimitive',
  createSolidPrimitive,
  readSolidPrimitive,
  writeSolidPrimitive,
)
