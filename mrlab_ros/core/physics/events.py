"""Events of the world."""

from __future__ import annotations

from dataclasses import dataclass

from mrlab_ros.core.base.diagnostic import Diagnostic
from mrlab_ros.core.physics.engine import Touch
from mrlab_ros.core.physics.grasp import Grasp
from mrlab_ros.core.physics.grasp_load import Load


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
