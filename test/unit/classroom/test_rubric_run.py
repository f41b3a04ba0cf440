"""`mrlab rubric` as a whole, in this process: the documentation's commands, cells, mistakes."""

from __future__ import annotations

import json
import re
import shlex
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
import scipy.io
import yaml
from page_document import document_in
from refusals import command_refuses
from typer.testing import CliRunner

from mrlab_ros.adapters.trajectories import formats
from mrlab_ros.classroom import commands as rubric_command
from mrlab_ros.classroom.rubrics.document import parse
from mrlab_ros.cli import make_app

pytestmark = pytest.mark.slow

ROOT = Path(__file__).parents[3]
PAGE = (ROOT / "docs" / "rubrics.md").read_text()
RUBRIC = ROOT / "examples" / "rubrics" / "pick_and_place.yaml"
QUINTIC = ROOT / "examples" / "quintic_ur5e.mat"


def run(*words):
    return CliRunner().invoke(make_app([words[0]]), [*map(str, words)])


def mark(file, rubric, *words):
    return run("rubric", "mark", file, "--rubric", rubric, *words)


BLOCK = re.search(r"test_rubric_run.py -->\n```\n(.*?)```", PAGE, re.DOTALL)
COMMANDS = [shlex.split(line)[1:] for line in BLOCK[1].splitlines()]


@pytest.mark.parametrize(
    ("command", "code", "words"),
    [
        (COMMANDS[0], 0, "works: Pick and place, 13 tests, 15 points; the reference gets 15"),
        (COMMANDS[1], 0, "15 of 15 points: pick_and_place_ur5e.mat"),
        (COMMANDS[2], 1, "cube_1 is never grasped; the gripper does not close"),
    ],
)
def test_the_commands_of_the_documentation(tmp_path, monkeypatch, command, code, words):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "examples").symlink_to(ROOT / "examples")
    said = run(*command)
    assert said.exit_code == code
    assert words in " ".join(said.stdout.split())
    if "--public" not in command:
        return
    page = tmp_path / "marks.html"
    found = document_in(page)
    for shown in (said.stdout, json.dumps(found)):
        assert "Keeps away from the bin" not in shown
        assert "Compare your motion" in shown
    assert "Keeps away from the bin" not in page.read_text()
    times = [mark["time"] for mark in found["check"]["marks"]["tests"] if not mark["passed"]]
    assert 0.0 in times
    assert any(3 < time < 4 for time in times)


def test_the_rubric_of_the_documentation_is_read():
    block = re.search(r"read by .*/test_rubric_run.py -->\n```yaml\n(.*?)```", PAGE, re.DOTALL)
    rubric = parse(yaml.safe_load(block[1]), "docs")
    assert (rubric.points, len(rubric.tests[1].measure.poses)) == (6.0, 3)


@pytest.mark.parametrize("path", sorted(RUBRIC.parent.glob("*.yaml")), ids=lambda path: path.name)
def test_a_shipped_rubric_gives_nothing_for_nothing_and_marks_fall_with_the_mistake(path):
    said = run("rubric", "lint", path, "--json")
    assert said.exit_code == 0, said.stdout
    found = json.loads(said.stdout)
    assert found["flaws"] == []
    points = {trial["name"]: trial["points"] for trial in found["trials"]}
    assert points["nothing at all"] == 0
    assert points["reference"] == found["points"]
    cut = [points[f"cut at {share}%"] for share in (25, 50, 75)]
    assert cut == sorted(cut)
    assert cut[-1] <= 0.7 * found["points"]
    assert points["reversed"] < cut[0]


CELL = """
scene: handover
reference: {0}
tests:
  - {{expect: no collision with the floor, points: 1}}
  - {{expect: parallel mode used, points: 1}}
  - {{expect: grasps rod_1 by ur5e_1 before 3 s, points: 1}}
  - {{expect: holds rod_1 from 2 s to 6 s, points: 2, partial: each}}
  - {{expect: grasps rod_1 by kuka_kr6_r900_sixx_1 after 4 s, points: 1}}
  - {{expect: total time < 5 s, points: 1, hidden: true, hint: Be quick.}}
  - {{expect: cycle of ur5e_1 < 20 s, points: 1}}
  - {{expect: joints within 1 deg of the reference, points: 1}}
"""


def test_a_cell_is_marked_and_the_reference_that_loses_points_is_told(tmp_path):
    rubric = tmp_path / "cell.yaml"
    rubric.write_text(CELL.format(ROOT / "examples" / "handover_cell.yaml"))
    said = run("rubric", "lint", rubric, "--json")
    assert said.exit_code == 1
    found = json.loads(said.stdout)
    assert found["reference"]["points"] == 8
    lost = [t for t in found["reference"]["tests"] if not t["passed"]]
    assert [t["name"] for t in lost] == ["total time < 5 s"]
    assert lost[0]["time"] == 5.0
    (flaw,) = found["flaws"]
    assert flaw["line"] == 10
    assert (flaw["code"], flaw["severity"]) == ("reference_loses", "error")
    assert flaw["values"]["lost"] == flaw["values"]["of"] == 1.0
    assert flaw["values"]["why"]["code"] == "total_time"


def test_the_report_of_the_check_comes_with_the_marks(tmp_path):
    rubric = tmp_path / "r.yaml"
    rubric.write_text("robot: ur5e\ntests: [{expect: cycle < 4 s, points: 2, partial: until 8 s}]")
    said = mark(QUINTIC, rubric, "--report", "--json")
    assert said.exit_code == 1
    found = json.loads(said.stdout)
    assert found["report"]["verdict"] == "ready"
    (test,) = found["tests"]
    assert (test["points"], test["time"], test["found"]["unit"]) == (1.0, 4.0, "s")
    assert test["found"]["code"] == "cycle_time"
    assert found["report"]["hash"] in mark(QUINTIC, rubric, "--report").stdout


