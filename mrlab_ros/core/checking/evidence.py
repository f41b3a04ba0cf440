"""Findings of a rehearsal in physics: collisions, distances, grasps."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, replace
from types import MappingProxyType
from typing import Any

from mrlab_ros.core.base.diagnostic import Diagnostic
from mrlab_ros.core.checking.diagnostics import (
    BEGINS_INSIDE,
    COLLIDES_AT_START,
    COLLISION,
    DROPS_OBJECT,
    FAILED_HAND_OVER,
    GRASPS_NOTHING,
    LEFT_THE_ROOM,
    LOSES_OBJECT,
    MISSED_HAND_OVER,
    NOTHING_TO_GRASP,
    PAYLOAD,
    TOO_CLOSE,
    UNCERTAIN_GRASP,
    WAITS_FOREVER,
)
from mrlab_ros.core.checking.rehearsal import FARTHEST
from mrlab_ros.core.checking.rehearsal_record import Collision, GraspChange, Rehearsed
from mrlab_ros.core.physics.diagnostics import PULLED_THROUGH, TORN_OFF
from mrlab_ros.core.physics.engine import Kind
from mrlab_ros.core.physics.grasp.states import Grasp

# A robot that comes nearer, m, without touching is a finding: what is measured in a real cell is
# seldom better.
CLOSE = 0.01
# What is said of a gripper that stays closed while another robot pulls.
PULLS = (PULLED_THROUGH.code, TORN_OFF.code)
# What falls less, m, was set down.
SET_DOWN = 0.01
# Between a robot's grasp and the other's loss in a hand-over, s.
HAND_OVER = 0.1
# How a conflict of two robots is resolved, by their names.
Advice = Mapping[frozenset[str], Diagnostic]
NO_ADVICE: Advice = MappingProxyType({})


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


def met(kind: Kind, other: str, other_link: str = "") -> dict[str, Any]:
    """Return what a robot touches or nears, as values of a diagnostic."""
    if kind is Kind.SELF:
        other, other_link = other_link, ""
    found = {"kind": kind.name.lower(), "other": other}
    return {**found, "other_link": other_link} if other_link else found


def of_collisions(recorded: Rehearsed, advice: Advice = NO_ADVICE) -> list[Diagnostic]:
    """Return a finding for each collision, with where it is and how to go round it.

    advice: how a conflict of two robots is resolved, by their names.
    """
    found = [
        (COLLIDES_AT_START if one.time <= 0 else COLLISION)(
            robot=one.robot,
            link=one.link,
            held=one.held or None,
            **met(one.kind, one.other, one.other_link),
            point=one.point,
            time=one.time,
            end=one.end,
            value=_deepest(recorded, one),
            limit=0.0,
            unit="m",
            advice=_advice(advice, one),
        )
        for one in recorded.collisions
    ]
    for robot, surfaces in recorded.begins_inside.items():
        found += [
            BEGINS_INSIDE(robot=robot, time=0.0, **met(Kind.SURFACE, surface))
            for surface in surfaces
        ]
    found += [WAITS_FOREVER(robot=robot, wait=wait) for robot, wait in recorded.stuck.items()]
    found += [LEFT_THE_ROOM(time=time, **met(Kind.OBJECT, name)) for time, name in recorded.gone]
    return found


def _advice(known: Advice, one: Collision | Clearance) -> Diagnostic | None:
    return known.get(frozenset((one.robot, one.other))) if one.kind is Kind.ROBOT else None


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


def of_distances(
    recorded: Rehearsed, closest: float = CLOSE, advice: Advice = NO_ADVICE
) -> list[Diagnostic]:
    """Return a finding for everything that a robot comes close to without touching it.

    closest: m. What it grasps at some time, and what it touches, is left out. advice: how a
    conflict of two robots is resolved, by their names.
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
        found.append(
            TOO_CLOSE(
                robot=one.robot,
                link=one.link,
                held=one.held or None,
                **met(one.kind, one.other, one.other_link),
                time=one.time,
                value=max(one.distance, 0.0),
                limit=closest,
                unit="m",
                advice=_advice(advice, one),
            )
        )
    return found


def of_grasps(recorded: Rehearsed, objects: Iterable[str]) -> list[Diagnostic]:
    """Return what is to be said of the grasps. objects: those of the scene that can be held."""
    found = []
    held: dict[str, str] = {}
    some = set(objects)
    for change in recorded.grasps:
        before = held.get(change.robot, "")
        at: dict[str, Any] = {
            "robot": change.robot,
            "time": change.time,
            "why": change.reason or None,
        }
        if change.state is Grasp.HOLDING and before == change.object:
            if change.reason:
                found.append(UNCERTAIN_GRASP(**at, **met(Kind.OBJECT, change.object)))
        elif change.state is Grasp.HOLDING:
            held[change.robot] = change.object
            found += _of_load(change)
        elif change.reason is not None and change.reason.code in PULLS:
            found.append(
                FAILED_HAND_OVER(**at, **met(Kind.OBJECT, change.reason.values["object"]))
            )
        elif change.state is Grasp.EMPTY and before:
            held.pop(change.robot)
            if not _taken(recorded, change, before):
                found.append(LOSES_OBJECT(**at, **met(Kind.OBJECT, before)))
        elif change.state is Grasp.EMPTY and not some:
            found.append(NOTHING_TO_GRASP(robot=change.robot, time=change.time))
        elif change.state is Grasp.EMPTY:
            giver = _last_let_go(recorded, change)
            if giver is None:
                found.append(GRASPS_NOTHING(**at))
            else:
                ago = change.time - giver.time
                thing = met(Kind.OBJECT, giver.object)
                found.append(MISSED_HAND_OVER(**at, **thing, giver=giver.robot, ago=ago))
        elif change.state is Grasp.OPEN:
            held.pop(change.robot, None)
    return found + [
        DROPS_OBJECT(
            robot=drop.robot,
            time=drop.time,
            **met(Kind.OBJECT, drop.object),
            value=drop.height,
            limit=SET_DOWN,
            unit="m",
        )
        for drop in recorded.drops
        if drop.height > SET_DOWN
    ]


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


def _of_load(change: GraspChange) -> list[Diagnostic]:
    load = change.load
    if load is None or not 0 < load.payload < load.mass:
        return []
    return [
        PAYLOAD(
            robot=change.robot,
            time=change.time,
            **met(Kind.OBJECT, change.object),
            value=load.mass,
            limit=load.payload,
            unit="kg",
        )
    ]
