"""A rubric's document: what it may say, and mistakes with their lines."""

from __future__ import annotations

import pytest
from made_motions import ROBOT, thing

from mrlab_ros.adapters.rubrics import files
from mrlab_ros.core.base.diagnostic import Severity
from mrlab_ros.core.errors import BadInput
from mrlab_ros.core.geometry import Pose
from mrlab_ros.core.rubrics.document import parse
from mrlab_ros.core.rubrics.ground import Ground
from mrlab_ros.core.rubrics.lint import flaws_of
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
    found = files.read(path)
    assert (found.name, found.points, found.closest) == ("First", 2.5, 0.02)
    assert found.reference == str(tmp_path / "solution.mat")
    assert found.scene == str(tmp_path / "scenes/own.yaml")
    assert [(t.name, t.line, t.hidden) for t in found.tests] == [
        ("no collision", 8, False), ("Way", 10, True),
    ]  # fmt: skip
    assert isinstance(found.tests[1].measure.poses[1], Pose)


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("tests: []", "r.yaml: tests has 0 entries"),
        ("", "expected a mapping"),
        ("tests:\n- {expect: no collision}", "r.yaml:2: test 'no collision': points is missing"),
        ("tests:\n- {expect: no collision, points: 0}", "points is 0; expected a number above 0"),
        ("tests:\n- {expect: no collision, points: -1}", "points is -1"),
        ("tests:\n- points: 1\n  expect: no colission", "r.yaml:3: test 'no colission': 'no col"),
        ("tests:\n- {expect: no collision, points: 1, hitn: x}", "hitn"),
        ("tests:\n- {expect: no collision, points: 1}\n- {expect: no collision, points: 1}",
         "r.yaml:3: the name 'no collision' is that of the test in line 2"),
        ("tests:\n- {expect: no collision, points: 1, points: 2}", "'points' is there twice"),
        ("tests:\n- {expect: no collision, points: 1, partial: each}", "knows no partial points"),
        ("tests:\n- {expect: cycle < 8 s, points: 1, partial: each}", "knows 'until 4 s'"),
        ("tests:\n- {expect: cycle < 8 s, points: 1, partial: until 9 mm}", "unit 'mm'"),
        ("tests:\n- {expect: no collision, points: 1, poses: [[0, 0, 1]]}", "reads no poses"),
        ("tests:\n- {expect: passes within 5 mm of poses, points: 1}", "poses has 0 entries"),
        ("tests:\n- {expect: passes within 5 mm of poses, points: 1, poses: [[0, 1]]}", "pose 1"),
        ("tests:\n- {expect: passes within 5 mm of poses, points: 1, poses: [here]}", "pose 1 is"),
        ("tests: [}", "r.yaml:1 is not YAML"),
        ("closest: 5\ntests:\n- {expect: no collision, points: 1}", "closest"),
        ("tests: &a\n- *a", "expected a mapping"),
    ],
)  # fmt: skip
def test_a_mistake_is_named_with_its_line(tmp_path, text, words):
    with pytest.raises(BadInput) as error:
        files.read(written(tmp_path, text))
    assert words in str(error.value)


def test_all_mistakes_are_named_at_once(tmp_path):
    text = "tests:\n- {expect: no colision, points: 1}\n- {expect: cycle < 8, points: 1}\n"
    with pytest.raises(BadInput) as error:
        files.read(written(tmp_path, text))
    assert "r.yaml:2" in str(error.value)
    assert "r.yaml:3" in str(error.value)


SCENE = SceneDocument(
    objects=(ObjectEntry("cube_1", "cube", Pose()), ObjectEntry("bin_1", "bin", Pose()))
)
GROUND = Ground(
    SCENE, (ROBOT,), {"cube_1": thing(), "bin_1": thing(0.3, 0.0)}, cell=False, reference=False
)


@pytest.mark.parametrize(
    ("test", "words"),
    [
        ({"expect": "no collision with pilar"}, "nothing called 'pilar'"),
        ({"expect": "no collision of ur5e_2"}, "no robot 'ur5e_2'; it has: ur5e_1; did you mean"),
        ({"expect": "grasps cube_2"}, "no object 'cube_2'; it has: cube_1, bin_1; did you mean"),
        ({"expect": "grasps bin_1"}, "is fixed"),
        ({"expect": "holds cube_3 for 2 s"}, "no object 'cube_3'"),
        ({"expect": "places cube_1 on cube_1"}, "cannot lie on itself"),
        ({"expect": "releases cube_1 within 5 mm of tray_1"}, "no object 'tray_1'"),
        ({"expect": "distance > 60 cm"}, "measured up to 500 mm"),
        ({"expect": "passes within 5 mm of [2, 2, 2]"}, "out of reach"),
        ({"expect": "ends within 5 mm of [0, 0, 3]"}, "out of reach"),
        ({"expect": "within 50% of jerk limits"}, "states no jerk limit"),
        ({"expect": "parallel mode used"}, "no mode"),
        ({"expect": "joints within 5 deg of the reference"}, "names no reference"),
        ({"expect": "cycle < 8 s", "partial": "until 6 s"}, "must lie above"),
        ({"expect": "distance > 5 cm", "partial": "until 6 cm"}, "must lie below"),
        ({"expect": "passes within 5 mm of poses", "partial": "each",
          "poses": [[0.4, 0.1, 0.4]]}, "there is one pose"),
        ({"expect": "passes within 5 mm and 5 deg of poses", "poses": [[0.4, 0.1, 0.4]]},
         "pose 1 has no orientation"),
        ({"expect": "no collision", "hidden": True}, "has no hint"),
    ],
)  # fmt: skip
def test_the_linter_says_what_cannot_be_measured(test, words):
    rubric = parse({"tests": [{"points": 1, **test}]}, "r")
    flaws = flaws_of(rubric, GROUND)
    assert any(words in flaw.message for flaw in flaws), [f.message for f in flaws]


def test_a_direction_of_no_length_is_told_with_its_line():
    pose = {"position": [0.4, 0.1, 0.4], "orientation": [0, 0, 0, 0]}
    test = {"expect": "passes within 5 mm of poses", "points": 1, "poses": [pose]}
    with pytest.raises(BadInput, match="r:7: test 'passes .*: pose 1: .* length 0"):
        parse({"tests": [test]}, "r", {("tests", 0): 7})


def test_what_can_be_measured_has_no_errors():
    sentences = [
        "no collision", "grasps cube_1", "places cube_1 in bin_1", "distance to bin_1 > 5 cm",
        "passes within 5 mm of [0.45, 0.2, 0.4]", "passes within 5 mm of [0.45, 0.2]",
        "cycle ≤ 8 s", "no collision with the floor",
    ]  # fmt: skip
    tests = [{"expect": s, "points": 1} for s in sentences]
    flaws = flaws_of(parse({"tests": tests}, "r"), GROUND)
    assert [f.message for f in flaws if f.severity is Severity.ERROR] == []
