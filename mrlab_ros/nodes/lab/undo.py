"""Undoes what somebody loaded, removed or dissolved, for all doors alike."""

from __future__ import annotations

import threading
import time
from collections.abc import Callable

from mrlab_msgs import msg
from rclpy.node import Node

from mrlab_ros.core.base.clock import SECOND
from mrlab_ros.core.base.diagnostic import Diagnostic
from mrlab_ros.core.base.errors import LabError, Misuse
from mrlab_ros.core.scene import restore as core
from mrlab_ros.core.scene.diagnostics import NOT_BACK, OBJECTS_TAKEN_OUT, UNDONE_IN_PART
from mrlab_ros.core.scene.document import SceneDocument
from mrlab_ros.core.scene.undo import Acts, opposite, plan_undo
from mrlab_ros.core.systems.diagnostics import DISSOLVED
from mrlab_ros.messages import qos
from mrlab_ros.messages.scenes import system_entry, things_of_scene
from mrlab_ros.messages.texts import told
from mrlab_ros.messages.time import make_header, time_to_message
from mrlab_ros.nodes.lab.observer import Observer
from mrlab_ros.nodes.lab.restore import LabRestore
from mrlab_ros.nodes.lab.scenes import Scenes
from mrlab_ros.ros.clock import LabClock, every
from mrlab_ros.ros.decoding import subscribe

# s between two looks whether an act has become too old.
PERIOD_S = 0.5


class Undo:
    """Keeps what destructive acts removed, announces the newest on /undoable, and undoes it.

    Acts of the lab's own services are noted by it; what physics and the coordinator removed is
    heard of. robots: returns the names of those that there are now.
    """

    def __init__(
        self,
        node: Node,
        observer: Observer,
        restore: LabRestore,
        clock: LabClock,
        robots: Callable[[], frozenset[str]],
    ) -> None:
        self._acts = Acts()
        self._lock = threading.Lock()
        self._restore = restore
        self._clock = clock
        self._robots = robots
        self._announced: tuple[str, float] | None = None
        # True while the lab itself removes things, as for a scene that is loaded.
        self._own = False
        self._publisher = node.create_publisher(msg.Undoable, "/undoable", qos.LATCHED)
        observer.dissolved = self._on_dissolved
        subscribe(node, msg.SceneObjects, "/objects/taken_out", self._on_objects, qos.EVENTS)
        every(node, PERIOD_S, self._announce)
        # Others may still have what a lab that died announced last.
        self._announce()

    def note(self, said: Diagnostic, lost: SceneDocument, *, whole: bool = False) -> None:
        """Note an act; whole: it put another scene in place of all that there was."""
        with self._lock:
            self._acts.note(said, lost, time.monotonic(), whole=whole)
        self._announce()

    def __enter__(self) -> None:
        """Begin to remove what is no act by itself."""
        self._own = True

    def __exit__(self, *_: object) -> None:
        self._own = False

    def _announce(self) -> None:
        """Publish the newest act, where it is another one than before, or for longer."""
        with self._lock:
            now = time.monotonic()
            act = self._acts.newest(now)
            announced = (act.id, act.until) if act is not None else ("", 0.0)
            if announced == self._announced:
                return
            self._announced = announced
        now_ns = self._clock.now_ns()
        message = msg.Undoable(header=make_header(now_ns, ""))
        if act is not None:
            until_ns = now_ns + round((act.until - now) * SECOND)
            message = msg.Undoable(
                header=make_header(now_ns, ""),
                id=act.id,
                until=time_to_message(until_ns),
                **told(act.said),
            )
        self._publisher.publish(message)

    def _on_dissolved(self, system: msg.RobotSystem) -> None:
        there = self._robots()
        # One that ends as its member leaves comes back with that robot.
        if self._own or not all(member.robot in there for member in system.members):
            return
        entry = system_entry(system, self._clock.now_ns())
        self.note(DISSOLVED(system=system.name), SceneDocument(systems=(entry,)))

    def _on_objects(self, message: msg.SceneObjects) -> None:
        things = things_of_scene(message.objects, self._robots())
        said = OBJECTS_TAKEN_OUT(objects=[thing.name for thing in things])
        self.note(said, SceneDocument(objects=things))

    def undo(self, id: str, scenes: Scenes) -> Diagnostic:
        """Undo an act, the newest where id is empty; return what to say.

        Raises Misuse where it cannot be, and LabError that names what was done and what not; then
        it can be tried again.
        """
        with self._lock:
            act = self._acts.find(id, time.monotonic())
        self._restore.await_leaving({robot.name for robot in act.lost.robots} - self._robots())
        present = scenes.present(self._robots())
        steps, missing = plan_undo(act, present)
        not_back = NOT_BACK(names=[*missing]) if missing else None
        if not steps and not_back is not None:
            raise Misuse(not_back)
        replaced = scenes.whole(physics=present.physics) if act.whole else None
        try:
            with self:
                core.run(steps, self._restore.execute, UNDONE_IN_PART)
        except LabError:
            back = scenes.present(self._robots()).names - present.names
            with self._lock:
                self._acts.failed(act, back, time.monotonic(), replaced)
            raise
        else:
            with self._lock:
                self._acts.undone(act, time.monotonic(), replaced)
        finally:
            self._announce()
        return opposite(act.said, missing=not_back)
