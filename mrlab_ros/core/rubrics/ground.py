"""What a rubric's sentences are about: the robots, objects and surfaces that a file will meet."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from functools import cached_property

from mrlab_ros.core.base.diagnostic import Diagnostic
from mrlab_ros.core.base.diagnostics import NO_ROBOT_IN_SCENE
from mrlab_ros.core.base.names import close_to
from mrlab_ros.core.checking.motion import CheckedRobot
from mrlab_ros.core.physics.catalogue import ObjectType
from mrlab_ros.core.rubrics.diagnostics import (
    OBJECT_IS_FIXED,
    OBJECT_NOT_IN_SCENE,
    THING_NOT_IN_SCENE,
)
from mrlab_ros.core.scene.document import SceneDocument
from mrlab_ros.core.scene.surfaces import FLOOR

ITSELF = "itself"


@dataclass(frozen=True, eq=False)
class Ground:
    """Everything that a rubric may name. robots: all of the scene, or the one of the rubric.

    types: of the objects, by their names. cell: whether a cell is marked; None: not known.
    reference: whether the rubric names a reference solution.
    """

    scene: SceneDocument
    robots: tuple[CheckedRobot, ...]
    types: Mapping[str, ObjectType] = field(default_factory=dict)
    cell: bool | None = None
    reference: bool = False

    @cached_property
    def surfaces(self) -> tuple[str, ...]:
        """Return the surfaces; a scene without any has a floor."""
        return tuple(s.name for s in self.scene.surfaces) or (FLOOR,)

    def of(self, robot: str) -> tuple[CheckedRobot, ...]:
        """Return the robots of a name or of a model; empty: all."""
        return tuple(r for r in self.robots if robot in ("", r.name, r.model.id))

    def robot_flaws(self, *robots: str) -> Iterator[Diagnostic]:
        """Yield what is wrong with names of robots; empty ones are left out."""
        names = [r.name for r in self.robots]
        for robot in robots:
            if robot and not self.of(robot):
                yield NO_ROBOT_IN_SCENE(robot=robot, known=names, close=close_to(robot, names))

    def object_flaws(self, thing: str) -> Iterator[Diagnostic]:
        """Yield what is wrong with the name of an object."""
        names = [o.name for o in self.scene.objects]
        if thing and thing not in names:
            yield OBJECT_NOT_IN_SCENE(object=thing, known=names, close=close_to(thing, names))

    def thing_flaws(self, thing: str) -> Iterator[Diagnostic]:
        """Yield what is wrong with the name of an object, a surface or a robot."""
        names = [o.name for o in self.scene.objects]
        names += [*self.surfaces, *(r.name for r in self.robots), ITSELF]
        if thing and thing not in names:
            yield THING_NOT_IN_SCENE(thing=thing, known=names, close=close_to(thing, names))

    def graspable_flaws(self, thing: str) -> Iterator[Diagnostic]:
        """Yield what is wrong with an object that shall be held."""
        yield from self.object_flaws(thing)
        kind = self.types.get(thing)
        if kind is not None and kind.mass <= 0:
            yield OBJECT_IS_FIXED(object=thing)
