"""Snapshots of the objects along a run, so that its timeline can be scrubbed."""

from __future__ import annotations

import bisect
from collections.abc import Mapping
from dataclasses import dataclass, replace

from mrlab_ros.core.base.geometry import Pose
from mrlab_ros.core.physics.engine import BodyState
from mrlab_ros.core.physics.grasp.load import Grip
from mrlab_ros.core.physics.grasp.states import Grasp


@dataclass(frozen=True)
class HeldSnapshot:
    """How a robot held an object. in_hand: T_hand_object. grip: None where it was attached by
    service. fingers: their positions. for_ns: how long it had held it."""

    in_hand: Pose
    grip: Grip | None
    fingers: tuple[float, ...]
    for_ns: int


@dataclass(frozen=True)
class ObjectSnapshot:
    """An object at one instant. held_by: the robot that held it, empty: none; held: how."""

    motion: BodyState
    held_by: str = ""
    held: HeldSnapshot | None = None


@dataclass(frozen=True)
class GripperSnapshot:
    """A gripper at one instant. closed: by command, for_ns ago. takes_over: whether it was about
    to take what another robot held. lost: the object that was taken from it."""

    closed: bool = False
    for_ns: int = 0
    grasp: Grasp = Grasp.OPEN
    takes_over: bool = False
    lost: str = ""


@dataclass(frozen=True)
class Snapshot:
    """All objects, and the gripper of one robot, when that robot's run passed `position`, s."""

    position: float
    objects: Mapping[str, ObjectSnapshot]
    gripper: GripperSnapshot = GripperSnapshot()

    def held_by(self, robot: str) -> frozenset[str]:
        """Return the names of the objects that `robot` held."""
        return frozenset(name for name, kept in self.objects.items() if kept.held_by == robot)


class Snapshots:
    """The snapshots of one run, by position on the timeline (s), bounded in number.

    When they are full, every second one is removed and the spacing doubles: a long run is covered
    whole, more coarsely.
    """

    def __init__(self, rate: float, count: int) -> None:
        self._first_spacing = 1.0 / rate
        self._count = max(count, 4)
        self.clear()

    def clear(self) -> None:
        self._spacing = self._first_spacing
        self._taken: list[Snapshot] = []

    def __len__(self) -> int:
        return len(self._taken)

    def wants(self, position: float) -> bool:
        """Return whether a snapshot at `position` would be kept."""
        i = bisect.bisect_right(self._taken, position, key=lambda s: s.position)
        return i == 0 or position - self._taken[i - 1].position >= self._spacing * (1 - 1e-6)

    def add(self, snapshot: Snapshot) -> None:
        """Add a snapshot; remove those of an earlier run at later positions."""
        i = bisect.bisect_left(self._taken, snapshot.position, key=lambda s: s.position)
        self._taken[i:] = [snapshot]
        if len(self._taken) > self._count:
            del self._taken[1::2]
            self._spacing *= 2

    def forget(self, robot: str) -> None:
        """Forget what `robot` held: it is not the same robot any more."""
        for i, snapshot in enumerate(self._taken):
            held = snapshot.held_by(robot)
            if held:
                left = {n: kept for n, kept in snapshot.objects.items() if n not in held}
                self._taken[i] = replace(snapshot, objects=left)

    def cut(self, position: float) -> None:
        """Remove everything after `position`: the run continues from there, differently."""
        i = bisect.bisect_right(self._taken, position, key=lambda s: s.position)
        del self._taken[i:]

    def at(self, position: float) -> Snapshot | None:
        """Return the last snapshot not after `position`; None where the run has not passed it."""
        i = bisect.bisect_right(self._taken, position + 1e-6, key=lambda s: s.position)
        passed = self._taken and position <= self._taken[-1].position + self._spacing
        return self._taken[i - 1] if i and passed else None

    def around(self, position: float) -> tuple[Snapshot, Snapshot, float] | None:
        """Return the snapshots before and after `position`, and its share of the way, 0 to 1.

        None where the run has not passed it.
        """
        before = self.at(position)
        if before is None:
            return None
        i = bisect.bisect_right(self._taken, position + 1e-6, key=lambda s: s.position)
        if i == len(self._taken):
            return before, before, 0.0
        after = self._taken[i]
        share = (position - before.position) / (after.position - before.position)
        return before, after, min(max(share, 0.0), 1.0)
