"""One run is one row: what playback states, contacts, grasps and objects say of it."""

from __future__ import annotations

import math

import numpy as np
import pytest

from mrlab_ros.core.clock import PlaybackClock
from mrlab_ros.core.geometry import Pose
from mrlab_ros.core.recording.moves import ObjectTrack, Placed, Target, Targets
from mrlab_ros.core.recording.report import Contact, ReportedState, SessionReport
from mrlab_ros.core.recording.report_text import deviation_text, lasting, report_lines
from mrlab_ros.core.recording.run_finding import runs_of
from mrlab_ros.core.recording.runs import Course, Deed, Result, RunJoint

SECOND = 1_000_000_000


def session(*states, duration=60.0):
    """A session of one robot; states: (time, label, position, rate)."""
    report = SessionReport(duration, 0)
    robot = report.robot("ur5e_1")
    for time, label, position, rate, *trajectory in states:
        stamp = round(time * SECOND)
        robot.add(
            ReportedState(
                stamp,
                label,
                trajectory[0] if trajectory else "wave",
                PlaybackClock(stamp, position, rate),
                time,
                length=8.0,
            )
        )
    return report, robot


def found(report, objects=None, targets=None):
    return runs_of(report, objects or {}, targets or {})


@pytest.mark.parametrize(
    ("states", "result", "outcome", "end"),
    [
        (((9, "COMPLETE", 8, 0), (9.1, "READY", 0, 0)), Result.COMPLETED, "completed", 9),
        (((4, "READY", 0, 0),), Result.STOPPED, "stopped at 3.00 of 8.00 s", 4),
        (
            ((3, "PAUSED", 2, 0), (5, "PLAYING", 2, 1), (11, "COMPLETE", 8, 0)),
            Result.COMPLETED,
            "completed",
            11,
        ),
        (
            ((3, "COLLISION_HALT", 2, 0), (5, "PAUSED", 2, 0), (6, "READY", 0, 0)),
            Result.STOPPED,
            "stopped after a collision at 2.00 of 8.00 s",
            6,
        ),
        (
            # the arm was taken back to its first frame
            ((3, "COLLISION_HALT", 2, 0), (4, "COLLISION_HALT", 0, 0), (5, "PAUSED", 0, 0),
             (6, "READY", 0, 0)),
            Result.STOPPED,
            "stopped after a collision at 2.00 of 8.00 s",
            6,
        ),
        (
            ((3, "COLLISION_HALT", 2, 0),),
            Result.HALTED,
            "halted by a collision at 2.00 of 8.00 s when the recording ended",
            60,
        ),
        ((), Result.OPEN, "still going on at 8.00 of 8.00 s when the recording ended", 60),
        (((9, "PLAYING", 0, 1), (10, "READY", 0, 0)), Result.STOPPED,
         "stopped at 1.00 of 8.00 s", 10),
        (((9, "PLAYING", 0, 1), (17, "COMPLETE", 8, 0)), Result.COMPLETED,
         "completed, 2 times", 17),
        (((4, "READY", 0, 0, "other"),), Result.STOPPED, "stopped at 3.00 of 8.00 s", 4),
    ],
)  # fmt: skip
def test_a_run_ends_as_its_states_say(states, result, outcome, end):
    report, _ = session((0, "READY", 0, 0), (1, "PLAYING", 0, 1), *states)
    (run,) = found(report)
    assert (run.start, run.end) == (1, end)
    assert run.result is result
    assert run.outcome() == outcome


@pytest.mark.parametrize("hours", [2, -2])
def test_a_clock_that_is_set_is_no_loop_and_no_place_on_the_trajectory(hours):
    report = SessionReport(60.0, 0)
    robot = report.robot("ur5e_1")
    # The same motion by the clock before and after; it is set back before the robot stops.
    for time, label, off, rate in (
        (1, "PLAYING", 0, 1), (3, "PLAYING", hours * 3600, 1), (4, "READY", 0, 0),
    ):  # fmt: skip
        clock = PlaybackClock((1 + off) * SECOND, 0.0, rate)
        robot.add(ReportedState((time + off) * SECOND, label, "wave", clock, time, length=8.0))
    (run,) = found(report)
    assert (run.loops, run.outcome()) == (0, "stopped at 3.00 of 8.00 s")


