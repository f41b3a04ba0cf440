"""The room with others: a system by touch, two headsets that see each other, hands, alignment."""

from __future__ import annotations

from collections.abc import Callable
from math import hypot
from pathlib import Path

import pytest
from room_side import BOARD, Headset
from served_lab import ServedLab

# Software draws the headset's pictures, on a busy machine a few a second.
pytestmark = pytest.mark.timeout(300)

HERE = Path(__file__).parents[1]
MOTION = HERE.parent / "examples" / "quintic_ur5e.mat"


def test_two_people_make_a_system_by_touch_see_each_other_and_use_their_hands(
    headsets: Callable[[], Headset], lab: ServedLab
) -> None:
    lab.done("scene", "load", "empty")
    lab.done("spawn", "ur5e")
    first = headsets()
    page = first.page
    first.enter()
    page.evaluate("room.board.panel.act('tab robots')")
    robots = page.evaluate("[...room.handles.keys()]")
    if "robot ur5e" not in page.evaluate("room.board.panel.ids"):
        first.act(BOARD, "next")
    x, y, z = page.evaluate(f"room.scene.base('{robots[0]}').position.toArray()")
    first.place("robot ur5e", x, y + 1.2, z)
    first.wait_for("room.handles.size > 1")
    robots = page.evaluate("[...room.handles.keys()]")
    pair = robots[:2]
    for robot in pair:
        lab.done("load", robot, str(MOTION))

    # A system by touch: numbered in order, one panel, a segment for each; own panels go.
    first.act(BOARD, "tab systems")
    first.act(BOARD, "pick")
    first.touch(pair[1])
    assert page.evaluate("room.creation.picked") == [pair[1]]
    first.touch(pair[0])
    assert page.evaluate("room.creation.picked") == [pair[1], pair[0]]
    first.act(BOARD, "sequential")
    first.wait_for("room.follower.systems.value.length === 1")
    system = page.evaluate("room.follower.systems.value[0].system.name")
    panel = f"room.systems.of('{system}')"
    first.wait_for(f"{panel}?.panel.ids.includes('play')")
    for robot in pair:
        first.wait_for(f"room.panels.of('{robot}') === undefined")
    members = page.evaluate(f"{panel}.members.map(({{ robot }}) => robot)")
    assert members == [pair[1], pair[0]]
    for _ in range(3):
        first.act(panel, "slower")

    # A second headset: both see each other, and who paused.
    second = headsets()
    second.enter()
    headsets_here = (first, second)
    for here, there in (headsets_here, headsets_here[::-1]):
        here.wait_for("room.people.present.length === 1")
        there.page.evaluate("headset.device.position.set(0.4, 1.5, 0.3)")
    assert second.page.evaluate("room.people.present[0].part") == 2, "who has the lab teaches"
    first.act(BOARD, "tab people")
    first.act(panel, "play")
    first.wait_for("['STAGING', 'PLAYING'].includes(room.follower.systems.value[0].system.label)")
    first.act(BOARD, "pause_all")
    second.wait_for(f"room.board.notice.includes('paused {system}')")
    first.wait_for("room.follower.systems.value[0].system.label === 'PAUSED'")

    # Nobody knows yet that the second one is in the same place: its surfaces do not count.
    devices = [each.page.evaluate("localStorage['mrlab.room.device']") for each in headsets_here]
    tables = "room.surfaces.filter(({ label }) => label === 'table').map(({ source }) => source)"
    first.wait_for(f"{tables}.includes('{devices[0]}')")
    first.wait_for("room.people.present[0].aligned === false")
    assert not first.page.evaluate(f"{tables}.includes('{devices[1]}')")
    # The same two points in the same order: the same place for the lab. Undone, it is as before.
    second.act(BOARD, "tab room")
    before = second.page.evaluate("room.stage.anchor.position.toArray()")
    second.act(BOARD, "align")
    for place in ((-1.0, 0.9, 1.0), (-1.0, 0.9, 2.0)):
        second.reach(place)
        for value in (1, 0):
            second.page.evaluate(
                f"headset.device.controllers.right.updateButtonValue('trigger', {value})"
            )
            second.frames()
    second.wait_for("room.touching.canUndo")
    origin = second.page.evaluate("room.stage.world.getWorldPosition(room.head.clone()).toArray()")
    assert hypot(origin[0] + 1.0, origin[2] - 1.0) < 0.01
    ahead = second.page.evaluate(
        "room.stage.world.localToWorld(room.head.clone().set(1, 0, 0)).toArray()"
    )
    assert hypot(ahead[0] + 1.0, ahead[2] - 2.0) < 0.01, "x points to the second point"
    # Each measured the room for itself: neither took the other's table away.
    for device in devices:
        first.wait_for(f"{tables}.includes('{device}')")
    first.wait_for("room.people.present[0].aligned")
    second.act(BOARD, "undo_align")
    first.wait_for(f"!{tables}.includes('{devices[1]}')")
    after = second.page.evaluate("room.stage.anchor.position.toArray()")
    assert max(abs(a - b) for a, b in zip(before, after, strict=True)) < 1e-6

    # Who leaves is gone at once.
    second.page.context.close()
    first.wait_for("room.people.present.length === 0")

    # Dissolving says what it does before it is done; then each has its own panel again.
    first.act(panel, "members")
    first.act(panel, f"choose {pair[0]}")
    first.act(panel, "confirm")
    first.wait_for("room.follower.systems.value.length === 0")
    first.wait_for(f"room.panels.of('{pair[0]}') !== undefined")

    # Hands in place of controllers, at any time: a poke presses, a pinch carries.
    page.evaluate("headset.device.primaryInputMode = 'hand'")
    first.wait_for("room.visit.inputs.hasHands")
    first.act(BOARD, "tab settings")
    first.frames()
    x, y, z = page.evaluate("room.board.panel.centre('contrast').toArray()")
    nx, ny, nz = page.evaluate(
        "room.board.panel.group.getWorldDirection(room.head.clone()).toArray()"
    )
    for away in (0.1, 0.05, -0.002, 0.05, 0.3):
        first.reach((x + nx * away, y + ny * away, z + nz * away))
    first.wait_for("room.settings.contrast.value")

    base = f"room.scene.base('{pair[0]}').getWorldPosition(room.head.clone()).toArray()"
    x, y, z = page.evaluate(base)
    start = page.evaluate(f"room.scene.base('{pair[0]}').position.toArray()")
    hand = "headset.device.hands.right"
    first.reach((x, y + 0.1, z + 0.2))
    page.evaluate(f"{hand}.poseId = 'pinch'; {hand}.updatePinchValue(1)")
    first.wait_for(f"room.handles.get('{pair[0]}').holders.length === 1")
    first.reach((x - 0.3, y + 0.1, z + 0.2))
    first.wait_for(f"room.handles.get('{pair[0]}').carried")
    # The hand goes out of view in mid-drag: the robot stands where it was last known.
    page.evaluate(f"{hand}.connected = false")
    first.wait_for(f"room.handles.get('{pair[0]}').holders.length === 0")
    placed = f"room.follower.robots.value.find(v => v.robot.name === '{pair[0]}').robot.pose"
    first.wait_for(
        f"Math.hypot({placed}.position.x - {start[0]}, {placed}.position.y - {start[1]}) > 0.2"
    )
