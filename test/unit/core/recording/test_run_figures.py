"""What a run's motion amounts to."""

from __future__ import annotations

import numpy as np
import pytest

from mrlab_ros.core.recording.run_figures import RunFigures, figures_of
from mrlab_ros.core.recording.runs import Course, RunJoint

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