def test_runs_are_numbered_over_all_robots_in_order_of_time():
    report, robot = session(
        (0, "READY", 0, 0), (5, "ADJUSTING", 0, 0), (6, "PLAYING", 0, 2), (10, "COMPLETE", 8, 0)
    )
    other = report.robot("kuka_1")
    for state in robot.reported:
        other.add(state)
    other.reported[1:1] = [
        ReportedState(0, "PLAYING", "first", PlaybackClock(0, 0.0, 1.0), 1.0),
        ReportedState(0, "READY", "first", PlaybackClock(0, 0.0, 0.0), 2.0),
    ]
    rows = [(run.number, run.robot, run.trajectory, run.start) for run in found(report)]
    assert rows == [
        (1, "kuka_1", "first", 1.0),
        (2, "ur5e_1", "wave", 5),
        (3, "kuka_1", "wave", 5),
    ]
    assert found(report)[1].speeds == [2]


def pose(x, y=0.0, z=0.0):
    return Pose((x, y, z))


def placed(x, held_by="", in_tool=None):
    return Placed(pose(x), held_by, in_tool)


def test_a_release_says_how_far_from_its_programmed_place():
    report, robot = session((0, "READY", 0, 0), (1, "PLAYING", 0, 1), (9, "COMPLETE", 8, 0))
    robot.bases.append((0.0, pose(1.0)))
    robot.grasps.add(2.0, "HOLDING", "cube_1")
    robot.grasps.add(5.0, "OPEN")
    robot.collisions.append(Contact(7.0, "forearm_link", "table", 600))
    robot.collisions.append(Contact(30.0, "forearm_link", "table", 0))  # no run any more
    cube = ObjectTrack()
    tool = pose(0.0, 0.0, 0.1)
    for time, x, holder in ((0.0, 1.2, ""), (2.0, 1.2, "ur5e_1"), (4.9, 1.5, "ur5e_1"),
                            (5.1, 1.52, ""), (5.5, 1.53, ""), (20.0, 3.0, "")):  # fmt: skip
        cube.add(time, placed(x, holder, tool if holder else None))
    targets = Targets()
    targets.add(0.0, (Target(1.0, True, pose(0.2)), Target(4.0, False, pose(0.5, 0, -0.1))))
    (run,) = found(report, {"cube_1": cube}, {"ur5e_1": targets})
    grasped, released, hit = run.actions
    assert (grasped.deed, grasped.time, grasped.place) == (Deed.GRASPED, 2.0, (1.2, 0.0, 0.0))
    assert (
        released.text
        == "released cube_1 30 mm from its programmed place, at 1.530, 0.000, 0.000 m"
    )
    assert released.off == pytest.approx(0.03)
    assert (hit.object, hit.link) == ("table", "forearm_link")
    assert run.facts()["actions"][1]["distance"] == pytest.approx(0.03)


def test_what_is_handed_over_or_lost_is_not_measured_against_the_program():
    report, robot = session((0, "READY", 0, 0), (1, "PLAYING", 0, 1), (9, "COMPLETE", 8, 0))
    for time, label in ((2.0, "HOLDING"), (3.0, "OPEN"), (4.0, "HOLDING"), (6.5, "OPEN")):
        robot.grasps.add(time, label, "rod_1" if label == "HOLDING" else "")
    rod = ObjectTrack()
    for time, holder in ((2.0, "ur5e_1"), (3.1, "kuka_1"), (4.0, "ur5e_1"), (6.5, "")):
        rod.add(time, placed(time, holder, pose(0.0) if holder else None))
    targets = Targets()
    targets.add(0.0, (Target(2.0, False, pose(0.5)),))  # not at 5.5 s, where it fell
    (run,) = found(report, {"rod_1": rod}, {"ur5e_1": targets})
    assert [a.text for a in run.actions if a.deed is Deed.RELEASED] == [
        "handed rod_1 to kuka_1",
        "released rod_1 at 6.500, 0.000, 0.000 m",
    ]


