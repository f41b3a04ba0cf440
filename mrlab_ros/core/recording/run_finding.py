"""Finds the runs of a session in its messages, each with its instant on the session's time."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import fields
from itertools import zip_longest

from mrlab_ros.core.base.clock import SECOND
from mrlab_ros.core.base.geometry import compose
from mrlab_ros.core.recording.diagnostics import (
    RUN_GRASPED,
    RUN_HANDED_OVER,
    RUN_HIT,
    RUN_LOST,
    RUN_MISSED,
    RUN_RELEASED,
)
from mrlab_ros.core.recording.moves import ObjectTrack, Targets
from mrlab_ros.core.recording.report import (
    HOLDING,
    Borne,
    ReportedState,
    RobotReport,
    SessionReport,
)
from mrlab_ros.core.recording.runs import Action, Deed, Result, Run

BORNE = tuple(each.name for each in fields(Borne))
BEGINS, ENDS = ("ADJUSTING", "PLAYING"), ("COMPLETE", "READY", "IDLE")
# s: what a robot does so soon after its run, such as opening its gripper, belongs to the run.
AFTER = 2.0
# s of a trajectory: a release so near to a programmed one is that one.
NEAR = 1.0
# ns: the stamps of two states that differ so much from their receipts are of a clock that was set.
SET_NS = SECOND
# s after its release an object counts as lying where it lies for good.
SETTLED = 2.0


def runs_of(
    report: SessionReport,
    objects: dict[str, ObjectTrack],
    targets: dict[str, Targets],
) -> list[Run]:
    """Return the runs of all robots in order of their beginnings, with what was done in each.

    targets: by robot, where its trajectories grasp and release.
    """
    found = []
    for robot in report.robots.values():
        runs = list(_runs(robot, report.duration))
        actions = list(_actions(robot, report.duration, objects, targets.get(robot.name)))
        for run, following in zip_longest(runs, runs[1:]):
            until = min(run.end + AFTER, following.start if following else math.inf)
            run.actions = sorted(
                (each for each in actions if run.start - 0.05 <= each.time < until),
                key=lambda each: each.time,
            )
        found += runs
    found.sort(key=lambda run: run.start)
    for number, run in enumerate(found, 1):
        run.number = number
    return found


def _runs(robot: RobotReport, end: float) -> Iterator[Run]:
    run: Run | None = None
    before: ReportedState | None = None
    for state in robot.reported:
        if run is not None and before is not None:
            same = (state.trajectory, state.version) == (run.trajectory, run.version)
            run.end = state.time
            if before.label == "PLAYING":
                run.position = _position(before, state)
            if state.label in ENDS or not same:
                done = state.label == "COMPLETE" and same
                run.result = Result.COMPLETED if done else Result.STOPPED
                yield run
                run = None
            else:
                _note(run, before, state)
        if run is None and state.label in BEGINS and state.trajectory:
            run = Run(
                robot.name,
                robot.model,
                state.trajectory,
                state.version,
                state.system,
                state.time,
                end,
                state.length,
                position=state.clock.position,
            )
            _note(run, None, state)
        before = state
    if run is not None and before is not None:
        run.end = end
        if before.label == "PLAYING":
            run.position = _within(
                before, before.clock.at(before.stamp_ns + _ns(end - before.time))
            )
        run.result = Result.HALTED if before.label == "COLLISION_HALT" else Result.OPEN
        yield run


def _note(run: Run, before: ReportedState | None, state: ReportedState) -> None:
    """Take note of a change within a run."""
    if state.label == "COLLISION_HALT" and (before is None or before.label != state.label):
        run.halts += 1
    if state.label != "PLAYING":
        return
    if not run.speeds or run.speeds[-1] != state.clock.rate:
        run.speeds.append(state.clock.rate)
    if before is not None and before.label == "PLAYING" and run.length:
        reached = before.clock.at(state.clock.stamp_ns - clock_step_ns(before, state))
        over = reached >= run.length - 1e-6 if state.clock.rate > 0 else reached <= 1e-6
        run.loops += over and abs(reached - state.clock.position) > run.length / 2


def clock_step_ns(before: ReportedState, state: ReportedState) -> int:
    """Return by how much the wall clock was set between two states, ns; 0: it was not."""
    step_ns = state.stamp_ns - before.stamp_ns - _ns(state.time - before.time)
    return step_ns if abs(step_ns) > SET_NS else 0


def _position(before: ReportedState, state: ReportedState) -> float:
    """Return where on its trajectory a robot was when it ceased to play, s."""
    if state.label in ("PAUSED", "COLLISION_HALT"):
        return state.clock.position
    return _within(before, before.clock.at(state.stamp_ns - clock_step_ns(before, state)))


def _within(state: ReportedState, position: float) -> float:
    return min(max(position, 0.0), state.length) if state.length else position


def _ns(seconds: float) -> int:
    return round(seconds * SECOND)


def _actions(
    robot: RobotReport,
    end: float,
    objects: dict[str, ObjectTrack],
    targets: Targets | None,
) -> Iterator[Action]:
    for contact in robot.collisions:
        said = RUN_HIT(robot=robot.name, other=contact.other, link=contact.link, row=contact.row)
        yield Action(contact.time, Deed.HIT, said)
    for time, remark in robot.remarks.values:
        yield Action(time, Deed.REMARK, remark)
    spans = robot.grasps.spans(end)
    before = ""
    for span, following in zip_longest(spans, spans[1:]):
        # Fingers are empty, too, once what they held is lost or handed over.
        if span.label == "EMPTY" and before != HOLDING:
            yield Action(span.start, Deed.MISSED, RUN_MISSED(robot=robot.name))
        before = span.label
        if span.label != HOLDING:
            continue
        track = objects.get(span.detail)
        place = None if track is None else track.at(span.start)
        borne = robot.borne.get(span.detail)
        load = dict.fromkeys(BORNE) if borne is None else vars(borne)
        said = RUN_GRASPED(
            object=span.detail,
            robot=robot.name,
            place=None if place is None else place.position,
            **load,
        )
        yield Action(span.start, Deed.GRASPED, said)
        if following is not None:
            lost = following.label == "EMPTY"
            yield _let_go(robot, span.detail, span.start, span.end, track, targets, lost=lost)


def _let_go(
    robot: RobotReport,
    name: str,
    since: float,
    time: float,
    track: ObjectTrack | None,
    targets: Targets | None,
    *,
    lost: bool,
) -> Action:
    """Return how an object left the gripper: where it lies then, and where it was to lie.

    lost: the fingers did not open.
    """
    taken = "" if track is None else track.taken_by(time, robot.name)
    if taken:
        said = RUN_HANDED_OVER(object=name, to=taken, robot=robot.name)
        return Action(time, Deed.HANDED_OVER, said)
    found = None if track is None else track.at_rest(time, SETTLED)
    place = None if found is None else found.position
    if lost:
        return Action(time, Deed.LOST, RUN_LOST(object=name, robot=robot.name, place=place))
    target = None
    in_tool = None if track is None else track.in_tool(since)
    if targets is not None and in_tool is not None:
        tool = targets.release(time, robot.position_at(time), NEAR)
        if tool is not None:
            target = compose(compose(robot.base_at(time), tool), in_tool).position
    off = None if place is None or target is None else math.dist(place, target)
    said = RUN_RELEASED(object=name, robot=robot.name, place=place, target=target, distance=off)
    return Action(time, Deed.RELEASED, said)


# A recorder on a busy machine receives this late at most, s. A stamp that is further from the
# receipt is of another clock: simulated time, or a replay's.
LATEST_S = 1.0


def time_of(received: float, stamp: float, before: float) -> float:
    """Return the time of a message, s of the session; never earlier than that of the one before.

    received, stamp: when the recorder received it and what its header says, s of the session.
    """
    return max(stamp if abs(stamp - received) <= LATEST_S else received, before)
