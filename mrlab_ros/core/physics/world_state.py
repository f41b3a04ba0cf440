"""State that all parts of the world share, and the events of the world.

The state is the engine, the robots, objects and surfaces, and the time.
"""

from __future__ import annotations

from dataclasses import dataclass, field

from mrlab_ros.core.base.diagnostic import Diagnostic
from mrlab_ros.core.base.diagnostics import NO_ROBOT_IN_SCENE
from mrlab_ros.core.base.errors import Misuse
from mrlab_ros.core.base.names import close_to
from mrlab_ros.core.physics.catalogue import ObjectType
from mrlab_ros.core.physics.diagnostics import NO_OBJECT_IN_SCENE
from mrlab_ros.core.physics.engine import BodyState, Engine, Touch
from mrlab_ros.core.physics.grasp.load import Load
from mrlab_ros.core.physics.grasp.states import Grasp
from mrlab_ros.core.physics.settings import Settings
from mrlab_ros.core.physics.simulated_robot import Robot
from mrlab_ros.core.scene.carrier import Carrier
from mrlab_ros.core.scene.surfaces import Surface

HAND = "hand"


@dataclass(eq=False)
class SceneObject:
    """An object of the scene; held_by: a robot's name, or "hand", or empty.

    kept_for: the robot that alone may take it from the hand; empty: any. carrier: whose moves on a
    topic it follows while it is in the hand.
    """

    name: str
    type: ObjectType
    held_by: str = ""
    hand: BodyState | None = None
    kept_for: str = ""
    carrier: Carrier | None = None

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


@dataclass(frozen=True)
class Contact:
    """A touch with its stamp and the source frame of the robot's trajectory."""

    stamp_ns: int
    robot: str
    frame: int
    touch: Touch


@dataclass(frozen=True)
class CollisionChanged:
    """contact: the first of the collision, None when it ended. clearance: m."""

    stamp_ns: int
    robot: str
    colliding: bool
    contact: Contact | None
    clearance: float


@dataclass(frozen=True)
class GraspChanged:
    """State of a gripper. positions, forces: of the fingers, in the arm's order.

    reason: what is to be said of it, None: nothing. load: what the grasp bears, None unless it is
    known.
    """

    stamp_ns: int
    robot: str
    state: Grasp
    object: str
    positions: tuple[float, ...]
    forces: tuple[float, ...]
    reason: Diagnostic | None = None
    load: Load | None = None


@dataclass(frozen=True)
class LoadChanged:
    """The grasp of a robot as before, but it bears something else, or something is to be said."""

    grasp: GraspChanged


@dataclass(frozen=True)
class ObjectRemoved:
    """An object that the world itself removed, and why."""

    stamp_ns: int
    name: str
    type: str
    why: Diagnostic


Event = CollisionChanged | GraspChanged | LoadChanged | ObjectRemoved
