"""The port to a physics engine.

Everything has a name: arms, objects and surfaces each have names of their own. SI units; poses
are in the frame world.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from enum import Enum
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from mrlab_ros.core.base.geometry import Array, Pose, Vector

IDENTITY = Pose()
LinkPairs = frozenset[frozenset[str]]


class Kind(Enum):
    """Kinds of obstacles of an arm; the values are those of mrlab_msgs/Contact."""

    OBJECT = 0
    SURFACE = 1
    ROBOT = 2
    SELF = 3


class Shape(Enum):
    """How a part is shaped. size: box edge lengths; cylinder radius, length along z; sphere
    radius; hull and mesh: none, they have vertices. A mesh may be hollow and is always fixed."""

    BOX = "box"
    CYLINDER = "cylinder"
    SPHERE = "sphere"
    HULL = "hull"
    MESH = "mesh"


@dataclass(frozen=True, eq=False)
class Part:
    """One shape of a body. vertices: (V, 3) m; triangles: (T, 3) vertex indices. density: beside
    the other parts' of the body, whose mass they share."""

    shape: Shape
    size: tuple[float, ...] = ()
    pose: Pose = IDENTITY
    vertices: Array | None = None
    triangles: NDArray[np.int32] | None = None
    density: float = 1.0


@dataclass(frozen=True, eq=False)
class Body:
    """An object or a surface for the engine. mass: kg, 0 is fixed. centre: of mass, m, and
    inertia: about it, (3, 3) kg*m^2, both in the frame of its parts; None: the engine's own."""

    parts: tuple[Part, ...]
    mass: float
    friction: float = 0.6
    restitution: float = 0.1
    centre: Vector = (0.0, 0.0, 0.0)
    inertia: Array | None = None


@dataclass(frozen=True)
class BodyState:
    """A rigid body's pose and its velocities in world, m/s and rad/s, at the pose's origin."""

    pose: Pose
    linear: Vector = (0.0, 0.0, 0.0)
    angular: Vector = (0.0, 0.0, 0.0)


@dataclass(frozen=True)
class Finger:
    """A force-driven joint. m or rad; max_force: N or N*m.

    closes: 1 where its upper limit is closed, -1 where its lower limit is.
    """

    joint: str
    link: str
    lower: float
    upper: float
    max_velocity: float
    max_force: float
    closes: float = 1.0

    @property
    def opened(self) -> float:
        """Its position where the gripper is open."""
        return self.lower if self.closes > 0 else self.upper

    def closed_by(self, position: float) -> float:
        """Return how far it has closed from its open end, m or rad."""
        return self.closes * (position - self.opened)


@dataclass(frozen=True, eq=False)
class Arm:
    """A robot's description as the engine reads it.

    fingers: its joints that the trajectory does not prescribe. hand: the link an object is fixed
    to. tool: tool0, or what stands for it. tool_links: all links beyond it. grip_links: the
    fingers and what is rigid with the hand. fixed_links: links that no joint moves. levers: m, of
    each prescribed joint the longest way from it to the arm's end. grip_force: N, of all fingers
    together. tool_mass: kg beyond the tool's frame. moving_mass: kg of all that its joints move,
    0 where the description does not state it.
    """

    fingers: tuple[Finger, ...]
    hand: str
    tool_links: frozenset[str]
    fixed_links: frozenset[str]
    levers: tuple[float, ...]
    tool: str
    grip_links: frozenset[str]
    grip_force: float = 0.0
    tool_mass: float = 0.0
    moving_mass: float = 0.0

    @property
    def face_links(self) -> frozenset[str]:
        """The links of a face that pulls: of the tool, or what is rigid with an arm's end."""
        return self.tool_links or self.grip_links


@dataclass(frozen=True)
class FingerState:
    """position: m or rad; force: N or N*m that the drive had to apply in the last step."""

    position: float
    force: float


@dataclass(frozen=True)
class Touch:
    """One contact point of an arm. normal: unit, from the other towards the arm; depth: m,
    positive where they overlap; impulse: N*s of the step.

    held: the object in its hand that touches; empty: the arm itself. grip: the cosine between the
    contact and the way in which the finger that touches closes, or in which a tool without fingers
    points; 1: it presses straight on the other. A touch of what is held with another robot's
    finger has that finger's. approach: m/s, how fast what is held moves into the other here.
    """

    link: str
    kind: Kind
    other: str
    other_link: str
    point: Vector
    normal: Vector
    depth: float
    impulse: float
    held: str = ""
    grip: float = 0.0
    approach: float = 0.0


@dataclass(frozen=True)
class Near:
    """The nearest places of an arm and an obstacle. distance: m, negative where they overlap.

    held: the object in its hand that is nearest; empty: the arm's link itself. other_link: of
    another robot, or of the arm itself.
    """

    distance: float
    link: str
    held: str = ""
    other_link: str = ""


