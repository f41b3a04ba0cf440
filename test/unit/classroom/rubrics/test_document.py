"""A rubric's document: what it may say, and mistakes with their lines."""

from __future__ import annotations

import pytest
from made_motions import ROBOT, thing
from refusals import refused

from mrlab_ros.adapters.diagnostics import KEY_TWICE
from mrlab_ros.classroom.mark import read_rubric
from mrlab_ros.classroom.rubrics.diagnostics import (
    BAD_CLOSEST,
    BAD_DUE,
    BAD_POSE,
    NO_PARTIAL,
    NO_UNIT,
    OTHER_UNIT,
    POSE_COUNT,
    READS_NO_POSES,
    REQUIRES_CIRCLE,
    REQUIRES_UNKNOWN,
    RUBRIC_TEST,
    SAME_TEST_NAME,
    TEST_COUNT,
    TEST_POSE,
    UNKNOWN_PARTIAL,
    UNKNOWN_SENTENCE,
)
from mrlab_ros.classroom.rubrics.document import parse
from mrlab_ros.classroom.rubrics.marking import flaws_of
from mrlab_ros.classroom.rubrics.rubric import Ground
from mrlab_ros.core.base import diagnostics as said
from mrlab_ros.core.base.errors import BadInput
from mrlab_ros.core.base.geometry import Pose
from mrlab_ros.core.scene.document import ObjectEntry, SceneDocument


def written(tmp_path, text):
    path = tmp_path / "r.yaml"
    path.write_text(text)
    return path


GOOD = """
name: First
robot: ur5e
scene: scenes/own.yaml
reference: solution.mat
closest: 2 cm
tests:
  - expect: no collision
    points: 2
  - name: Way
    expect: passes within 5 mm of poses, in order
    poses: [[0.1, 0.2, 0.3], {position: [0, 0, 1], rpy_deg: [180, 0, 0]}]
    points: 0.5
    partial: each
    hidden: true
    hint: Slowly.
"""


def test_a_rubric_is_read_with_its_paths_and_lines(tmp_path):
    path = written(tmp_path, GOOD)
    found = read_rubric(path)
    assert (found.name, found.points, found.closest) == ("First", 2.5, 0.02)
    assert found.reference == str(tmp_path / "solution.mat")
    assert found.scene == str(tmp_path / "scenes/own.yaml")
    assert [(t.name, t.line, t.hidden) for t in found.tests] == [
        ("no collision", 8, False), ("Way", 10, True),
    ]  # fmt: skip
    assert isinstance(found.tests[1].measure.poses[1], Pose)


def test_a_rubric_says_what_is_on_top_and_what_a_late_submission_loses(tmp_path):
    late = "late: {due: '2026-11-30 23:59 +01:00', per_day: 10%, at_most: 50%}\n"
    bonus = "- {expect: cycle < 5 s, points: 1, bonus: true}\n"
    found = read_rubric(written(tmp_path, f"{late}{ONE}}}\n{bonus}"))
    assert found.points == 1
    assert [t.name for t in found.tests] == ["no collision", "cycle < 5 s", "Late"]
    assert found.late.share(3) == pytest.approx(0.3)
    flaws = flaws_of(found, Ground(SceneDocument(), (), {}, None, True))
    assert [flaw.found.code for flaw in flaws] == ["no_reference"]
    for wrong in ("{per_day: 2}", "{}", "{per_day: 10%, due: tomorrow}", "{per_day: 1%, by: x}"):
        with pytest.raises(BadInput):
            read_rubric(written(tmp_path, f"late: {wrong}\n{ONE}}}\n"))
    with refused(BAD_DUE, BadInput):
        read_rubric(written(tmp_path, f"{late.replace('11-30', '11-31')}{ONE}}}\n"))


ONE = "tests:\n- {expect: no collision, points: 1"
POSES = "tests:\n- {expect: passes within 5 mm of poses, points: 1"


