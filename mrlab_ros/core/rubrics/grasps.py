"""Measures of what a gripper holds, when, and where it lets go."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from mrlab_ros.core.checking.recording import Rehearsed
from mrlab_ros.core.physics.grasp import Grasp
from mrlab_ros.core.rubrics.checked import Checked
from mrlab_ros.core.rubrics.contacts import recording
from mrlab_ros.core.rubrics.ground import Ground
from mrlab_ros.core.rubrics.quantities import LENGTH
from mrlab_ros.core.rubrics.rubric import Measure, Outcome
from mrlab_ros.core.rubrics.sentences import Form, Gaps, Given
from mrlab_ros.core.rubrics.threshold import Threshold

# What moves slower at the end, m/s, is at rest.
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
        words = f"{thing} is never grasped; {other.object} is, at {other.time:.2f} s."
        return Outcome(0.0, words, other.time)
    if empty is not None:
        why = f": {empty.reason}" if empty.reason else ""
        words = (
            f"{thing} is never grasped; the gripper closes on nothing at {empty.time:.2f} s{why}"
        )
        return Outcome(0.0, f"{words.rstrip('.')}.", empty.time)
    if closed:
        words = f"{thing} is never grasped; the gripper closes at {closed[0].time:.2f} s."
        return Outcome(0.0, words, closed[0].time)
    return Outcome(0.0, f"{thing} is never grasped; the gripper does not close.", 0.0)


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
        words = f"{hold.robot} grasps {self.thing} at {hold.start:.2f} s"
        early = self.since is not None and hold.start < self.since
        limit = self.since if early or self.until is None else self.until
        if inside:
            return Outcome(1.0, f"{words}.", None, hold.start, limit, "s")
        return Outcome(0.0, f"{words}; expected {self._span}.", hold.start, hold.start, limit, "s")

    def _inside(self, time: float) -> bool:
        return (self.since is None or time >= self.since) and (
            self.until is None or time <= self.until
        )

    @property
    def _span(self) -> str:
        if self.since is None:
            return f"before {self.until:g} s"
        if self.until is None:
            return f"after {self.since:g} s"
        return f"between {self.since:g} and {self.until:g} s"

    def flaws(self, ground: Ground) -> Iterator[str]:
        yield from ground.graspable_flaws(self.thing)
        yield from ground.robot_flaws(self.robot)
        yield from _no_gripper(ground, self.robot)


def _no_gripper(ground: Ground, robot: str) -> Iterator[str]:
    robots = ground.of(robot)
    if robots and all(not r.end_effector for r in robots):
        names = ", ".join(r.name for r in robots)
        yield f"{names} has no tool to grasp with; add tool: parallel_gripper to the rubric"


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
            words = f"{self.thing} is held for {end - begin:.2f} s; expected {self.span:g} s."
            return self._outcome(share, words, end, end - begin, self.span)
        since = spans[0][0] if self.since is None else self.since
        until = recorded.duration if self.until is None else self.until
        if since > until:
            words = f"{self.thing} is grasped at {since:.2f} s; expected before {until:g} s."
            return Outcome(0.0, words, since, since, until, "s")
        held = sum(max(min(e, until) - max(b, since), 0.0) for b, e in spans)
        wanted = max(until - since, 0.0)
        share = held / wanted if wanted > 0 else float(any(b <= until <= e for b, e in spans))
        # From where on it is not held for the first time.
        lost = since
        for begin, end in spans:
            if begin <= lost + 1e-6 < end + 1e-6:
                lost = max(lost, min(end, until))
        expected = f"from {since:.2f} to {until:.2f} s"
        words = f"{self.thing} is held {expected}."
        if share < 1 - 1e-6:
            words = f"{self.thing} is not held at {lost:.2f} s; expected {expected}."
        return self._outcome(1.0 if share >= 1 - 1e-6 else share, words, lost, held, wanted)

    def _outcome(
        self, share: float, words: str, time: float, measured: float, limit: float
    ) -> Outcome:
        share = share if self.each or share >= 1 else 0.0
        return Outcome(share, words, time, measured, limit, "s")

    def flaws(self, ground: Ground) -> Iterator[str]:
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
    """Where an object is at the end. position, orientation: m in world; speed: m/s."""

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
        words = f"{thing} is still held by {own[-1].robot} at the end."
        return Outcome(0.0, words, recorded.duration)
    rests = at_the_end(recorded, thing)
    if rests is None:
        return Outcome(0.0, f"{thing} is not in the room any more at the end.", own[-1].end)
    if rests.speed > STANDS:
        words = f"{thing} still moves at the end, with {rests.speed:.2g} m/s."
        return Outcome(0.0, words, own[-1].end, rests.speed, STANDS, "m/s")
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
        place, name = self.place, f"({', '.join(f'{v:.4g}' for v in self.place)})"
        if self.other:
            there = at_the_end(recording(checked), self.other)
            if there is None:
                return Outcome(0.0, f"There is no {self.other} in what was checked.", time)
            place, name = there.values[:2], self.other
        off = float(np.linalg.norm(np.subtract(rests.values[: len(place)], place)))
        return self.threshold.outcome(off, f"{self.thing} lies {{}} away from {name}", time)

    def flaws(self, ground: Ground) -> Iterator[str]:
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
