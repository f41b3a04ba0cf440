"""A world for a rehearsal: robots of the library and the objects of a scene, without a graph."""

from __future__ import annotations

import hashlib
import importlib.metadata
import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from types import MappingProxyType
from typing import Any

from mrlab_ros.adapters.bullet import support
from mrlab_ros.adapters.robots.library import RobotLibrary
from mrlab_ros.adapters.scenes.object_meshes import ObjectMeshes
from mrlab_ros.adapters.yaml_files import read_yaml
from mrlab_ros.core.base.errors import BadInput
from mrlab_ros.core.base.geometry import Pose, compose
from mrlab_ros.core.checking.joint_limits import StatedLimits
from mrlab_ros.core.checking.motion import CheckedRobot
from mrlab_ros.core.checking.rehearsal import DISTANCE_PERIOD, FARTHEST, Actor, Rehearsal
from mrlab_ros.core.checking.rehearsal_record import Rehearsed
from mrlab_ros.core.checking.report import digest
from mrlab_ros.core.physics import catalogue
from mrlab_ros.core.physics.catalogue import Catalogue, ObjectType
from mrlab_ros.core.physics.engine import Engine
from mrlab_ros.core.physics.settings import Settings
from mrlab_ros.core.physics.world import World
from mrlab_ros.core.scene import document as scene_document
from mrlab_ros.core.scene.document import SceneDocument

NOTHING_HELD: Mapping[str, Pose] = MappingProxyType({})


@dataclass(frozen=True)
class Played:
    """The record of a rehearsal, and the types of the objects in it, by name."""

    recorded: Rehearsed
    objects: dict[str, ObjectType]
    fingers: dict[str, tuple[str, ...]]

    @property
    def graspable(self) -> tuple[str, ...]:
        return tuple(name for name, kind in self.objects.items() if kind.mass > 0)


class Stage:
    """The library, the catalogue and the settings that every rehearsal of a command shares.

    share: the package's folder.
    """

    def __init__(self, share: Path, library: RobotLibrary) -> None:
        self.library = library
        self._physics = read_yaml(share / "config" / "physics.yaml")
        self._settings = Settings.from_mapping(self._physics)
        self._plain_types = read_yaml(share / "config" / "objects.yaml")
        meshes = ObjectMeshes(share, self._settings.max_triangles)
        self._types: Catalogue = catalogue.parse(self._plain_types, meshes)

    def robot(self, name: str, model: str, end_effector: str, pose: Pose) -> CheckedRobot:
        """Return a robot to check; raise BadInput for an unknown model or end effector."""
        found = self.library.model(model)
        self.library.description(model, end_effector or None)
        return CheckedRobot(name, found, end_effector, pose, self._stated(model))

    def _stated(self, model: str) -> dict[str, StatedLimits]:
        """Return what robot.yaml states of the joints: acceleration, rad/s^2, jerk, rad/s^3."""
        stated = {}
        for joint in self.library.facts(model).get("joints", ()):
            limits = [joint.get(key) for key in ("acceleration", "jerk")]
            numbers = [None if value is None else float(value) for value in limits]
            stated[str(joint.get("name"))] = StatedLimits(*numbers)
        return stated

    def types(self, scene: SceneDocument) -> dict[str, ObjectType]:
        """Return the types of a scene's objects, by name; raise BadInput for an unknown one."""
        return {thing.name: self._types.get(thing.type) for thing in scene.objects}

    def inputs(self, robots: Sequence[CheckedRobot], scene: SceneDocument) -> dict[str, Any]:
        """Return what a rehearsal depends on beside the motions, as digests."""
        return {
            "robots": {
                robot.name: {
                    "model": robot.model.id,
                    "end_effector": robot.end_effector,
                    "position": robot.pose.position,
                    "orientation": robot.pose.orientation,
                    "urdf": _sha256(
                        self.library.description(robot.model.id, robot.end_effector or None)
                    ),
                }
                for robot in robots
            },
            "scene": digest(scene_document.plain(scene)),
            "objects": digest(self._plain_types),
            "physics": digest(self._physics),
            "engine": f"pybullet {_version()}",
            "distance_period": DISTANCE_PERIOD,
            "distance_farthest": FARTHEST,
        }

    def rehearse(
        self,
        robots: Sequence[CheckedRobot],
        actors: Sequence[Actor],
        scene: SceneDocument,
        *,
        drawn: bool = True,
        in_tool: Mapping[str, Pose] = NOTHING_HELD,
        progress: Callable[[float], None] | None = None,
    ) -> Played:
        """Play the actors, one for each robot, among the scene's objects and surfaces.

        progress: see Rehearsal.
        in_tool: T_tool0_object of held objects whose `in_hand` the scene does not say, by name.
        Raises BadInput where pybullet is missing or the scene names what there is not.
        """
        missing = support.missing()
        if missing:
            raise BadInput(missing)
        from mrlab_ros.adapters.bullet.engine import BulletEngine

        engine = BulletEngine(self.library.mesh_path)
        try:
            world = World(engine, self._types, self._settings)
            world.set_surfaces(scene.surfaces)
            for robot in robots:
                self._add(world, robot)
            for thing in scene.objects:
                world.spawn(thing.type, thing.name, thing.pose, automatic=thing.automatic)
            rehearsal = Rehearsal(world, engine, actors, drawn, progress)
            rehearsal.place()
            for thing in scene.objects:
                held = None
                if thing.held_by and thing.in_hand is not None:
                    held = compose(world.hand(thing.held_by).pose, thing.in_hand)
                elif thing.held_by and thing.name in in_tool:
                    tool = engine.link(thing.held_by, world.robot(thing.held_by).tool_link).pose
                    held = compose(tool, in_tool[thing.name])
                if held is not None:
                    world.move(thing.name, held, (0.0, 0.0, 0.0), (0.0, 0.0, 0.0), held=True)
                    world.attach(thing.held_by, thing.name, math.inf)
            types = {thing.name: thing.type for thing in world.objects}
            fingers = {r.name: tuple(world.fingers(r.name)) for r in robots}
            return Played(rehearsal.run(), types, fingers)
        finally:
            engine.close()

    @contextmanager
    def arms(self, robots: Sequence[CheckedRobot]) -> Iterator[Engine]:
        """Yield an engine with nothing but these arms in it, to compare their poses."""
        from mrlab_ros.adapters.bullet.engine import BulletEngine

        engine = BulletEngine(self.library.mesh_path)
        try:
            for robot in robots:
                model = robot.model.id
                engine.add_arm(
                    robot.name,
                    self.library.description(model, robot.end_effector or None),
                    robot.model.joint_names,
                    robot.pose,
                    self.library.never_touch(model),
                )
            yield engine
        finally:
            engine.close()

    def _add(self, world: World, robot: CheckedRobot) -> None:
        model, tool = robot.model.id, robot.end_effector
        world.add_robot(
            robot.name,
            self.library.description(model, tool or None),
            robot.model.joint_names,
            robot.pose,
            self.library.gripper(model, tool),
            self.library.never_touch(model),
            self.library.hand_facts(model, tool),
        )


def first_link(robot: CheckedRobot) -> str:
    """Return the first link of a robot that moves."""
    return next(s.link for s in robot.model.chain.segments if s.axis is not None)


def _sha256(text: str) -> str:
    return hashlib.sha256(text.encode()).hexdigest()


def _version() -> str:
    try:
        return importlib.metadata.version("pybullet")
    except importlib.metadata.PackageNotFoundError:
        return "missing"
