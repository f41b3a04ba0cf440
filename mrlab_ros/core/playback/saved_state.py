"""The state of a playback that a restart restores, and its journal entry."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any, NamedTuple

import numpy as np

from mrlab_ros.core.base.clock import checked_rate
from mrlab_ros.core.base.geometry import Array
from mrlab_ros.core.playback.diagnostics import PLAYBACK_RESTARTED
from mrlab_ros.core.playback.execution import Execution
from mrlab_ros.core.playback.states import Event, State
from mrlab_ros.core.trajectory.trajectory import Trajectory

ROBOTS = "robots"
# A journal lies less than this behind the last pose, s on the trajectory; otherwise the pose is
# not of the run that the journal names.
MOST_BEHIND_S = 1.0


class Kept(NamedTuple):
    """State restored after a restart.

    position: s on the trajectory. halted: it stood in COLLISION_HALT. begun: it does not stand
    READY for the first frame. arm: (J,) rad, as last sent.
    """

    trajectory_id: str
    version: int
    position: float
    rate: float
    loop: bool
    halted: bool
    begun: bool
    arm: Array


def with_pose(kept: Kept, position: float, joints: Sequence[float]) -> Kept:
    """Return what a journal says with the newer last pose: s on the trajectory, and (J,) rad."""
    if abs(position - kept.position) > MOST_BEHIND_S or len(joints) != len(kept.arm):
        return kept
    return kept._replace(position=position, arm=np.array(joints))


def come_back(execution: Execution, now_ns: int, trajectory: Trajectory, kept: Kept) -> None:
    """Stand where the arm stood before its process was restarted.

    PAUSED, or READY where it had not begun; in COLLISION_HALT where it was halted, unless
    physics has reported meanwhile that the arm is clear.
    """
    execution.machine.check(Event.RETURNED_PAUSED)
    execution.check_fits(trajectory)
    position = min(max(kept.position, 0.0), trajectory.duration)
    if kept.halted and execution.touching is not False:
        event = Event.RETURNED_HALTED
    else:
        event = Event.RETURNED_PAUSED if kept.begun else Event.LOAD
    execution.machine.fire(event)
    execution.stream.trajectory = trajectory
    execution.stream.rate = checked_rate(kept.rate)
    execution.loop = kept.loop
    if event is Event.LOAD:
        execution.stream.arm = kept.arm
        execution.stream.stand(now_ns, execution.stream.begin)
    else:
        execution.stream.come_back(now_ns, position, kept.arm)
    execution.announce(PLAYBACK_RESTARTED())


def keep(execution: Execution) -> Kept | None:
    """Return what a restart has to know again; None without a trajectory."""
    if execution.trajectory is None:
        return None
    return Kept(
        execution.trajectory.id,
        execution.trajectory.version,
        execution.stream.position,
        execution.rate,
        execution.loop,
        halted=execution.state is State.COLLISION_HALT,
        begun=execution.state not in (State.READY, State.COMPLETE),
        arm=execution.arm,
    )


def plain(model: str, kept: Kept) -> dict[str, Any]:
    """Return a robot's entry in the journal. model: of the robot."""
    return {
        "model": model,
        "trajectory": kept.trajectory_id,
        "version": kept.version,
        "position": kept.position,
        "rate": kept.rate,
        "loop": kept.loop,
        "halted": kept.halted,
        "begun": kept.begun,
        "arm": [float(value) for value in kept.arm],
    }


def read(content: Mapping[str, Any]) -> dict[str, tuple[str, Kept]]:
    """Return by robot its model and what it had; entries of another form are left out."""
    found = {}
    for name, entry in content.get(ROBOTS, {}).items():
        try:
            kept = Kept(
                str(entry["trajectory"]),
                int(entry["version"]),
                float(entry["position"]),
                float(entry["rate"]),
                bool(entry["loop"]),
                halted=bool(entry["halted"]),
                begun=bool(entry["begun"]),
                arm=np.array(entry["arm"], dtype=float),
            )
            if kept.arm.ndim == 1 and np.isfinite(kept.arm).all():
                found[str(name)] = str(entry["model"]), kept
        except (KeyError, TypeError, ValueError):
            continue
    return found
