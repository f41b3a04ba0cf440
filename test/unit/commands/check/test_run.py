"""`mrlab check` as a whole, in this process: exit codes, words, JSON, page, hash."""

from __future__ import annotations

import json
import shutil
from pathlib import Path

import pytest
from page_document import document_in
from refusals import command_refuses
from typer.testing import CliRunner

from mrlab_ros.cli import make_app
from mrlab_ros.commands.check import command

pytestmark = pytest.mark.slow

ROOT = Path(__file__).parents[4]
QUINTIC = str(ROOT / "examples" / "quintic_ur5e.mat")
PICK = str(ROOT / "examples" / "pick_and_place_ur5e.mat")


def check(*words):
    return CliRunner().invoke(make_app(["check"]), ["check", *map(str, words)])


def test_a_grasp_in_its_scene_is_ready_and_told(tmp_path):
    points = tmp_path / "points.csv"
    points.write_text("x,y,z\n0.42596,-0.29826,0.18\n0.0,0.0,3.0\n")
    given = (PICK, "--robot", "ur5e", "--scene", "pick_and_place")
    found = json.loads(check(*given, "--json").stdout)
    assert found["verdict"] == "ready"
    # a load that changes while it holds the cube is no further grasp
    assert [g["state"] for g in found["grasps"]] == ["open", "closing", "holding", "open"]
    assert found["grasps"][2]["object"] == "cube_1"
    assert {c["other"] for c in found["clearances"]} >= {"cube_1", "bin_1", "floor"}
    other = check(*given, "--points", points, "--within", "3cm", "--json")
    assert other.exit_code == 1
    misses = [f for f in json.loads(other.stdout)["findings"] if f["code"] == "misses_point"]
    assert [f["values"]["number"] for f in misses] == [2]


def test_a_motion_that_closes_a_gripper_is_told_that_there_is_none():
    found = json.loads(check(PICK, "--robot", "ur5e", "--scene", "empty", "--json").stdout)
    (bare,) = found["findings"]
    assert (bare["code"], bare["robot"], bare["time"]) == ("bare_flange", "ur5e_1", 1.85)
    assert found["verdict"] == "ready"


def test_a_collision_refuses_and_the_page_and_the_report_have_one_hash(tmp_path):
    given = (QUINTIC, "--robot", "ur5e", "--scene", "obstacle_course")
    page = tmp_path / "page.html"
    said = check(*given, "--out", page)
    assert said.exit_code == 1
    assert said.stdout.startswith("not ready: ")
    found = json.loads(check(*given, "--json").stdout)
    hits = [f for f in found["findings"] if f["code"] == "collision"]
    assert {"pedestal_1", "pillar_2"} <= {f["other"] for f in hits}
    assert found["summary"]["code"] == "check_not_ready"
    assert found["summary"]["values"]["time"] == pytest.approx(3.15, abs=0.06)
    assert all(f["link"] and f["time"] > 3 and f["value"] > 0 and f["remedy"] for f in hits)
    assert found["hash"] in said.stdout.replace("\n", "")
    shown = document_in(page)["check"]
    assert shown["hash"] == found["hash"]
    assert "pedestal_1" in [f.get("other") for f in shown["findings"]]
    assert "pedestal_1" in page.read_text()  # without a script, too


@pytest.mark.parametrize(
    ("words", "code", "values"),
    [
        (("--robot", "ur6e"), "no_robot_model", {}),
        (("--robot", "ur5e", "--scene", "tabel"), "no_scene", {}),
        (("--robot", "ur5e", "--tool", "hammer"), "no_end_effector", {}),
        (("--robot", "kuka_kr3_r540", "--scene", "table"), "model_not_in_scene",
         {"robot": "kuka_kr3_r540"}),
        ((), "robot_not_named", {"file": "quintic_ur5e.mat"}),
        (("--robot", "ur5e", "--within", "5 miles"), "no_length", {"option": "within"}),
        (("--robot", "ur5e", "--within", "5"), "length_without_unit", {"text": "5"}),
        (("--robot", "ur5e", "--points", "nowhere.csv"), "points_not_read",
         {"file": "nowhere.csv"}),
        (("--robot", "ur5e", "--out", "page.pdf"), "page_name", {"name": "page.pdf"}),
        (("--robot", "ur5e", "--closest", "600mm"), "too_far_to_measure",
         {"value": 0.6, "most": 0.5}),
    ],
)  # fmt: skip
def test_what_cannot_be_checked_ends_with_2_and_a_code(words, code, values):
    with command_refuses(command, code, **values):
        assert check(QUINTIC, *words).exit_code == 2


