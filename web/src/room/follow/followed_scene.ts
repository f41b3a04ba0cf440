import type { FollowedScene } from '../../lab/follower'
import type { LabScene } from '../../scene/lab/lab_scene'
import type { ShownSurface } from '../../scene/lab/surfaces'
import type { ObjectHandles } from '../handles/object_handles'
import type { RoomRobots } from './robots'

/** Who takes what a lab says. */
export interface FollowedParts {
  readonly scene: LabScene
  readonly robots: RoomRobots
  readonly objects: ObjectHandles
  /** The robots are there, or others. */
  came(): void
  setSurfaces(surfaces: readonly ShownSurface[]): void
}

/** Return the scene as the follower moves it. */
export function followedScene(parts: FollowedParts): FollowedScene {
  const { scene, robots, objects } = parts
  return {
    setRobots: (shown) => {
      robots.set(shown)
      parts.came()
    },
    setState: (name, word, colour, filled) => scene.setState(name, word, colour, filled),
    setCollision: (name, link) => scene.setCollision(name, link),
    setObjects: (shown) => {
      scene.setObjects(shown)
      objects.set(shown)
    },
    setContacts: (contacts) => scene.setContacts(contacts),
    setSurfaces: (surfaces) => parts.setSurfaces(surfaces),
    // cubes between the fingers mark them here
    setTargets: () => undefined,
    frame: () => undefined,
    robot: (name) => scene.robot(name),
  }
}
