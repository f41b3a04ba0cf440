"""What happened in a session, from what its messages tell."""

from __future__ import annotations

import json
from types import SimpleNamespace

import numpy as np
import pytest

from mrlab_ros.adapters.bags.diagnostics import BAG_NO_INDEX, CLOCK_SET_BACK
from mrlab_ros.core.base.clock import PlaybackClock
from mrlab_ros.core.base.diagnostic import plain
from mrlab_ros.core.recording.diagnostics import RUN_MISSED
from mrlab_ros.core.recording.report import (
    Borne,
    Changes,
    Contact,
    Hop,
    ReferenceTrajectory,
    ReportedState,
    RobotReport,
    Series,
    SessionReport,
)
from mrlab_ros.core.recording.report_text import report_lines
from mrlab_ros.core.recording.runs import Action, Deed, Result, Run

SECOND = 1_000_000_000
COURSE = ReferenceTrajectory(10.0, np.column_stack([np.arange(11.0), -np.arange(11.0)]))


def test_the_same_told_again_is_no_change():
    changes = Changes()
    for time, label in ((0.0, "READY"), (1.0, "PLAYING"), (2.0, "PLAYING"), (4.0, "READY")):
        changes.add(time, label)
    spans = [(span.start, span.end, span.label) for span in changes.spans(9.0)]
    assert spans == [(0.0, 1.0, "READY"), (1.0, 4.0, "PLAYING"), (4.0, 9.0, "READY")]
    assert Changes().spans(9.0) == []


def test_a_value_changes_with_what_is_said_of_it_but_not_with_figures():
    states = Changes()
    said = [CLOCK_SET_BACK(time=time, by=2.0, then="even") for time in (1.0, 2.0)]
    for time, each in enumerate((None, said[0], said[1], RUN_MISSED(), None)):
        states.add(float(time), "PAUSED", said=each)
    assert [(span.start, span.said) for span in states.spans(5.0)] == [
        (0.0, None), (1.0, said[0]), (3.0, RUN_MISSED()), (4.0, None),
    ]  # fmt: skip


@pytest.mark.parametrize(
    ("position", "expected"),
    [(0.0, 0.0), (0.25, 2.5), (1.0, 10.0), (1.0 + 1e-9, 10.0), (1.1, None), (-0.1, None)],
)
def test_a_course_is_linear_between_frames_and_nothing_outside(position, expected):
    found = COURSE.at(position)
    if expected is None:
        assert found is None
    else:
        assert found == pytest.approx([expected, -expected])


def told(stamp, label, position=0.0, rate=1.0, clock_stamp=None, trajectory="wave"):
    clock_ns = round((stamp if clock_stamp is None else clock_stamp) * SECOND)
    return ReportedState(
        round(stamp * SECOND), label, trajectory, PlaybackClock(clock_ns, position, rate)
    )


def compared(robot, stamp, positions):
    before = len(robot.tracking.values)
    robot.compare(0.0, round(stamp * SECOND), np.array(positions), {"wave": COURSE})
    return robot.tracking.values[before:]


def test_a_joint_state_is_compared_with_the_trajectory_at_its_stamp():
    robot = RobotReport("ur5e_1")
    assert compared(robot, 0.0, [0.0, 0.0]) == []
    robot.add(told(1.0, "READY"))
    assert compared(robot, 1.5, [0.0, 0.0]) == []
    # ReportedState a moment after the first frame was due.
    robot.add(told(2.01, "PLAYING", clock_stamp=2.0))
    assert compared(robot, 2.0, [0.0, 0.0]) == [0.0]
    assert compared(robot, 2.5, [5.0, -5.25]) == [0.25]
    robot.add(told(2.6, "PAUSED", 0.6, 0.0))
    assert compared(robot, 2.7, [7.0, -7.0]) == []
    robot.add(told(3.0, "PLAYING", 0.6, 2.0))
    assert compared(robot, 3.1, [8.0, -8.0]) == pytest.approx([0.0])
    assert compared(robot, 3.1, [8.0]) == []
    robot.add(told(4.0, "PLAYING", trajectory="unknown"))
    assert compared(robot, 4.1, [1.0, 1.0]) == []


def test_figures_of_a_series():
    series = Series()
    assert series.summary() == {"count": 0, "p50": None, "p95": None, "max": None}
    for value in (1.0, 2.0, 3.0):
        series.add(0.0, value)
    assert series.summary() == {"count": 3, "p50": 2.0, "p95": pytest.approx(2.9), "max": 3.0}


def test_the_facts_tell_everything():
    trouble = BAG_NO_INDEX(file="x_0.mcap")
    report = SessionReport(20.0, 0, troubles=[trouble])
    robot = report.robot("ur5e_1")
    assert report.robot("ur5e_1") is robot
    robot.model = "ur5e"
    robot.collisions.append(Contact(10.0, "wrist_3_link", "table", 412))
    robot.grasps.add(2.0, "HOLDING", "cube_1")
    robot.grasps.add(5.0, "OPEN")
    for needed in (0.2, 0.5, 0.3):
        grasp = SimpleNamespace(
            mass=1.5, payload=4.0, friction=0.9, friction_needed=needed, wrist_moment=2.0
        )
        robot.bear("cube_1", grasp)
    robot.tracking.add(1.0, 0.5)
    assert robot.borne["cube_1"] == Borne(1.5, 4.0, 0.9, 0.5, 2.0)
    lines = report_lines(report)
    assert lines[:2] == [report.summary.message, trouble.message]
    assert "    tracking error: p50 0.5 rad, p95 0.5 rad, max 0.5 rad (1)" in lines
    robot.latency[Hop("published_to_bridged")] = Series([1.0], [0.002])
    facts = report.facts()
    assert facts["troubles"] == [plain(trouble)]
    assert facts["summary"]["values"] == {"duration": 20.0, "robots": 1, "runs": 0}
    told = facts["robots"][0]
    assert told["collisions"][0]["row"] == 412
    assert told["grasps"][0] == {
        "start": 2.0, "end": 5.0, "label": "HOLDING", "detail": "cube_1", "said": None,
    }  # fmt: skip
    assert told["latency"] == [
        {"ends": "published_to_bridged", "observer": "", "count": 1, "p50": 0.002, "p95": 0.002,
         "max": 0.002}
    ]  # fmt: skip
    json.dumps(facts, allow_nan=False)


def test_the_events_of_a_session_are_those_of_its_runs_in_order():
    report = SessionReport(20.0, 0)
    run = Run("ur5e_1", "ur5e", "wave", 1, "", 1.0, 9.0, 8.0, number=1, result=Result.COMPLETED)
    run.actions = [Action(11.0, Deed.MISSED, RUN_MISSED()), Action(3.0, Deed.MISSED, RUN_MISSED())]
    report.runs = [run]
    events = [(event.time, event.said.code) for event in report.events()]
    assert events == [
        (1.0, "run_began"), (3.0, "run_missed"), (9.0, "run_ended"), (11.0, "run_missed"),
    ]  # fmt: skip
    assert report.facts()["events"][2]["said"]["values"]["outcome"]["code"] == "run_completed"
