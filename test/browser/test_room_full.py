"""The room with an emulated Quest 3, from Enter to Leave: place on a table, play, scrub, halt at a
thing of the real room, go on, give an object to a gripper and take it back."""

from __future__ import annotations

from collections.abc import Callable
from math import atan2, cos, hypot
from pathlib import Path

import pytest
from room_side import BOARD, Headset
from served_lab import ServedLab

# Software draws the headset's pictures, on a busy machine a few a second.
pytestmark = pytest.mark.timeout(300)

HERE = Path(__file__).parents[1]
MOTION = HERE.parent / "examples" / "quintic_ur5e.mat"

# Stands a small sheet of the real room where the tool will be farthest from its start; returns how
# far that is, m.
BLOCK = """() => {
  const robot = room.scene.robot('ur5e_1')
  const course = room.follower.course('ur5e_1')
  const pose = new Float64Array(course.jointCount)
  const toolAt = share => {
    course.sample(course.duration * share, pose)
    robot.setPositions(pose)
    room.stage.scene.updateMatrixWorld(true)
    return robot.tool.matrixWorld.elements.slice(12, 15)
  }
  const start = toolAt(0)
  const far = ([x, y, z]) => Math.hypot(x - start[0], y - start[1], z - start[2])
  const places = Array.from({ length: 40 }, (_, i) => toolAt(i / 39))
  const farthest = places.reduce((a, b) => (far(b) > far(a) ? b : a))
  const [x, y, z] = farthest
  window.block = headset.plane(0.08, 0.08, 'other', { x, y, z })
  headset.planes.add(block)
  return far(farthest)
}"""
# The middle of the table in the lab's frame.
TABLE = "room.stage.world.worldToLocal(room.head.clone().set(0.2, 0.72, -1.1)).toArray()"
# Where the only object is, and where the fingers are, in the scene.
OBJECT = """(() => {
  const [handle] = room.objects.handles.values()
  return handle.centre(room.head.clone()).toArray()
})()"""
FINGERS = "room.scene.robot('ur5e_1').tip.matrixWorld.elements.slice(12, 15)"
# The most that the object left its place in the hand in 20 frames, m.
SLACK = """() => new Promise(resolve => {
  const robot = room.scene.robot('ur5e_1')
  const object = room.stage.world.getObjectByName(room.objects.handles.keys().next().value)
  const place = () => robot.tool.worldToLocal(object.getWorldPosition(room.head.clone()))
  const first = place()
  const start = robot.angle('shoulder_pan_joint')
  let most = 0
  let frames = 0
  const look = () => {
    most = Math.max(most, place().distanceTo(first))
    if (++frames < 20) return setTimeout(look, 50)
    resolve({ most, turned: Math.abs(robot.angle('shoulder_pan_joint') - start) })
  }
  look()
})"""


# Where a robot's base stands, in the scene, and how far from the eyes, m.
BASE = "room.scene.base('ur5e_1').getWorldPosition(room.head.clone()).toArray()"
APART = "room.head.distanceTo(room.scene.base('ur5e_1').getWorldPosition(room.head.clone()))"
HEADING = "Math.abs(room.handles.get('ur5e_1').grab.heading - window.heading)"
# The headset no longer sees the controllers, until `seen` is true again.
LOSE = """() => {
  const found = XRFrame.prototype.getPose
  const inputs = () => [...room.visit.session.inputSources]
  window.seen = false
  XRFrame.prototype.getPose = function (space, base) {
    const own = inputs().some(({ gripSpace, targetRaySpace }) =>
      space === gripSpace || space === targetRaySpace)
    return own && !window.seen ? undefined : found.call(this, space, base)
  }
}"""


@pytest.fixture
def headset(headsets: Callable[[], Headset]) -> Headset:
    return headsets()


ROBOT = "room.panels.of('ur5e_1')"


