"""The stops of a guided replay: what happened in a session, and what somebody pointed at."""

from __future__ import annotations

from bisect import bisect_left, bisect_right
from collections.abc import Sequence
from dataclasses import dataclass

from mrlab_ros.core.base.diagnostic import INFO, Diagnostic, Severity
from mrlab_ros.core.base.errors import Misuse
from mrlab_ros.core.base.geometry import Vector
from mrlab_ros.core.recording.diagnostics import NO_STOP_BEFORE, STOP_EVENT, TOUR_STOP
from mrlab_ros.core.recording.report import Event, SessionReport

# s: what happens so soon after something belongs to the same stop.
TOGETHER = 0.5
# s after the last event of a stop at which the replay stands: its effect can be seen.
SEEN = 0.1
# s: a stop that was passed so recently is not the one before.
RECENT = 0.5
# s before the end of the bag at the latest: the replay is over at the end.
BEFORE_END = 0.01


@dataclass(frozen=True)
class Stop:
    """Where a replay stands: time, s of the session; said: what happened, with the place, m.

    severity: the gravest of what happened.
    """

    time: float
    said: Diagnostic
    severity: Severity = INFO


def stops_of(report: SessionReport) -> list[Stop]:
    """Return the stops of a session in order; none where nothing happened in it."""
    groups: list[list[Event]] = []
    for event in sorted([*report.events(), *report.marks], key=lambda event: event.time):
        if groups and event.time - groups[-1][0].time <= TOGETHER:
            groups[-1].append(event)
        else:
            groups.append([event])
    last = report.duration - BEFORE_END
    return [
        Stop(
            max(min(group[-1].time + SEEN, last), 0.0),
            TOUR_STOP(
                number=number,
                count=len(groups),
                events=[
                    STOP_EVENT(robot=each.robot, said=each.said) if each.robot else each.said
                    for each in group
                ],
                place=_place(group),
            ),
            max(each.said.severity for each in group),
        )
        for number, group in enumerate(groups, 1)
    ]


def _place(group: Sequence[Event]) -> Vector:
    """Return where to look: where somebody pointed, else where the last thing happened."""
    return next((each for each in group if not each.robot), group[-1]).place


def next_stop(stops: Sequence[Stop], position: float) -> Stop | None:
    """Return the first stop after a place, s; None: there is none."""
    number = bisect_right(stops, position + 1e-6, key=lambda stop: stop.time)
    return stops[number] if number < len(stops) else None


def stop_before(stops: Sequence[Stop], position: float) -> Stop:
    """Return the last stop before a place, s; raise Misuse where there is none."""
    number = bisect_left(stops, position - RECENT, key=lambda stop: stop.time)
    if number == 0:
        raise Misuse(NO_STOP_BEFORE())
    return stops[number - 1]
