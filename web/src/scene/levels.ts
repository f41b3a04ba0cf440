import { Vector3 } from 'three'

/** A model drawn from packed files in place of the meshes of its links. */
export interface Level {
  /** What the URIs of the meshes begin with that it stands for. */
  readonly meshes: string
  readonly near: string
  readonly far: string
}

/** A hose between two links, as a description states it; m. */
export interface StatedHose {
  readonly radius: number
  readonly length: number
  readonly ends: readonly [StatedEnd, StatedEnd]
}

export interface StatedEnd {
  readonly link: string
  readonly point: Vector3
  readonly direction: Vector3
}

/** Return the packed levels that a description names; they stand for the folder meshes/ beside theirs. */
export function levelsOf(description: Document): Level[] {
  return [...description.querySelectorAll('robot > level_of_detail')].map((element) => {
    const near = element.getAttribute('near') ?? ''
    const meshes = near.replace(/lod\/[^/]*$/, 'meshes/')
    return { meshes, near, far: element.getAttribute('far') ?? '' }
  })
}

/** Return the hoses of a description; one that is not complete is left out. */
export function hosesOf(description: Document): StatedHose[] {
  const found: StatedHose[] = []
  for (const element of description.querySelectorAll('robot > hose')) {
    const [from, to] = [...element.querySelectorAll('end')].map(stated)
    const [radius = 0] = numbers(element, 'radius')
    const [length = 0] = numbers(element, 'length')
    if (from === undefined || to === undefined || !(radius > 0) || !(length > 0)) continue
    found.push({ radius, length, ends: [from, to] })
  }
  return found
}

function stated(element: Element): StatedEnd {
  const [x = 0, y = 0, z = 0] = numbers(element, 'xyz')
  const [ahead = 0, left = 0, up = 1] = numbers(element, 'direction')
  return {
    link: element.getAttribute('link') ?? '',
    point: new Vector3(x, y, z),
    direction: new Vector3(ahead, left, up).normalize(),
  }
}

function numbers(element: Element, name: string): number[] {
  const text = element.getAttribute(name)?.trim() ?? ''
  return text === '' ? [] : text.split(/\s+/).map(Number)
}
