"""The robot systems of a lab, which robot is a member of which, and their journal."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from typing import Any

from mrlab_ros.core.base.diagnostics import NO_ROBOT_IN_SCENE
from mrlab_ros.core.base.errors import BadInput, LabError, Misuse
from mrlab_ros.core.base.names import checked_name, close_to
from mrlab_ros.core.playback.diagnostics import MEMBER_OF_SYSTEM
from mrlab_ros.core.systems import diagnostics as say
from mrlab_ros.core.systems.members import Fleet
from mrlab_ros.core.systems.robot_system import RobotSystem
from mrlab_ros.core.systems.states import Policy, SystemState
from mrlab_ros.core.systems.timeline import Member, Mode
from mrlab_ros.core.systems.waits import parse

SYSTEMS = "systems"


class Systems:
    """All systems of the lab; a robot is a member of at most one."""

    def __init__(self) -> None:
        self._systems: dict[str, RobotSystem] = {}

    def __iter__(self) -> Iterator[RobotSystem]:
        return iter(tuple(self._systems.values()))

    def get(self, name: str) -> RobotSystem:
        """Return the system called `name`; raise Misuse where there is none."""
        try:
            return self._systems[name]
        except KeyError:
            close = close_to(name, self._systems)
            missing = say.NO_SYSTEM(system=name, known=list(self._systems), close=close)
            raise Misuse(missing) from None

    def of(self, robot: str) -> RobotSystem | None:
        """Return the system that `robot` is a member of; None where it is independent."""
        return next((s for s in self if robot in s.members), None)

    def check(self, name: str, robots: Sequence[str], scene: frozenset[str]) -> str:
        """Return the name for a system of `robots`; an empty `name` is chosen here.

        scene: the names of all robots. Raises BadInput where the robots or the name cannot be
        taken, Misuse where a robot is a member of another system.
        """
        if not robots:
            raise BadInput(say.NO_MEMBERS())
        for robot in robots:
            if robot not in scene:
                known = sorted(scene)
                close = close_to(robot, known)
                raise BadInput(NO_ROBOT_IN_SCENE(robot=robot, known=known, close=close))
            if robots.count(robot) > 1:
                raise BadInput(say.ROBOT_REPEATED(robot=robot, count=robots.count(robot)))
            if (other := self.of(robot)) is not None:
                raise Misuse(MEMBER_OF_SYSTEM(robot=robot, system=other.name))
        number = 1
        while not name and f"system_{number}" in self._systems:
            number += 1
        taken = scene | frozenset(self._systems)
        return checked_name(name or f"system_{number}", taken, "system")

    def add(self, system: RobotSystem) -> None:
        """Add a system whose name check() returned."""
        self._systems[system.name] = system

    def dissolve(self, name: str) -> RobotSystem:
        """Remove and return the system called `name`; raise Misuse where there is none."""
        self.get(name)
        return self._systems.pop(name)

    def without_members(self, scene: frozenset[str]) -> list[tuple[RobotSystem, list[str]]]:
        """Return the systems that cannot go on with the robots of `scene`.

        Each comes with its members that are missing: without one of them there is no timeline.
        """
        missing = [(system, [r for r in system.members if r not in scene]) for system in self]
        return [(system, robots) for system, robots in missing if robots]


def plain(systems: Iterable[RobotSystem], now_ns: int) -> dict[str, Any]:
    """Return the content of the journal."""
    return {SYSTEMS: [_system(system, now_ns) for system in systems]}


def read(content: Mapping[str, Any]) -> Iterator[tuple[str, list[str], Mapping[str, Any]]]:
    """Yield each system's name, its robots, and its entry for restore()."""
    for entry in content.get(SYSTEMS, ()):
        try:
            yield str(entry["name"]), [str(m["robot"]) for m in entry["members"]], entry
        except (KeyError, TypeError):
            continue


def restore(
    entry: Mapping[str, Any], fleet: Fleet, announce: Callable[[], None], now_ns: int
) -> RobotSystem | None:
    """Return the system as it was, PAUSED in place where it was under way; None: unreadable.

    Its members are claimed as they report themselves, and by the next play.
    """
    try:
        system = RobotSystem(
            str(entry["name"]),
            [_restored(member) for member in entry["members"]],
            fleet,
            Mode[entry["mode"]],
            Policy[entry["policy"]],
            bool(entry["loop"]),
            announce,
        )
        if entry["state"] not in (SystemState.READY.name, SystemState.COMPLETE.name):
            system.come_back(now_ns, float(entry["position"]), float(entry["rate"]))
        else:
            system.set_rate(now_ns, float(entry["rate"]))
    except (KeyError, TypeError, ValueError, LabError):
        return None
    return system


def _system(system: RobotSystem, now_ns: int) -> dict[str, Any]:
    return {
        "name": system.name,
        "mode": system.mode.name,
        "policy": system.policy.name,
        "loop": system.loop,
        "rate": system.rate,
        "state": system.state.name,
        "position": min(max(system.clock.at(now_ns), 0.0), system.duration),
        "members": [
            {
                "robot": m.robot,
                "trajectory": m.trajectory_id,
                "dwell": m.dwell,
                "waits": [wait.text for wait in m.waits],
                "met": [wait.text for wait in m.met],
                "duration": m.duration,
                "frame_rate": m.frame_rate,
                "start": m.start,
                "position": m.position,
                "done": m.done,
            }
            for m in system.members.values()
        ],
    }


def _restored(entry: Mapping[str, Any]) -> Member:
    return Member(
        str(entry["robot"]),
        str(entry["trajectory"]),
        float(entry["dwell"]),
        tuple(map(parse, entry["waits"])),
        duration=float(entry["duration"]),
        frame_rate=float(entry["frame_rate"]),
        start=float(entry["start"]),
        position=float(entry["position"]),
        done=bool(entry["done"]),
        met=set(map(parse, entry["met"])),
    )
