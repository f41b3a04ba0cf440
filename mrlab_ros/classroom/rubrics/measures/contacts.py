"""Measures of contact and distance."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from mrlab_ros.classroom.rubrics.diagnostics import (
    BEYOND_MEASURE,
    LEAST_DISTANCE,
    NO_DISTANCE,
    NOTHING_NEAR,
    NOTHING_TOUCHED,
    SELF_DISTANCE,
    STARTS_INSIDE,
    TOUCHES,
)
from mrlab_ros.classroom.rubrics.rubric import ITSELF, LENGTH, Ground, Measure, Outcome, Threshold
from mrlab_ros.classroom.rubrics.sentences import Form, Gaps, Given
from mrlab_ros.core.base.diagnostic import Diagnostic
from mrlab_ros.core.checking.check_record import Checked
from mrlab_ros.core.checking.evidence import met
from mrlab_ros.core.checking.rehearsal import FARTHEST
from mrlab_ros.core.checking.rehearsal_record import Collision, Distances, Rehearsed
from mrlab_ros.core.physics.engine import Kind


def recording(checked: Checked) -> Rehearsed:
    """Return what was recorded; only files that hold a motion are assessed."""
    assert checked.recorded is not None
    return checked.recorded


def _names(checked: Checked, robot: str) -> set[str]:
    return {motion.robot.name for motion in checked.of(robot)}


@dataclass(frozen=True)
class NoCollision:
    """robot: its name or model; thing: an object, a surface, a robot or `itself`; empty: all."""

    robot: str
    thing: str

    def assess(self, checked: Checked, reference: Checked | None) -> Outcome:
        recorded = recording(checked)
        names = _names(checked, self.robot)
        hits = sorted(
            (hit for hit in recorded.collisions if self._counts(hit, names)), key=lambda h: h.time
        )
        inside = [
            (robot, surface)
            for robot, surfaces in recorded.begins_inside.items()
            for surface in surfaces
            if robot in names and self.thing in ("", surface)
        ]
        count = len(hits) + len(inside)
        more = count - 1 or None
        if not count:
            return Outcome(1.0, NOTHING_TOUCHED())
        if inside:
            robot, surface = inside[0]
            found = STARTS_INSIDE(robot=robot, **met(Kind.SURFACE, surface), more=more)
            return Outcome(0.0, found, 0.0)
        first = hits[0]
        found = TOUCHES(
            robot=first.robot,
            link=first.link,
            held=first.held or None,
            **met(first.kind, first.other, first.other_link),
            time=first.time,
            more=more,
        )
        return Outcome(0.0, found, first.time)

    def _counts(self, hit: Collision, names: set[str]) -> bool:
        other = ITSELF if hit.kind is Kind.SELF else hit.other
        if hit.robot in names and self.thing in ("", other):
            return True
        # Two robots that touch are told of one of them.
        return hit.kind is Kind.ROBOT and hit.other in names and self.thing in ("", hit.robot)

    def flaws(self, ground: Ground) -> Iterator[Diagnostic]:
        yield from ground.robot_flaws(self.robot)
        yield from ground.thing_flaws(self.thing)


@dataclass(frozen=True)
class Distance:
    """The least distance of `robot` to `thing`, to all but `but` where there is none."""

    robot: str
    thing: str
    but: str
    threshold: Threshold

    def assess(self, checked: Checked, reference: Checked | None) -> Outcome:
        recorded = recording(checked)
        names = _names(checked, self.robot)
        near = [
            (series.values[at], recorded.times[at], robot, kind, other, series, at)
            for (robot, (kind, other)), every in recorded.distances.items()
            for series in [every.without(self.but, FARTHEST)]
            if self._counts(robot, other, kind, names) and series.values
            for at in [series.least()]
        ]
        if not near:
            return Outcome(0.0, NO_DISTANCE(thing=self.thing or None), 0.0)
        value, time, robot, kind, other, series, at = min(near, key=lambda n: n[:2])
        if not series.links[at]:
            far = NOTHING_NEAR(value=FARTHEST, limit=self.threshold.limit, unit="m")
            return Outcome(1.0, far)
        return self.threshold.outcome(
            LEAST_DISTANCE,
            max(value, 0.0),
            self._since(recorded, series, time),
            link=series.links[at],
            held=series.held[at] or None,
            robot=robot if len(checked.motions) > 1 else None,
            time=time,
            **met(kind, other, series.other_links[at]),
        )

    def _since(self, recorded: Rehearsed, series: Distances, least: float) -> float:
        """Return when it first is too near."""
        both = zip(recorded.times, series.values, strict=False)
        return next((t for t, d in both if d < self.threshold.limit), least)

    def _counts(self, robot: str, other: str, kind: Kind, names: set[str]) -> bool:
        if self.but and other == self.but:
            return False
        if robot in names and self.thing in ("", other):
            return True
        return kind is Kind.ROBOT and other in names and self.thing in ("", robot)

    def flaws(self, ground: Ground) -> Iterator[Diagnostic]:
        yield from ground.robot_flaws(self.robot)
        yield from ground.thing_flaws(self.thing)
        yield from ground.thing_flaws(self.but)
        yield from self.threshold.flaws()
        if self.thing == ITSELF:
            yield SELF_DISTANCE()
        if self.threshold.limit > FARTHEST:
            yield BEYOND_MEASURE(most=FARTHEST, limit=self.threshold.limit)


def _thing(gaps: Gaps) -> str:
    name = gaps.get("thing") or gaps.get("other") or ""
    return "" if name in ("anything", "everything") else name


def _no_collision(gaps: Gaps, given: Given) -> Measure:
    return NoCollision(gaps.get("robot") or "", _thing(gaps))


def _distance(gaps: Gaps, given: Given) -> Measure:
    threshold = Threshold(LENGTH, gaps["length"], given.until, at_least=True)
    return Distance(gaps.get("robot") or "", _thing(gaps), gaps.get("object") or "", threshold)


FAMILY = "contact and distance"
FORMS = (
    Form(
        "no collision [of ROBOT] [with [the] THING]", _no_collision,
        "No link and nothing held touches anything, or THING: an object, a surface, a robot, "
        "`floor`, `itself`.",
    ),
    Form(
        "distance [of ROBOT] [to [the] THING] > LENGTH", _distance,
        "The least distance to everything, or to THING, from the collision hulls, every 20 ms.",
        until=LENGTH,
    ),
    Form(
        "distance [of ROBOT] to everything but [the] OBJECT > LENGTH", _distance,
        "The same, without what is picked up.", until=LENGTH,
    ),
    Form(
        "distance between ROBOT and OTHER > LENGTH", _distance,
        "The least distance of two robots of a cell.", until=LENGTH,
    ),
)  # fmt: skip
