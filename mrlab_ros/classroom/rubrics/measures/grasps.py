"""Measures of what a gripper holds, when, and where it lets go."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np

from mrlab_ros.classroom.rubrics.diagnostics import (
    GRASPED,
    GRASPED_LATE,
    HELD,
    HELD_FOR,
    LIES_FROM_OBJECT,
    LIES_FROM_PLACE,
    NEVER_GRASPED,
    NEVER_GRASPED_CLOSES,
    NEVER_GRASPED_NOTHING,
    NEVER_GRASPED_OTHER,
    NO_OBJECT_CHECKED,
    NO_TOOL_TO_GRASP,
    NOT_HELD,
    NOT_IN_THE_ROOM,
    STILL_HELD,
    STILL_MOVES,
)
from mrlab_ros.classroom.rubrics.measures.contacts import recording
from mrlab_ros.classroom.rubrics.rubric import LENGTH, Ground, Measure, Outcome, Threshold
from mrlab_ros.classroom.rubrics.sentences import Form, Gaps, Given
from mrlab_ros.core.base.diagnostic import Diagnostic
from mrlab_ros.core.checking.check_record import Checked
from mrlab_ros.core.checking.rehearsal_record import Rehearsed
from mrlab_ros.core.physics.grasp.states import Grasp

# An object slower than this at the end, m/s, is at rest.
STANDS = 0.01
# Between the grasp of one robot and the next in a hand-over, s, nothing is dropped.
HAND_OVER = 0.15


@dataclass(frozen=True)
class Hold:
    """From when to when a robot holds an object, s; end: None: to the end of the motion."""

    robot: str
    object: str
    start: float
    end: float | None


def holds_of(recorded: Rehearsed) -> list[Hold]:
    """Return every hold in order of its beginning."""
    held: dict[str, Hold] = {}
    found: list[Hold] = []
    for change in recorded.grasps:
        now = held.get(change.robot)
        if now is not None and (change.state is not Grasp.HOLDING or change.object != now.object):
            found.append(Hold(now.robot, now.object, now.start, change.time))
            del held[change.robot]
        if change.state is Grasp.HOLDING and change.robot not in held:
            held[change.robot] = Hold(change.robot, change.object, change.time, None)
    return sorted([*found, *held.values()], key=lambda hold: (hold.start, hold.robot))


def _own(checked: Checked, robot: str, thing: str) -> list[Hold]:
    names = {motion.robot.name for motion in checked.of(robot)}
    return [h for h in holds_of(recording(checked)) if h.object == thing and h.robot in names]


def _never(checked: Checked, thing: str) -> Outcome:
    """Return what a test gets whose object is never held; the instant is that of the attempt."""
    recorded = recording(checked)
    closed = [g for g in recorded.grasps if g.state is not Grasp.OPEN]
    empty = next((g for g in closed if g.state is Grasp.EMPTY), None)
    other = next((g for g in closed if g.state is Grasp.HOLDING), None)
    if other is not None:
        found = NEVER_GRASPED_OTHER(object=thing, other=other.object, time=other.time)
        return Outcome(0.0, found, other.time)
    if empty is not None:
        why = empty.reason or None
        found = NEVER_GRASPED_NOTHING(object=thing, time=empty.time, why=why)
        return Outcome(0.0, found, empty.time)
    if closed:
        time = closed[0].time
        return Outcome(0.0, NEVER_GRASPED_CLOSES(object=thing, time=time), time)
    return Outcome(0.0, NEVER_GRASPED(object=thing), 0.0)


@dataclass(frozen=True)
class Grasps:
    """An object is grasped, between two instants, s."""

    robot: str
    thing: str
    since: float | None
    until: float | None

    def assess(self, checked: Checked, reference: Checked | None) -> Outcome:
        own = _own(checked, self.robot, self.thing)
        if not own:
            return _never(checked, self.thing)
        inside = [h for h in own if self._inside(h.start)]
        hold = inside[0] if inside else own[0]
        found = GRASPED(
            robot=hold.robot,
            object=self.thing,
            value=hold.start,
            unit="s",
            since=None if inside else self.since,
            until=None if inside else self.until,
        )
        return Outcome(1.0, found) if inside else Outcome(0.0, found, hold.start)

    def _inside(self, time: float) -> bool:
        return (self.since is None or time >= self.since) and (
            self.until is None or time <= self.until
        )

    def flaws(self, ground: Ground) -> Iterator[Diagnostic]:
        yield from ground.graspable_flaws(self.thing)
        yield from ground.robot_flaws(self.robot)
        yield from _no_gripper(ground, self.robot)


def _no_gripper(ground: Ground, robot: str) -> Iterator[Diagnostic]:
    robots = ground.of(robot)
    if robots and all(not r.end_effector for r in robots):
        yield NO_TOOL_TO_GRASP(robots=[r.name for r in robots])


@dataclass(frozen=True)
class Holds:
    """An object is held from `since` to `until`, s, by whomever it is; None: from the first grasp,
    and to the end. span: s, it is held so long without a gap, whenever that is."""

    thing: str
    since: float | None = None
    until: float | None = None
    span: float | None = None
    each: bool = False

    def assess(self, checked: Checked, reference: Checked | None) -> Outcome:
        recorded = recording(checked)
        spans = _joined([h for h in holds_of(recorded) if h.object == self.thing],
                        recorded.duration)  # fmt: skip
        if not spans:
            return _never(checked, self.thing)
        if self.span is not None:
            begin, end = max(spans, key=lambda s: s[1] - s[0])
            share = min((end - begin) / self.span, 1.0)
            found = HELD_FOR(object=self.thing, value=end - begin, limit=self.span, unit="s")
            return self._outcome(share, found, end)
        since = spans[0][0] if self.since is None else self.since
        until = recorded.duration if self.until is None else self.until
        if since > until:
            found = GRASPED_LATE(object=self.thing, value=since, limit=until, unit="s")
            return Outcome(0.0, found, since)
        held = sum(max(min(e, until) - max(b, since), 0.0) for b, e in spans)
        wanted = max(until - since, 0.0)
        share = held / wanted if wanted > 0 else float(any(b <= until <= e for b, e in spans))
        # From where on it is not held for the first time.
        lost = since
        for begin, end in spans:
            if begin <= lost + 1e-6 < end + 1e-6:
                lost = max(lost, min(end, until))
        of: dict[str, Any] = {"object": self.thing, "since": since, "until": until}
        of |= {"value": held, "limit": wanted, "unit": "s"}
        if share < 1 - 1e-6:
            return self._outcome(share, NOT_HELD(**of, time=lost), lost)
        return self._outcome(1.0, HELD(**of), lost)

    def _outcome(self, share: float, found: Diagnostic, time: float) -> Outcome:
        return Outcome(share if self.each or share >= 1 else 0.0, found, time)

    def flaws(self, ground: Ground) -> Iterator[Diagnostic]:
        yield from ground.graspable_flaws(self.thing)
        yield from _no_gripper(ground, "")


def _joined(holds: list[Hold], duration: float) -> list[tuple[float, float]]:
    """Return from when to when an object is held, a hand-over being one hold."""
    spans: list[tuple[float, float]] = []
    for hold in holds:
        end = duration if hold.end is None else hold.end
        if spans and hold.start <= spans[-1][1] + HAND_OVER:
            spans[-1] = (spans[-1][0], max(spans[-1][1], end))
        else:
            spans.append((hold.start, end))
    return spans


@dataclass(frozen=True)
class Resting:
    """The pose of an object at the end. position, orientation: m in world; speed: m/s."""

    values: tuple[float, ...]
    speed: float
    held: str


def at_the_end(recorded: Rehearsed, thing: str) -> Resting | None:
    """Return where an object is at the end; None: it is not there any more."""
    course = recorded.objects.get(thing)
    gone = any(name == thing for _, name in recorded.gone)
    if course is None or not course.times or gone:
        return None
    speed = 0.0
    if len(course.times) > 1 and course.times[-1] > course.times[-2]:
        way = np.subtract(course.values[-1][:3], course.values[-2][:3])
        speed = float(np.linalg.norm(way)) / (course.times[-1] - course.times[-2])
    return Resting(
        tuple(course.values[-1]), speed, course.holders[-1][1] if course.holders else ""
    )


def let_go(checked: Checked, thing: str) -> tuple[float, Resting] | Outcome:
    """Return when an object was let go for the last time and where it is at rest then; or what a
    test gets where it was not."""
    recorded = recording(checked)
    own = [h for h in holds_of(recorded) if h.object == thing]
    if not own:
        return _never(checked, thing)
    if own[-1].end is None:
        found = STILL_HELD(object=thing, robot=own[-1].robot)
        return Outcome(0.0, found, recorded.duration)
    rests = at_the_end(recorded, thing)
    if rests is None:
        return Outcome(0.0, NOT_IN_THE_ROOM(object=thing), own[-1].end)
    if rests.speed > STANDS:
        found = STILL_MOVES(object=thing, value=rests.speed, limit=STANDS, unit="m/s")
        return Outcome(0.0, found, own[-1].end)
    return own[-1].end, rests


@dataclass(frozen=True)
class Releases:
    """An object is let go and lies at a place, m in world, or at another object as seen from
    above."""

    thing: str
    place: tuple[float, ...]
    other: str
    threshold: Threshold

    def assess(self, checked: Checked, reference: Checked | None) -> Outcome:
        found = let_go(checked, self.thing)
        if isinstance(found, Outcome):
            return found
        time, rests = found
        place = self.place
        if self.other:
            there = at_the_end(recording(checked), self.other)
            if there is None:
                return Outcome(0.0, NO_OBJECT_CHECKED(object=self.other), time)
            place = there.values[:2]
        off = float(np.linalg.norm(np.subtract(rests.values[: len(place)], place)))
        outcome = self.threshold.outcome
        if self.other:
            return outcome(LIES_FROM_OBJECT, off, time, object=self.thing, other=self.other)
        return outcome(LIES_FROM_PLACE, off, time, object=self.thing, place=place)

    def flaws(self, ground: Ground) -> Iterator[Diagnostic]:
        yield from ground.graspable_flaws(self.thing)
        yield from ground.object_flaws(self.other)
        yield from self.threshold.flaws()
        yield from _no_gripper(ground, "")


def _grasps(gaps: Gaps, given: Given) -> Measure:
    return Grasps(gaps.get("robot") or "", gaps["object"], gaps.get("from"), gaps.get("to"))


def _holds(gaps: Gaps, given: Given) -> Measure:
    return Holds(gaps["object"], gaps.get("from"), gaps.get("to"), gaps.get("time"), given.each)


def _releases(gaps: Gaps, given: Given) -> Measure:
    threshold = Threshold(LENGTH, gaps["length"], given.until)
    return Releases(gaps["object"], gaps.get("place") or (), gaps.get("thing") or "", threshold)


FAMILY = "grasps"
FORMS = (
    Form("grasps OBJECT [by ROBOT] between FROM and TO", _grasps,
         "The gripper holds it, by its fingers or its vacuum, and took it in that time."),
    Form("grasps OBJECT [by ROBOT] before TO", _grasps, "The same."),
    Form("grasps OBJECT [by ROBOT] after FROM", _grasps, "The same."),
    Form("grasps OBJECT [by ROBOT]", _grasps, "The same, at any time."),
    Form("holds OBJECT until the end", _holds, "From the first grasp on.", each=True),
    Form("holds OBJECT until TO", _holds, "From the first grasp on, without a loss.", each=True),
    Form("holds OBJECT from FROM to TO", _holds,
         "All that time; a hand-over is no loss.", each=True),
    Form("holds OBJECT for TIME", _holds, "So long without a loss.", each=True),
    Form("releases OBJECT within LENGTH of PLACE", _releases,
         "Let go, and at rest half a second after the end, its centre at that distance; a place "
         "of two numbers is seen from above.", until=LENGTH),
    Form("releases OBJECT within LENGTH of [the] THING", _releases,
         "The same, of the centre of another object, seen from above.", until=LENGTH),
)  # fmt: skip
