// Generated from the message definitions by `make docs`.

import type { CdrReader } from './cdr'
import { type Polygon, createPolygon, readPolygon } from './geometry_msgs'

/** shape_msgs/msg/SolidPrimitive */
export interface SolidPrimitive {
  type: number
  dimensions: Float64Array
  polygon: Polygon
}

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
