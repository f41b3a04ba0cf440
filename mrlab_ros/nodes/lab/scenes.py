"""The scenes of the lab: saved as they are, loaded whole or refused with nothing changed."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterable, Sequence
from dataclasses import replace
from typing import Any

from mrlab_msgs import srv
from rclpy.node import Node

from mrlab_ros.adapters.robots.library import RobotLibrary
from mrlab_ros.adapters.scenes.files import SceneFiles
from mrlab_ros.core.base.diagnostic import Diagnostic, heard
from mrlab_ros.core.base.errors import LabError, Unavailable
from mrlab_ros.core.scene import restore as core
from mrlab_ros.core.scene.document import RobotEntry, SceneDocument
from mrlab_ros.core.scene.restore import Present
from mrlab_ros.core.systems.members import Loaded
from mrlab_ros.messages import qos
from mrlab_ros.messages.physics import surface_from_message
from mrlab_ros.messages.scenes import loaded_from_messages, placements_from_messages
from mrlab_ros.nodes.lab.diagnostics import (
    NO_COORDINATOR_RUNS,
    NO_PHYSICS_TO_SAVE,
    NO_PLAYBACK_RUNS,
    SCENE_LOADED,
    SCENE_SAVED,
)
from mrlab_ros.nodes.lab.observer import Observer
from mrlab_ros.nodes.lab.restore import ARRIVAL_TIMEOUT_S, LOAD_TIMEOUT_S, LabRestore
from mrlab_ros.ros.calls import NoAnswer, call

# Messages published before a request reach the lab within this time, s.
SETTLE_S = 0.1
# Every process that plays robots offers a service of this type.
PLAYBACK = "mrlab_msgs/srv/CommandMembers"
# A lab with physics offers its services within this, s.
PHYSICS_TIMEOUT_S = 1.0


class Scenes:
    """Saves what the lab's nodes hold as a document, and brings them to what one says.

    caller: a node that another thread spins than the one that waits here. document: returns the
    robots and systems as they are.
    """

    def __init__(
        self,
        caller: Node,
        files: SceneFiles,
        library: RobotLibrary,
        observer: Observer,
        restore: LabRestore,
        document: Callable[[], SceneDocument],
    ) -> None:
        self._files = files
        self._library = library
        self._observer = observer
        self._restore = restore
        self._document = document
        self._caller = caller
        self._list = caller.create_client(
            srv.ListTrajectories, "/converter/list_any", qos_profile=qos.SERVICES
        )
        self._create_system = caller.create_client(
            srv.CreateSystem, "/coordinator/create_system", qos_profile=qos.SERVICES
        )
        self._get_objects = caller.create_client(
            srv.GetObjects, "/physics/get_objects", qos_profile=qos.SERVICES
        )

    def names(self) -> tuple[str, ...]:
        """Return the names of all scenes, sorted."""
        return self._files.names()

    def save(self, name: str) -> Diagnostic:
        """Save the scene; return what was saved. Raises LabError where it cannot be."""
        time.sleep(SETTLE_S)
        physics = self._physics_runs()
        scene = self.whole(physics=physics)
        path = self._files.save(name, core.self_contained(scene))
        missing = None if physics else NO_PHYSICS_TO_SAVE()
        return SCENE_SAVED(**_counts(scene), file=str(path), missing=missing)

    def load(
        self, name: str, robots: Iterable[str], note: Callable[[Diagnostic, SceneDocument], None]
    ) -> Diagnostic:
        """Load a scene in place of `robots` and all else; return what was loaded.

        note: is called with what to say and with what there was, once something was changed.
        Raises LabError: either nothing was changed, or LOADED_IN_PART says what was.
        """
        scene = self._files.load(name)
        present = self.present(robots)
        self._check(scene, present)
        before = self.whole(physics=present.physics)
        try:
            core.run(core.plan_scene(scene, present), self._restore.execute)
        except LabError as error:
            note(error.diagnostic, before)
            raise
        missing = core.left_out(scene, present)
        if missing is not None:
            scene = replace(scene, objects=(), surfaces=())
        counts = _counts(scene)
        counts |= {part: counts[part] or None for part in ("objects", "surfaces", "systems")}
        said = SCENE_LOADED(**counts, scene=name, missing=missing)
        note(said, before)
        return said

    def whole(self, *, physics: bool) -> SceneDocument:
        """Return the scene as it is, with what physics holds where that runs."""
        scene = self._document()
        if not physics:
            return scene
        content = call(self._get_objects, srv.GetObjects.Request(), LOAD_TIMEOUT_S)
        return replace(
            scene,
            objects=placements_from_messages(content.objects),
            surfaces=tuple(map(surface_from_message, content.surfaces)),
        )

    def present(self, robots: Iterable[str]) -> Present:
        """Return what the lab holds beside `robots`."""
        systems = self._observer.systems or ()
        return Present(
            robots=frozenset(robots),
            systems=frozenset(
                system.name for system in systems if self._observer.published(["/systems"])
            ),
            physics=self._physics_runs(),
            objects={thing.name: thing.held_by for thing in self._observer.objects},
        )

    def _physics_runs(self) -> bool:
        return bool(self._get_objects.wait_for_service(timeout_sec=PHYSICS_TIMEOUT_S))

    def _check(self, scene: SceneDocument, present: Present) -> None:
        """Raise LabError where the scene cannot be; nothing is changed yet."""
        for robot in scene.robots:
            self._library.model(robot.model)
            self._library.description(robot.model, robot.end_effector or None)
        core.check_trajectories(scene, self._fitting)
        if present.physics:
            self._restore.set_objects(scene.objects, scene.surfaces, dry_run=True)
        plays = scene.systems or any(robot.trajectory for robot in scene.robots)
        if plays and not self._observer.wait_for(self._playback_runs, ARRIVAL_TIMEOUT_S):
            raise NoAnswer(NO_PLAYBACK_RUNS())
        if scene.systems and not self._create_system.wait_for_service(ARRIVAL_TIMEOUT_S):
            raise NoAnswer(NO_COORDINATOR_RUNS())

    def _playback_runs(self) -> bool:
        services = self._caller.get_service_names_and_types()
        return any(PLAYBACK in kinds for _, kinds in services)

    def _fitting(self, robot: RobotEntry) -> Sequence[Loaded]:
        request = srv.ListTrajectories.Request(
            robot_model=robot.model, end_effector=robot.end_effector
        )
        answer = call(self._list, request)
        if not answer.success:
            raise Unavailable(heard(answer))
        return loaded_from_messages(answer.trajectories)


def _counts(scene: SceneDocument) -> dict[str, Any]:
    return {
        "robots": len(scene.robots),
        "objects": len(scene.objects),
        "surfaces": len(scene.surfaces),
        "systems": len(scene.systems),
    }
