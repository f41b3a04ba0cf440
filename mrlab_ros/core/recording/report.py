"""Report of a recorded session: states, contacts, grasps, errors, latency, per robot.

Times are s from the bag's first message unless a name says otherwise.
"""

from __future__ import annotations

from bisect import bisect_right
from dataclasses import dataclass, field
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from mrlab_ros.core.base.clock import SECOND, PlaybackClock
from mrlab_ros.core.base.diagnostic import Diagnostic, plain
from mrlab_ros.core.base.geometry import Pose, Vector
from mrlab_ros.core.recording.diagnostics import RUN_BEGAN, RUN_ENDED, SESSION_SUMMARY
from mrlab_ros.core.recording.runs import Deed, Result, Run, figures_of

Array = NDArray[np.float64]
PLAYING = "PLAYING"
# The values of Grasp.state.
HOLDING = "HOLDING"
GRASP_STATES = ("OPEN", "CLOSING", HOLDING, "EMPTY")


@dataclass(frozen=True)
class Span:
    """Something that lasted from `start` to `end`, s. said: why, for a person; None: nothing."""

    start: float
    end: float
    label: str
    detail: str = ""
    said: Diagnostic | None = None

    def facts(self) -> dict[str, Any]:
        return {
            "start": self.start,
            "end": self.end,
            "label": self.label,
            "detail": self.detail,
            "said": plain(self.said),
        }


@dataclass
class Changes:
    """A value's history; repeated equal values are ignored."""

    values: list[tuple[float, str, str, Diagnostic | None]] = field(default_factory=list)

    def add(
        self, time: float, label: str, detail: str = "", said: Diagnostic | None = None
    ) -> None:
        last = self.values[-1] if self.values else None
        if last is None or last[1:3] != (label, detail) or _meaning(last[3]) != _meaning(said):
            self.values.append((time, label, detail, said))

    def spans(self, end: float) -> list[Span]:
        """Return how long each value lasted; the last one until `end`."""
        ends = [*(time for time, *_ in self.values[1:]), end][: len(self.values)]
        return [
            Span(time, max(until, time), label, detail, said)
            for (time, label, detail, said), until in zip(self.values, ends, strict=True)
        ]


@dataclass
class Said:
    """Remarks and their times, s; a repeated one is ignored, also where its figures vary."""

    values: list[tuple[float, Diagnostic]] = field(default_factory=list)

    def add(self, time: float, said: Diagnostic) -> None:
        if not self.values or _meaning(self.values[-1][1]) != _meaning(said):
            self.values.append((time, said))


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


def course_of(
    courses: dict[str, ReferenceTrajectory], trajectory: str, version: int
) -> ReferenceTrajectory | None:
    """Return a version of a trajectory; the first one of a bag has the id alone for a name."""
    return courses.get(f"{trajectory}@{version}") or courses.get(trajectory)


@dataclass(frozen=True)
class ReportedState:
    """A recorded playback_state; stamps ns. time: s of the session; length: s, 0: unknown."""

    stamp_ns: int
    label: str
    trajectory: str
    clock: PlaybackClock
    time: float = 0.0
    version: int = 0
    length: float = 0.0
    system: str = ""

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


class Hop(NamedTuple):
    """A way of a message on which its latency was measured. observer: empty: the bridge."""

    ends: str
    observer: str = ""


def latency_facts(latency: dict[Hop, Series]) -> list[dict[str, Any]]:
    """Return latencies, s, ready for JSON."""
    return [{**hop._asdict(), **series.summary()} for hop, series in latency.items()]


@dataclass(frozen=True)
class Event:
    """Something in the run `run` of a robot, s of the session; place: m, in the frame world."""

    time: float
    robot: str
    run: int
    said: Diagnostic
    place: Vector

    def facts(self) -> dict[str, Any]:
        return {**vars(self), "said": plain(self.said)}


@dataclass
class Contact:
    """A contact that halted an arm, or would have.

    row: of the trajectory, from 1. place: m, in the frame world.
    """

    time: float
    link: str
    other: str
    row: int
    place: Vector | None = None


@dataclass
class Borne:
    """The most that the grasps of an object bore: kg, coefficients of friction, N*m."""

    mass: float
    payload: float
    friction: float
    friction_needed: float
    wrist_moment: float


