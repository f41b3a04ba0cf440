"""The report of a check: a verdict, its grounds, the readiness for hardware, and a hash.

Two reports with the same hash are equal.
"""

from __future__ import annotations

import hashlib
import json
import math
from collections.abc import Collection, Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from enum import Enum
from typing import Any

from mrlab_ros.core.base.diagnostic import Code, Diagnostic, Severity, plain
from mrlab_ros.core.checking.diagnostics import (
    ACCELERATION_LIMIT,
    ACCELERATIONS_IN_LIMITS,
    BEGINS_AT_REST,
    BEGINS_INSIDE,
    CHECK_NOT_READY,
    CHECK_READY,
    CLAIM,
    COLLIDES_AT_START,
    COLLISION,
    CONTINUOUS,
    ENDS_AT_REST,
    JERK_LIMIT,
    JERKS_IN_LIMITS,
    LARGEST_OF_JOINT,
    LARGEST_SHARE,
    LARGEST_STEP,
    LEAST_ROOM,
    LIMITS_NOT_STATED,
    MOVES_AT_END,
    MOVES_AT_START,
    NO_COLLISION,
    NO_MOTION_IN_FILE,
    NOT_REHEARSED,
    OUTSIDE_RANGE,
    OVER_SPEED,
    POSITIONS_IN_RANGE,
    REFUSED_BY_CONVERSION,
    SMALL_JUMPS,
    SPEED_AT_END,
    SPEED_STEP,
    SPEEDS_IN_LIMITS,
    ZIGZAG,
)
from mrlab_ros.core.checking.evidence import Clearance
from mrlab_ros.core.checking.joint_limits import ROUNDING, JointFigures
from mrlab_ros.core.checking.rehearsal_record import GraspChange
from mrlab_ros.core.checking.waypoints import Passed
from mrlab_ros.core.conversion.motion_checks import LIMIT_TOLERANCE


class State(Enum):
    """The state of a condition."""

    OK = "ok"
    NOT = "not"
    UNKNOWN = "unknown"


@dataclass(frozen=True)
class Condition:
    """One condition. found: the figure against its limit, or why it is not known."""

    condition: Diagnostic
    state: State
    found: Diagnostic

    def plain(self) -> dict[str, Any]:
        """Return the condition as a mapping for JSON."""
        return {
            "condition": plain(self.condition),
            "state": self.state.value,
            "found": plain(self.found),
        }


# Codes of findings that say that a condition does not hold.
JUMPS = frozenset({"discontinuity", "jump_2pi", "stray_rows"})
RANGES = frozenset({"joint_limit", OUTSIDE_RANGE.code})
SPEEDS = frozenset({"velocity_limit", OVER_SPEED.code})
# By how much a limit may be passed: rad, or a share of it.
TOLERANCES: Mapping[Code, float] = {
    POSITIONS_IN_RANGE: LIMIT_TOLERANCE,
    SPEEDS_IN_LIMITS: ROUNDING - 1,
    ACCELERATIONS_IN_LIMITS: ROUNDING - 1,
    JERKS_IN_LIMITS: ROUNDING - 1,
}
CONTACTS = frozenset({COLLISION.code, COLLIDES_AT_START.code, BEGINS_INSIDE.code})


