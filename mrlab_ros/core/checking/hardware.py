"""Whether a real controller would take a motion: each condition that one refuses for."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Sequence
from dataclasses import dataclass
from enum import Enum
from typing import Any

from mrlab_ros.core.base.diagnostic import Code, Diagnostic, plain
from mrlab_ros.core.checking.diagnostics import (
    ACCELERATION_LIMIT,
    ACCELERATIONS_IN_LIMITS,
    BEGINS_AT_REST,
    BEGINS_INSIDE,
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
    SPEED_AT_END,
    SPEED_STEP,
    SPEEDS_IN_LIMITS,
)
from mrlab_ros.core.checking.joints import JointFigures


class State(Enum):
    """Whether a condition holds."""

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
JUMPS = frozenset({"discontinuity", "jump_2pi"})
RANGES = frozenset({"joint_limit", OUTSIDE_RANGE.code})
SPEEDS = frozenset({"velocity_limit", OVER_SPEED.code})
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
            CONTINUOUS, codes & {*JUMPS, SPEED_STEP.code},
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
        Condition(condition(), State.NOT, REFUSED_BY_CONVERSION())
        if codes & refused
        else Condition(condition(), State.UNKNOWN, NO_MOTION_IN_FILE())
        for condition, refused in refusing.items()
    ]


def _condition(condition: Code, refused: Collection[str], found: Diagnostic) -> Condition:
    return Condition(condition(), State.NOT if refused else State.OK, found)


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
        return Condition(condition(), State.UNKNOWN, LIMITS_NOT_STATED(**found, missing=some))
    return _condition(condition, refused, LARGEST_OF_JOINT(**found))
