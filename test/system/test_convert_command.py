"""The `mrlab convert` command as a student runs it."""

import json
import os

import in_process
import launched_lab
import numpy as np
import pytest
import rclpy
import scipy.io
from builtin_interfaces.msg import Duration
from trajectory_msgs.msg import JointTrajectory, JointTrajectoryPoint

from mrlab_ros.adapters.robots.library import RobotLibrary
from mrlab_ros.adapters.share import directory
from mrlab_ros.adapters.trajectories.formats import parse
from mrlab_ros.messages import qos


def motion(rows=200):
    u = np.linspace(0, 1, rows)[:, None]
    return (10 * u**3 - 15 * u**4 + 6 * u**5) * np.linspace(0.2, 0.9, 6) - 0.3


def run(*arguments, start=in_process.mrlab):
    """Run it in this process, or by `start` in one of its own."""
    return start("convert", "--robot", "ur5e", *arguments)


@pytest.fixture
def folder(tmp_path):
    inside = tmp_path / "in"
    inside.mkdir()
    q = np.column_stack([motion(), np.arange(200) > 100])
    scipy.io.savemat(inside / "good.mat", {"q": q, "fs": 50.0})
    scipy.io.savemat(inside / "two.mat", {"q1": motion(), "q2": motion() + 0.5})
    (inside / "bad.mat").write_text("q = 1;")
    return inside


def test_one_json_object_a_file_and_the_exit_code_of_the_worst(folder, tmp_path):
    done = run("--json", "--out", tmp_path / "out", folder, start=launched_lab.mrlab)
    assert done.returncode == 1, done.stderr
    bad, good, two = (json.loads(line) for line in done.stdout.splitlines())
    assert (bad["outcome"], bad["diagnostics"][0]["code"]) == ("rejected", "unsupported_format")
    assert (two["outcome"], two["trajectory"]) == ("ambiguous", None)
    assert [c["variable"] for c in two["candidates"]] == ["q1", "q2"]
    assert set(two["candidates"][0]) >= {"variable", "shape", "score", "why"}
    assert good["outcome"] == "accepted"
    assert good["variable"] == "q"
    assert good["shape"] == [200, 7]
    assert good["has_gripper"] is True
    assert good["frame_rate"] == 50.0
    with open(good["trajectory"], "rb") as file:
        trajectory = parse(file.read(), "good.json")
    np.testing.assert_allclose(trajectory.positions, motion(), rtol=0, atol=1e-12)


def test_bad_inputs_have_an_answer_each_and_end_no_batch(folder, tmp_path):
    empty, long = tmp_path / "empty", "a" * 300 + ".mat"
    empty.mkdir()
    os.mkfifo(tmp_path / "fifo.mat")
    scipy.io.savemat(tmp_path / "over.mat", {"q": motion() * 1e308, "fs": 50.0})
    names = [tmp_path / "none.mat", empty, tmp_path / "fifo.mat", tmp_path / "over.mat", long]
    done = run("--json", *names, folder / "good.mat")
    answers = [json.loads(line) for line in done.stdout.splitlines()]
    assert [a["said"]["code"] for a in answers] == [
        "missing",
        "folder_without_files",
        "unsupported_format",
        "joint_limit",
        "missing",
        "trajectory_taken",
    ]
    assert done.returncode == 1
    assert done.stderr.count("There is no file") == 2


def test_the_choice_is_a_table_and_exit_code_2(folder):
    done = run(folder / "two.mat")
    assert done.returncode == 2, done.stderr
    assert "q1" in done.stdout
    assert "▁" in done.stdout
    assert "--variable q1" in done.stdout


