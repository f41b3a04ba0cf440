"""Messages of the other nodes about the lab's robots and systems."""

from __future__ import annotations

import threading
import time
from collections.abc import Callable, Collection, Sequence
from functools import partial

from mrlab_msgs import msg
from rclpy.node import Node
from rclpy.serialization import deserialize_message
from rclpy.subscription import Subscription

from mrlab_ros.core.base.errors import LabError
from mrlab_ros.core.runtime.identity import Identity
from mrlab_ros.core.scene.placement import Support, Thing
from mrlab_ros.messages import qos
from mrlab_ros.messages.physics import supports_from_message, things_from_message
from mrlab_ros.ros.decoding import subscribe

POLL_PERIOD_S = 0.02


class Observer:
    """Keeps the newest playback state of each robot and the newest list of systems.

    node: is spun by another thread than the one that asks. identity: which messages are of this
    lab.
    """

    def __init__(self, node: Node, identity: Identity) -> None:
        self._identity = identity
        self._node = node
        self._lock = threading.Lock()
        self._states: dict[str, msg.PlaybackState] = {}
        self._systems: msg.RobotSystems | None = None
        self._supports: tuple[Support, ...] = ()
        self._subscriptions: dict[str, Subscription] = {}
        # Set where a system was made or dissolved, until somebody clears it.
        self.systems_changed = threading.Event()
        # Called with each system that is dissolved.
        self.dissolved: Callable[[msg.RobotSystem], None] = lambda _: None
        # Counts what was received, so that a caller sees whether something changed.
        self.received = 0
        subscribe(node, msg.RobotSystems, "/systems", self._on_systems, qos.LATCHED_EVENTS)

        subscribe(node, msg.Surfaces, "/surfaces", self._on_surfaces, qos.LATCHED)
        # Read only where it is asked for: it comes thirty times a second.
        self._objects = b""
        node.create_subscription(
            msg.SceneObjects, "/objects", self._on_objects, qos.LATCHED, raw=True
        )

    @property
    def supports(self) -> tuple[Support, ...]:
        """The level surfaces of the room that physics published last."""
        with self._lock:
            return self._supports

    @property
    def objects(self) -> Sequence[msg.SceneObject]:
        """The objects that physics published last; none where it does not run."""
        if not self._objects or not self.published(["/objects"]):
            return ()
        return list(deserialize_message(self._objects, msg.SceneObjects).objects)

    @property
    def things(self) -> tuple[Thing, ...]:
        """The objects that physics published last, but for those that are held."""
        return things_from_message(self.objects)

    def follow(self, robots: Collection[str]) -> None:
        """Observe exactly these robots; forget the others."""
        for name in self._subscriptions.keys() - set(robots):
            self._node.destroy_subscription(self._subscriptions.pop(name))
            with self._lock:
                self._states.pop(name, None)
        for name in set(robots) - self._subscriptions.keys():
            self._subscriptions[name] = subscribe(
                self._node,
                msg.PlaybackState,
                f"/{name}/playback_state",
                partial(self._on_state, name),
                qos.LATCHED_EVENTS,
            )

    def state(self, robot: str) -> msg.PlaybackState | None:
        """Return the robot's newest playback state, None before the first."""
        with self._lock:
            return self._states.get(robot)

    @property
    def systems(self) -> tuple[msg.RobotSystem, ...] | None:
        """The systems that a coordinator published last; None before the first list."""
        with self._lock:
            return None if self._systems is None else tuple(self._systems.systems)

    def manned(self, robots: Collection[str]) -> bool:
        """Return whether one of the robots is a member of a system."""
        members = {member.robot for system in self.systems or () for member in system.members}
        return not members.isdisjoint(robots) and self.published(["/systems"])

    def published(self, topics: Collection[str]) -> bool:
        """Return whether somebody publishes one of the topics."""
        return any(map(self._node.count_publishers, topics))

    def wait_for(self, condition: Callable[[], bool], timeout: float) -> bool:
        """Return whether `condition` became true within `timeout`, s."""
        deadline = time.monotonic() + timeout
        while not condition():
            if time.monotonic() > deadline or not self._node.context.ok():
                return False
            time.sleep(POLL_PERIOD_S)
        return True

    def _on_state(self, robot: str, message: msg.PlaybackState) -> None:
        if not self._identity.accepts(message.lab):
            return
        with self._lock:
            # A message of a robot that was just removed may still be on its way.
            if robot in self._subscriptions:
                self._states[robot] = message
                self.received += 1

    def _on_objects(self, data: bytes) -> None:
        self._objects = data

    def _on_surfaces(self, message: msg.Surfaces) -> None:
        try:
            supports = supports_from_message(message)
        except LabError as error:
            self._node.get_logger().warning(f"the surfaces stay as they were: {error}")
            return
        with self._lock:
            self._supports = supports

    def _on_systems(self, message: msg.RobotSystems) -> None:
        if not self._identity.accepts(message.lab):
            return
        with self._lock:
            before, self._systems = self._systems, message
            self.received += 1
        if before is None or _names(before) != _names(message):
            self.systems_changed.set()
        for system in before.systems if before is not None else ():
            if system.name not in _names(message):
                self.dissolved(system)


def _names(message: msg.RobotSystems) -> list[str]:
    return [system.name for system in message.systems]