def test_deviation_is_the_worst_joint_and_the_way_of_the_tool():
    joints = (RunJoint("a"), RunJoint("b"))
    expected = np.array([[0.0, 0.0], [0.0, np.nan], [0.0, 1.0]])
    course = Course(
        np.array([1.0, 2.0, 3.0]),
        np.array([0.0, 1.0, 2.0]),
        np.array([[0.0, 0.0], [0.0, 9.0], [0.0, 1.0 + math.radians(2)]]),
        expected,
        np.array([[0.0, 0.0, 0.0], [0.0, 0.0, 0.0], [0.003, 0.004, 0.0]]),
        np.zeros((3, 3)),
    )
    deviation = course.deviation("ref.mat", joints)
    assert deviation is not None
    assert deviation_text(deviation, joints) == (
        "up to 2.00 deg from ref.mat (b at 3.00 s), the tool 5.0 mm"
    )
    course.expected = expected * np.nan
    assert course.deviation("ref.mat", joints) is None


def test_the_text_has_one_row_a_run_and_no_state_changes():
    report, robot = session(
        (0, "READY", 0, 0), (1, "PLAYING", 0, 2), (3, "PAUSED", 4, 0), (5, "PLAYING", 4, 2),
        (7, "COMPLETE", 8, 0),
    )  # fmt: skip
    robot.collisions.append(Contact(2.5, "wrist_3_link", "table", 412))
    report.robot("kuka_1")
    report.runs = found(report)
    lines = report_lines(report)
    assert lines[0] == "60.0 s, 2 robots, 1 run, 1 completed, 1 collision"
    rows = [line.split() for line in lines]
    assert ["1", "ur5e_1", "wave", "at", "2x", "1.00", "s", "6.00", "s", "completed"] in rows
    assert "2.50 s  hit table with wrist_3_link at frame 412" in "\n".join(lines)
    assert "without a run: kuka_1" in lines
    assert not any("PAUSED" in line for line in lines)
    assert lines.index("technical") > lines.index("without a run: kuka_1")


def test_fingers_that_are_empty_after_they_held_something_closed_on_it():
    report, robot = session((0, "READY", 0, 0), (1, "PLAYING", 0, 1), (9, "COMPLETE", 8, 0))
    for time, label, name in (
        (2.0, "HOLDING", "rod_1"), (3.0, "EMPTY", ""), (3.5, "OPEN", ""),
        (4.0, "HOLDING", "cube_1"), (5.0, "EMPTY", ""), (6.0, "OPEN", ""), (7.0, "EMPTY", ""),
    ):  # fmt: skip
        robot.grasps.add(time, label, name)
    rod, cube = ObjectTrack(), ObjectTrack()
    for time, holder in ((2.0, "ur5e_1"), (3.1, "kuka_1")):
        rod.add(time, placed(time, holder, pose(0.0)))
    for time, holder in ((4.0, "ur5e_1"), (5.0, "")):
        cube.add(time, placed(time, holder, pose(0.0) if holder else None))
    (run,) = found(report, {"rod_1": rod, "cube_1": cube})
    assert [(a.deed, a.text) for a in run.actions] == [
        (Deed.GRASPED, "grasped rod_1"),
        (Deed.RELEASED, "handed rod_1 to kuka_1"),
        (Deed.GRASPED, "grasped cube_1"),
        (Deed.LOST, "lost cube_1 at 5.000, 0.000, 0.000 m"),
        (Deed.MISSED, "closed the gripper on nothing"),
    ]


@pytest.mark.parametrize(
    ("seconds", "words"),
    [
        (0.0, "0.00 s"), (99.994, "99.99 s"), (99.996, "1:40.0 min"), (125.34, "2:05.3 min"),
        (3599.94, "59:59.9 min"), (3599.96, "1:00:00 h"), (3725.4, "1:02:05 h"),
    ],
)  # fmt: skip
def test_a_length_of_time_for_a_person(seconds, words):
    assert lasting(seconds) == words
