"""Whether a real controller would take a motion: each condition that one refuses for."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from enum import Enum

from mrlab_ros.core.checking.findings import Finding
from mrlab_ros.core.checking.joints import JointFigures

# What this list does not say; it stands beside every verdict.
CLAIM = (
    "This says what the model shows: nominal kinematics, convex hulls of the links, rigid bodies, "
    "the objects that the scene names, and prescribed joints. It knows no torque, no controller's "
    "own limits, no brakes, no cables, no people, and nothing of how the arm comes to the first "
    "frame. Run it first at low speed with a hand on the stop button."
)


class State(Enum):
    """Whether a condition holds."""

    OK = "ok"
    NOT = "not"
    UNKNOWN = "unknown"


@dataclass(frozen=True)
class Condition:
    """One condition. words: the figure against its limit, or why it is not known."""

    name: str
    state: State
    words: str


# Codes of the conversion that say that a joint jumps.
JUMPS = frozenset({"discontinuity", "jump_2pi"})
CONTACTS = frozenset({"collision", "begins_inside"})


def conditions(
    figures: Sequence[JointFigures], findings: Iterable[Finding], *, rehearsed: bool, scene: str
) -> list[Condition]:
    """Return every condition; figures: empty where no motion was found.

    rehearsed: whether the motion went through physics. scene: what it went through, in words.
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
        Condition(
            "positions inside their ranges", _unless("joint_limit" in codes),
            f"least room {nearest.room:.3g} rad, {nearest.joint.name} at "
            f"{nearest.room_time:.2f} s",
        ),
        Condition(
            "speeds below their limits", _unless("velocity_limit" in codes),
            f"at most {100 * fastest.speed_share:.0f}% of the limit, {fastest.joint.name} at "
            f"{fastest.speed_time:.2f} s",
        ),
        _stated("accelerations below their limits", figures, "acceleration", "rad/s^2", codes),
        _stated("jerks below their limits", figures, "jerk", "rad/s^3", codes),
        Condition(
            "begins at rest", _unless("moves_at_start" in codes),
            f"{first.first_speed:.2g} rad/s, {first.joint.name}",
        ),
        Condition(
            "ends at rest", _unless("moves_at_end" in codes),
            f"{last.last_speed:.2g} rad/s, {last.joint.name}",
        ),
        Condition(
            "continuous", _unless(bool(codes & (JUMPS | {"speed_step"}))),
            f"largest change of speed between two frames {step.speed_step:.2g} rad/s, "
            f"{step.joint.name} at {step.step_time:.2f} s",
        ),
        _contacts(codes, rehearsed=rehearsed, scene=scene),
    ]  # fmt: skip


def _without_motion(codes: set[str]) -> list[Condition]:
    """Return what the converter's refusal says, and that the rest is not known."""
    why = "no motion could be taken from the file"
    names = {
        "positions inside their ranges": {"joint_limit"},
        "speeds below their limits": {"velocity_limit"},
        "accelerations below their limits": set(),
        "jerks below their limits": set(),
        "begins at rest": set(),
        "ends at rest": set(),
        "continuous": {*JUMPS},
        "no collision": set(),
    }
    return [
        Condition(name, State.NOT, "refused by the conversion")
        if codes & refusing
        else Condition(name, State.UNKNOWN, why)
        for name, refusing in names.items()
    ]


def _unless(refused: bool) -> State:
    return State.NOT if refused else State.OK


def _stated(
    name: str, figures: Sequence[JointFigures], what: str, unit: str, codes: set[str]
) -> Condition:
    values: dict[str, float] = {f.joint.name: getattr(f, what) for f in figures}
    limits = {f.joint.name: getattr(f.stated, what) for f in figures}
    most = max(values, key=values.__getitem__)
    words = f"at most {values[most]:.3g} {unit}, {most}"
    missing = [joint for joint, limit in limits.items() if limit is None]
    if f"{what}_limit" in codes:
        return Condition(name, State.NOT, words)
    if missing:
        of = "no limit of it" if len(missing) == len(limits) else f"none of {', '.join(missing)}"
        return Condition(name, State.UNKNOWN, f"{words}; the model states {of}")
    return Condition(name, State.OK, words)


def _contacts(codes: set[str], *, rehearsed: bool, scene: str) -> Condition:
    if not rehearsed:
        return Condition("no collision", State.UNKNOWN, "the motion did not go through physics")
    return Condition("no collision", _unless(bool(codes & CONTACTS)), f"in {scene}")
