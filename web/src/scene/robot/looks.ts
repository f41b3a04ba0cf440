import {
  Color,
  LineBasicMaterial,
  MeshDepthMaterial,
  MeshStandardMaterial,
  type Texture,
} from 'three'
import { reducedMotion, type SceneTheme } from '../stage/theme'
import { bodyMaterial } from './robot_body'

/** The materials that robots share. */
export class Looks {
  /** Return whether the person prefers reduced motion. */
  still: () => boolean = reducedMotion
  readonly grey = new MeshStandardMaterial({ roughness: 0.75, metalness: 0 })
  readonly failing = new MeshStandardMaterial({ roughness: 0.5, metalness: 0 })
  readonly ghost = new MeshStandardMaterial({
    transparent: true,
    roughness: 0.9,
    metalness: 0,
    // Drawn behind surfaces that coincide: a ghost does not tint the robot at its first pose.
    polygonOffset: true,
    polygonOffsetFactor: 2,
    polygonOffsetUnits: 8,
  })
  /** Looks of unpainted robots, by the atlas of their links. */
  private readonly bodies = new Map<Texture | null, MeshStandardMaterial>()
  readonly shadow = new MeshDepthMaterial()
  readonly missing = new LineBasicMaterial({ color: 0xd6006c })

  /** Return the look of an unpainted robot; atlas: drawings on its links, null: none. */
  bodyOf(atlas: Texture | null): MeshStandardMaterial {
    const known = this.bodies.get(atlas)
    if (known !== undefined) return known
    const made = bodyMaterial(atlas)
    this.bodies.set(atlas, made)
    return made
  }

  setTheme(theme: SceneTheme): void {
    const dark = theme.name === 'dark'
    this.grey.color.set(dark ? 0x7d8791 : 0xa9b1ba)
    this.failing.color.set(theme.failing)
    this.failing.emissive.copy(new Color(theme.failing)).multiplyScalar(0.25)
    this.ghost.color.set(theme.accent)
    this.ghost.opacity = dark ? 0.26 : 0.2
  }

  dispose(): void {
    const { grey, failing, ghost, shadow, missing } = this
    for (const material of [grey, failing, ghost, shadow, missing]) material.dispose()
    for (const material of this.bodies.values()) material.dispose()
    this.bodies.clear()
  }
}