def test_a_missing_file_or_robot_ends_with_2_too():
    for words in ((QUINTIC,), ("nowhere.mat", "--robot", "ur5e")):
        said = check(*words)
        assert said.exit_code == 2
        assert said.stderr.startswith("mrlab: ")
        assert Path(words[0]).name in said.stderr


CELL = """
robots:
  - {name: left, model: ur5e, position: [0, 0, 0]}
  - {name: right, model: ur5e, position: [1.25, 0, 0], orientation: [0, 0, 1, 0]}
systems:
  - name: pair
    members:
      - {robot: left, trajectory: quintic_ur5e.mat}
      - {robot: right, trajectory: quintic_ur5e.mat}
"""


def test_two_robots_that_collide_are_told_the_wait_that_resolves_it(tmp_path):
    shutil.copy(QUINTIC, tmp_path)
    cell, page = tmp_path / "cell.yaml", tmp_path / "cell.html"
    cell.write_text(CELL)
    said = check(cell, "--json", "--out", page)
    found = json.loads(said.stdout)
    assert said.exit_code == 1
    (pair,) = found["pairs"]
    assert pair["touches"]
    assert 3.0 < pair["conflict"] < 3.3
    assert pair["closing"] > 0.5
    wait = found["wait"]
    assert wait["clears"]
    assert wait["all_clear"]
    assert document_in(page)["check"]["hash"] == found["hash"]
    # The advice followed to the letter.
    robot = f"robot: {wait['robot']}, "
    line = f"{robot}after: {wait['other']}.frame {wait['frame']}, "
    cell.write_text(CELL.replace(robot, line))
    again = check(cell, "--json")
    assert again.exit_code == 0
    assert json.loads(again.stdout)["pairs"][0]["conflict"] is None


@pytest.mark.parametrize(
    ("text", "code", "values"),
    [
        ("members: [{robot: left, trajectory: a.mat}]", "places_not_known", {}),
        (CELL.replace("robot: right", "robot: rihgt"), "robot_not_among", {"robot": "rihgt"}),
        (CELL.replace("quintic_ur5e", "nowhere"), "member_file_missing",
         {"trajectory": "nowhere.mat", "robot": "left"}),
        (CELL.replace("- name: pair", "- name: pair\n    rate: -1.0"), "plays_backwards", {}),
        ("members: [", "not_of_format", {}),
    ],
)  # fmt: skip
def test_a_cell_that_cannot_be_checked_ends_with_2_and_a_code(tmp_path, text, code, values):
    shutil.copy(QUINTIC, tmp_path)
    cell = tmp_path / "cell.yaml"
    cell.write_text(text)
    with command_refuses(command, code, **values):
        assert check(cell).exit_code == 2


@pytest.mark.parametrize(
    ("option", "value", "code"),
    [("--scene", "table", "robots_twice"), ("--tool", "vacuum_cup", "for_one_motion")],
)
def test_a_cell_does_not_pass_over_an_option(tmp_path, option, value, code):
    cell = tmp_path / "cell.yaml"
    cell.write_text(CELL)
    with command_refuses(command, code):
        assert check(cell, option, value).exit_code == 2


def test_a_damaged_trajectory_file_is_told_as_such_without_a_robot(tmp_path):
    file = tmp_path / "mine.json"
    file.write_text('{"schema_version": "1.0"}')
    with command_refuses(command, "not_as_schema"):
        check(file, "--out", tmp_path / "page.html")