@dataclass(frozen=True)
class Hit:
    """The place where a ray meets an object. share: of the ray's length; normal: unit, outward."""

    share: float
    normal: Vector


class Engine(Protocol):
    """A rigid body engine. Names are those the world gave; poses and numbers are checked."""

    def add_arm(
        self, name: str, urdf: str, joints: tuple[str, ...], pose: Pose, apart: LinkPairs
    ) -> Arm:
        """Load an arm whose `joints` are prescribed; raise BadInput where the URDF has none.

        apart: pairs of its links that never touch, though their collision shapes may.
        """
        ...

    def place_arm(self, name: str, pose: Pose) -> None: ...

    def remove_arm(self, name: str) -> None: ...

    def move_arm(
        self,
        name: str,
        positions: Sequence[float],
        velocities: Sequence[float],
        *,
        jumped: bool = False,
    ) -> None:
        """Put the arm's joints at `positions`, rad, moving with `velocities`, rad/s.

        jumped: it was placed there, not moved.
        """
        ...

    def speed(self, name: str) -> float:
        """Return how fast the fastest point of the arm and of what it holds moves with the present
        velocities, m/s."""
        ...

    def drive_fingers(self, name: str, velocities: Sequence[float]) -> None:
        """Drive the fingers at `velocities` with their limited force."""
        ...

    def set_fingers(self, name: str, positions: Sequence[float]) -> None:
        """Place the fingers at `positions`, at rest."""
        ...

    def settle(self, name: str, thing: str) -> None:
        """Take an arm's fingers out of an object that they press on from all sides: they open, and
        it moves to their middle unless another arm holds it."""
        ...

    def fingers(self, name: str) -> tuple[FingerState, ...]: ...

    def link(self, arm: str, link: str) -> BodyState:
        """Return pose and velocity of a link's centre of mass."""
        ...

    def touches(self, name: str) -> list[Touch]:
        """Return the contact points of the last step of the arm and of what it holds."""
        ...

    def distance(self, arm: str, kind: Kind, other: str, limit: float) -> float:
        """Return the distance from the arm's moving links and what it holds to something, m, at
        most `limit`."""
        ...

    def nearest(
        self,
        arm: str,
        kind: Kind,
        other: str,
        limit: float,
        without: frozenset[str] = frozenset(),
    ) -> Near | None:
        """Return where the arm's moving links and what it holds are nearest to something; None
        where that is further than `limit`, m. without: links, and what is held, that do not
        count."""
        ...

    def add_object(self, name: str, body: Body, motion: BodyState) -> None: ...

    def remove_object(self, name: str) -> None: ...

    def object(self, name: str) -> BodyState:
        """Return an object's motion; of a held one that at the instant its hand was posed for."""
        ...

    def objects(self) -> dict[str, BodyState]:
        """Return object() of every object that has a mass, by name, in the order of adding."""
        ...

    def set_object(self, name: str, motion: BodyState) -> None: ...

    def add_surface(self, name: str, body: Body, pose: Pose) -> None: ...

    def remove_surface(self, name: str) -> None: ...

    def hold(self, arm: str, link: str, name: str, mass: float) -> None:
        """Fix an object to an arm's link where it is now.

        mass: kg that others feel when they meet it. Contacts with the fingers and what is rigid
        with the hand are off.
        """
        ...

    def slide(self, name: str, way: Vector) -> None:
        """Shift a held object in its hand by `way`, m, in the frame of the hand."""
        ...

    def release(self, name: str) -> None:
        """Undo hold()."""
        ...

    def squeezed(self, arm: str, name: str, normal: Vector) -> Vector:
        """Return the way, m, out of what an arm presses an object into; zeros: into nothing.

        normal: unit, of the contact, from the object towards the arm.
        """
        ...

    def let_pass(self, arm: str, name: str, passes: bool) -> None:
        """Let an arm and what it holds pass into an object without moving it, or not any more.

        Its touches are found all the same.
        """
        ...

    def below(self, point: Vector) -> float | None:
        """Return the height of the first fixed thing below `point`, m; None without one."""
        ...

    def rays(
        self, name: str, starts: Sequence[Vector], ends: Sequence[Vector]
    ) -> list[Hit | None]:
        """Return where rays meet an object first; None for those that pass it."""
        ...

    def overlapping(self, low: Vector, high: Vector) -> set[str]:
        """Return the names of arms and objects whose bounding boxes reach into this box."""
        ...

    def step(self, duration: float) -> None:
        """Compute the contacts of the present poses, then advance by `duration`, s."""
        ...

    def close(self) -> None: ...
