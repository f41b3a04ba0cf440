"""Places of the objects of a session, and places where trajectories release them.

Times are s from the bag's first message; poses are in the frame world unless they say otherwise.
"""

from __future__ import annotations

from bisect import bisect_right
from dataclasses import dataclass, field

from mrlab_ros.core.base.geometry import Pose

# s: a hand-over shows in the objects at most so long after it shows in the grasp.
LATE = 0.3


@dataclass(frozen=True)
class Placed:
    """The pose of an object from a time on. in_tool: its pose in tool0 of the holding robot."""

    pose: Pose
    held_by: str
    in_tool: Pose | None


@dataclass
class ObjectTrack:
    """The places of one object; equal ones that follow each other count once."""

    times: list[float] = field(default_factory=list)
    places: list[Placed] = field(default_factory=list)

    def add(self, time: float, place: Placed) -> None:
        if not self.places or self.places[-1] != place:
            self.times.append(time)
            self.places.append(place)

    def at(self, time: float) -> Pose | None:
        """Return the pose at a time, None where the object was not there yet."""
        number = bisect_right(self.times, time) - 1
        return self.places[number].pose if number >= 0 else None

    def at_rest(self, time: float, settled: float) -> Pose | None:
        """Return where it lies after its release: `settled` s later, or before it is held anew."""
        number = bisect_right(self.times, time) - 1
        if number < 0:
            return None
        free = not self.places[number].held_by
        found = self.places[number].pose
        for at, place in zip(self.times[number + 1 :], self.places[number + 1 :], strict=True):
            if at > time + settled or (free and place.held_by):
                break
            free = free or not place.held_by
            found = place.pose
        return found

    def in_tool(self, since: float) -> Pose | None:
        """Return its first pose in the tool that holds it from `since` on."""
        for at, place in zip(self.times, self.places, strict=True):
            if at >= since - LATE and place.held_by and place.in_tool is not None:
                return place.in_tool
        return None

    def taken_by(self, time: float, robot: str) -> str:
        """Return who else holds it when `robot` releases it; empty: nobody."""
        number = max(bisect_right(self.times, time + LATE) - 1, 0)
        holder = self.places[number].held_by if self.places else ""
        return holder if holder != robot else ""


@dataclass(frozen=True)
class Target:
    """A frame at which a trajectory opens or closes the gripper: s of the trajectory.

    tool0: pose in the robot's base_link.
    """

    time: float
    close: bool
    tool0: Pose


@dataclass
class Targets:
    """Gripper states of the trajectories that a robot loaded."""

    times: list[float] = field(default_factory=list)
    sets: list[tuple[Target, ...]] = field(default_factory=list)

    def add(self, time: float, targets: tuple[Target, ...]) -> None:
        self.times.append(time)
        self.sets.append(targets)

    def release(self, time: float, position: float, near: float) -> Pose | None:
        """Return tool0 at the programmed release nearest to `position` s of the trajectory.

        time: when, in the session. None where no release is so near.
        """
        number = bisect_right(self.times, time) - 1
        opening = [t for t in self.sets[number] if not t.close] if number >= 0 else []
        nearest = min(opening, key=lambda each: abs(each.time - position), default=None)
        if nearest is None or abs(nearest.time - position) > near:
            return None
        return nearest.tool0
