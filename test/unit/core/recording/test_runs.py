"""One run is one row: what playback states, contacts, grasps and objects say of it."""

from __future__ import annotations

import math

import numpy as np
import pytest

from mrlab_ros.core.base.clock import PlaybackClock
from mrlab_ros.core.base.diagnostic import WARNING, Diagnostic
from mrlab_ros.core.base.geometry import Pose
from mrlab_ros.core.recording.moves import ObjectTrack, Placed, Target, Targets
from mrlab_ros.core.recording.report import Contact, ReportedState, SessionReport
from mrlab_ros.core.recording.report_text import report_lines
from mrlab_ros.core.recording.run_finding import runs_of
from mrlab_ros.core.recording.runs import Course, Deed, Result, RunFigures, RunJoint, figures_of

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
    ("states", "code", "values", "end"),
    [
        (((9, "COMPLETE", 8, 0), (9.1, "READY", 0, 0)), "run_completed", {}, 9),
        (((4, "READY", 0, 0),), "run_stopped", {"position": 3, "length": 8}, 4),
        (
            ((3, "PAUSED", 2, 0), (5, "PLAYING", 2, 1), (11, "COMPLETE", 8, 0)),
            "run_completed",
            {},
            11,
        ),
        (
            ((3, "COLLISION_HALT", 2, 0), (5, "PAUSED", 2, 0), (6, "READY", 0, 0)),
            "run_stopped",
            {"halts": 1, "position": 2, "length": 8},
            6,
        ),
        (
            # the arm was taken back to its first frame
            ((3, "COLLISION_HALT", 2, 0), (4, "COLLISION_HALT", 0, 0), (5, "PAUSED", 0, 0),
             (6, "READY", 0, 0)),
            "run_stopped",
            {"halts": 1, "position": 2, "length": 8},
            6,
        ),
        (
            ((3, "COLLISION_HALT", 2, 0),),
            "run_halted",
            {"halts": 1, "position": 2, "length": 8},
            60,
        ),
        ((), "run_open", {"position": 8, "length": 8}, 60),
        (((9, "PLAYING", 0, 1), (10, "READY", 0, 0)), "run_stopped",
         {"position": 1, "length": 8}, 10),
        (((9, "PLAYING", 0, 1), (17, "COMPLETE", 8, 0)), "run_completed", {"rounds": 2}, 17),
        (((4, "READY", 0, 0, "other"),), "run_stopped", {"position": 3, "length": 8}, 4),
    ],
)  # fmt: skip
def test_a_run_ends_as_its_states_say(states, code, values, end):
    report, _ = session((0, "READY", 0, 0), (1, "PLAYING", 0, 1), *states)
    (run,) = found(report)
    assert (run.start, run.end) == (1, end)
    assert run.outcome.code == code == f"run_{run.result.value}"
    assert run.outcome.values == {"robot": "ur5e_1", **values}


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
    assert (run.loops, run.result, run.position) == (0, Result.STOPPED, 3)


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
    robot.collisions.append(Contact(7.0, "forearm_link", "table", 601))
    robot.collisions.append(Contact(30.0, "forearm_link", "table", 1))  # no run any more
    cube = ObjectTrack()
    tool = pose(0.0, 0.0, 0.1)
    for time, x, holder in ((0.0, 1.2, ""), (2.0, 1.2, "ur5e_1"), (4.9, 1.5, "ur5e_1"),
                            (5.1, 1.52, ""), (5.5, 1.53, ""), (20.0, 3.0, "")):  # fmt: skip
        cube.add(time, placed(x, holder, tool if holder else None))
    targets = Targets()
    targets.add(0.0, (Target(1.0, True, pose(0.2)), Target(4.0, False, pose(0.5, 0, -0.1))))
    (run,) = found(report, {"cube_1": cube}, {"ur5e_1": targets})
    grasped, released, hit = run.actions
    assert (grasped.deed, grasped.time) == (Deed.GRASPED, 2.0)
    assert grasped.said.values["place"] == (1.2, 0.0, 0.0)
    assert released.said.code == "run_released"
    assert released.said.values["place"] == pytest.approx((1.53, 0.0, 0.0))
    assert released.said.values["target"] == pytest.approx((1.5, 0.0, 0.0))
    assert run.facts()["actions"][1]["said"]["values"]["distance"] == pytest.approx(0.03)
    assert (hit.said.other, hit.said.link, hit.said.values["row"]) == (
        "table", "forearm_link", 601,
    )  # fmt: skip


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
    _, handed, _, released = [a.said for a in run.actions]
    assert (handed.code, handed.values["to"]) == ("run_handed_over", "kuka_1")
    assert released.code == "run_released"
    assert released.values == {"object": "rod_1", "robot": "ur5e_1", "place": (6.5, 0.0, 0.0)}


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
    said = deviation.said
    assert (said.code, said.joint, said.time) == ("run_deviated", "b", 3.0)
    assert said.values["reference"] == "ref.mat"
    assert said.values["angle"] == pytest.approx(math.radians(2))
    assert said.values["tool"] == pytest.approx(0.005)
    assert "distance" not in said.values
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
    assert report.summary.values == {
        "duration": 60.0, "robots": 2, "runs": 1, "completed": 1, "collisions": 1,
    }  # fmt: skip
    assert lines[0] == report.summary.message
    rows = [line.split() for line in lines]
    assert ["1", "ur5e_1", "wave", "at", "2x", "1.00", "s", "6.00", "s", "completed"] in rows
    (hit,) = report.runs[0].actions
    assert any(line.endswith(f"2.50 s  {hit.said.message}") for line in lines)
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
    assert [(a.said.code, a.said.values.get("object")) for a in run.actions] == [
        ("run_grasped", "rod_1"),
        ("run_handed_over", "rod_1"),
        ("run_grasped", "cube_1"),
        ("run_lost", "cube_1"),
        ("run_missed", None),
    ]
    assert run.actions[3].said.values["place"] == (5.0, 0.0, 0.0)


