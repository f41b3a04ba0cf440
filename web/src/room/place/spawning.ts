import { Quaternion, Vector3 } from 'three'
import { order } from '../../lab/commands'
import type { Unsubscribe } from '../../link/link'
import type { Pose } from '../../protocol/geometry_msgs'
import {
  createSpawnRobotRequest,
  listCatalogueType,
  type ObjectType,
  spawnRobotType,
} from '../../protocol/mrlab_msgs'
import type { Entry, Frames, Lab, Speech } from '../ports'
import { poseInWorld } from '../scene/frames'

const BELOW_EYES = 0.2 // m
const LOWEST = 0.3 // m
const UPRIGHT = { x: 0, y: 0, z: 0, w: 1 } as const
const level = new Quaternion()
const at = new Vector3()

/** Puts new robots and objects before the eyes. */
export class Spawning {
  types: readonly ObjectType[] = []
  /** Objects that there may be at once; 0: not known. */
  most = 0
  private readonly undo: Unsubscribe

  /** listed: called once the types of objects are known. */
  constructor(
    private readonly ports: Speech & Lab & Frames,
    private readonly listed: () => void,
  ) {
    this.undo = ports.link.onOffer(() => this.list())
    this.list()
  }

  /** Have the lab place a robot on the surface before the eyes. */
  async spawn({ id }: Entry): Promise<void> {
    const { ports } = this
    const request = {
      ...createSpawnRobotRequest(),
      model: id,
      automatic: true,
      has_viewer: true,
      viewer: poseInWorld(ports.world, ports.head, ports.look),
    }
    const answer = await order(ports, 'lab/spawn_robot', spawnRobotType, request)
    if (answer !== null) ports.say(ports.words.room.placed(answer.robot.name), false)
  }

  /** Return the place at a distance before the eyes, m, a little below them. */
  before(distance: number): Pose {
    const { head, look } = this.ports
    at.set(0, 0, -distance).applyQuaternion(look).add(head)
    at.y = Math.max(at.y - BELOW_EYES, LOWEST)
    return { ...poseInWorld(this.ports.world, at, level), orientation: UPRIGHT }
  }

  dispose(): void {
    this.undo()
  }

  private list(): void {
    if (this.types.length > 0) return
    this.ports.link
      .call('physics/list_catalogue', listCatalogueType, {})
      .then(({ types, limit }) => {
        this.types = types
        this.most = limit
        this.listed()
      })
      // Without physics there are no objects; the next offer lists them.
      .catch(() => undefined)
  }
}
