import { BufferAttribute, BufferGeometry, Mesh } from 'three'
import { expect, test } from 'vitest'
import { type Painted, paint } from '../../../src/scene/robot/glb_meshes'

const PAINTED: Painted = {
  palette: [
    [0.8, 0.2, 0.05, 0.4, 0],
    [0.01, 0.01, 0.01, 0.5, 0],
  ],
  band: 0.02,
  white: [0.5, 0.03],
  drawings: [[0.1, 0.2, 0.5, 0.4, 0]],
}

/** A mesh of three vertices: orange, black, and one in the middle of the drawing. */
function mesh(): Mesh {
  const geometry = new BufferGeometry()
  geometry.setAttribute('position', new BufferAttribute(new Float32Array(9), 3))
  geometry.setAttribute('color', new BufferAttribute(new Float32Array(12).fill(0.5), 4))
  const places = [0.25, 0.01, 0.75, 0.01, 0.3, 0.3]
  geometry.setAttribute('uv', new BufferAttribute(new Float32Array(places), 2))
  return new Mesh(geometry)
}

const values = ({ geometry }: Mesh, name: string) => {
  const found = geometry.getAttribute(name)
  return Array.from({ length: found.count }, (_, i) =>
    Array.from({ length: found.itemSize }, (_, k) => found.getComponent(i, k)),
  )
}

test('a drawing keeps its place in the atlas and its light; the rest is white there', () => {
  const body = mesh()
  paint(body, PAINTED, true)
  expect(values(body, 'uv').flat()).toEqual(
    [0.5, 0.03, 0.5, 0.03, 0.3, 0.3].map((value) => expect.closeTo(value, 4)),
  )
  expect(values(body, 'color')[0]?.[0]).toBeCloseTo(0.4)
  expect(values(body, 'color')[2]).toEqual([0.5, 0.5, 0.5])
  expect(values(body, 'finish')[2]?.[0]).toBeCloseTo(0.4)
})

test('without a picture what is drawn on has the paint around it', () => {
  const body = mesh()
  paint(body, PAINTED, false)
  expect(body.geometry.getAttribute('uv')).toBeUndefined()
  expect(values(body, 'color')[2]).toEqual(values(body, 'color')[0])
})

test('a file without drawings names its colours over the whole height', () => {
  const body = mesh()
  paint(body, { palette: PAINTED.palette }, false)
  expect(values(body, 'color')[2]?.[0]).toBeCloseTo(0.4)
  expect(values(body, 'color')[1]?.[0]).toBeCloseTo(0.005)
})