def test_a_remark_counts_once_however_its_figures_vary():
    report, robot = session((0, "READY", 0, 0), (1, "PLAYING", 0, 1), (9, "COMPLETE", 8, 0))
    for time, name, needed in (
        (2.0, "rod_1", "1.1"),
        (3.0, "rod_1", "1.2"),
        (4.0, "rod_2", "1.2"),
    ):
        values = {"object": name, "friction_needed": needed}
        robot.remarks.add(time, Diagnostic("slips", WARNING, f"it slips: {needed}", values=values))
    for time in (5.0, 6.0):
        robot.remarks.add(time, Diagnostic("", WARNING, "what an older bag says"))
    (run,) = found(report)
    assert [(a.time, a.said.code) for a in run.actions] == [(2, "slips"), (4, "slips"), (5, "")]


TIMES = np.linspace(10.0, 14.0, 401)
JOINTS = (RunJoint("a", lower=-1.0, upper=2.0), RunJoint("slide", True, 0.0, 0.3), RunJoint("c"))


def course(tool: np.ndarray | None, played: np.ndarray | None = None) -> Course:
    positions = TIMES - 10.0 if played is None else np.where(played, TIMES - 10.0, np.nan)
    joints = np.column_stack([np.sin(TIMES - 10.0), 0.1 + 0 * TIMES, 9 * TIMES])
    return Course(TIMES, positions, joints, np.full((len(TIMES), 3), np.nan), tool)


def straight(speed: np.ndarray) -> np.ndarray:
    """A tool that moves along x with a speed, m/s, at each instant."""
    x = np.concatenate([[0.0], np.cumsum(speed[:-1] * np.diff(TIMES))])
    return np.column_stack([x, 0 * x, 0 * x])


def test_the_way_and_the_highest_speed_of_the_tool():
    speed = np.where(TIMES < 12.0, 0.1, 0.5)
    found = figures_of(course(straight(speed)), JOINTS)
    assert found.way == pytest.approx(1.2, abs=0.01)
    assert found.fastest == pytest.approx(0.5, abs=1e-6)
    assert found.fastest_at is not None
    assert found.fastest_at >= 12.0


def test_one_late_stamp_makes_no_speed():
    tool = straight(np.full(len(TIMES), 0.2))
    late = course(tool)
    late.times = TIMES.copy()
    late.times[200] += 0.009  # almost at the next one
    assert figures_of(late, JOINTS).fastest == pytest.approx(0.2, rel=0.1)


def test_what_was_not_played_or_not_recorded_does_not_count():
    speed = np.where(TIMES < 12.0, 0.1, 5.0)  # such as being taken back after a halt
    found = figures_of(course(straight(speed), TIMES < 12.0), JOINTS)
    assert found.way == pytest.approx(0.2, abs=0.01)
    assert found.fastest == pytest.approx(0.1, abs=1e-6)
    seen = (TIMES < 11.0) | (TIMES > 13.0)
    gap = course(straight(np.full(len(TIMES), 0.1)))
    gap = Course(gap.times[seen], gap.positions[seen], gap.joints[seen], gap.expected[seen],
                 np.where(TIMES[:, None] < 12, 0.0, [9.0, 0, 0])[seen])  # fmt: skip
    assert figures_of(gap, JOINTS).way == 0
    assert figures_of(gap, JOINTS).fastest == 0


def test_the_joint_nearest_to_its_limit():
    near = figures_of(course(None), JOINTS).near
    assert near is not None
    assert (near.joint, near.prismatic, near.room) == ("slide", True, pytest.approx(0.1))
    near = figures_of(course(None), (RunJoint("a", lower=0.5, upper=2.0), *JOINTS[1:])).near
    assert near is not None
    assert near.joint == "a"
    assert near.room == pytest.approx(-0.5 + np.sin(4.0), abs=1e-6)
    assert figures_of(course(None), tuple(map(RunJoint, "abc"))) == RunFigures()
