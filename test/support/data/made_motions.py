"""Checked motions that are made, not rehearsed."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from mrlab_ros.adapters.robots.library import RobotLibrary
from mrlab_ros.classroom.rubrics.document import parse
from mrlab_ros.core.base.geometry import Pose
from mrlab_ros.core.checking.check_record import Checked, Motion
from mrlab_ros.core.checking.motion import CheckedRobot, figures_of
from mrlab_ros.core.checking.rehearsal_record import Course, GraspChange, Rehearsed
from mrlab_ros.core.checking.report import CheckReport
from mrlab_ros.core.physics.catalogue import ObjectType
from mrlab_ros.core.physics.engine import Body
from mrlab_ros.core.physics.grasp.states import Grasp
from mrlab_ros.core.scene.document import ObjectEntry, SceneDocument
from mrlab_ros.core.trajectory.trajectory import Channels, Source, Trajectory

MODEL = RobotLibrary(Path(__file__).parents[3] / "robots").model("ur5e")
ROBOT = CheckedRobot("ur5e_1", MODEL, "parallel_gripper", Pose(), {})
RATE = 50.0
STEP = np.linspace(0, 1, 201)
QUINTIC = 10 * STEP**3 - 15 * STEP**4 + 6 * STEP**5


def reach(joints=(0.5, -0.3, 0.2, 0.0, 0.1, 0.4), progress=QUINTIC, rate=RATE):
    """Return a motion of 4 s from home by `joints`, rad."""
    positions = MODEL.home + np.outer(progress, joints)
    still = Channels(np.zeros_like(positions), np.zeros_like(positions))
    trajectory = Trajectory(
        "made", "ur5e", None, MODEL.joint_names, rate, positions, None, still,
        Source("made.mat", "q", "0" * 64),
    )  # fmt: skip
    return Motion(ROBOT, trajectory, figures_of(trajectory, ROBOT))


def thing(size=0.05, mass=0.1):
    half = size / 2
    return ObjectType(
        "cube", Body((), mass), (-half,) * 3, (half,) * 3, (1, 1, 1, 1), "", ""
    )  # fmt: skip


def recorded(grasps=(), objects=None, duration=4.0, **rest):
    """Return a recording. grasps: (time, state, object); objects: where each is at the end."""
    changes = [GraspChange(t, "ur5e_1", Grasp[s], o) for t, s, o in grasps]
    courses = {
        name: Course([duration, duration + 0.5], [[*at, 0, 0, 0, 1]] * 2, [(0.0, "")])
        for name, at in (objects or {}).items()
    }
    return Rehearsed(duration=duration, grasps=changes, objects=courses, **rest)


def checked(*motions, record=None, objects=None, extras=None):
    scene = SceneDocument(objects=tuple(ObjectEntry(n, "cube", Pose()) for n in objects or {}))
    report = CheckReport("made", {}, (), (), extras=extras or {})
    return Checked(report, {}, motions or (reach(),), record or recorded(), scene, objects or {})


def outcome(expect, given, reference=None, **test):
    """Return what a test gets, by its sentence."""
    return measure(expect, **test).assess(given, reference)


def measure(expect, **test):
    return parse({"tests": [{"expect": expect, "points": 1, **test}]}, "r").tests[0].measure
