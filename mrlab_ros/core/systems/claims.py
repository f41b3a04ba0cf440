"""Which robots obey a system, each with the trajectory that the system gives it.

A claim is a lease: a robot belongs to a system as long as somebody keeps the system.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence

from mrlab_ros.core.base.errors import LabError, Misuse
from mrlab_ros.core.playback.states import State
from mrlab_ros.core.systems.diagnostics import NO_TRAJECTORY_LOADED, NOT_TAKEN_BACK
from mrlab_ros.core.systems.members import Command, Fleet, Loaded, Order
from mrlab_ros.core.systems.timeline import Member, Timeline

# The coordinator names its systems once a second; one that it has not named for this long is
# kept by nobody, s.
LEASE_S = 4.0


class Claims:
    """Claims the members of a timeline and loads their trajectories, all of them at once."""

    def __init__(self, fleet: Fleet, timeline: Timeline) -> None:
        self._fleet = fleet
        self._timeline = timeline

    def prepare(self) -> None:
        """Claim and load every member, and check the waits.

        Raises LabError where that cannot be; every robot is then as it was before.
        """
        members = list(self._timeline)
        robots = [member.robot for member in members]
        before: dict[str, Loaded] = {}
        loads: dict[str, str] = {}
        try:
            before = dict(zip(robots, self._fleet.claim(robots), strict=True))
            loads = _other_trajectories(members, before)
            self._take(members, before, loads)
            self._timeline.check_waits()
            for member in members:
                found = before[member.robot].state
                if member.robot not in loads and found is State.COLLISION_HALT:
                    member.playback_state = found
        except LabError as error:
            self._undo(robots, {robot: before[robot] for robot in loads}, error)
            raise

    def revive(self) -> None:
        """Claim and load those members again that lost their playback."""
        members = [m for m in self._timeline if m.playback_state is State.IDLE]
        if members:
            claimed = self._fleet.claim([m.robot for m in members])
            loaded = {m.robot: found for m, found in zip(members, claimed, strict=True)}
            for member in members:
                _take_place(member, loaded[member.robot])
            self._take(members, loaded, _other_trajectories(members, loaded))

    def take_back(self, member: Member) -> State:
        """Claim a member again that came back with its trajectory; return its state."""
        [loaded] = self._fleet.claim([member.robot])
        if loaded.trajectory_id == member.trajectory_id:
            _take_place(member, loaded)
            member.playback_state, member.replied_ns = loaded.state, loaded.stamp_ns
        return member.playback_state

    def _take(
        self, members: Sequence[Member], loaded: Mapping[str, Loaded], loads: Mapping[str, str]
    ) -> None:
        """Load what members lack; take the lengths and rates of their trajectories."""
        if loads:
            # A member accepts no load, so it leaves the system for it.
            self._fleet.release(list(loads))
            self._fleet.load(loads)
            again = self._fleet.claim(list(loads))
            loaded = {**loaded, **dict(zip(loads, again, strict=True))}
        for member in members:
            found = loaded[member.robot]
            if not found.trajectory_id:
                raise Misuse(NO_TRAJECTORY_LOADED(robot=member.robot))
            member.trajectory_id = found.trajectory_id
            member.duration, member.frame_rate = found.duration, found.frame_rate
            member.replied_ns = found.stamp_ns
            member.playback_state = State.READY

    def _undo(self, robots: list[str], loads: Mapping[str, Loaded], why: LabError) -> None:
        """Let all robots go; bring those in `loads` back to what they had, and where."""
        try:
            if loads:
                present = self._fleet.claim(list(loads))
                loads = {
                    robot: loads[robot]
                    for robot, has in zip(loads, present, strict=True)
                    if has.trajectory_id != loads[robot].trajectory_id
                }
            self._fleet.release(robots)
            if loads:
                self._fleet.load({robot: had.trajectory_id for robot, had in loads.items()})
            places = [
                Order(robot, Command.SEEK, position=had.position)
                for robot, had in loads.items()
                if had.state is State.PAUSED
            ]
            if places:
                moved = [order.robot for order in places]
                self._fleet.claim(moved)
                self._fleet.drive(places)
                self._fleet.release(moved)
        except LabError as error:
            changed = list(loads) or robots
            raise Misuse(NOT_TAKEN_BACK(why=why, error=error, robots=changed)) from error


def _take_place(member: Member, loaded: Loaded) -> None:
    """Take where a member that was claimed again stands on the trajectory of its share."""
    stands = loaded.state in (State.PAUSED, State.COLLISION_HALT)
    if stands and loaded.trajectory_id == member.trajectory_id:
        member.position = loaded.position


def _other_trajectories(members: Iterable[Member], loaded: Mapping[str, Loaded]) -> dict[str, str]:
    """Return by robot what has to be loaded in place of what it has."""
    return {
        member.robot: member.trajectory_id
        for member in members
        if member.trajectory_id not in ("", loaded[member.robot].trajectory_id)
    }


class Leases:
    """When each system was named last. Times are s of any clock that never goes back."""

    def __init__(self, lease: float = LEASE_S) -> None:
        self._lease = lease
        self._renewed: dict[str, float] = {}

    def renew(self, systems: Iterable[str], now: float) -> None:
        """Note that these systems are kept at `now`."""
        self._renewed |= dict.fromkeys(systems, now)

    def expired(self, claimed: Iterable[str], now: float) -> list[str]:
        """Return those of the claimed systems that nobody keeps; forget all others.

        One that is seen here first has just been made, and gets its time.
        """
        self._renewed = {name: self._renewed.get(name, now) for name in claimed}
        return [name for name, renewed in self._renewed.items() if now - renewed >= self._lease]