def conditions(
    figures: Sequence[JointFigures],
    findings: Iterable[Diagnostic],
    *,
    rehearsed: bool,
    scene: Diagnostic,
) -> list[Condition]:
    """Return every condition; figures: empty where no motion was found.

    rehearsed: whether the motion went through physics. scene: what it went through.
    """
    codes = {f.code for f in findings if f.refuses}
    if not figures:
        return _without_motion(codes)
    nearest = min(figures, key=lambda f: f.room)
    fastest = max(figures, key=lambda f: f.speed_share)
    first = max(figures, key=lambda f: f.first_speed)
    last = max(figures, key=lambda f: f.last_speed)
    step = max(figures, key=lambda f: f.speed_step / f.joint.max_velocity)
    return [
        _condition(
            POSITIONS_IN_RANGE, codes & RANGES,
            LEAST_ROOM(
                value=nearest.room, unit="rad", joint=nearest.joint.name, time=nearest.room_time
            ),
        ),
        _condition(
            SPEEDS_IN_LIMITS, codes & SPEEDS,
            LARGEST_SHARE(
                value=fastest.speed_share, joint=fastest.joint.name, time=fastest.speed_time
            ),
        ),
        _stated(
            ACCELERATIONS_IN_LIMITS, figures, "acceleration", "rad/s^2",
            codes & {ACCELERATION_LIMIT.code},
        ),
        _stated(JERKS_IN_LIMITS, figures, "jerk", "rad/s^3", codes & {JERK_LIMIT.code}),
        _condition(
            BEGINS_AT_REST, codes & {MOVES_AT_START.code},
            SPEED_AT_END(value=first.first_speed, unit="rad/s", joint=first.joint.name, time=0.0),
        ),
        _condition(
            ENDS_AT_REST, codes & {MOVES_AT_END.code},
            SPEED_AT_END(value=last.last_speed, unit="rad/s", joint=last.joint.name),
        ),
        _condition(
            CONTINUOUS, codes & {*JUMPS, SPEED_STEP.code, ZIGZAG.code, SMALL_JUMPS.code},
            LARGEST_STEP(
                value=step.speed_step, unit="rad/s", joint=step.joint.name, time=step.step_time
            ),
        ),
        _condition(NO_COLLISION, codes & CONTACTS, scene)
        if rehearsed
        else Condition(NO_COLLISION(), State.UNKNOWN, NOT_REHEARSED()),
    ]  # fmt: skip


def _without_motion(codes: set[str]) -> list[Condition]:
    """Return what the converter's refusal says, and that the rest is not known."""
    refusing: dict[Code, frozenset[str]] = {
        POSITIONS_IN_RANGE: RANGES,
        SPEEDS_IN_LIMITS: SPEEDS,
        ACCELERATIONS_IN_LIMITS: frozenset(),
        JERKS_IN_LIMITS: frozenset(),
        BEGINS_AT_REST: frozenset(),
        ENDS_AT_REST: frozenset(),
        CONTINUOUS: JUMPS,
        NO_COLLISION: frozenset(),
    }
    return [
        Condition(_to_within(condition), State.NOT, REFUSED_BY_CONVERSION())
        if codes & refused
        else Condition(_to_within(condition), State.UNKNOWN, NO_MOTION_IN_FILE())
        for condition, refused in refusing.items()
    ]


def _condition(condition: Code, refused: Collection[str], found: Diagnostic) -> Condition:
    return Condition(_to_within(condition), State.NOT if refused else State.OK, found)


def _to_within(condition: Code) -> Diagnostic:
    """Return a condition with the tolerance that it is judged by."""
    return condition(tolerance=TOLERANCES[condition]) if condition in TOLERANCES else condition()


def _stated(
    condition: Code,
    figures: Sequence[JointFigures],
    what: str,
    unit: str,
    refused: Collection[str],
) -> Condition:
    values: dict[str, float] = {f.joint.name: getattr(f, what) for f in figures}
    limits = {f.joint.name: getattr(f.stated, what) for f in figures}
    most = max(values, key=values.__getitem__)
    found: dict[str, Any] = {"value": values[most], "unit": unit, "joint": most}
    missing = [joint for joint, limit in limits.items() if limit is None]
    if not refused and missing:
        some = missing if len(missing) < len(limits) else None
        return Condition(
            _to_within(condition), State.UNKNOWN, LIMITS_NOT_STATED(**found, missing=some)
        )
    return _condition(condition, refused, LARGEST_OF_JOINT(**found))


SCHEMA = "mrlab.check.1"
READY, NOT_READY = "ready", "not_ready"
# Numbers of the report have so many decimals: a micrometre, a microsecond.
DECIMALS = 6


