"""What a rehearsal in physics says: collisions, distances, grasps, as findings."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, replace

from mrlab_ros.core.base.diagnostic import Diagnostic, Severity
from mrlab_ros.core.checking.findings import Finding
from mrlab_ros.core.checking.recording import Collision, GraspChange, Rehearsed
from mrlab_ros.core.checking.rehearsal import FARTHEST
from mrlab_ros.core.physics.engine import Kind
from mrlab_ros.core.physics.grasp import Grasp

# A robot that comes nearer, m, without touching is a finding: what is measured in a real cell is
# seldom better.
CLOSE = 0.01
# Between a robot's grasp and the other's loss in a hand-over, s.
HAND_OVER = 0.1


@dataclass(frozen=True)
class Clearance:
    """The least distance of a robot to something. distance: m; far: it was never nearer than
    `distance`. time: s; link: of the robot, held: in its hand."""

    robot: str
    kind: Kind
    other: str
    distance: float
    time: float
    link: str = ""
    other_link: str = ""
    held: str = ""

    @property
    def far(self) -> bool:
        return not self.link


def clearances(recorded: Rehearsed) -> list[Clearance]:
    """Return the least distance to everything, the nearest first."""
    found = []
    for (robot, (kind, other)), series in recorded.distances.items():
        at = series.least()
        found.append(
            Clearance(
                robot, kind, other, series.values[at] if series.links[at] else FARTHEST,
                recorded.times[at], series.links[at], series.other_links[at], series.held[at],
            )
        )  # fmt: skip
    return sorted(found, key=lambda c: (c.far, c.distance, c.robot, c.other))


def thing(kind: Kind, other: str, other_link: str = "") -> str:
    """Return the words for what a robot touches or nears."""
    if kind is Kind.SELF:
        return f"its own {other_link}"
    if kind is Kind.ROBOT:
        return f"{other_link} of {other}" if other_link else other
    return f"the {other}" if other == "floor" else other


def of_collisions(recorded: Rehearsed) -> list[Finding]:
    """Return a finding for each collision, with where it is and how to go round it."""
    found = []
    for one in recorded.collisions:
        what = thing(one.kind, one.other, one.other_link)
        who = f"{one.held}, held by {one.link}," if one.held else one.link
        place = ", ".join(f"{v:.3g}" for v in one.point)
        depth = _deepest(recorded, one)
        found.append(
            Finding(
                "collision", Severity.ERROR,
                f"{who} touches {what} at {place} m.",
                _remedy(one.kind, one.time, one.other),
                one.robot, one.link, one.time, one.end, depth, 0.0, "m",
                one.kind.name.lower(), one.other,
            )
        )  # fmt: skip
    for robot, surfaces in recorded.begins_inside.items():
        found += [
            Finding(
                "begins_inside", Severity.ERROR,
                f"The arm begins inside the surface {surface}.",
                "Correct the first frame, or where the robot stands in the scene.",
                robot, "", 0.0,
            )
            for surface in surfaces
        ]  # fmt: skip
    found += [
        Finding(
            "waits_for_ever", Severity.ERROR,
            f"It waits for ever: '{wait}' does not come true.",
            "Correct the wait, or the motion that it waits for.",
            robot,
        )
        for robot, wait in recorded.stuck.items()
    ]  # fmt: skip
    found += [
        Finding(
            "left_the_room", Severity.WARNING,
            f"{name} left the room and was removed.",
            "Look at what pushed or dropped it.",
            "", "", time,
        )
        for time, name in recorded.gone
    ]  # fmt: skip
    return found


def _deepest(recorded: Rehearsed, one: Collision) -> float:
    """Return how far a robot goes into what it touches until it is clear again, m."""
    pair = (one.robot, (one.kind, one.other))
    if pair not in recorded.distances and one.kind is Kind.ROBOT:
        pair = (one.other, (one.kind, one.robot))
    series = recorded.distances.get(pair)
    values = [
        -value
        for time, value in zip(recorded.times, series.values if series else (), strict=False)
        if one.time - 0.02 <= time and (one.end is None or time <= one.end)
    ]
    return max([one.depth, *values])


def _remedy(kind: Kind, time: float, other: str) -> str:
    if time <= 0:
        return "The first frame touches it already: begin elsewhere, or move what stands there."
    if kind is Kind.SELF:
        return "Bend the arm less there, or go through another configuration."
    if kind is Kind.ROBOT:
        return "Let one of the two wait, or give them ways that do not cross."
    if kind is Kind.SURFACE:
        return "Lift the way there; add a point above it."
    return f"Lead the way round {other}, or move it; the lab would halt the arm here."


def of_distances(recorded: Rehearsed, closest: float = CLOSE) -> list[Finding]:
    """Return a finding for everything that a robot comes close to without touching it.

    closest: m. What it grasps at some time, and what it touches, is left out.
    """
    grasped = {(c.robot, c.object) for c in recorded.grasps if c.object}
    touched = {(c.robot, c.kind, c.other) for c in recorded.collisions}
    touched |= {(c.other, c.kind, c.robot) for c in recorded.collisions if c.kind is Kind.ROBOT}
    found = []
    for one in clearances(recorded):
        if one.far or one.distance >= closest or (one.robot, one.other) in grasped:
            continue
        if (one.robot, one.kind, one.other) in touched or (one.held and one.distance <= 0):
            continue
        who = one.held or one.link
        found.append(
            Finding(
                "close", Severity.WARNING,
                f"{who} comes within {1e3 * max(one.distance, 0.0):.2g} mm of "
                f"{thing(one.kind, one.other, one.other_link)}.",
                "Keep more distance: a real cell is measured less exactly than this one.",
                one.robot, one.link, one.time, None, one.distance, closest, "m",
                one.kind.name.lower(), one.other,
            )
        )  # fmt: skip
    return found


def of_grasps(recorded: Rehearsed, objects: Iterable[str]) -> list[Finding]:
    """Return what is to be said of the grasps. objects: those of the scene that can be held."""
    found = []
    held: dict[str, str] = {}
    some = set(objects)
    for change in recorded.grasps:
        before = held.get(change.robot, "")
        if change.state is Grasp.HOLDING and before == change.object:
            if change.reason:
                found.append(
                    Finding(
                        "grasp", Severity.WARNING,
                        f"{change.object} in the gripper{_because(change.reason)}.",
                        "Move more gently there, or grasp it nearer to its centre of mass.",
                        change.robot, "", change.time,
                    )
                )  # fmt: skip
        elif change.state is Grasp.HOLDING:
            held[change.robot] = change.object
            found += _of_load(change)
        elif change.state is Grasp.EMPTY and before:
            held.pop(change.robot)
            if _taken(recorded, change, before):
                continue
            found.append(
                Finding(
                    "loses_object", Severity.ERROR,
                    f"It loses {before}{_because(change.reason)}.",
                    "Grasp it nearer to its centre of mass, move more gently, or take a stronger "
                    "gripper.",
                    change.robot, "", change.time,
                )
            )  # fmt: skip
        elif change.state is Grasp.EMPTY and some:
            why = str(change.reason or "").rstrip(".")
            remedy = "the distances say how far it was away."
            giver = _last_let_go(recorded, change)
            if giver is not None:
                ago = change.time - giver.time
                told = f"{giver.robot} let go of {giver.object} {ago:.1f} s before"
                why = f"{why}; {told}" if why else told
                remedy = (
                    f"for a hand-over of {giver.object}, close it while {giver.robot} still holds "
                    "it: in a parallel cell, with 'after:' where one is early."
                )
            found.append(
                Finding(
                    "grasps_nothing", Severity.WARNING,
                    f"The gripper closes on nothing{f': {why}' if why else ''}.",
                    f"Close it where an object is; {remedy}",
                    change.robot, "", change.time,
                )
            )  # fmt: skip
        elif change.state is Grasp.OPEN:
            held.pop(change.robot, None)
    return found


def _because(reason: Diagnostic | None) -> str:
    return f": {reason}".rstrip(".") if reason is not None else ""


def _taken(recorded: Rehearsed, lost: GraspChange, thing: str) -> bool:
    """Return whether another robot took what a robot no longer holds: a hand-over."""
    return any(
        other.state is Grasp.HOLDING
        and other.object == thing
        and other.robot != lost.robot
        and abs(other.time - lost.time) <= HAND_OVER
        for other in recorded.grasps
    )


def _last_let_go(recorded: Rehearsed, missed: GraspChange) -> GraspChange | None:
    """Return who last let go of what before another robot closed on nothing, held by nobody then.

    Returns the giver's name and object at the time it opened; None: there is no such object.
    """
    held: dict[str, str] = {}
    last = None
    for change in recorded.grasps:
        if change.time > missed.time:
            break
        before = held.pop(change.robot, "")
        if change.state is Grasp.HOLDING:
            held[change.robot] = change.object
        elif before and change.state is Grasp.OPEN and change.robot != missed.robot:
            last = replace(change, object=before)
    return None if last is None or last.object in held.values() else last


def _of_load(change: GraspChange) -> list[Finding]:
    load = change.load
    if load is None or not 0 < load.payload < load.mass:
        return []
    return [
        Finding(
            "payload", Severity.ERROR,
            f"It carries {load.mass:.3g} kg in {change.object}; the robot may carry "
            f"{load.payload:.3g} kg beside its end effector.",
            "Take a lighter object, or a robot with more payload.",
            change.robot, "", change.time, None, load.mass, load.payload, "kg",
        )
    ]  # fmt: skip