def test_what_is_written_is_read_again_and_drawn(folder, tmp_path):
    out = tmp_path / "out"
    done = run("--out", out, "--to", "jointtrajectory", "--plot", out, folder / "good.mat")
    assert done.returncode == 0, done.stderr
    assert (out / "good.png").stat().st_size > 10_000
    again = run("--json", "--rate", "50", out)
    record = json.loads(again.stdout)
    assert record["outcome"] == "accepted", record
    assert (record["shape"], record["frame_rate"]) == ([200, 7], 50.0)


def test_a_joint_trajectory_comes_from_a_topic(tmp_path):
    names = RobotLibrary(directory() / "robots").model("ur5e").joint_names
    context = rclpy.Context()
    context.init()
    node = rclpy.create_node("planner", context=context)
    points = [
        JointTrajectoryPoint(positions=row.tolist(), time_from_start=Duration(sec=second))
        for second, row in enumerate(motion(3))
    ]
    topic = "/ur5e_1/joint_trajectory"
    node.create_publisher(JointTrajectory, topic, qos.LATCHED).publish(
        JointTrajectory(joint_names=names, points=points)
    )
    try:
        done = run("--json", "--out", tmp_path, "--topic", topic, "--timeout", "30")
    finally:
        node.destroy_node()
        context.try_shutdown()
    assert done.returncode == 0, done.stderr
    record = json.loads(done.stdout)
    assert (record["variable"], record["shape"]) == (topic, [201, 6])
    assert record["trajectory"].endswith("ur5e_1_joint_trajectory.json")


@pytest.mark.parametrize(
    ("arguments", "words", "start"),
    [
        (["--robot", "r2d2", "x.mat"], "r2d2", launched_lab.mrlab),
        (["--to", "doc", "x.mat"], "csv", in_process.mrlab),
        (["--end-effector", "hook", "x.mat"], "hook", in_process.mrlab),
        (["--units", "furlong", "x.mat"], "furlong", in_process.mrlab),
        (["--rate", "-1", "x.mat"], "-1", in_process.mrlab),
        ([], "--topic", in_process.mrlab),
    ],
)
def test_a_wrong_call_is_one_sentence(arguments, words, start):
    done = run(*arguments, start=start)
    assert done.returncode == 2
    assert words in done.stderr
    assert "Traceback" not in done.stderr


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (["--memory", "-1"], "--memory is -1; expected 64"),
        (["--time-limit", "nan"], "--time-limit is nan; expected 0.1"),
        (["--time-limit", "0"], "--time-limit is 0; expected 0.1"),
        (["--plot", "one.png"], "is one picture, and there are 3 files"),
    ],
)
def test_a_limit_that_cannot_be_is_refused_before_anything_is_read(folder, arguments, said):
    done = run(*arguments, folder)
    assert done.returncode == 2
    assert said in done.stderr
    assert "Traceback" not in done.stderr
    assert not done.stdout


@pytest.mark.parametrize("words", [("convert", "--to", "doc"), ("check", "--within", "far")])
def test_debug_adds_the_traceback_to_the_same_sentence_and_exit_code(folder, words):
    command, *rest = words
    given = (command, *rest, str(folder / "good.mat"), "--robot", "ur5e")
    plainly, traced = in_process.mrlab(*given), in_process.mrlab("--debug", *given)
    assert plainly.returncode == traced.returncode == 2
    assert "Traceback" not in plainly.stderr
    assert traced.stderr.startswith("Traceback")
    assert traced.stderr.endswith(plainly.stderr)


def test_what_cannot_be_written_ends_no_batch(folder, tmp_path):
    occupied = tmp_path / "file"
    occupied.write_text("")
    for option in ("--out", "--plot"):
        done = run(option, occupied / "inside", folder)
        assert done.returncode == 1
        assert f"{option} '{occupied / 'inside'}' cannot be written" in done.stderr
    (tmp_path / "out" / "good.json").mkdir(parents=True)
    done = run("--out", tmp_path / "out", "--force", "--json", folder)
    assert done.returncode == 1
    assert "not written" in done.stderr
    assert len(done.stdout.splitlines()) == 3
