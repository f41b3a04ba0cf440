"""What happened in a recorded session: states, contacts, grasps, errors, latency, per robot.

Times are s from the bag's first message unless a name says otherwise.
"""

from __future__ import annotations

from bisect import bisect_right
from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mrlab_ros.core.clock import PlaybackClock

Array = NDArray[np.float64]
PLAYING = "PLAYING"
# The values of Grasp.state.
HOLDING = "HOLDING"
GRASP_STATES = ("OPEN", "CLOSING", HOLDING, "EMPTY")


@dataclass(frozen=True)
class Span:
    """Something that lasted from `start` to `end`, s."""

    start: float
    end: float
    label: str
    detail: str = ""

    def facts(self) -> dict[str, Any]:
        return {
            "start": self.start,
            "end": self.end,
            "label": self.label,
            "detail": self.detail,
        }


@dataclass
class Changes:
    """A value's history; repeated equal values are ignored."""

    values: list[tuple[float, str, str]] = field(default_factory=list)

    def add(self, time: float, label: str, detail: str = "") -> None:
        if not self.values or self.values[-1][1:] != (label, detail):
            self.values.append((time, label, detail))

    def spans(self, end: float) -> list[Span]:
        """Return how long each value lasted; the last one until `end`."""
        ends = [*(time for time, _, _ in self.values[1:]), end][: len(self.values)]
        return [
            Span(time, max(until, time), label, detail)
            for (time, label, detail), until in zip(self.values, ends, strict=True)
        ]


@dataclass(frozen=True)
class ReferenceTrajectory:
    """A trajectory: positions (N, J) rad at `frame_rate` Hz."""

    frame_rate: float
    positions: Array

    def at(self, position: float) -> Array | None:
        """Return the joint positions (J,) rad at `position` s, None outside of the trajectory."""
        frame = position * self.frame_rate
        last = len(self.positions) - 1
        # A stamp is rounded to 1 ns: the last frame may seem to lie past the end.
        if not -1e-3 <= frame <= last + 1e-3:
            return None
        frame = min(max(frame, 0.0), float(last))
        before = min(int(frame), last - 1)
        share = frame - before
        found: Array = self.positions[before] * (1 - share) + self.positions[before + 1] * share
        return found


@dataclass(frozen=True)
class ReportedState:
    """What a playback_state says for the comparison with the trajectory; stamps ns."""

    stamp_ns: int
    label: str
    trajectory: str
    clock: PlaybackClock

    @property
    def holds_from_ns(self) -> int:
        """When it begins to hold, ns: playing begins at its clock's stamp."""
        return self.clock.stamp_ns if self.label == PLAYING else self.stamp_ns


@dataclass
class Series:
    """Values over time."""

    times: list[float] = field(default_factory=list)
    values: list[float] = field(default_factory=list)

    def add(self, time: float, value: float) -> None:
        self.times.append(time)
        self.values.append(value)

    def summary(self) -> dict[str, float | int | None]:
        """Return count, median, 95th percentile and largest value; None where there is none."""
        if not self.values:
            return {"count": 0, "p50": None, "p95": None, "max": None}
        p50, p95, most = np.percentile(self.values, (50, 95, 100))
        return {
            "count": len(self.values),
            "p50": float(p50),
            "p95": float(p95),
            "max": float(most),
        }


@dataclass
class Contact:
    """A contact that halted an arm, or would have."""

    time: float
    link: str
    other: str
    frame: int


@dataclass
class Borne:
    """The most that the grasps of an object bore: kg, coefficients of friction, N*m."""

    mass: float
    payload: float
    friction: float
    friction_needed: float
    wrist_moment: float

    @property
    def label(self) -> str:
        return (
            f"{self.mass:.3g} kg, friction {self.friction:.2f}, "
            f"needed {self.friction_needed:.2f}, {self.wrist_moment:.3g} N*m at the wrist"
        )


