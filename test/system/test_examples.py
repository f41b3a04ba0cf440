"""The shipped examples: what their MATLAB scripts write, and what the robots make of it."""

from __future__ import annotations

import importlib.util
import json
import re
import subprocess
from pathlib import Path

import h5py
import numpy as np
import pytest
from numpy.typing import NDArray
from page_blocks import blocks
from scipy.io import loadmat
from typer.testing import CliRunner

from mrlab_ros.adapters.robots.library import RobotLibrary
from mrlab_ros.cli import make_app

ROOT = Path(__file__).parents[2]
EXAMPLES = ROOT / "examples"
SCRIPTS = sorted(path for path in (EXAMPLES / "matlab").glob("*.m") if "save(" in path.read_text())
FUNCTIONS = sorted(
    {*(EXAMPLES / "matlab").glob("*.m"), *(ROOT / "matlab").rglob("*.m")} - {*SCRIPTS}
)
ROBOTS = {
    "quintic_ur5e": "ur5e",
    "pick_and_place_ur5e": "ur5e",
    "two_robot_handover_ur5e": "ur5e",
    "two_robot_handover_kr6": "kuka_kr6_r900_sixx",
}
# Octave and MATLAB round elementary functions differently in the last digits, and an inverse
# kinematics near a singular pose magnifies that.
SAME = 1e-6  # rad
BETWEEN_BASES = 1.2  # m, as in two_robot_handover.m
BETWEEN_TOOLS = 0.412  # m, two grippers of 0.166 and 0.08 of the rod

# How long a script may take, on a machine with many times as much to do as it has processors.
OCTAVE_S = 300.0

pytestmark = pytest.mark.timeout(OCTAVE_S + 30)
LIBRARY = RobotLibrary(ROOT / "robots")


def octave(script: Path, folder: Path) -> subprocess.CompletedProcess[str]:
    command = ["octave-cli", "--no-init-file", "--no-history", "--path", str(script.parent)]
    return subprocess.run(
        [*command, str(script)], cwd=folder, capture_output=True, text=True, timeout=OCTAVE_S
    )


def written_by(script: Path) -> list[str]:
    return re.findall(r"save\('([^']+)'", script.read_text())


def read(name: str) -> tuple[NDArray[np.float64], float]:
    """Return q, (N, 6 or 7), and fs of a shipped example."""
    content = loadmat(EXAMPLES / f"{name}.mat")
    return content["q"], float(content["fs"].item())


@pytest.mark.parametrize("script", SCRIPTS, ids=lambda path: path.stem)
def test_script_writes_the_shipped_files(script: Path, tmp_path: Path) -> None:
    done = octave(script, tmp_path)
    assert done.returncode == 0, done.stderr
    assert not done.stderr
    assert sorted(p.name for p in tmp_path.iterdir()) == sorted(written_by(script))
    for name in written_by(script):
        ours, shipped = loadmat(tmp_path / name), loadmat(EXAMPLES / name)
        assert ours["q"].shape == shipped["q"].shape
        assert np.abs(ours["q"] - shipped["q"]).max() < SAME
        assert ours["fs"] == shipped["fs"]


def test_the_lines_of_the_page_write_a_file_that_the_robot_can_play(tmp_path: Path) -> None:
    (lines,) = (b for b in blocks(ROOT / "docs" / "examples.md") if b.language == "matlab")
    script = tmp_path / "write_your_own.m"
    script.write_text(lines.text)
    done = octave(script, tmp_path)
    assert done.returncode == 0, done.stderr
    written = loadmat(tmp_path / "my_motion.mat")
    assert written["q"].shape == (401, 6)
    assert float(written["fs"].item()) == 100
    # It swings the base and comes back: what the page says beside the lines.
    assert np.ptp(written["q"], axis=0).round(9).tolist() == [1, 0, 0, 0, 0, 0]


def test_the_wrong_file_of_the_tutorial_is_mended_as_it_says(tmp_path: Path) -> None:
    page = ROOT / "docs" / "tutorials" / "first_motion.md"
    (lines,) = (b for b in blocks(page) if b.language == "matlab")
    (script := tmp_path / "wrong.m").write_text(lines.text)
    assert octave(script, tmp_path).returncode == 0
    words = ("convert", str(tmp_path / "my_motion.mat"), "--robot", "ur5e", "--json")
    refused, mended = (
        CliRunner().invoke(make_app(words), (*words, *unit)) for unit in ((), ("--units", "deg"))
    )
    errors = [each["code"] for each in json.loads(refused.stdout)["diagnostics"]]
    assert (refused.exit_code, mended.exit_code) == (1, 0)
    assert "degrees" in errors


def test_every_shipped_file_has_its_script() -> None:
    written = {name for script in SCRIPTS for name in written_by(script)}
    shipped = {path.name for path in EXAMPLES.glob("*.mat")}
    assert written == {f"{name}.mat" for name in ROBOTS}
    assert shipped == written | {"quintic_ur5e_v73.mat"}


@pytest.mark.parametrize("path", [*SCRIPTS, *FUNCTIONS], ids=lambda path: path.stem)
def test_source_is_matlab_not_only_octave(path: Path) -> None:
    lines = path.read_text().splitlines()
    whole = (line for line in lines if not line.lstrip().startswith("%"))
    code = "\n".join(re.sub(r"'[^'\n]*'", "''", line).split("%")[0] for line in whole)
    octave_only = (
        r"#|\bend(function|if|for|while)\b|\+=|-=|\+\+|!=|!|\"|\b(printf|puts|do|until|unwind)\b"
    )
    assert not re.search(octave_only, code)