@dataclass(frozen=True)
class RobotReport:
    """The report of one robot. figures: numbers by name, SI; joints: of each joint, by name."""

    name: str
    model: str
    end_effector: str
    trajectory: str = ""
    source: Mapping[str, str] = field(default_factory=dict)
    figures: Mapping[str, Any] = field(default_factory=dict)
    joints: Sequence[Mapping[str, Any]] = ()
    hardware: Sequence[Condition] = ()


@dataclass(frozen=True)
class CheckReport:
    """All that a check found. inputs: what it was computed from, digests of texts among it.

    extras: what only a cell has, as mappings for JSON.
    """

    title: str
    inputs: Mapping[str, Any]
    robots: Sequence[RobotReport]
    findings: tuple[Diagnostic, ...]
    duration: float | None = None
    clearances: Sequence[Clearance] = ()
    grasps: Sequence[GraspChange] = ()
    points: Sequence[Passed] = ()
    extras: Mapping[str, Any] = field(default_factory=dict)

    @property
    def verdict(self) -> str:
        return NOT_READY if self.refusing else READY

    @property
    def refusing(self) -> tuple[Diagnostic, ...]:
        return tuple(f for f in self.findings if f.refuses)

    @property
    def summary(self) -> Diagnostic:
        """Return the verdict and its grounds in short."""
        if self.refusing:
            first = self.refusing[0]
            return CHECK_NOT_READY(count=len(self.refusing), time=first.time, first=first)
        unknown = {c.condition for r in self.robots for c in r.hardware if c.state is _U}
        warnings = sum(f.severity > Severity.INFO for f in self.findings)
        return CHECK_READY(warnings=warnings or None, unknown=len(unknown) or None)

    def document(self) -> dict[str, Any]:
        """Return the report as JSON has it; `hash` is of all else in it."""
        document = rounded(
            {
                "schema": SCHEMA,
                "title": self.title,
                "verdict": self.verdict,
                "summary": plain(self.summary),
                "inputs": dict(self.inputs),
                "duration": self.duration,
                "robots": [
                    {**vars(r), "hardware": [c.plain() for c in r.hardware]} for r in self.robots
                ],
                "findings": [plain(f) for f in self.findings],
                "clearances": [
                    {**vars(c), "kind": c.kind.name.lower(), "far": c.far} for c in self.clearances
                ],
                "grasps": [
                    {
                        "time": g.time,
                        "robot": g.robot,
                        "state": g.state.name.lower(),
                        "object": g.object,
                        "reason": plain(g.reason) if g.reason else None,
                        "mass": g.load.mass if g.load else None,
                    }
                    for g in self.grasps
                ],
                "points": [vars(p) for p in self.points],
                **self.extras,
                "claim": plain(CLAIM()),
            }
        )
        return {**document, "hash": digest(document)}


_U = State.UNKNOWN


def digest(document: Any) -> str:
    """Return the sha256 of what JSON can hold, however its mappings are ordered."""
    text = json.dumps(document, sort_keys=True, separators=(",", ":"), allow_nan=False)
    return hashlib.sha256(text.encode()).hexdigest()


def in_order(findings: Iterable[Diagnostic]) -> tuple[Diagnostic, ...]:
    """Return the findings that refuse first, each kind by time; the same one once."""
    return tuple(
        sorted(
            dict.fromkeys(findings),
            key=lambda f: (-f.severity, f.time if f.time is not None else -1.0, f.robot, f.code),
        )
    )


def rounded(value: Any) -> Any:
    """Return plain mappings, lists and numbers: none that JSON cannot hold."""
    if isinstance(value, Mapping):
        return {str(key): rounded(each) for key, each in value.items()}
    if isinstance(value, (list, tuple)):
        return [rounded(each) for each in value]
    if isinstance(value, bool) or value is None or isinstance(value, (int, str)):
        return value
    number = float(value)
    return round(number, DECIMALS) + 0.0 if math.isfinite(number) else None