def test_a_trajectory_file_that_is_damaged_or_of_another_robot_gets_nothing(tmp_path):
    convert = ("convert", ROOT / "examples" / "two_robot_handover_kr6.mat", "--robot")
    run(*convert, "kuka_kr6_r900_sixx", "--out", tmp_path)
    (tmp_path / "broken.json").write_text("{}")
    for file, code, values in (
        ("two_robot_handover_kr6.json", "motion_of_another_robot",
         {"found": "kuka_kr6_r900_sixx", "model": "ur5e"}),
        ("broken.json", "", {}),
    ):  # fmt: skip
        found = json.loads(mark(tmp_path / file, RUBRIC, "--public", "--json").stdout)
        assert found["points"] == 0
        assert found["note"]["severity"] == "error"
        assert not code or found["note"]["code"] == code
        assert values.items() <= found["note"]["values"].items()


def test_a_motion_gets_the_same_marks_in_every_format(tmp_path):
    """A jump is no less a jump in a trajectory file, which skips the conversion."""
    run("convert", QUINTIC, "--robot", "ur5e", "--out", tmp_path)
    good = formats.parse((tmp_path / "quintic_ur5e.json").read_bytes(), "quintic_ur5e.json")
    jumps = np.array(good.positions)
    jumps[jumps.shape[0] // 2 :, 0] += 1.0
    rubric = tmp_path / "r.yaml"
    rubric.write_text(
        "robot: ur5e\ntests: [{expect: cycle < 20 s, points: 2}, {expect: ready, points: 1}]"
    )
    for positions, expected in ((np.array(good.positions), 3.0), (jumps, 0.0)):
        times = np.arange(len(positions)) / good.frame_rate
        scipy.io.savemat(tmp_path / "a.mat", {"q": positions, "fs": good.frame_rate})
        formats.write(replace(good, positions=positions), tmp_path / "a.json")
        heads = ",".join(("time", *good.joint_names))
        table = np.column_stack([times, positions])
        np.savetxt(tmp_path / "a.csv", table, delimiter=",", header=heads, comments="")
        said = {
            suffix: json.loads(mark(tmp_path / f"a.{suffix}", rubric, "--json").stdout)
            for suffix in ("mat", "json", "csv")
        }
        assert {suffix: found["points"] for suffix, found in said.items()} == dict.fromkeys(
            said, expected
        )
        codes = {found["note"]["code"] if found["note"] else "" for found in said.values()}
        assert codes == {"" if expected else "discontinuity"}


def test_what_is_held_may_touch_what_the_gripper_keeps_away_from(tmp_path):
    rubric = tmp_path / "r.yaml"
    rubric.write_text(
        "robot: ur5e\nscene: pick_and_place\ntests:\n"
        "  - {expect: distance to everything but cube_1 > 10 mm, points: 1}\n"
        "  - {expect: distance to the floor > 10 mm, points: 1}\n"
    )
    found = json.loads(
        mark(ROOT / "examples" / "pick_and_place_ur5e.mat", rubric, "--json").stdout
    )
    assert [t["points"] for t in found["tests"]] == [1.0, 0.0]


def test_a_file_without_a_motion_gets_nothing_and_a_reason():
    said = mark(ROOT / "README.md", RUBRIC, "--json")
    assert said.exit_code == 1
    found = json.loads(said.stdout)
    assert (found["points"], found["of"]) == (0.0, 15.0)
    assert found["note"]["code"] == "unsupported_format"


def test_the_example_works_where_it_is_written_and_the_measures_are_printed(tmp_path):
    (tmp_path / "rubric.yaml").write_text(run("rubric", "example").stdout)
    said = run("rubric", "lint", tmp_path / "rubric.yaml", "--json")
    assert said.exit_code == 0, said.stdout
    assert json.loads(said.stdout)["reference"]["points"] == 15
    held = json.loads(run("rubric", "example", "--json").stdout)
    assert held["name"] == "Pick and place"
    listed = json.loads(run("rubric", "measures", "--json").stdout)
    assert {"each"} in [set(form["partial"]) for form in listed]
    assert "grasps OBJECT [by ROBOT] between FROM and TO" in run("rubric", "measures").stdout


@pytest.mark.parametrize(
    ("text", "sentence"),
    [
        ("robot: ur6e\ntests: [{expect: no collision, points: 1}]", "Did you mean 'ur5e'"),
        ("robot: ur5e\nscene: tabel\ntests: [{expect: no collision, points: 1}]", "'table'"),
        ("tests: [{expect: no colision, points: 1}]", "r.yaml:1: test 'no colision'"),
        ("robot: ur5e\nreference: no.mat\ntests:\n- expect: joints within 1 deg of the reference\n"
         "  points: 1", "r.yaml: reference: There is no file"),
        ("tests: 5", "expected a list"),
        ("tests: [{expect: no collision, points: 1}]", "add robot: ur5e to the rubric"),
        ("closest: 2 m\ntests: [{expect: no collision, points: 1}]", "0 to 500 mm"),
    ],
)  # fmt: skip
def test_what_cannot_be_marked_ends_with_2_and_a_sentence(tmp_path, text, sentence):
    rubric = tmp_path / "r.yaml"
    rubric.write_text(text)
    said = mark(QUINTIC, rubric)
    assert said.exit_code == 2
    assert sentence in said.stderr
    assert said.stderr.startswith("mrlab: ")


def test_a_cell_by_a_rubric_for_one_robot_is_refused():
    with command_refuses(rubric_command, "cell_for_one_robot", robot="ur5e"):
        assert mark(ROOT / "examples" / "handover_cell.yaml", RUBRIC).exit_code == 2
