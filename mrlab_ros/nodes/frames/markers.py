"""Publishes the markers: all of a kind at once, latched, when something changed."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterable
from typing import Any

import numpy as np
from mrlab_msgs import msg
from rclpy.node import Node
from visualization_msgs.msg import Marker, MarkerArray

from mrlab_ros.adapters import share
from mrlab_ros.adapters.robots.library import RobotLibrary
from mrlab_ros.core.base.errors import LabError
from mrlab_ros.core.robots.frames import frame_name
from mrlab_ros.core.runtime.identity import Identity
from mrlab_ros.messages import markers, qos
from mrlab_ros.nodes.converter.catalogue import CatalogueClient
from mrlab_ros.ros.spinning import Caller
from mrlab_ros.ros.worker import Worker

# A tool's path has at most so many points.
MOST_POINTS = 500
# Above a robot, as a share of its reach, and m beyond that.
STATE_HEIGHT = 1.0
STATE_ABOVE = 0.15

Topic = tuple[Any, str, Callable[[Any], None], Any]


class Latched:
    """A topic whose newest message holds all markers of a kind.

    Its messages delete what was in the one before, so a display that was there all the time drops
    it, and one that comes late finds what there is.
    """

    def __init__(self, node: Node, topic: str) -> None:
        self.publisher = node.create_publisher(MarkerArray, topic, qos.LATCHED)
        self._before: list[Marker] = []

    def publish(self, now: list[Marker]) -> None:
        gone = markers.without(self._before, now)
        self._before = now
        self.publisher.publish(markers.array([*gone, *now]))


class MarkerPublishers:
    """The topics /markers/objects, surfaces, contacts and robots.

    rate: of each at most, Hz. The methods are called by one thread; a second one fetches what
    robots play, for the paths of their tools.
    """

    def __init__(self, node: Node, rate: float, identity: Identity) -> None:
        self._period = 1 / rate
        self._identity = identity
        self._log = node.get_logger()
        self._objects = Latched(node, "/markers/objects")
        self._surfaces = Latched(node, "/markers/surfaces")
        self._robots = Latched(node, "/markers/robots")
        self._contacts = node.create_publisher(MarkerArray, "/markers/contacts", qos.EVENTS)
        self._library = RobotLibrary(share.directory() / "robots")
        self._models: dict[str, str] = {}
        # The newest of what moves, published when it is due.
        self._newest_objects: msg.SceneObjects | None = None
        self._newest_contacts: msg.Contacts | None = None
        # By robot and kind: path, targets, state, collision, grasp.
        self._shown: dict[tuple[str, str], list[Marker]] = {}
        self._changed = False
        self._due = 0.0
        # By robot the trajectory whose path is shown or being fetched.
        self._paths: dict[str, str] = {}
        self._caller = Caller(node)
        self._fetch = CatalogueClient(self._caller.node).fetch
        self._work = Worker("paths", on_error=self._complain)
        # Publishers of what moves.
        self.moves = (self._objects.publisher, self._robots.publisher, self._contacts)

    def close(self) -> None:
        self._work.close(timeout=0.0)
        self._caller.close()

    def topics(self) -> Iterable[Topic]:
        """Return what is followed of the lab: type, topic, what takes it, quality."""
        return (
            (msg.SceneObjects, "/objects", self._take_objects, qos.LATCHED),
            (msg.Surfaces, "/surfaces", self._take_surfaces, qos.LATCHED),
            (msg.Contacts, "/contacts", self._take_contacts, qos.EVENTS),
        )

    def topics_of(self, robot: str) -> Iterable[Topic]:
        """Return what is followed of a robot."""

        def show(kind: str, found: Iterable[Marker | None]) -> None:
            self._show(robot, kind, found)

        return (
            (
                msg.PlaybackState,
                f"/{robot}/playback_state",
                lambda message: self._take_state(robot, message),
                qos.LATCHED,
            ),
            (
                msg.GraspTargets,
                f"/{robot}/targets",
                lambda message: show("targets", markers.target_markers(robot, message)),
                qos.LATCHED,
            ),
            (
                msg.Collision,
                f"/{robot}/collision",
                lambda message: show("collision", [markers.collision_marker(robot, message)]),
                qos.LATCHED,
            ),
            (
                msg.Grasp,
                f"/{robot}/grasp",
                lambda message: show("grasp", [markers.grasp_marker(robot, message)]),
                qos.LATCHED,
            ),
        )

    def robots(self, robots: Iterable[msg.Robot]) -> None:
        """Take which robots there are; what belongs to others is deleted."""
        self._models = {robot.name: robot.model for robot in robots}
        gone = [key for key in self._shown if key[0] not in self._models]
        for key in gone:
            del self._shown[key]
            self._paths.pop(key[0], None)
        self._changed |= bool(gone)

    def publish_due(self) -> None:
        """Publish what changed, each topic at most at the rate."""
        now = time.monotonic()
        if now < self._due:
            return
        self._due = now + self._period
        objects, self._newest_objects = self._newest_objects, None
        if objects is not None:
            self._objects.publish([markers.object_marker(thing) for thing in objects.objects])
        contacts, self._newest_contacts = self._newest_contacts, None
        if contacts is not None:
            found = markers.contact_markers(contacts.contacts)
            self._contacts.publish(markers.array(found))
        if self._changed:
            self._changed = False
            self._robots.publish([m for shown in list(self._shown.values()) for m in shown])

    def _take_objects(self, message: msg.SceneObjects) -> None:
        self._newest_objects = message

    def _take_contacts(self, message: msg.Contacts) -> None:
        self._newest_contacts = message

    def _take_surfaces(self, message: msg.Surfaces) -> None:
        self._surfaces.publish([markers.surface_marker(s) for s in message.surfaces])

    def _show(self, robot: str, kind: str, found: Iterable[Marker | None]) -> None:
        self._shown[robot, kind] = [marker for marker in found if marker is not None]
        self._changed = True

    def _take_state(self, robot: str, message: msg.PlaybackState) -> None:
        if not self._identity.accepts(message.lab) or robot not in self._models:
            return
        base = frame_name(robot, "base_link")
        reach = self._library.model(self._models[robot]).reach
        text = f"{robot}\n{message.label}"
        height = STATE_HEIGHT * reach + STATE_ABOVE
        self._show(robot, "state", [markers.state_marker(robot, base, text, height)])
        wanted = f"{message.trajectory_id}@{message.trajectory_version}"
        if self._paths.get(robot) == wanted:
            return
        self._paths[robot] = wanted
        self._show(robot, "path", [])
        # Without a version it is in no catalogue: somebody else's goal, or a stream.
        if message.trajectory_version:
            self._work.send(lambda: self._draw_path(robot, wanted))

    def _draw_path(self, robot: str, wanted: str) -> None:
        """Fetch a trajectory, in the worker's thread, and show where its tool goes."""
        model = self._library.model(self._models[robot])
        positions = self._fetch(wanted).positions
        step = -(-len(positions) // MOST_POINTS)
        points = model.chain.tool0(positions[::step])[:, :3, 3]
        if self._paths.get(robot) == wanted:
            base = frame_name(robot, model.chain.base)
            self._show(robot, "path", [markers.path_marker(robot, base, np.asarray(points))])

    def _complain(self, error: Exception) -> None:
        said = error if isinstance(error, LabError) else repr(error)
        self._log.warning(f"a tool's path is not shown: {said}", throttle_duration_sec=5.0)
