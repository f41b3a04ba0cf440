import { Vector3 } from 'three'
import type { RoomContext } from './context'
import type { Fixtures, RoomParts } from './fixtures'
import type { Feedback } from './panels/panel'

/** m */
const READ_AT = 0.9

const tip = new Vector3()

/** Return what the parts of a room share; what changes is read from the room. */
export function contextOf(room: Fixtures, parts: RoomParts, feedback: Feedback): RoomContext {
  const { link, words, robots, endEffectors, checks, commands } = parts
  return {
    link,
    words,
    robots,
    endEffectors,
    checks,
    commands,
    feedback,
    stir: () => room.stage.invalidate(),
    world: room.stage.world,
    head: room.head,
    get trajectories() {
      return room.trajectories
    },
    get supports() {
      return room.supports
    },
    get bases() {
      return room.robots.bases()
    },
    get drawings() {
      return room.drawings
    },
    objectAt: (name) => {
      const robot = room.scene.robot(name)
      return robot === undefined
        ? ''
        : room.objects.nearest(tip.setFromMatrixPosition(robot.tip.matrixWorld))
    },
    robotAt: (place) => room.robots.fingersAt(place),
    get leftHanded() {
      return room.settings.leftHanded.value
    },
    get seated() {
      return room.settings.seated.value
    },
    get still() {
      return room.settings.still.value
    },
    get choosing() {
      return room.creation.on
    },
    readAt: READ_AT,
    get screen() {
      return room.inside.value ? null : room.stage.camera
    },
    repaintBoard: () => room.board.panel.repaint(),
    say: (text, warns) => room.board.say(text, warns),
  }
}
