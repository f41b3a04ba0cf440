"""An arm as Bullet knows it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field

from mrlab_ros.adapters.bullet.description import Coupling
from mrlab_ros.core.base.geometry import Vector
from mrlab_ros.core.physics.engine import Arm, LinkPairs


@dataclass(frozen=True)
class Way:
    """How a joint carries a finger along while the gripper closes. index: of its link; axis: unit,
    in the link's frame; rate: its share of the leader's speed, signed."""

    index: int
    axis: Vector
    slides: bool
    rate: float


@dataclass(eq=False)
class LoadedArm:
    """An arm as Bullet knows it: its numbers of body, joints and links.

    index: the number of each link. links: the link that each number counts as: what is fixed to
    a finger is that finger. made_of: its URDF, its joints, its links that never touch. ways: by
    the number of a finger's link, how it closes. present: it was moved to where it stands; before
    that nothing touches it.
    """

    body: int
    facts: Arm
    joints: list[int]
    fingers: list[int]
    index: dict[str, int]
    links: dict[int, str]
    moving: list[int]
    positions: Sequence[float]
    couplings: tuple[Coupling, ...]
    ignored: set[tuple[int, int]]
    made_of: tuple[str, tuple[str, ...], LinkPairs]
    followers: frozenset[int] = frozenset()
    ways: dict[int, tuple[Way, ...]] = field(default_factory=dict)
    present: bool = False