@pytest.mark.parametrize(
    ("text", "code", "values"),
    [
        ("tests: []", TEST_COUNT, {"count": 0}),
        ("", said.EMPTY_VALUE, {}),
        ("tests:\n- {expect: no collision}", said.MISSING_FIELD, {}),
        ("tests:\n- {expect: no collision, points: 0}", said.BAD_VALUE, {"found": "0"}),
        ("tests:\n- {expect: no collision, points: -1}", said.BAD_VALUE, {"found": "-1"}),
        ("tests:\n- points: 1\n  expect: no colission", UNKNOWN_SENTENCE,
         {"text": "no colission"}),
        (f"{ONE}, hitn: x}}", said.UNKNOWN_FIELD, {}),
        (f"{ONE}}}\n- {{expect: no collision, points: 1}}", SAME_TEST_NAME, {"line": 2}),
        (f"{ONE}, points: 2}}", KEY_TWICE, {"key": "points"}),
        (f"{ONE}, partial: each}}", NO_PARTIAL, {"rule": "each"}),
        ("tests:\n- {expect: cycle < 8 s, points: 1, partial: each}", UNKNOWN_PARTIAL,
         {"rules": ["until 4 s"]}),
        ("tests:\n- {expect: cycle < 8 s, points: 1, partial: until 9 mm}", OTHER_UNIT,
         {"given": "mm"}),
        (f"{ONE}, requires: other}}", REQUIRES_UNKNOWN, {"test": "other"}),
        (f"{ONE}, requires: no collision}}", REQUIRES_UNKNOWN, {"test": "no collision"}),
        (f"{ONE}, name: a, requires: b}}\n- {{expect: no collision, points: 1, name: b, "
         "requires: [a]}", REQUIRES_CIRCLE, {"tests": ["b"]}),
        (f"{ONE}, cap: -1}}", said.BAD_VALUE, {"found": "-1"}),
        (f"{ONE}, poses: [[0, 0, 1]]}}", READS_NO_POSES, {}),
        (f"{POSES}}}", POSE_COUNT, {"count": 0}),
        (f"{POSES}, poses: [[0, 1]]}}", TEST_POSE, {"number": 1}),
        (f"{POSES}, poses: [here]}}", BAD_POSE, {"found": "'here'"}),
        ("closest: '5'\ntests:\n- {expect: no collision, points: 1}", NO_UNIT, {"text": "5"}),
        ("closest: 5 m\ntests:\n- {expect: no collision, points: 1}", BAD_CLOSEST,
         {"text": "5 m"}),
    ],
)  # fmt: skip
def test_a_mistake_has_its_code(tmp_path, text, code, values):
    with refused(code, **values):
        read_rubric(written(tmp_path, text))


@pytest.mark.parametrize(
    ("text", "line"),
    [
        ("tests:\n- {expect: no collision}", 2),
        ("tests:\n- points: 1\n  expect: no colission", 3),
        (f"{ONE}}}\n- {{expect: no collision, points: 1}}", 3),
    ],
)
def test_a_mistake_has_its_line(tmp_path, text, line):
    with refused(RUBRIC_TEST, line=line):
        read_rubric(written(tmp_path, text))


@pytest.mark.parametrize("text", ["tests: [}", "tests: &a\n- *a"])
def test_what_is_no_yaml_is_refused(tmp_path, text):
    with pytest.raises(BadInput):
        read_rubric(written(tmp_path, text))


def test_all_mistakes_are_named_at_once(tmp_path):
    text = "tests:\n- {expect: no colision, points: 1}\n- {expect: cycle < 8, points: 1}\n"
    with refused(said.MISTAKES, count=2):
        read_rubric(written(tmp_path, text))


SCENE = SceneDocument(
    objects=(ObjectEntry("cube_1", "cube", Pose()), ObjectEntry("bin_1", "bin", Pose()))
)
GROUND = Ground(
    SCENE, (ROBOT,), {"cube_1": thing(), "bin_1": thing(0.3, 0.0)}, cell=False, reference=False
)


