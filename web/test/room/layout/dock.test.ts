import { Group, Mesh, type Object3D, PerspectiveCamera, PlaneGeometry, Vector3 } from 'three'
import { describe, expect, test } from 'vitest'
import { dock, type Edge } from '../../../src/room/layout/dock'

const SCREENS = [
  [1280, 740],
  [800, 540],
  [390, 720],
  [360, 560],
  [844, 330],
] as const
const CORNERS = [-1, 1].flatMap((x) => [-1, 1].map((y) => [x, y] as const))

function panel(width: number, height: number): Group {
  const group = new Group()
  group.add(new Mesh(new PlaneGeometry(width, height)))
  return group
}

function camera(width: number, height: number): PerspectiveCamera {
  const made = new PerspectiveCamera(60, width / height)
  made.position.set(0.4, 1.6, 0.9)
  made.lookAt(0, 0.8, -1)
  made.updateMatrixWorld()
  return made
}

/** Return where the corners of a panel's face, width by height, m, are in the picture, -1 to 1. */
function corners(
  face: Object3D,
  width: number,
  height: number,
  eyes: PerspectiveCamera,
): Vector3[] {
  face.updateWorldMatrix(true, true)
  return CORNERS.map(([x, y]) =>
    face.localToWorld(new Vector3((x * width) / 2, (y * height) / 2, 0)).project(eyes),
  )
}

describe.each(SCREENS)('on a screen of %i x %i', (width, height) => {
  const eyes = camera(width, height)

  test('a panel is whole in the picture wherever its robot is', () => {
    for (const at of [
      [0.7, 1.2, -1],
      [-6, 1, -3],
      [9, 0.2, 1],
      [0, 9, -2],
      [0.1, -4, -1],
    ] as const) {
      const shown = panel(0.64, 0.5)
      dock(shown, new Vector3(...at), eyes, 'bottom')
      for (const { x, y } of corners(shown, 0.64, 0.5, eyes)) {
        expect(Math.abs(x)).toBeLessThan(1)
        expect(Math.abs(y)).toBeLessThan(1)
      }
    }
  })

  test('so is what hangs from it', () => {
    const shown = panel(0.64, 0.5)
    const beside = panel(0.64, 0.6)
    beside.position.x = 0.66
    shown.add(beside)
    dock(shown, new Vector3(3, 1, -2), eyes, 'bottom')
    for (const { x } of corners(beside, 0.64, 0.6, eyes)) expect(Math.abs(x)).toBeLessThan(1)
    beside.visible = false
    dock(shown, new Vector3(3, 1, -2), eyes, 'bottom')
    const rightmost = Math.max(...corners(shown, 0.64, 0.5, eyes).map(({ x }) => x))
    expect(rightmost).toBeGreaterThan(0.9)
  })

  test('the board and the panel of a robot lie beside or above each other', () => {
    const place = (edge: Edge, x: number, across: number, along: number) => {
      const shown = panel(across, along)
      dock(shown, new Vector3(x, 1.3, -0.3), eyes, edge)
      return corners(shown, across, along, eyes)
    }
    const board = place('top', -0.9, 0.76, 0.78)
    const robot = place('bottom', 1.5, 0.64, 0.5)
    const apart = width > height ? 'x' : 'y'
    const [low, high] = width > height ? [board, robot] : [robot, board]
    const end = Math.max(...low.map((corner) => corner[apart]))
    expect(end).toBeLessThan(Math.min(...high.map((corner) => corner[apart])))
  })
})

test('a panel that lies where it should asks for no picture', () => {
  const eyes = camera(800, 600)
  const shown = panel(0.64, 0.5)
  expect(dock(shown, new Vector3(0.7, 1.2, -1), eyes, 'bottom')).toBe(true)
  expect(dock(shown, new Vector3(0.7, 1.2, -1), eyes, 'bottom')).toBe(false)
})
