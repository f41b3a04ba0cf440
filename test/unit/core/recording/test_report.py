"""What happened in a session, from what its messages tell."""

from __future__ import annotations

from types import SimpleNamespace

import numpy as np
import pytest

from mrlab_ros.core.clock import PlaybackClock
from mrlab_ros.core.recording.report import (
    Changes,
    Contact,
    ReferenceTrajectory,
    ReportedState,
    RobotReport,
    Series,
    SessionReport,
)
from mrlab_ros.core.recording.report_text import report_lines

SECOND = 1_000_000_000
COURSE = ReferenceTrajectory(10.0, np.column_stack([np.arange(11.0), -np.arange(11.0)]))


def test_the_same_told_again_is_no_change():
    changes = Changes()
    for time, label in ((0.0, "READY"), (1.0, "PLAYING"), (2.0, "PLAYING"), (4.0, "READY")):
        changes.add(time, label)
    spans = [(span.start, span.end, span.label) for span in changes.spans(9.0)]
    assert spans == [(0.0, 1.0, "READY"), (1.0, 4.0, "PLAYING"), (4.0, 9.0, "READY")]
    assert Changes().spans(9.0) == []


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
    report = SessionReport(20.0, 0, troubles=["x_0.mcap has no index"])
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
    assert robot.borne["cube_1"].label == (
        "1.5 kg, friction 0.90, needed 0.50, 2.00 N*m at the wrist"
    )
    lines = report_lines(report)
    assert lines[:2] == ["20.0 s, 1 robot, 0 runs", "x_0.mcap has no index"]
    assert "    tracking error: p50 0.5 rad, p95 0.5 rad, max 0.5 rad (1)" in lines
    facts = report.facts()["robots"][0]
    assert facts["collisions"][0]["frame"] == 412
    assert facts["grasps"][0] == {"start": 2.0, "end": 5.0, "label": "HOLDING", "detail": "cube_1"}