def test_a_person_works_with_a_robot_on_a_table(headset: Headset, lab: ServedLab) -> None:
    page = headset.page
    headset.enter()

    # the table that the headset knows is a surface of the lab
    headset.wait_for("room.supports.some(({ name }) => name === 'table_1')")

    headset.press(ROBOT, "remove")
    headset.wait_for("room.handles.size === 0")
    if "robot ur5e" not in page.evaluate("room.board.panel.ids"):
        headset.press(BOARD, "next")
    # it stands on the table where it was aimed: the table's middle, in the lab's frame
    aimed = page.evaluate(TABLE)
    headset.place("robot ur5e", *aimed)
    headset.wait_for("room.scene.base('ur5e_1')")
    x, y, z = page.evaluate("room.scene.base('ur5e_1').position.toArray()")
    assert hypot(x - aimed[0], y - aimed[1], z - aimed[2]) < 0.01
    facing = page.evaluate(
        "room.scene.base('ur5e_1').getWorldDirection(room.head.clone().set(0, 0, 0)).toArray()"
    )
    assert abs(facing[1] - 1) < 1e-6, "it stands upright"
    heading = page.evaluate(
        "(({ x, y, z, w }) => Math.atan2(2 * (w * z + x * y), 1 - 2 * (y * y + z * z)))"
        "(room.scene.base('ur5e_1').quaternion)"
    )
    viewer = page.evaluate("room.stage.world.worldToLocal(room.head.clone()).toArray()")
    assert cos(heading - atan2(viewer[1] - y, viewer[0] - x)) > 0.95, "it faces the viewer"

    lab.done("play", "ur5e_1", str(MOTION), "--no-wait")
    headset.reaches("PLAYING")
    headset.press(ROBOT, "stop")
    headset.reaches("READY")

    # with the trajectory here, the pose at a display instant comes from the clock
    headset.press(ROBOT, "play")
    headset.reaches("PLAYING")
    headset.wait_for("room.follower.source('ur5e_1') === 'course'")
    headset.press(ROBOT, "play")  # the same button pauses
    headset.reaches("PAUSED")

    headset.point(ROBOT, "timeline", 0.2)
    headset.trigger(True)
    for share in (0.4, 0.6):
        headset.point(ROBOT, "timeline", share)
    headset.trigger(False)
    player = f"{ROBOT}.robot.player"
    headset.wait_for(f"Math.abs({player}.position() / {player}.duration - 0.6) < 0.02")

    # a thing of the real room comes to stand where the arm will go
    headset.press(ROBOT, "stop")
    headset.reaches("READY")
    assert page.evaluate(BLOCK) > 0.15
    headset.wait_for("room.surfaces.some(({ name }) => name.startsWith('other'))")
    headset.press(ROBOT, "play")
    headset.reaches("COLLISION_HALT")
    headset.wait_for(f"{ROBOT}.robot.touching.includes('other')")
    assert page.evaluate(f"{ROBOT}.collisions.length") == 1

    page.evaluate("headset.planes.delete(block)")
    headset.reaches("PAUSED")
    headset.press(ROBOT, "play")
    headset.reaches("PLAYING")
    headset.press(ROBOT, "stop")
    headset.reaches("READY")

    # an object is carried between the fingers and let go there
    headset.press(ROBOT, "end_effector")
    headset.choose(ROBOT, "choose parallel_gripper")
    headset.wait_for("room.scene.robot('ur5e_1')?.root.links.tcp")
    headset.press(BOARD, "tab objects")
    headset.place("object cube", aimed[0] + 0.2, aimed[1] + 0.3, aimed[2])
    headset.wait_for("room.objects.count === 1")
    headset.reach_for(page.evaluate(OBJECT))
    headset.trigger(True)
    headset.reach_for(page.evaluate(FINGERS))
    headset.trigger(False)
    holding = "room.follower.robots.value[0].holding"
    headset.wait_for(f"{holding} !== ''")

    # it stays in the hand while the arm moves
    headset.press(ROBOT, "motions")
    headset.choose(ROBOT, "choose quintic_ur5e")
    headset.reaches("READY")
    headset.press(ROBOT, "play")
    headset.reaches("PLAYING")
    found = page.evaluate(SLACK)
    assert found["turned"] > 0.01
    assert found["most"] < 0.001, "it sits in the fingers without lag"
    headset.press(ROBOT, "play")
    headset.reaches("PAUSED")

    # a hand takes it from the gripper: from nearby, as a panel may stand before where it is now
    headset.reach_for(page.evaluate(OBJECT), away=0.05)
    headset.trigger(True)
    headset.wait_for(f"{holding} === ''")
    headset.trigger(False)

    page.evaluate("room.visit.leave()")
    headset.wait_for("!room.inside.value")


def test_a_robot_stays_where_it_was_when_a_hand_is_lost_and_the_floor_moves(
    headset: Headset, lab: ServedLab
) -> None:
    page = headset.page
    headset.enter()
    headset.wait_for("room.handles.size > 0")
    lab.done("load", "ur5e_1", str(MOTION))

    # drawn on demand: the path of the tool and how far it reaches
    page.evaluate(f"{ROBOT}.panel.act('show')")
    page.evaluate(f"{ROBOT}.panel.act('path'), {ROBOT}.panel.act('reach')")
    headset.wait_for("room.drawings.fastest('ur5e_1') > 0")
    page.evaluate(f"{ROBOT}.panel.act('path'), {ROBOT}.panel.act('reach')")
    page.evaluate(f"{ROBOT}.panel.act('back')")

    # a stick turns what is held; a hand that is lost in mid-drag moves nothing, and lets go
    holds = "room.handles.get('ur5e_1').holders.length"
    headset.reach_for(page.evaluate(BASE), 0.1)
    headset.trigger(True)
    headset.wait_for(f"{holds} === 1")
    page.evaluate("window.heading = room.handles.get('ur5e_1').grab.heading")
    stick = "headset.device.controllers.right.updateAxes"
    page.evaluate(f"{stick}('thumbstick', 1, 0)")
    headset.wait_for(f"{HEADING} > 0.3")
    page.evaluate(f"{stick}('thumbstick', 0, 0)")
    headset.frames()
    held = page.evaluate(BASE)
    page.evaluate(LOSE)
    page.evaluate("headset.device.controllers.right.position.x += 0.4")
    headset.wait_for(f"{holds} === 0")
    assert page.evaluate(BASE) == pytest.approx(held, abs=1e-3)
    page.evaluate("window.seen = true")
    headset.trigger(False)

    # a recentre moves the floor space, and no robot
    before = page.evaluate(APART)
    page.evaluate("headset.device.recenter()")
    headset.frames(5)
    assert page.evaluate(APART) == pytest.approx(before, abs=0.02)

    # a scene is kept from the board
    headset.press(BOARD, "tab lab")
    headset.press(BOARD, "save_scene")
    headset.wait_for("room.board.notice !== '' && !room.board.warns")
