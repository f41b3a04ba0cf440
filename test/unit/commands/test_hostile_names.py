"""Names in files act on nobody's terminal, in no command that shows them."""

from __future__ import annotations

import json
import os
import re
import subprocess
import sys
from pathlib import Path

import h5py
import numpy as np
import pytest
import scipy.io
from rosbags.rosbag2 import StoragePlugin, Writer

from mrlab_ros.adapters.bags.writer import BagWriter

pytestmark = [pytest.mark.slow, pytest.mark.timeout(300)]

ROOT = Path(__file__).parents[3]
RUBRIC = ROOT / "examples" / "rubrics" / "pick_and_place.yaml"
# Markup that rich would take, a link, the clipboard, another line, the screen, a turned direction
NAME = (
    "[/red][link=http:evil]q[bold]\x1b]52;c;ZXZpbA==\x07\x1b]8;;http:evil\x07\x1b[2J\x9b2J"
    "\nmrlab: fine\u202e$\\frac{$"
)
FILE = NAME.replace("/", "|")
COLOURS = re.compile(r"\x1b\[[\d;]*m")  # rich's own
ACTS = re.compile("[\x00-\x08\x0b-\x1f\x7f-\x9f\u202a-\u202e\u2066-\u2069]")


def motion(scale: float = 1.0) -> np.ndarray:
    return np.linspace(0, 0.5, 101)[:, None] ** 2 * np.linspace(0.2, 1, 6) * scale


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Return a folder of files with such names, inside and outside."""
    folder = tmp_path_factory.mktemp("names")
    (folder / "mats").mkdir()
    scipy.io.savemat(folder / "mats" / "one.mat", {"q": motion(), "fs": 100.0})
    with h5py.File(folder / "mats" / f"{FILE}.mat", "w", userblock_size=512) as file:
        for name, scale in ((NAME, 1.0), (f"{NAME}2", 2.0)):
            made = file.create_dataset(name.replace("/", "|"), data=motion(scale).T)
            made.attrs["MATLAB_class"] = np.bytes_("double")
    content = bytearray((folder / "mats" / f"{FILE}.mat").read_bytes())
    content[:128] = b"MATLAB 7.3 MAT-file".ljust(124) + b"\x00\x02IM"
    (folder / "mats" / f"{FILE}.mat").write_bytes(content)
    name = "[/red]\x1b[2J"
    scipy.io.savemat(folder / "mats" / "v5.mat", {name: motion(100.0).T})
    rows = "\n".join(",".join(map(str, row)) for row in motion())
    heads = ",".join(f'"{NAME.replace(chr(10), "")}{k}"' for k in range(6))
    (folder / "mats" / "table.csv").write_text(f"{heads}\n{rows}\n")
    writer = BagWriter(folder / "bag", lambda kind: ("", ""))
    writer.attach("scene.json", NAME, b"{}", 0)
    writer.close()
    (folder / "mats" / "loop.mat").symlink_to("loop.mat")
    topic = "/a" + NAME
    with Writer(folder / "other", version=9, storage_plugin=StoragePlugin.SQLITE3) as other:
        given = other.add_connection(
            topic, "std_msgs/msg/String", msgdef="string data\n", rihs01="RIHS01_0"
        )
        other.write(given, 1, b"\x00\x01\x00\x00\x02\x00\x00\x00a\x00")
    (folder / "class" / FILE).mkdir(parents=True)
    (folder / "class" / FILE / f"{FILE}.mat").write_bytes(content)
    (folder / "arm.urdf").write_text(
        f'<robot name="a"><link name="{NAME.translate(dict.fromkeys(range(32)))}"/></robot>'
    )
    return folder


def mrlab(folder: Path, *words: str, colours: bool) -> tuple[str, str, int]:
    """Run a command; return what it said on both streams, byte for byte, and how it ended."""
    command = [sys.executable, "-m", "mrlab_ros.cli", *words]
    environment = os.environ | ({"FORCE_COLOR": "1"} if colours else {})
    done = subprocess.run(command, cwd=folder, env=environment, capture_output=True, check=False)
    return done.stdout.decode(), done.stderr.decode(), done.returncode


CASES = {
    "convert": ["convert", "mats", "--robot", "ur5e", "--out", "made", "--force"],
    "convert one": ["convert", f"mats/{FILE}.mat", "--robot", "ur5e"],
    "plots": ["convert", "mats", "--robot", "ur5e", "--plot", "plots", "--force"],
    "check": ["check", f"mats/{FILE}.mat", "--robot", "ur5e"],
    "show": ["show", f"mats/{FILE}.mat", "--robot", "ur5e", "--out", "page.html", "--no-open"],
    "bag info": ["bag", "info", "bag"],
    "bag info of another": ["bag", "info", "other"],
    "bag report": ["bag", "report", "bag"],
    "bag report of another": ["bag", "report", "other"],
    "bag extract": ["bag", "extract", "bag", "--out", "extracted"],
    "class": ["class", "class", "--rubric", str(RUBRIC), "--out", "marks", "--jobs", "1"],
    "robots import": ["robots", "import", "arm.urdf"],
    "none": ["check", f"{FILE}.none", "--robot", "ur5e"],
}


@pytest.mark.parametrize("words", CASES.values(), ids=CASES.keys())
def test_names_act_on_no_terminal(folder: Path, words: list[str]) -> None:
    out, err, code = mrlab(folder, *words, colours=True)
    said = COLOURS.sub("", out + err)
    assert not ACTS.search(said), said
    assert "MarkupError" not in said
    assert "Traceback" not in said, said
    assert code in (0, 1, 2), said
    assert not [line for line in said.splitlines() if line.startswith("mrlab: fine")]


def test_every_file_of_a_batch_is_reported(folder: Path) -> None:
    out, err, _ = mrlab(folder, "convert", "mats", "--robot", "ur5e", "--json", colours=False)
    assert len([json.loads(line) for line in out.split("\n") if line]) == 5
    assert not ACTS.search(out + err)


def test_a_name_that_is_no_text_is_converted_and_reported(folder: Path, tmp_path: Path) -> None:
    content = (folder / "mats" / "one.mat").read_bytes()
    (tmp_path / os.fsdecode(b"\xff\xfe.mat")).write_bytes(content)
    out, _, code = mrlab(tmp_path, "convert", ".", "--robot", "ur5e", "--json", colours=False)
    assert code == 0
    assert json.loads(out)["file"] == "\N{REPLACEMENT CHARACTER}" * 2 + ".mat"
    submissions = tmp_path / "class"
    (submissions / os.fsdecode(b"\xff")).mkdir(parents=True)
    (submissions / os.fsdecode(b"\xff") / os.fsdecode(b"\xfe.mat")).write_bytes(content)
    words = ["class", "class", "--rubric", str(RUBRIC), "--out", "marks", "--jobs", "1"]
    assert mrlab(tmp_path, *words, colours=False)[2] == 0
    assert "\N{REPLACEMENT CHARACTER}" in (tmp_path / "marks" / "grades.csv").read_text()


def test_the_page_shows_names_as_text(folder: Path) -> None:
    words = ["show", "mats/table.csv", "--robot", "ur5e", "--out", "table.html", "--no-open"]
    mrlab(folder, *words, colours=False)
    page = (folder / "table.html").read_text()
    assert not ACTS.search(page)
