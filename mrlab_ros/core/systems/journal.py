"""What the coordinator writes into its journal: its systems, with their clocks and shares."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping
from typing import Any

from mrlab_ros.core.base.errors import LabError
from mrlab_ros.core.systems.members import Fleet
from mrlab_ros.core.systems.robot_system import Policy, RobotSystem
from mrlab_ros.core.systems.states import SystemState
from mrlab_ros.core.systems.timeline import Member, Mode
from mrlab_ros.core.systems.waits import parse

SYSTEMS = "systems"


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