@pytest.mark.parametrize(
    ("name", "version"),
    [
        ("quintic_ur5e", "compressed"),
        ("pick_and_place_ur5e", "plain"),
        ("two_robot_handover_ur5e", "compressed"),
        ("two_robot_handover_kr6", "compressed"),
    ],
)
def test_file_has_the_version_it_shows(name: str, version: str) -> None:
    content = (EXAMPLES / f"{name}.mat").read_bytes()
    assert content[124:128] == b"\x00\x01IM"
    compressed = int.from_bytes(content[128:132], "little") == 15  # miCOMPRESSED
    assert compressed == (version == "compressed")


@pytest.mark.parametrize(("name", "robot"), ROBOTS.items())
def test_motion_suits_the_robot(name: str, robot: str) -> None:
    model = LIBRARY.model(robot)
    q, fs = read(name)
    arm = q[:, : len(model.joints)]
    assert fs == 100.0
    assert 4.0 <= (len(q) - 1) / fs <= 8.0
    assert np.isfinite(q).all()
    assert np.abs(arm[[0, -1]] - model.home).max() < SAME
    assert (arm >= [joint.lower for joint in model.joints]).all()
    assert (arm <= [joint.upper for joint in model.joints]).all()
    speed = np.abs(np.diff(arm, axis=0)) * fs
    assert (speed.max(axis=0) < [0.8 * joint.max_velocity for joint in model.joints]).all()
    # Smooth: a jump of the velocity would show as an acceleration far above this, rad/s^2.
    assert np.abs(np.diff(arm, n=2, axis=0)).max() * fs**2 < 15.0
    links = model.chain.links(arm)
    assert min(pose[:, 2, 3].min() for link, pose in links.items() if link != "base_link") >= 0


@pytest.mark.parametrize("name", [name for name in ROBOTS if name != "quintic_ur5e"])
def test_gripper_closes_once_and_opens_again(name: str) -> None:
    gripper = read(name)[0][:, 6]
    assert set(gripper) == {0.0, 1.0}
    assert list(np.diff(gripper)[np.diff(gripper) != 0]) == [1.0, -1.0]


def test_pick_and_place_goes_straight_down_with_the_tool_pointing_down() -> None:
    q, fs = read("pick_and_place_ur5e")
    poses = LIBRARY.model("ur5e").chain.tool0(q[:, :6])
    assert poses[:, :3, 2] == pytest.approx(np.tile([0.0, 0.0, -1.0], (len(q), 1)), abs=1e-6)
    down = poses[round(1.2 * fs) : round(2.8 * fs)]
    assert np.ptp(down[:, :2, 3], axis=0) == pytest.approx(0, abs=1e-6)
    assert np.ptp(down[:, 2, 3]) == pytest.approx(0.10, abs=1e-6)
    closed = np.flatnonzero(q[:, 6])
    take, put = poses[closed[0]], poses[closed[-1] + 1]
    assert [take[2, 3], put[2, 3]] == pytest.approx([0.191, 0.191], abs=1e-6)
    turn = np.arccos(np.clip(take[:3, 0] @ put[:3, 0], -1, 1))
    assert turn == pytest.approx(np.pi / 2, abs=1e-6)


def test_handover_brings_the_tools_face_to_face() -> None:
    giver, _ = read("two_robot_handover_ur5e")
    taker, _ = read("two_robot_handover_kr6")
    assert giver.shape == taker.shape
    both = np.flatnonzero((giver[:, 6] == 1) & (taker[:, 6] == 1))
    assert len(both) >= 10, "for at least 0.1 s both hold the rod"
    kuka_in_world = np.diag([-1.0, -1.0, 1.0, 1.0])
    kuka_in_world[0, 3] = BETWEEN_BASES
    gives = LIBRARY.model("ur5e").chain.tool0(giver[both, :6])
    takes = kuka_in_world @ LIBRARY.model("kuka_kr6_r900_sixx").chain.tool0(taker[both, :6])
    for give, take in zip(gives, takes, strict=True):
        assert give[:3, 2] == pytest.approx(-take[:3, 2], abs=1e-6)
        assert take[:3, 3] - give[:3, 3] == pytest.approx(BETWEEN_TOOLS * give[:3, 2], abs=1e-6)
    # The giver lets go last of all, and nobody holds on afterwards.
    assert giver[both[-1] + 1, 6] == 0


def test_v73_file_is_laid_out_as_matlab_does(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / "quintic_ur5e.mat").write_bytes((EXAMPLES / "quintic_ur5e.mat").read_bytes())
    spec = importlib.util.spec_from_file_location("make_v73", EXAMPLES / "make_v73.py")
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    monkeypatch.chdir(tmp_path)
    module.main()
    expected, fs = read("quintic_ur5e")
    for path in (tmp_path / "quintic_ur5e_v73.mat", EXAMPLES / "quintic_ur5e_v73.mat"):
        assert path.read_bytes()[124:128] == b"\x00\x02IM"
        with h5py.File(path) as file:
            assert file.userblock_size == 512
            assert np.array_equal(file["q"][()].T, expected)
            assert file["fs"][()] == fs
            assert {d.attrs["MATLAB_class"] for d in file.values()} == {b"double"}
