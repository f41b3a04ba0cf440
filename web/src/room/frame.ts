import { Matrix4, Vector3 } from 'three'
import type { Fixtures } from './fixtures'

/** s between a frame's start and the instant at which it is seen, where the device does not tell. */
const AHEAD_S = 0.015
const MOST_AHEAD_S = 0.05

const matrix = new Matrix4()
const scale = new Vector3()

/** What the room does in each frame: poses, input, playback, robots, panels, picture. */
export class Frame {
  private last = 0

  constructor(private readonly room: Fixtures) {}

  /** time: of the frame, ms; frame: of a session, undefined without a headset. */
  draw(time: number, frame: XRFrame | undefined): void {
    const { room } = this
    const began = performance.now()
    const now = began / 1000
    const step = Math.min(now - this.last, 0.1)
    room.stage.measure(now - this.last)
    this.last = now
    let ahead = AHEAD_S
    const space = room.stage.renderer.xr.getReferenceSpace()
    if (frame !== undefined && space !== null) {
      ahead = Math.max((frame.predictedDisplayTime ?? time + AHEAD_S * 1000) - began, 0) / 1000
      this.track(frame, space, now)
    } else if (!room.inside.value) {
      room.stage.controls.update()
      room.stage.camera.updateMatrixWorld()
      room.stage.camera.matrixWorld.decompose(room.head, room.look, scale)
      room.mouse.update(now)
    }
    room.robots.update(now, step)
    room.objects.update(now)
    if (room.follower.pose(Math.min(ahead, MOST_AHEAD_S))) room.stage.invalidate()
    if (room.drawings.update()) room.stage.invalidate()
    room.stage.lightAbout(room.robots.handles.values())
    room.scene.update()
    room.overlays.setPicked(room.creation.picked)
    room.overlays.update(room.settings.still.value ? 0 : now)
    if (room.boardPlace.update(room, now, step)) room.stage.invalidate()
    room.board.update(now)
    room.guide.update(room.visit.inputs)
    if (room.people.update(now, step)) room.stage.invalidate()
    room.panels.update(now, step)
    room.systems.update(now, step)
    if (room.stage.draw(now)) room.frames++
    room.frameMs = performance.now() - began
    room.stats.frame(now, room.frameMs)
  }

  /** Follow the headset, its surfaces and what it points with. now: s. */
  private track(frame: XRFrame, space: XRReferenceSpace, now: number): void {
    const { room } = this
    room.anchor.update(frame, space)
    const viewer = frame.getViewerPose(space)
    if (viewer !== undefined) {
      matrix.fromArray(viewer.transform.matrix).decompose(room.head, room.look, scale)
      if (room.alignment.due) {
        room.alignment.align(room)
        room.boardPlace.face(room.look)
      }
    }
    room.scan.update(frame, space, now)
    const { inputs } = room.visit
    inputs?.update(frame, space, now)
    if (inputs !== null) room.people.tell(room, inputs)
  }
}
