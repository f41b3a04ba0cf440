"""Which contacts are collisions: a grasp, a release and setting down are none.

A finger may press on an object only the way it closes, and only while the gripper closes or holds.
What a person gives to a gripper by hand meets the gripper without a collision, until it has left
it. What is held is part of the robot; it may meet something along its release direction by a
declared tolerance. Everything else that a moving link touches halts the arm.
"""

from __future__ import annotations

from mrlab_ros.core.base.geometry import dot, rotate
from mrlab_ros.core.physics.engine import Kind, Touch
from mrlab_ros.core.physics.grasp.states import INWARDS, opposed
from mrlab_ros.core.physics.simulated_robot import Pressed, Robot
from mrlab_ros.core.physics.world_state import HAND, WorldState

# Cosine between a contact and the release direction, for the tolerance along it: 45 degrees.
ALONG = 0.707
UP = (0.0, 0.0, 1.0)
# A contact that ended this long ago, ns, is forgotten.
FORGET_NS = 100_000_000
# A contact that begins this soon after a grasp, ns, began with it.
GRASPED_NS = 10_000_000


def counts(state: WorldState, robot: Robot, touch: Touch) -> bool:
    """Return whether `touch` is a collision of this robot."""
    if touch.kind is Kind.SURFACE and touch.other in robot.tolerated:
        return False
    if touch.held:
        return _held_counts(state, robot, touch)
    if touch.link in robot.arm.fixed_links:
        return False
    if touch.kind is Kind.OBJECT:
        thing = state.objects.get(touch.other)
        grips = robot.gripper.closes or robot.gripper.pulls
        if thing is not None and thing.held_by == HAND and grips and _of_hand(robot, touch.link):
            # Somebody gives it to the gripper.
            return False
        return thing is None or not thing.graspable or not may_touch(robot, touch, touch.other)
    return True


def _of_hand(robot: Robot, link: str) -> bool:
    return link in robot.arm.grip_links | robot.arm.tool_links


def may_touch(robot: Robot, touch: Touch, name: str, link: str = "") -> bool:
    """Return whether a link of `robot` may touch an object that can be grasped.

    link: of this robot; empty: that of the touch.
    """
    link = link or touch.link
    if name == robot.held:
        return link in robot.arm.grip_links
    if name in robot.leaving and _of_hand(robot, link):
        return True
    if robot.gripper.closes:
        return robot.closed and (
            touch.grip >= INWARDS and touch.depth <= robot.settings.set_down
            if link in robot.finger_links
            else link in robot.arm.grip_links and _against(robot, touch)
        )
    return robot.gripper.pulls and link in robot.arm.face_links and touch.grip >= INWARDS


def _against(robot: Robot, touch: Touch) -> bool:
    """Return whether a finger presses what is touched against this link of the hand."""
    return any(
        finger.other == touch.other
        and finger.link in robot.finger_links
        and finger.grip >= INWARDS
        and opposed(finger, touch)
        for finger in robot.touches
    )


def _held_counts(state: WorldState, robot: Robot, touch: Touch) -> bool:
    other = state.robots.get(touch.other) if touch.kind is Kind.ROBOT else None
    settings = state.settings
    if other is not None and may_touch(other, touch, touch.held, touch.other_link):
        still = other.still_grips
        strain = still.strain if still is not None and still.object == touch.held else 0.0
        return max(touch.depth, strain) > settings.set_down
    pressed = robot.pressed.get(_key(touch))
    way = pressed.way if pressed is not None else 0.0
    before = pressed.depth if pressed is not None else 0.0
    allowed = settings.set_down if _along(state, robot, touch) else settings.graze
    return touch.depth > settings.set_down + before or way > allowed


def _along(state: WorldState, robot: Robot, touch: Touch) -> bool:
    """Return whether a touch of what is held is below it or ahead of the tool."""
    if dot(touch.normal, UP) > ALONG:
        return True
    tool = state.engine.link(robot.name, robot.tool_link).pose
    return dot(touch.normal, rotate(tool.orientation, UP)) < -ALONG


def _key(touch: Touch) -> tuple[Kind, str, str]:
    return (touch.kind, touch.other, touch.other_link)


def press(robot: Robot, now_ns: int, duration: float) -> None:
    """Add up how far what is held has moved into what it touches, over a step of `duration` s."""
    most: dict[tuple[Kind, str, str], tuple[float, float]] = {}
    for touch in robot.touches:
        if touch.held:
            key = _key(touch)
            approach, depth = most.get(key, (touch.approach, touch.depth))
            most[key] = (max(approach, touch.approach), max(depth, touch.depth))
    for key, (approach, depth) in most.items():
        before = robot.pressed.get(key)
        if before is not None:
            way, depth = approach * duration + before.way, before.depth
        else:
            way = approach * duration
            depth = depth if now_ns - robot.held_since_ns < GRASPED_NS else 0.0
        robot.pressed[key] = Pressed(now_ns, max(way, 0.0), depth)


def forget(robot: Robot, now_ns: int) -> None:
    """Forget what the held object has left."""
    for key, pressed in list(robot.pressed.items()):
        if now_ns - pressed.seen_ns > FORGET_NS:
            del robot.pressed[key]
