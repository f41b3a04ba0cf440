"""Publishers of the physics node: contacts, collisions, grasps, objects, surfaces."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

from mrlab_msgs import msg
from rclpy.node import Node
from rclpy.publisher import Publisher
from sensor_msgs.msg import JointState

from mrlab_ros.core.base.clock import SECOND
from mrlab_ros.core.physics.engine import BodyState
from mrlab_ros.core.physics.world import World
from mrlab_ros.core.physics.world_state import (
    CollisionChanged,
    Event,
    LoadChanged,
    ObjectRemoved,
    SceneObject,
)
from mrlab_ros.core.scene.surfaces import Surface
from mrlab_ros.messages import physics as messages
from mrlab_ros.messages import qos
from mrlab_ros.ros.clock import LabClock

CONTACTS_NS = SECOND // 50
OBJECTS_NS = SECOND // 30
REPEAT_NS = SECOND
# An object that moved less than this since it was last published is at rest, m.
STILL = 1e-4


@dataclass(frozen=True, eq=False)
class PublishedObject:
    """An object as it was last published."""

    message: msg.SceneObject
    motion: BodyState
    held_by: str

    def holds(self, motion: BodyState, held_by: str) -> bool:
        before, now = self.motion.pose, motion.pose
        pairs = (
            *zip(before.position, now.position, strict=True),
            *zip(before.orientation, now.orientation, strict=True),
        )
        return held_by == self.held_by and all(abs(a - b) < STILL for a, b in pairs)


class WorldPublishers:
    """Publishes the events and the state of a world.

    The caller must hold the world's lock unless a method says otherwise. The world has instants
    of `clock`, and messages the stamps of it.
    """

    def __init__(self, node: Node, world: World, clock: LabClock) -> None:
        self._node = node
        self._world = world
        self._clock = clock
        self._collisions: dict[str, Publisher] = {}
        self._grasps: dict[str, Publisher] = {}
        self._fingers: dict[str, Publisher] = {}
        # By robot the positions that were published last.
        self._finger_positions: dict[str, dict[str, float]] = {}
        self._published: dict[str, PublishedObject] | None = None
        self._next_contacts_ns = self._next_objects_ns = self._repeat_ns = 0
        self._contacts = node.create_publisher(msg.Contacts, "/contacts", qos.EVENTS)
        self._objects = node.create_publisher(msg.SceneObjects, "/objects", qos.LATCHED)
        self._removed = node.create_publisher(msg.ObjectRemoved, "/objects/removed", qos.EVENTS)
        self._taken_out = node.create_publisher(msg.SceneObjects, "/objects/taken_out", qos.EVENTS)
        self._overlaps = node.create_publisher(msg.Overlaps, "/overlaps", qos.LATCHED)
        self._overlapping: list[tuple[str, str]] | None = None
        self._surfaces = node.create_publisher(msg.Surfaces, "/surfaces", qos.LATCHED)

    def add_robot(self, name: str) -> None:
        self._collisions[name] = self._node.create_publisher(
            msg.Collision, f"/{name}/collision", qos.LATCHED
        )
        self._grasps[name] = self._node.create_publisher(msg.Grasp, f"/{name}/grasp", qos.LATCHED)
        # Apart from the arm's frames, which are exactly those of its trajectory.
        self._fingers[name] = self._node.create_publisher(
            JointState, f"/{name}/finger_states", qos.LATCHED
        )

    def remove_robot(self, name: str) -> None:
        self._node.destroy_publisher(self._collisions.pop(name))
        self._node.destroy_publisher(self._grasps.pop(name))
        self._node.destroy_publisher(self._fingers.pop(name))
        self._finger_positions.pop(name, None)

    def publish_due(self, now_ns: int) -> bool:
        """Publish what is due; return whether an object was added, removed or moved."""
        for event in self._world.take_events():
            self._publish_event(event)
        if now_ns >= self._next_contacts_ns:
            contacts = self._world.take_contacts()
            if contacts:
                self._next_contacts_ns = now_ns + CONTACTS_NS
                shifted_ns = self._clock.shifted_ns
                self._contacts.publish(messages.contacts_to_message(now_ns, contacts, shifted_ns))
        if now_ns < self._next_objects_ns:
            return False
        self._next_objects_ns = now_ns + OBJECTS_NS
        self._publish_fingers(now_ns)
        self._publish_overlaps()
        return self._publish_objects(now_ns)

    def _publish_event(self, event: Event) -> None:
        shifted_ns = self._clock.shifted_ns
        if isinstance(event, ObjectRemoved):
            self._node.get_logger().info(f"{event.name} is removed: {event.why}")
            self._removed.publish(messages.removed_to_message(event, shifted_ns))
        elif isinstance(event, CollisionChanged):
            if event.robot in self._collisions:
                collision = messages.collision_to_message(event, shifted_ns)
                self._collisions[event.robot].publish(collision)
        elif isinstance(event, LoadChanged):
            self._publish_event(event.grasp)
        elif event.robot in self._grasps and event.robot in self._world.robots:
            fingers = [finger.joint for finger in self._world.robot(event.robot).arm.fingers]
            grasp = messages.grasp_to_message(event, fingers, shifted_ns)
            self._grasps[event.robot].publish(grasp)

    def _publish_overlaps(self) -> None:
        """Publish which robots stand in surfaces, where that has changed."""
        found = self._world.overlaps()
        pairs = [(robot, surface.name) for robot, surface in found]
        if pairs == self._overlapping:
            return
        self._overlapping = pairs
        self._overlaps.publish(messages.overlaps_to_message(self._clock.now_ns(), found))

    def _publish_fingers(self, now_ns: int) -> None:
        """Publish the fingers of each gripper where they moved; else once a second."""
        again = now_ns >= self._repeat_ns
        for name in self._world.robots:
            positions = self._world.fingers(name)
            before = self._finger_positions.get(name)
            if not positions or name not in self._fingers:
                continue
            moved = before is None or any(
                abs(position - before.get(joint, math.inf)) >= STILL
                for joint, position in positions.items()
            )
            if moved or again:
                self._finger_positions[name] = positions
                stamp_ns = self._clock.stamp(now_ns)
                self._fingers[name].publish(messages.fingers_to_message(stamp_ns, name, positions))

    def _publish_objects(self, now_ns: int) -> bool:
        """Publish all objects where one was added, removed or moved; else once a second."""
        before = self._published or {}
        published: dict[str, PublishedObject] = {}
        for thing in self._world.objects:
            motion = self._world.motion(thing.name)
            known = before.get(thing.name)
            if known is None or not known.holds(motion, thing.held_by):
                in_tool = self._world.in_tool(thing.name)
                known = PublishedObject(
                    messages.object_to_message(thing, motion, in_tool), motion, thing.held_by
                )
            published[thing.name] = known
        changed = (
            self._published is None
            or published.keys() != before.keys()
            or any(published[name] is not before[name] for name in published)
        )
        self._published = published
        if changed or now_ns >= self._repeat_ns:
            self._repeat_ns = now_ns + REPEAT_NS
            objects = [known.message for known in published.values()]
            # The instant of the poses: the arms' joint states have the same stamps.
            stamp_ns = self._clock.stamp(self._world.now_ns or now_ns)
            self._objects.publish(messages.objects_to_message(stamp_ns, objects))
        return changed

    def publish_taken_out(self, things: Sequence[SceneObject]) -> None:
        """Publish objects as they are before a request removes them."""
        if not things:
            return
        motion = self._world.motion
        objects = [messages.object_to_message(thing, motion(thing.name)) for thing in things]
        self._taken_out.publish(messages.objects_to_message(self._clock.now_ns(), objects))

    def publish_surfaces(self, surfaces: Sequence[Surface]) -> None:
        """Publish the surfaces. The caller need not hold the lock: a large room takes long."""
        self._surfaces.publish(messages.surfaces_to_message(self._clock.now_ns(), surfaces))
