import type { Object3D, Vector3 } from 'three'
import type { ShadowFit } from './shadow_fit'
import type { SceneTheme } from './theme'

/** Where a lab is drawn: a page's picture, or the room. */
export interface SceneHost {
  /** The lab's frame `world`: z up, m. */
  readonly world: Object3D
  readonly theme: SceneTheme
  readonly shadow: ShadowFit
  onTheme(listener: (theme: SceneTheme) => void): () => void
  /** Ask for a new picture. */
  invalidate(): void
  /** Show points of the world's frame whole; a view that a person chose stays, unless `again`. */
  frame(points: readonly Vector3[], again?: boolean): void
}
