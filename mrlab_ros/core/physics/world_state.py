"""State that all parts of the world share: engine, robots, objects, surfaces and time."""

from __future__ import annotations

from dataclasses import dataclass, field

from mrlab_ros.core.base.diagnostics import NO_ROBOT_IN_SCENE
from mrlab_ros.core.base.errors import Misuse
from mrlab_ros.core.base.names import close_to
from mrlab_ros.core.physics.catalogue import ObjectType
from mrlab_ros.core.physics.diagnostics import NO_OBJECT_IN_SCENE
from mrlab_ros.core.physics.engine import BodyState, Engine
from mrlab_ros.core.physics.events import Event
from mrlab_ros.core.physics.settings import Settings
from mrlab_ros.core.physics.simulated_robot import Robot
from mrlab_ros.core.physics.surfaces import Surface

HAND = "hand"


@dataclass(eq=False)
class SceneObject:
    """An object of the scene; held_by: a robot's name, or "hand", or empty.

    kept_for: the robot that alone may take it from the hand; empty: any.
    """

    name: str
    type: ObjectType
    held_by: str = ""
    hand: BodyState | None = None
    kept_for: str = ""

    @property
    def graspable(self) -> bool:
        return self.type.mass > 0


@dataclass(eq=False)
class WorldState:
    """now_ns: the time of the last step."""

    engine: Engine
    settings: Settings
    robots: dict[str, Robot] = field(default_factory=dict)
    objects: dict[str, SceneObject] = field(default_factory=dict)
    surfaces: dict[str, Surface] = field(default_factory=dict)
    events: list[Event] = field(default_factory=list)
    now_ns: int = 0

    def robot(self, name: str) -> Robot:
        """Return a robot; raise Misuse where there is none."""
        try:
            return self.robots[name]
        except KeyError:
            close = close_to(name, self.robots)
            raise Misuse(
                NO_ROBOT_IN_SCENE(robot=name, known=[*self.robots], close=close)
            ) from None

    def object(self, name: str) -> SceneObject:
        """Return an object; raise Misuse where there is none."""
        try:
            return self.objects[name]
        except KeyError:
            close = close_to(name, self.objects)
            raise Misuse(
                NO_OBJECT_IN_SCENE(object=name, known=[*self.objects], close=close)
            ) from None

    def hand(self, robot: Robot) -> BodyState:
        """Return pose and velocity of the link that a robot's objects are fixed to."""
        return self.engine.link(robot.name, robot.arm.hand)
