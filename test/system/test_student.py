"""A student with a file that is refused, by messages alone; and the verbs for one robot."""

from __future__ import annotations

import json
import re
import shlex
import time
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import scipy.io
from graph import wait_for
from launched_lab import DEADLINE, launched_lab
from typer.testing import CliRunner

from mrlab_ros import Lab, Options
from mrlab_ros.cli import make_app
from mrlab_ros.client.lab import FileRefused
from mrlab_ros.client.link import LinkGraph
from mrlab_ros.commands.output import with_fixes
from mrlab_ros.core.base.errors import LabError, Misuse

RATE = 100.0


@pytest.fixture(scope="module")
def lab(tmp_path_factory: pytest.TempPathFactory) -> Iterator[None]:
    # A short name: the path of a Unix socket has 107 bytes at most.
    folder = tmp_path_factory.mktemp("s")
    with (
        pytest.MonkeyPatch.context() as patch,
        launched_lab(folder, patch, "--robots", "ur5e", "--physics"),
    ):
        yield


def said(*words: str) -> tuple[int, str]:
    """Run a command in this process; return its exit code and all that it printed."""
    done = CliRunner().invoke(make_app(words), words)
    if isinstance(done.exception, LabError):
        return 1, f"{done.output}{with_fixes(done.exception.diagnostic)}"
    assert done.exception is None or isinstance(done.exception, SystemExit), done.exception
    return done.exit_code, done.output


def ok(*words: str) -> str:
    code, output = said(*words)
    assert code == 0, output
    return output


def motion() -> np.ndarray[Any, Any]:
    """A calm motion of one second, (101, 6) rad."""
    u = np.linspace(0, 1, 101)[:, None]
    home = np.array([0, -1.57, 1.57, -1.57, -1.57, 0])
    return home + (10 * u**3 - 15 * u**4 + 6 * u**5) * np.array([0.9, 0.2, -0.3, 0.2, 0.4, 0.6])


def write(path: Path) -> None:
    """Write the motion with the fault that the file's name says."""
    q, name = motion(), path.stem
    shifted = np.column_stack([(q[:, 0] + 2.6 + np.pi) % (2 * np.pi) - np.pi, q[:, 1:]])
    content: dict[str, Any] = {
        "degrees": {"q": np.degrees(q)},
        "transposed": {"q": q.T},
        "columns": {"data": np.column_stack([np.arange(101) / RATE, q, 0 * q[:, 0]])},
        "wrapped": {"q": shifted},
        "matrices": {"a": q, "b": q[::-1].copy()},
    }.get(name, {"q": np.degrees(q)})
    if path.suffix == ".csv":
        np.savetxt(path, content["q"], delimiter=",")
    elif path.suffix == ".npz":
        np.savez(path, q=q.T, fs=RATE)
    elif path.suffix == ".json":
        path.write_text(json.dumps({"q": content["q"].tolist(), "fs": RATE}))
    else:
        scipy.io.savemat(path, {**content, "fs": RATE})


def test_an_array_is_played_without_a_file(lab: None) -> None:
    times = np.arange(51) / RATE
    q = np.column_stack([np.sin(times), *([-1.2 + 0 * times] * 5)])
    with Lab() as lab_:
        run = lab_.play(q, fs=RATE, speed=4)
        assert run.wait(DEADLINE)
        (motion,) = [each for each in lab_.trajectories() if each.id.endswith("array")]
    assert (motion.frame_count, motion.frame_rate) == (51, RATE)


def state() -> str:
    with Lab() as lab:
        return lab.robot("ur5e_1").state


@pytest.mark.parametrize(
    "name",
    [
        "degrees.mat",
        "transposed.mat",
        "columns.mat",
        "wrapped.mat",
        "matrices.mat",
        "table.csv",
        "arrays.npz",
        "document.json",
    ],
)
def test_the_messages_alone_lead_from_a_refused_file_to_a_robot_that_moves(
    lab: None, tmp_path: Path, name: str
) -> None:
    path = tmp_path / name
    write(path)
    words = ["mrlab", "play", "ur5e_1", str(path)]
    for _ in range(4):
        code, output = said(*words[1:], "--speed", "4", "--no-wait")
        if code == 0:
            break
        tries = [line.partition("try: ")[2] for line in output.splitlines() if "try: " in line]
        assert tries, output
        words = shlex.split(tries[0])
    assert code == 0, output
    # A state comes to the bridge by another way than a service's answer.
    wait_for(lambda: state() in ("ADJUSTING", "PLAYING", "COMPLETE", "READY"), "the motion")
    assert f"ur5e_1 plays {path.stem}" in output
    ok("stop", "ur5e_1")


def test_what_convert_writes_can_be_played_and_replaces_nothing(lab: None, tmp_path: Path) -> None:
    scipy.io.savemat(tmp_path / "mine.mat", {"q": motion(), "fs": RATE})
    mine = (tmp_path / "mine.mat").read_bytes()
    convert = ("convert", str(tmp_path / "mine.mat"), "--robot", "ur5e", "--out")
    for options in ((), ("--force",)):
        code, output = said(*convert, str(tmp_path), "--to", "mat", *options)
        assert code == 1
        assert "is read as well" in output
    assert (tmp_path / "mine.mat").read_bytes() == mine
    out = tmp_path / "out"
    for form in ("json", "csv", "mat", "npz", "jointtrajectory"):
        ok(*convert, str(out), "--to", form)
        code, output = said(*convert, str(out), "--to", form)
        assert (code, "--force" in output) == (1, True)
        ok(*convert, str(out), "--to", form, "--force")
    for file in sorted(out.iterdir()):
        ok("load", "ur5e_1", str(file))
    assert len(list(out.iterdir())) == 5