@dataclass
class RobotReport:
    """What one robot did. tracking rad, deadline s, latency s by hop."""

    name: str
    model: str = ""
    states: Changes = field(default_factory=Changes)
    grasps: Changes = field(default_factory=Changes)
    # What was said of its grasps.
    remarks: Changes = field(default_factory=Changes)
    borne: dict[str, Borne] = field(default_factory=dict)
    collisions: list[Contact] = field(default_factory=list)
    # When the arm or the tool touched something, halting or not.
    contacts: list[float] = field(default_factory=list)
    reported: list[ReportedState] = field(default_factory=list)
    joint_states: int = 0
    frames_lost: int = 0
    tracking: Series = field(default_factory=Series)
    deadline: Series = field(default_factory=Series)
    latency: dict[str, Series] = field(default_factory=dict)
    _holds: list[int] = field(default_factory=list)
    # Where in _holds the present reckoning of time begins: the clock may be set back.
    _begin: int = 0

    def add(self, reported: ReportedState) -> None:
        """Take note of a playback_state, in the order in which they came."""
        if self.reported and reported.stamp_ns < self.reported[-1].stamp_ns:
            self._begin = len(self._holds)
        self.reported.append(reported)
        self._holds.append(reported.holds_from_ns)

    def bear(self, name: str, grasp: Any) -> None:
        """Take note of what a grasp of object `name` bears; grasp: a mrlab_msgs/Grasp."""
        before = self.borne.get(name)
        needed, wrist = grasp.friction_needed, grasp.wrist_moment
        if before is not None:
            needed = max(needed, before.friction_needed)
            wrist = max(wrist, before.wrist_moment)
        self.borne[name] = Borne(grasp.mass, grasp.payload, grasp.friction, needed, wrist)

    def compare(
        self, time: float, stamp_ns: int, positions: Array, courses: dict[str, ReferenceTrajectory]
    ) -> None:
        """Compare a joint state with the trajectory at its stamp; note the largest deviation."""
        expected = self._expected(stamp_ns, courses)
        if expected is not None and expected.shape == positions.shape:
            self.tracking.add(time, float(np.max(np.abs(positions - expected))))

    def _expected(self, stamp_ns: int, courses: dict[str, ReferenceTrajectory]) -> Array | None:
        number = bisect_right(self._holds, stamp_ns, self._begin) - 1
        if number < self._begin:
            return None
        reported = self.reported[number]
        course = courses.get(reported.trajectory)
        if reported.label != PLAYING or reported.clock.rate == 0 or course is None:
            return None
        return course.at(reported.clock.at(stamp_ns))

    def facts(self, end: float) -> dict[str, Any]:
        """Return everything, ready for JSON."""
        return {
            "name": self.name,
            "model": self.model,
            "states": [span.facts() for span in self.states.spans(end)],
            "grasps": [span.facts() for span in self.grasps.spans(end)],
            "remarks": [span.facts() for span in self.remarks.spans(end)],
            "borne": {name: vars(borne) for name, borne in self.borne.items()},
            "collisions": [vars(contact) for contact in self.collisions],
            "contacts": len(self.contacts),
            "joint_states": self.joint_states,
            "frames_lost": self.frames_lost,
            "tracking_error": self.tracking.summary(),
            "deadline_error": self.deadline.summary(),
            "latency": {hop: series.summary() for hop, series in self.latency.items()},
        }


@dataclass
class SessionReport:
    """What happened in a session of `duration` s that began at `start_ns`."""

    duration: float
    start_ns: int
    robots: dict[str, RobotReport] = field(default_factory=dict)
    systems: dict[str, Changes] = field(default_factory=dict)
    latency: dict[str, Series] = field(default_factory=dict)
    # Every how many joint states one was compared.
    step: int = 1
    troubles: list[str] = field(default_factory=list)

    def robot(self, name: str) -> RobotReport:
        if name not in self.robots:
            self.robots[name] = RobotReport(name)
        return self.robots[name]

    def facts(self) -> dict[str, Any]:
        """Return everything, ready for JSON: SI units."""
        return {
            "duration": self.duration,
            "start_ns": self.start_ns,
            "troubles": self.troubles,
            "compared_every": self.step,
            "robots": [robot.facts(self.duration) for robot in self.robots.values()],
            "systems": {
                name: [span.facts() for span in changes.spans(self.duration)]
                for name, changes in self.systems.items()
            },
            "latency": {hop: series.summary() for hop, series in self.latency.items()},
        }


def report_lines(report: SessionReport) -> list[str]:
    """Return the report as lines of text."""
    count = len(report.robots)
    lines = [f"{report.duration:.1f} s, {count} robot{'s' * (count != 1)}"]
    lines += report.troubles
    for name, changes in report.systems.items():
        lines += ["", f"system {name}"]
        lines += _span_lines(changes.spans(report.duration))
    for robot in report.robots.values():
        lines += ["", f"{robot.name} ({robot.model or 'model unknown'})"]
        lines += _course_lines(robot, report.duration)
        lines.append(
            f"  {robot.joint_states} joint states, {robot.frames_lost} frames left out, "
            f"{len(robot.contacts)} contacts"
        )
        lines += _figures("tracking error", robot.tracking, "rad", 1.0)
        lines += _figures("deadline error", robot.deadline, "ms", 1e3)
        for hop, series in robot.latency.items():
            lines += _figures(f"latency {hop}", series, "ms", 1e3)
    if report.latency:
        lines += ["", "latency of all topics"]
        for hop, series in report.latency.items():
            lines += _figures(hop, series, "ms", 1e3)
    return lines


def _course_lines(robot: RobotReport, end: float) -> list[str]:
    """Return states, collisions and what was held, in order of time."""
    lines = _span_lines(robot.states.spans(end))
    lines += [
        f"  {contact.time:8.2f} s  collision: {contact.link} touched {contact.other} "
        f"at frame {contact.frame}"
        for contact in robot.collisions
    ]
    lines += [
        f"  {span.start:8.2f} s  holds {span.detail} for {span.end - span.start:.2f} s"
        + (f": {robot.borne[span.detail].label}" if span.detail in robot.borne else "")
        for span in robot.grasps.spans(end)
        if span.label == HOLDING
    ]
    lines += [f"  {span.start:8.2f} s  {span.label}" for span in robot.remarks.spans(end)]
    return sorted(lines, key=lambda line: float(line.split(maxsplit=1)[0]))


def _span_lines(spans: Sequence[Span]) -> list[str]:
    return [
        f"  {span.start:8.2f} s  {span.label} for {span.end - span.start:.2f} s"
        + (f": {span.detail}" if span.detail else "")
        for span in spans
    ]


def _figures(what: str, series: Series, unit: str, scale: float) -> list[str]:
    figures = series.summary()
    if not figures["count"]:
        return []
    values = ", ".join(
        f"{name} {float(figures[name] or 0) * scale:.3g} {unit}" for name in ("p50", "p95", "max")
    )
    return [f"  {what}: {values} ({figures['count']})"]