@dataclass
class RobotReport:
    """Report of one robot. tracking rad, deadline s, latency s by hop."""

    name: str
    model: str = ""
    states: Changes = field(default_factory=Changes)
    grasps: Changes = field(default_factory=Changes)
    # Remarks on its grasps, and on its states.
    remarks: Said = field(default_factory=Said)
    reasons: Said = field(default_factory=Said)
    borne: dict[str, Borne] = field(default_factory=dict)
    collisions: list[Contact] = field(default_factory=list)
    # When the arm or the tool touched something, halting or not.
    contacts: list[float] = field(default_factory=list)
    reported: list[ReportedState] = field(default_factory=list)
    # (time, pose of base_link in world)
    bases: list[tuple[float, Pose]] = field(default_factory=list)
    joint_states: int = 0
    frames_lost: int = 0
    tracking: Series = field(default_factory=Series)
    deadline: Series = field(default_factory=Series)
    latency: dict[Hop, Series] = field(default_factory=dict)
    _holds: list[int] = field(default_factory=list)
    # Start of the present reckoning of time in _holds: the clock may be set back.
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
        found = self.playing_at(stamp_ns)
        if found is None:
            return
        reported, position = found
        course = course_of(courses, reported.trajectory, reported.version)
        expected = None if course is None else course.at(position)
        if expected is not None and expected.shape == positions.shape:
            self.tracking.add(time, float(np.max(np.abs(positions - expected))))

    def playing_at(self, stamp_ns: int) -> tuple[ReportedState, float] | None:
        """Return the state at a stamp and the place on its trajectory, s, while it played."""
        number = bisect_right(self._holds, stamp_ns, self._begin) - 1
        if number < self._begin:
            return None
        reported = self.reported[number]
        if reported.label != PLAYING or reported.clock.rate == 0:
            return None
        return reported, reported.clock.at(stamp_ns)

    def position_at(self, time: float) -> float:
        """Return the place on its trajectory at a time of the session, s; 0 before the first."""
        number = bisect_right(self.reported, time, key=lambda state: state.time) - 1
        if number < 0:
            return 0.0
        state = self.reported[number]
        return state.clock.at(state.stamp_ns + round((time - state.time) * SECOND))

    def base_at(self, time: float) -> Pose:
        """Return where its base stands, in the frame world."""
        number = bisect_right(self.bases, time, key=lambda base: base[0]) - 1
        return self.bases[max(number, 0)][1] if self.bases else Pose()

    def place_of(self, time: float, said: Diagnostic) -> Vector:
        """Return where something of it happened: of a contact or an object, else its base."""
        hit = next((each.place for each in self.collisions if each.time == time), None)
        return said.values.get("place") or hit or self.base_at(time).position

    def facts(self, end: float) -> dict[str, Any]:
        """Return everything, ready for JSON."""
        return {
            "name": self.name,
            "model": self.model,
            "states": [span.facts() for span in self.states.spans(end)],
            "grasps": [span.facts() for span in self.grasps.spans(end)],
            "remarks": [{"time": time, "said": plain(said)} for time, said in self.remarks.values],
            "reasons": [{"time": time, "said": plain(said)} for time, said in self.reasons.values],
            "borne": {name: vars(borne) for name, borne in self.borne.items()},
            "collisions": [vars(contact) for contact in self.collisions],
            "contacts": len(self.contacts),
            "joint_states": self.joint_states,
            "frames_lost": self.frames_lost,
            "tracking_error": self.tracking.summary(),
            "deadline_error": self.deadline.summary(),
            "latency": latency_facts(self.latency),
        }


@dataclass
class SessionReport:
    """Report of a session of `duration` s that began at `start_ns`."""

    duration: float
    start_ns: int
    robots: dict[str, RobotReport] = field(default_factory=dict)
    systems: dict[str, Changes] = field(default_factory=dict)
    latency: dict[Hop, Series] = field(default_factory=dict)
    # Every how many joint states one was compared.
    step: int = 1
    troubles: list[Diagnostic] = field(default_factory=list)
    runs: list[Run] = field(default_factory=list)
    # Where somebody asked everybody to look; of no robot, in no run.
    marks: list[Event] = field(default_factory=list)

    def robot(self, name: str) -> RobotReport:
        if name not in self.robots:
            self.robots[name] = RobotReport(name)
        return self.robots[name]

    @property
    def summary(self) -> Diagnostic:
        """How long it was, how many played how often, and how that ended."""
        hits = sum(a.deed is Deed.HIT for run in self.runs for a in run.actions)
        done = sum(run.result is Result.COMPLETED for run in self.runs)
        return SESSION_SUMMARY(
            duration=self.duration,
            robots=len(self.robots),
            runs=len(self.runs),
            completed=done if self.runs else None,
            collisions=hits or None,
        )

    def events(self) -> list[Event]:
        """Return in order when runs began and ended, and what was done in them."""
        found = []
        for run in self.runs:
            began = RUN_BEGAN(trajectory=run.trajectory, robot=run.robot)
            ended = RUN_ENDED(trajectory=run.trajectory, outcome=run.outcome, robot=run.robot)
            told = [(run.start, began), *((a.time, a.said) for a in run.actions), (run.end, ended)]
            robot = self.robot(run.robot)
            found += [
                Event(time, run.robot, run.number, said, robot.place_of(time, said))
                for time, said in told
            ]
        return sorted(found, key=lambda event: event.time)

    def facts(self) -> dict[str, Any]:
        """Return everything, ready for JSON: SI units; each `said` as diagnostic.plain()."""
        return {
            "duration": self.duration,
            "start_ns": self.start_ns,
            "summary": plain(self.summary),
            "troubles": plain(self.troubles),
            "runs": [
                {**run.facts(), "figures": figures_of(run.course, run.joints).facts()}
                if run.course is not None
                else {**run.facts(), "figures": None}
                for run in self.runs
            ],
            "events": [event.facts() for event in self.events()],
            "compared_every": self.step,
            "robots": [robot.facts(self.duration) for robot in self.robots.values()],
            "systems": {
                name: [span.facts() for span in changes.spans(self.duration)]
                for name, changes in self.systems.items()
            },
            "latency": latency_facts(self.latency),
        }


def _meaning(said: Diagnostic | None) -> tuple[str, dict[str, Any]]:
    """Return what two diagnostics have in common that say the same; a text without code is itself.

    Figures may vary.
    """
    if said is None:
        return "", {}
    if not said.code:
        return said.message, {}
    return said.code, {name: said.values.get(name) for name in ("object", "robot", "link")}
