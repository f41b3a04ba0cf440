"""An installed lab is started in a folder full of modules: it imports none of them."""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
from importlib.metadata import packages_distributions
from pathlib import Path

import pytest
from launched_lab import launched_lab

ROOT = Path(__file__).resolve().parents[2]
EXAMPLES = ROOT / "examples"
# Python looks for these by itself.
ASKED_FOR = ("sitecustomize", "usercustomize", "conftest", "mrlab_ros", "mrlab_msgs")


@pytest.fixture(scope="module")
def site(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Return a folder with the lab as pip installs its wheel."""
    made = tmp_path_factory.mktemp("dist")
    ran(sys.executable, ROOT / "scripts" / "dist.py", made)
    site = tmp_path_factory.mktemp("site")
    (wheel,) = made.glob("*.whl")
    pip = (sys.executable, "-m", "pip", "install", "-q", "--no-deps", "--target", site, wheel)
    ran(*pip)
    return site


@pytest.fixture
def folder(tmp_path: Path, site: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Go to a folder with a module of every name there is, which leaves a trace where it runs."""
    folder = tmp_path / "downloads"
    folder.mkdir()
    trace = f"open({str(tmp_path / 'ran')!r}, 'a').write(__name__ + '\\n')\n"
    for name in {*ASKED_FOR, *sys.stdlib_module_names, *packages_distributions()}:
        (folder / f"{name}.py").write_text(trace)
    (folder / "evil.pth").write_text("import sitecustomize\n")
    (folder / "matplotlibrc").write_text("text.usetex: True\nbackend: module://sitecustomize\n")
    programs = tmp_path / "programs"
    programs.mkdir()
    (programs / "latex").write_text(f"#!/bin/sh\necho latex >> {tmp_path / 'ran'}\n")
    (programs / "latex").chmod(0o755)
    monkeypatch.setenv("PATH", f"{programs}:{os.environ['PATH']}")
    (folder / "one").mkdir()
    shutil.copy(EXAMPLES / "quintic_ur5e.mat", folder / "one" / "quintic_ur5e.mat")
    monkeypatch.chdir(folder)
    clone = (str(ROOT), str(ROOT / "build" / "mrlab_ros"))
    others = [p for p in os.environ["PYTHONPATH"].split(":") if p not in clone]
    monkeypatch.setenv("PYTHONPATH", ":".join([str(site), *others]))
    others = [p for p in os.environ["AMENT_PREFIX_PATH"].split(":") if "mrlab_ros" not in p]
    monkeypatch.setenv("AMENT_PREFIX_PATH", ":".join([str(site), *others]))
    monkeypatch.delenv("PYTHONSAFEPATH", raising=False)
    return folder


def ran(*command: str | Path) -> str:
    done = subprocess.run([*map(str, command)], capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stdout + done.stderr
    return done.stdout


def test_commands_import_nothing_from_their_folder(
    folder: Path, site: Path, tmp_path: Path
) -> None:
    mrlab = site / "bin" / "mrlab"
    ran(mrlab, "--help")
    ran(mrlab, "convert", "one", "--robot", "ur5e", "--out", "made", "--plot", "made")
    ran(mrlab, "check", "one/quintic_ur5e.mat", "--robot", "ur5e")
    ran(mrlab, "show", "one/quintic_ur5e.mat", "--robot", "ur5e", "--out", "page.html")
    ran(mrlab, "robots", "show", "ur5e")
    (folder / "class" / "anna").mkdir(parents=True)
    shutil.copy(EXAMPLES / "pick_and_place_ur5e.mat", folder / "class" / "anna" / "a.mat")
    rubric = EXAMPLES / "rubrics" / "pick_and_place.yaml"
    ran(mrlab, "class", "class", "--rubric", rubric, "--out", "marks", "--jobs", "1")
    assert (folder / "page.html").is_file()
    assert not (tmp_path / "ran").exists(), (tmp_path / "ran").read_text()


def test_a_lab_imports_nothing_from_its_folder(
    folder: Path, site: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("launched_lab.MRLAB", (str(site / "bin" / "mrlab"),))
    with launched_lab(tmp_path, monkeypatch, "--http", "0"):
        mrlab = site / "bin" / "mrlab"
        ran(mrlab, "status", "--once")
    assert not (tmp_path / "ran").exists(), (tmp_path / "ran").read_text()
