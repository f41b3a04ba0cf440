import { Color, LineBasicMaterial, MeshDepthMaterial, MeshStandardMaterial } from 'three'
import { bodyMaterial } from './robot_body'
import type { SceneTheme } from './theme'

/** The materials that robots share. */
export class Looks {
  readonly grey = new MeshStandardMaterial({ roughness: 0.75, metalness: 0 })
  readonly failing = new MeshStandardMaterial({ roughness: 0.5, metalness: 0 })
  readonly ghost = new MeshStandardMaterial({
    transparent: true,
    roughness: 0.9,
    metalness: 0,
    // behind what it coincides with: a robot at its first pose is not tinted by its ghost
    polygonOffset: true,
    polygonOffsetFactor: 2,
    polygonOffsetUnits: 8,
  })
  /** Of a robot as it is made, and of its shadow. */
  readonly body = bodyMaterial()
  readonly shadow = new MeshDepthMaterial()
  readonly missing = new LineBasicMaterial({ color: 0xd6006c })

  setTheme(theme: SceneTheme): void {
    const dark = theme.name === 'dark'
    this.grey.color.set(dark ? 0x7d8791 : 0xa9b1ba)
    this.failing.color.set(theme.failing)
    this.failing.emissive.copy(new Color(theme.failing)).multiplyScalar(0.25)
    this.ghost.color.set(theme.accent)
    this.ghost.opacity = dark ? 0.26 : 0.2
  }

  dispose(): void {
    const { grey, failing, ghost, body, shadow, missing } = this
    for (const material of [grey, failing, ghost, body, shadow, missing]) material.dispose()
  }
}
