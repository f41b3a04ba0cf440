"""What has moved in a lab since a check: only what matters to a motion."""

import math
from dataclasses import replace

import numpy as np
import pytest

from mrlab_ros.app.check.in_lab import LabScene, changed
from mrlab_ros.core.base.geometry import Pose
from mrlab_ros.core.scene.document import ObjectEntry, RobotEntry, SceneDocument
from mrlab_ros.core.scene.surfaces import Surface

TABLE = Surface("table_1", "table", Pose(), np.zeros((4, 3)), np.zeros((0, 3), np.int32))
DOCUMENT = SceneDocument(
    (RobotEntry("a", "ur5e", "", Pose()), RobotEntry("b", "ur5e", "", Pose((1.0, 0.0, 0.0)))),
    (ObjectEntry("cube_1", "cube", Pose((0.5, 0.0, 0.1))),),
    (TABLE,),
)
SCENE = LabScene(DOCUMENT, {"a": (0.0,) * 6, "b": (0.0,) * 6})
TURNED = (0.0, 0.0, math.sin(0.05), math.cos(0.05))


def with_object(**fields: object) -> LabScene:
    thing = replace(DOCUMENT.objects[0], **fields)
    return replace(SCENE, document=replace(DOCUMENT, objects=(thing,)))


def with_robot(**fields: object) -> LabScene:
    robots = (DOCUMENT.robots[0], replace(DOCUMENT.robots[1], **fields))
    return replace(SCENE, document=replace(DOCUMENT, robots=robots))


@pytest.mark.parametrize(
    ("now", "code", "name"),
    [
        (SCENE, "", ""),
        (with_object(pose=Pose((0.5, 0.001, 0.1))), "", ""),
        (with_object(pose=Pose((0.5, 0.003, 0.1))), "moved", "cube_1"),
        (with_object(pose=Pose((0.5, 0.0, 0.1), TURNED)), "moved", "cube_1"),
        (with_object(held_by="b"), "held_by_another", "cube_1"),
        (with_object(name="cube_2"), "disappeared", "cube_1"),
        (with_robot(pose=Pose((1.1, 0.0, 0.0))), "moved", "b"),
        (with_robot(end_effector="hand"), "other_model", "b"),
        (replace(SCENE, stands={"a": (1.0,) * 6, "b": (0.0,) * 6}), "", ""),
        (replace(SCENE, stands={"a": (0.0,) * 6, "b": (0.1,) * 6}), "stands_elsewhere", "b"),
        (replace(SCENE, document=replace(DOCUMENT, surfaces=())), "surfaces_changed", ""),
    ],
)
def test_what_has_changed_for_a_motion_of_a(now: LabScene, code: str, name: str) -> None:
    found = changed(SCENE, now, "a")
    assert (found.code if found else "", found.values.get("name", "") if found else "") == (
        code,
        name,
    )


def test_what_is_held_goes_where_its_robot_goes() -> None:
    held = with_object(held_by="b")
    assert changed(held, with_object(held_by="b", pose=Pose((2.0, 0.0, 1.0))), "a") is None
