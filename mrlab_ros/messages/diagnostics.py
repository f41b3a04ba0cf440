"""Signs of life of the lab's processes as diagnostic messages, and back."""

from __future__ import annotations

from collections.abc import Mapping

from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus, KeyValue

from mrlab_ros.core.watch import Sign
from mrlab_ros.messages.time import make_header

# What the names of the lab's processes begin with on /diagnostics.
PREFIX = "mrlab: "
# What a process says of itself alone, and never of another.
RESTARTS = "restarts"
# That its own text says how it ended, and what was lost: for a minute after its restart.
RESTARTED = "restarted"


def signs_to_message(
    now_ns: int, own: Sign, age: float, silent: Mapping[str, float]
) -> DiagnosticArray:
    """Return a process's own sign of life, and which others are silent, by process in s.

    age: how long it runs, s.
    """
    trouble = own.sentence(age)
    level = DiagnosticStatus.WARN if trouble else DiagnosticStatus.OK
    values = {
        RESTARTS: str(own.restarts),
        "last_exit": own.last_exit,
        **({RESTARTED: "true"} if own.restarted(age) else {}),
        **{f"failed {number}": text for number, text in enumerate(own.failed, 1)},
        **{f"lost {number}": text for number, text in enumerate(own.lost or (), 1)},
    }
    statuses = [
        DiagnosticStatus(
            level=DiagnosticStatus.ERROR if own.failed else level,
            name=f"{PREFIX}{own.process}",
            message=trouble or "runs",
            hardware_id="mrlab",
            values=[KeyValue(key=key, value=value) for key, value in values.items()],
        )
    ]
    statuses += [
        DiagnosticStatus(
            level=DiagnosticStatus.ERROR,
            name=f"{PREFIX}{process}",
            message=f"no sign of life for {seconds:.0f} s: it died or hangs",
            hardware_id="mrlab",
        )
        for process, seconds in silent.items()
    ]
    return DiagnosticArray(header=make_header(now_ns), status=statuses)


def living_in(message: DiagnosticArray) -> list[str]:
    """Return the processes that give a sign of life in a message."""
    return [
        status.name.removeprefix(PREFIX)
        for status in message.status
        if status.name.startswith(PREFIX) and any(v.key == RESTARTS for v in status.values)
    ]


def restarted_in(message: DiagnosticArray) -> set[str]:
    """Return the processes that say themselves that they were restarted lately."""
    return {
        status.name.removeprefix(PREFIX)
        for status in message.status
        if status.name.startswith(PREFIX) and any(v.key == RESTARTED for v in status.values)
    }


def troubles_in(message: DiagnosticArray) -> dict[str, str]:
    """Return for each process in a message what is amiss with it, empty: nothing."""
    return {
        status.name.removeprefix(PREFIX): (
            "" if status.level == DiagnosticStatus.OK else str(status.message)
        )
        for status in message.status
        if status.name.startswith(PREFIX)
    }
