"""Every command that messages and pages name is run, and every block of a page that can be."""

from __future__ import annotations

import builtins
import json
import re
import runpy
import shutil
import signal
import subprocess
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import scipy.io
from child_process import start_child
from graph import wait_for
from launched_lab import DEADLINE, MRLAB, launched_lab
from named_commands import GROUPS, PEOPLE
from own_port import free_endpoint
from page_blocks import ROOT, Block, all_blocks, pattern, plain
from rosbags.rosbag2 import Writer
from rosbags.typesys import Stores, get_typestore
from typer.testing import CliRunner

from mrlab_ros import Lab
from mrlab_ros.cli import make_app
from mrlab_ros.core.base.errors import LabError

RATE = 100.0
JOINTS = ("shoulder_pan", "shoulder_lift", "elbow", "wrist_1", "wrist_2", "wrist_3")
# What examines this machine may find something.
MAY_FAIL = ("doctor",)
RUN = [block for block in all_blocks() if block.run]
SHELL = [block for block in RUN if block.language == ""]
PYTHON = [block for block in RUN if block.language == "python"]
CELL = """
name: cell
members:
  - {robot: ur5e_1, trajectory: my_motion.mat}
"""


@pytest.fixture(scope="module")
def state(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The folder in which the lab keeps its state."""
    return tmp_path_factory.mktemp("n") / "state"


@pytest.fixture(scope="module")
def endpoint(state: Path) -> Iterator[str]:
    # A short name: the path of a Unix socket has 107 bytes at most.
    folder = state.parent
    (folder / "limits.yaml").write_text("pages: 500\n")
    listen = free_endpoint()
    options = (
        *("--robots", "ur5e", "--physics", "--http", "127.0.0.1:0", "--zenoh-listen", listen),
        *("--state-dir", state, "--web-limits", folder / "limits.yaml"),
    )
    with pytest.MonkeyPatch.context() as patch, launched_lab(folder, patch, *options):
        yield listen


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A folder to stand in, with what the commands need."""
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("COLUMNS", "200")
    monkeypatch.setenv("MRLAB_ROBOTS", str(tmp_path / "robots"))
    monkeypatch.delenv("DISPLAY", raising=False)
    scipy.io.savemat("my_motion.mat", {"q": motion(), "fs": RATE})
    Path("cell.yaml").write_text(CELL)
    Path("examples").symlink_to(ROOT / "examples")
    return tmp_path


def unsigned(text: str) -> str:
    """Return a text without the signs of its numbers."""
    return re.sub(r"(?<![\w.])-(?=[\d.])", "", text)


def motion() -> np.ndarray[Any, Any]:
    """A calm motion of one second, (101, 6) rad."""
    u = np.linspace(0, 1, 101)[:, None]
    home = np.array([0, -1.57, 1.57, -1.57, -1.57, 0])
    return home + (10 * u**3 - 15 * u**4 + 6 * u**5) * np.array([0.9, 0.2, -0.3, 0.2, 0.4, 0.6])


def write_foreign_bag() -> None:
    """Write a bag of another recorder: the joint states of a UR5e."""
    types = get_typestore(Stores.ROS2_HUMBLE)
    kind = "sensor_msgs/msg/JointState"
    names = [f"{joint}_joint" for joint in JOINTS]
    with Writer(Path("foreign_bag"), version=9) as bag:
        joints = bag.add_connection("/joint_states", kind, typestore=types)
        for i, row in enumerate(motion()):
            stamp = types.types["builtin_interfaces/msg/Time"](0, 0)
            header = types.types["std_msgs/msg/Header"](stamp, "")
            state = types.types[kind](header, names, row, np.zeros(0), np.zeros(0))
            bag.write(joints, 10**18 + i * 10**7, types.serialize_cdr(state, kind))


def run(*words: str, codes: tuple[int, ...] = (0,)) -> str:
    """Run a command in this process; return all that it printed."""
    done = CliRunner().invoke(make_app(words), words)
    if isinstance(done.exception, LabError):
        pytest.fail(f"mrlab {' '.join(words)}: {done.output}{done.exception}")
    assert done.exception is None or isinstance(done.exception, SystemExit), done.exception
    assert done.exit_code in codes, f"mrlab {' '.join(words)}: {done.output}"
    return done.output


class Recording:
    """`mrlab record` in a process of its own."""

    def __init__(self, words: tuple[str, ...]) -> None:
        self.process = start_child(*MRLAB, *words, stdout=subprocess.PIPE, text=True)
        assert self.process.stdout is not None
        self.said = self.process.stdout.readline()

    def end(self) -> str:
        """Wait for its end; return all that it printed."""
        try:
            self.said += self.process.communicate(timeout=DEADLINE)[0]
        finally:
            self.process.kill()
        assert self.process.returncode == 0, self.said
        return self.said


def set_robots(models: list[str]) -> None:
    """Leave these robots in the lab and nothing else."""
    run("scene", "load", "empty")
    with Lab() as lab:
        for model in models:
            lab.spawn(model)


def test_a_notebook_shows_what_it_does(endpoint: str, folder: Path) -> None:
    set_robots(["ur5e"])
    notebook = runpy.run_path(str(ROOT / "scripts" / "docs" / "notebook.py"))
    (file,) = (ROOT / "docs").glob("*.ipynb")
    kept = json.loads(file.read_text())
    anew = notebook["executed"](kept)

    def rest(document: dict[str, Any]) -> str:
        """A document without its numbers and pictures."""
        text = re.sub(r'"image/png": "[^"]+"', "", notebook["written"](document))
        return re.sub(r"[-+]?\d+(?:\.\d+)?(?:e-?\d+)?", "0", text)

    assert rest(anew) == rest(kept)


def test_people_are_named_where_no_lab_runs(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("XDG_RUNTIME_DIR", str(folder))
    for line in PEOPLE:
        run(*line.split())


@pytest.mark.parametrize("group", GROUPS)
def test_every_command_that_is_named_runs(endpoint: str, folder: Path, group: str) -> None:
    set_robots(["ur5e"])
    write_foreign_bag()
    recording: Recording | None = None
    for line in GROUPS[group].strip().splitlines():
        words = tuple(line.split())
        if words == ("record", "class.bag"):
            recording = Recording(words)
            continue
        run(*words, codes=(0, 1) if words[0] in MAY_FAIL else (0,))
        if words == ("record", "--stop"):
            assert recording is not None
            recording.end()


@pytest.mark.parametrize("block", SHELL, ids=lambda block: f"{block.page}-{block.line}")
def test_a_block_of_a_page_prints_what_the_page_says(
    endpoint: str, state: Path, block: Block, folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    shutil.rmtree(state / "scenes", ignore_errors=True)
    programs = [words[1:] for words in block.commands]
    if programs[0][0] == "keys":
        monkeypatch.setenv("XDG_RUNTIME_DIR", str(folder))
        if programs[0][1] != "init":
            run("keys", "init")
    else:
        set_robots(["ur5e"])
        write_foreign_bag()
    output = ""
    for words in programs:
        if words[0] == "up":
            if "--robots" in words:
                set_robots(words[words.index("--robots") + 1].split(","))
        elif words[0] == "record":
            recording = Recording(words)
            run("play", "ur5e_1", "my_motion.mat")
            recording.process.send_signal(signal.SIGINT)
            output += recording.end()
        else:
            output += run(*words)
    assert block.printed is not None
    assert pattern(block.printed).fullmatch(plain(output)), plain(output)


@pytest.mark.parametrize("block", PYTHON, ids=lambda block: f"{block.page}-{block.line}")
def test_a_python_block_of_a_page_runs(
    endpoint: str,
    block: Block,
    folder: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    set_robots(["ur5e"])
    scipy.io.savemat("my_motion.mat", {"q": np.degrees(motion()), "fs": RATE})
    run("load", "ur5e_1", str(ROOT / "examples" / "quintic_ur5e.mat"))
    printed = ""

    def enter(prompt: str) -> str:
        run("play", "ur5e_1", "--speed", "4", "--no-wait")

        def said() -> bool:
            nonlocal printed
            printed += capsys.readouterr().out
            return printed.count("\n") > 2

        wait_for(said, "joint states")
        return ""

    monkeypatch.setattr(builtins, "input", enter)
    exec(block.text.replace("tcp/127.0.0.1:7447", endpoint), {})
    printed += capsys.readouterr().out
    assert block.printed is not None
    # The robot moves: figures and their signs are those of an instant.
    found = plain(unsigned(printed))
    assert pattern(unsigned(block.printed)).fullmatch(found), printed[-2000:]
    shutil.rmtree("class.bag", ignore_errors=True)
    assert not re.search("Traceback", printed)