def test_after_a_collision_the_commands_of_the_message_lead_on(lab: None, tmp_path: Path) -> None:
    scipy.io.savemat(tmp_path / "hit.mat", {"q": motion(), "fs": RATE})
    ok("objects", "spawn", "pillar", "--at", "0.5,0.4,0.5")
    code, output = said("play", "ur5e_1", str(tmp_path / "hit.mat"))
    assert code == 1
    assert "pillar_1" in output
    stop, remove, _, resume = map(shlex.split, re.findall(r"try: mrlab (.*)", output))
    assert stop == ["stop", "ur5e_1"]
    ok(*remove)
    ok(*stop)
    end = time.monotonic() + DEADLINE
    while state() != "PAUSED":
        assert time.monotonic() < end
        time.sleep(0.02)
    ok(*resume)
    ok("play", "ur5e_1")


def test_the_verbs_say_what_they_did(lab: None) -> None:
    spawned = json.loads(ok("spawn", "ur5e", "--at", "2,0", "--yaw", "90", "--json"))
    robot = spawned["robot"]
    assert spawned["message"].startswith(f"{robot} stands at x 2.000 y 0.000")
    assert "Did you mean 'ur5e'" in said("spawn", "ur6e")[1]
    assert ok("tool", robot, "parallel_gripper") == f"{robot} carries parallel_gripper.\n"
    assert ok("place", robot, "--at", "-2,0.5") == f"{robot} is placed.\n"
    code, output = said("pause", robot)
    assert (code, output) == (1, f"{robot}: cannot pause in IDLE; possible now: load")
    assert ok("rate", robot, "0.5") == f"{robot}: rate 0.5\n"
    assert ok("loop", robot) == f"{robot}: loops\n"
    assert "speed is set with --speed" in said("play", robot, "mine", "--rate", "2")[1]
    ok("remove", robot)


def test_a_recording_is_ended_from_another_terminal(lab: None, tmp_path: Path) -> None:
    with Lab() as lab_:
        recording = lab_.record(tmp_path / "class.bag")
        assert "it is being recorded" in ok("bag", "info", str(recording.bag))
        assert "try: mrlab record --stop" in said("bag", "repair", str(recording.bag))[1]
        assert json.loads(ok("record", "--stop", "--json"))["bag"] == str(recording.bag)
        assert "nothing is recorded" in said("record", "--stop")[1]
        with lab_.record(tmp_path / "second.bag") as recording:
            assert recording.bag == tmp_path / "second.bag"
    assert (tmp_path / "second.bag" / "metadata.yaml").is_file()


def wait_until_at(positions: np.ndarray[Any, Any], samples: list[Any]) -> None:
    """Wait for the joint states of a robot that has come to `positions`."""
    wait_for(
        lambda: samples and np.allclose(samples[-1].positions, positions, atol=1e-9),
        "the last frame",
    )


def test_the_python_api_drives_a_robot(lab: None, tmp_path: Path) -> None:
    scipy.io.savemat(tmp_path / "api.mat", {"q": np.degrees(motion()), "fs": RATE})
    with Lab() as lab_:
        assert isinstance(lab_.graph, LinkGraph)  # over the socket: no discovery
        robot = lab_.robot("ur5e_1")
        with pytest.raises(FileRefused) as refused:
            lab_.convert(tmp_path / "api.mat", robot)
        assert refused.value.result.diagnostics[0].code == "degrees"
        found = lab_.convert(tmp_path / "api.mat", robot, Options(degrees=True))
        assert (found.frame_count, found.frame_rate) == (101, RATE)
        assert found.id in [each.id for each in lab_.trajectories()]
        samples: list[Any] = []
        robot.watch(samples.append)
        run = robot.play(found, speed=4.0)
        assert run.wait(DEADLINE)
        wait_until_at(motion()[-1], samples)
        run = robot.play(speed=0.1)
        robot.stop()
        with pytest.raises(Misuse, match="ended before its last frame: stopped"):
            run.wait(DEADLINE)


def test_a_file_that_changed_is_played_anew_under_its_name(lab: None, tmp_path: Path) -> None:
    path = tmp_path / "again.mat"
    samples: list[Any] = []
    with Lab() as lab_:
        robot = lab_.robot("ur5e_1")
        robot.watch(samples.append)
        for end in (0.2, -0.2):
            q = motion()
            q[:, 0] *= end / q[-1, 0]
            scipy.io.savemat(path, {"q": q, "fs": RATE})
            ok("play", "ur5e_1", str(path), "--speed", "4")
            wait_until_at(q[-1], samples)
        q[:, 0] /= 2
        scipy.io.savemat(path, {"q": q, "fs": RATE})
        lab_.convert(path, robot)
        ok("play", "ur5e_1", "again", "--speed", "4")
        wait_until_at(q[-1], samples)


def test_status_says_who_drives_and_folds(lab: None, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("COLUMNS", "50")
    output = ok("status", "--once")
    assert "ur5e_1" in output
    assert max(map(len, output.splitlines())) <= 50
    facts = json.loads(ok("status", "--json"))
    assert all(facts["nodes"].values())
