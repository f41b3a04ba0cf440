"""What set-up writes for shells, and what that says in a clone that was moved or copied."""

from __future__ import annotations

import contextlib
import importlib.util
import os
import shutil
import subprocess
from pathlib import Path
from types import ModuleType

import pytest

SCRIPT = Path(__file__).parents[2] / "scripts" / "bootstrap.py"
SAYS = "was set up in {} and moved or copied; set it up here: make demo"


@pytest.fixture
def bootstrap() -> ModuleType:
    spec = importlib.util.spec_from_file_location("bootstrap", SCRIPT)
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


@pytest.fixture
def clone(tmp_path: Path, bootstrap: ModuleType, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A clone whose `python` prints its arguments."""
    root = tmp_path / "a clone"
    (root / ".venv" / "bin").mkdir(parents=True)
    for name, path in {
        "ROOT": root,
        "VENV": root / ".venv",
        "INSTALL": root / "install",
        "STAMPS": root / ".venv" / ".mrlab",
    }.items():
        monkeypatch.setattr(bootstrap, name, path)
    setup = object.__new__(bootstrap.Setup)
    setup.python = {"version": "3.11"}
    setup.venv_python = root / ".venv" / "bin" / "python"
    setup.venv_python.write_text('#!/bin/sh\necho "$@"\n')
    setup.venv_python.chmod(0o755)
    setup.site = root / ".venv" / "site-packages"
    setup.environment()
    return root


def run(*command: str | Path) -> subprocess.CompletedProcess[str]:
    return subprocess.run([*map(str, command)], capture_output=True, text=True, check=False)


@pytest.mark.parametrize("shell", ["sh", "bash"])
def test_a_clone_in_its_place_works(clone: Path, shell: str) -> None:
    assert run(clone / ".venv/bin/mrlab", "status").stdout == "-m mrlab_ros.cli status\n"
    link = clone / "link"
    link.symlink_to(clone / ".venv/bin/mrlab")
    assert run(link).returncode == 0
    sourced = run(shell, "-c", f"cd '{clone}' && . .venv/mrlab.sh && command -v mrlab")
    assert sourced.stdout == f"{clone}/.venv/bin/mrlab\n"


def test_a_moved_clone_says_what_to_do(clone: Path) -> None:
    moved = clone.rename(clone.parent / "moved")
    for done in (
        run(moved / ".venv/bin/mrlab", "status"),
        run("sh", "-c", f". {moved}/.venv/mrlab.sh && echo went on"),
    ):
        assert (done.returncode, done.stdout) == (1, "")
        assert SAYS.format(clone) in done.stderr


def test_a_copy_does_not_run_the_original(clone: Path) -> None:
    copy = Path(shutil.copytree(clone, clone.parent / "copy"))
    for done in (
        run(copy / ".venv/bin/mrlab", "status"),
        run("bash", "-c", f". {copy}/.venv/mrlab.sh && echo went on"),
    ):
        assert (done.returncode, done.stdout) == (1, "")
        assert SAYS.format(clone) in done.stderr


def test_a_look_names_what_has_to_be_done_again_and_does_nothing(
    clone: Path, bootstrap: ModuleType, capsys: pytest.CaptureFixture[str]
) -> None:
    stamps = clone / ".venv" / ".mrlab"
    stamps.mkdir()
    setup = object.__new__(bootstrap.Setup)
    setup.look = True
    for name, left in (("pages", "now"), ("messages", "before"), ("web", None)):
        if left is not None:
            (stamps / name).write_text(left)
        setup.step(name, "now", lambda: pytest.fail("done"), "says", clone)
    assert capsys.readouterr().out.split() == ["messages", "web"]


def test_what_is_cut_off_leaves_no_stamp_and_is_built_anew(
    clone: Path, bootstrap: ModuleType
) -> None:
    stamps = clone / ".venv" / ".mrlab"
    stamps.mkdir()
    # Its inputs were others meanwhile, and are again what they were.
    (stamps / "messages").write_text("now")
    half = clone / "build" / "mrlab_msgs" / "half_written.py"
    half.parent.mkdir(parents=True)
    setup = object.__new__(bootstrap.Setup)
    setup.look = False
    ways = []

    def cut_off(*packages: str) -> None:
        half.touch()
        raise KeyboardInterrupt

    def built(*packages: str) -> None:
        ways.append(half.exists())

    for build, mark in ((cut_off, "other"), (built, "now"), (built, "now")):
        setup.build = build
        with contextlib.suppress(KeyboardInterrupt):
            setup.step("messages", mark, lambda: setup.colcon("mrlab_msgs"), "says", clone)
    assert ways == [False]
    assert (stamps / "messages").read_text() == "now"


def test_uv_finds_packages_where_pip_is_told_to(
    clone: Path, bootstrap: ModuleType, monkeypatch: pytest.MonkeyPatch
) -> None:
    (clone / ".venv" / ".mrlab").mkdir()
    python, asked = clone / ".venv" / "bin" / "python", clone / "asked"
    options = {
        "global.index-url": "https://packages.example.org/simple",
        ":env:.find-links": "/wheels\n/more",
        "global.no-index": "true",
        "user.progress-bar": "off",
    }
    listed = clone / "listed"
    listed.write_text("".join(f"{key}={value!r}\n" for key, value in options.items()))
    python.write_text(f"#!/bin/sh\ncat '{listed}'\n")
    uv = python.with_name("uv")
    uv.write_text(f"#!/bin/sh\n(echo $UV_DEFAULT_INDEX $UV_FIND_LINKS; echo $@) > '{asked}'\n")
    uv.chmod(0o755)
    monkeypatch.delenv("UV_FIND_LINKS", raising=False)
    setup = object.__new__(bootstrap.Setup)
    setup.venv_python = python
    setup.install(clone / "a.lock")
    where, words = asked.read_text().splitlines()
    assert where == "https://packages.example.org/simple /wheels,/more"
    assert {"--require-hashes", "--no-index"} <= {*words.split()}
    assert words.endswith(f"-r {clone / 'a.lock'}")


def test_what_is_done_beside_fails_as_a_whole(
    clone: Path, bootstrap: ModuleType, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (clone / ".venv" / ".mrlab").mkdir()

    def fails() -> None:
        raise bootstrap.SetupError("no network")

    monkeypatch.setattr(bootstrap, "PROGRESS_S", 0.1)
    with pytest.raises(SystemExit), bootstrap.beside(fails):
        bootstrap.run(["sleep", "600"])
    with pytest.raises(SystemExit), bootstrap.beside(fails):
        pass
    with bootstrap.beside((tmp_path / "made").touch):
        pass
    assert (tmp_path / "made").exists()


def test_a_set_up_that_is_ended_ends_what_it_started(
    clone: Path, bootstrap: ModuleType, monkeypatch: pytest.MonkeyPatch
) -> None:
    (clone / ".venv" / ".mrlab").mkdir()
    read, write = os.pipe()

    def ended(process: subprocess.Popen[bytes], _: float) -> int:
        # The child of the command has begun.
        assert os.read(read, 1)
        raise KeyboardInterrupt

    monkeypatch.setattr(bootstrap, "wait", ended)
    monkeypatch.setattr(bootstrap, "HELD", [os.fdopen(write, "wb")])
    with pytest.raises(KeyboardInterrupt):
        bootstrap.run(["sh", "-c", f"(echo > /dev/fd/{write}; exec sleep 60) & wait"])
    bootstrap.HELD[0].close()
    assert os.read(read, 1) == b"", "nobody holds the other end any more"
    os.close(read)
