import { order } from '../../lab/commands'
import type { Unsubscribe } from '../../link/link'
import type { Pose } from '../../protocol/geometry_msgs'
import {
  createSpawnRobotRequest,
  listCatalogueType,
  type ObjectType,
  spawnObjectType,
  spawnRobotType,
} from '../../protocol/mrlab_msgs'
import type { Lab, Speech } from '../ports'

/** Has the lab put new robots and objects at a place. */
export class Spawning {
  types: readonly ObjectType[] = []
  /** Objects that there may be at once; 0: not known. */
  most = 0
  private readonly undo: Unsubscribe

  /** listed: called once the types of objects are known. placed: with each new robot. */
  constructor(
    private readonly ports: Speech & Lab,
    private readonly listed: () => void,
    private readonly placed: (robot: string) => void,
  ) {
    this.undo = ports.link.onOffer(() => this.list())
    this.list()
  }

  /** Put a robot there. pose: of its base; support: name of the surface. */
  async spawnRobot(model: string, pose: Pose, support: string): Promise<void> {
    const { ports } = this
    const request = { ...createSpawnRobotRequest(), model, pose, surface: support }
    const answer = await order(ports, 'lab/spawn_robot', spawnRobotType, request)
    if (answer === null) return
    ports.say(ports.words.room.placed(answer.robot.name), false)
    this.placed(answer.robot.name)
  }

  /** Put an object there; pose: of its middle. */
  spawnObject(type: string, pose: Pose): Promise<unknown> {
    const request = { type, name: '', automatic: false, pose }
    return order(this.ports, 'physics/spawn_object', spawnObjectType, request)
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