@pytest.mark.parametrize(
    ("test", "code", "values"),
    [
        ({"expect": "no collision with pilar"}, "thing_not_in_scene", {"thing": "pilar"}),
        ({"expect": "no collision of ur5e_2"}, "no_robot_in_scene",
         {"robot": "ur5e_2", "known": ["ur5e_1"], "close": "ur5e_1"}),
        ({"expect": "grasps cube_2"}, "object_not_in_scene",
         {"object": "cube_2", "close": "cube_1"}),
        ({"expect": "grasps bin_1"}, "object_is_fixed", {"object": "bin_1"}),
        ({"expect": "holds cube_3 for 2 s"}, "object_not_in_scene", {"object": "cube_3"}),
        ({"expect": "places cube_1 on cube_1"}, "lies_on_itself", {"side": "on"}),
        ({"expect": "releases cube_1 within 5 mm of tray_1"}, "object_not_in_scene",
         {"object": "tray_1"}),
        ({"expect": "distance > 60 cm"}, "beyond_measure", {"most": 0.5, "limit": 0.6}),
        ({"expect": "passes within 5 mm of [2, 2, 2]"}, "pose_out_of_reach", {"number": 1}),
        ({"expect": "ends within 5 mm of [0, 0, 3]"}, "out_of_reach", {"limit": 0.005}),
        ({"expect": "within 50% of jerk limits"}, "limit_not_stated", {"of": "jerk"}),
        ({"expect": "parallel mode used"}, "mode_of_one_motion", {}),
        ({"expect": "joints within 5 deg of the reference"}, "no_reference_named", {}),
        ({"expect": "cycle < 8 s", "partial": "until 6 s"}, "partial_gives_nothing",
         {"side": "above", "until": 6.0, "limit": 8.0, "unit": "s"}),
        ({"expect": "distance > 5 cm", "partial": "until 6 cm"}, "partial_gives_nothing",
         {"side": "below"}),
        ({"expect": "passes within 5 mm of poses", "partial": "each",
          "poses": [[0.4, 0.1, 0.4]]}, "one_pose_each", {}),
        ({"expect": "passes within 5 mm and 5 deg of poses", "poses": [[0.4, 0.1, 0.4]]},
         "pose_not_turned", {"number": 1}),
        ({"expect": "cycle < 0 s"}, "never_held", {"limit": 0.0, "unit": "s"}),
        ({"expect": "smoothness > 3"}, "never_held", {"limit": 3.0}),
        ({"expect": "distance to bin_1 > 0 m"}, "never_lost", {"limit": 0.0}),
        ({"expect": "within 120% of speed limits"}, "no_share_of_limits", {"value": 1.2}),
        ({"expect": "no collision", "hidden": True}, "hidden_without_hint", {}),
    ],
)  # fmt: skip
def test_the_linter_says_what_cannot_be_measured(test, code, values):
    rubric = parse({"tests": [{"points": 1, **test}]}, "r")
    flaws = {flaw.found.code: flaw for flaw in flaws_of(rubric, GROUND)}
    assert code in flaws
    found = flaws[code].found.values
    assert {name: found[name] for name in values} == values


def test_a_direction_of_no_length_is_told_with_its_line():
    pose = {"position": [0.4, 0.1, 0.4], "orientation": [0, 0, 0, 0]}
    test = {"expect": "passes within 5 mm of poses", "points": 1, "poses": [pose]}
    with refused(RUBRIC_TEST, line=7):
        parse({"tests": [test]}, "r", {("tests", 0): 7})


def test_what_can_be_measured_has_no_errors():
    sentences = [
        "no collision", "grasps cube_1", "places cube_1 in bin_1", "distance to bin_1 > 5 cm",
        "passes within 5 mm of [0.45, 0.2, 0.4]", "passes within 5 mm of [0.45, 0.2]",
        "cycle ≤ 8 s", "no collision with the floor",
    ]  # fmt: skip
    tests = [{"expect": s, "points": 1} for s in sentences]
    flaws = flaws_of(parse({"tests": tests}, "r"), GROUND)
    assert [flaw.found.code for flaw in flaws if flaw.found.refuses] == []
