"""A process of the lab that is stopped while it starts ends at once and prints nothing."""

from __future__ import annotations

import signal
import subprocess
import sys

import pytest

from mrlab_ros.core.base.records import fields_of
from mrlab_ros.nodes.parameters import NODES as PARAMETERS
from mrlab_ros.processes import host
from mrlab_ros.processes.lab import NODES

# Runs with SIGINT blocked, as the supervisor starts it. {before}, {within}: what happens before
# main() is called, and at the first import inside it.
START = """
import os, signal, sys
signal.pthread_sigmask(signal.SIG_BLOCK, {{signal.SIGINT}})
import mrlab_ros.processes.host as host

class Finder:
    def find_spec(self, name, path=None, target=None):
        {within}
        print("imports", name, flush=True)
        os._exit(3)

{before}
sys.meta_path.insert(0, Finder())
host.main(["converter"])
"""
INTERRUPT = "os.kill(os.getpid(), signal.SIGINT)"


@pytest.mark.parametrize(("before", "within"), [(INTERRUPT, "pass"), ("pass", INTERRUPT)])
def test_sigint_ends_the_start_without_a_traceback(before: str, within: str) -> None:
    code = START.format(before=before, within=within)
    done = subprocess.run(
        (sys.executable, "-c", code), capture_output=True, timeout=60, check=False
    )
    assert (done.returncode, done.stdout, done.stderr) == (-signal.SIGINT, b"", b"")


def test_the_imports_of_the_test_above_are_those_of_main() -> None:
    code = START.format(before="pass", within="pass")
    done = subprocess.run(
        (sys.executable, "-c", code), capture_output=True, timeout=60, check=False
    )
    assert (done.returncode, done.stdout) == (3, b"imports mrlab_ros.processes.lab\n")


@pytest.fixture(autouse=True)
def no_process_of_its_own(monkeypatch: pytest.MonkeyPatch) -> None:
    """Keep what main() does to its whole process out of that of the tests."""
    for name in ("guard", "keep_to_installed_modules"):
        monkeypatch.setattr(host, name, lambda: None)


def said_by(monkeypatch: pytest.MonkeyPatch, *words: str, names: list[str] | None = None) -> str:
    """Return what the host exits with; it must not come to its nodes."""
    monkeypatch.setattr(sys, "argv", ["host", *words])
    monkeypatch.setattr(signal, "signal", lambda *_: None)
    with pytest.raises(SystemExit) as ended:
        host.main(names)
    return str(ended.value)


@pytest.mark.parametrize("flag", ["-h", "--help"])
@pytest.mark.parametrize("names", [[name] for name in NODES], ids=list(NODES))
def test_help_lists_the_parameters_and_starts_nothing(names, flag, monkeypatch, capsys) -> None:
    monkeypatch.setattr(sys, "argv", [names[0], flag])
    monkeypatch.setattr(signal, "signal", lambda *_: None)
    host.main(names)
    said = capsys.readouterr().out
    assert said.startswith(f"usage: ros2 run mrlab_ros {names[0]} [--ros-args ")
    for field in fields_of(PARAMETERS[NODES[names[0]].graph_name]).values():
        assert f"\n  {field.name} (default " in said
    # The executable that takes several nodes says the same.
    monkeypatch.setattr(sys, "argv", ["host", names[0], flag])
    host.main()
    assert capsys.readouterr().out == said


def test_help_of_the_host_names_the_nodes(monkeypatch, capsys) -> None:
    monkeypatch.setattr(sys, "argv", ["host", "--help"])
    monkeypatch.setattr(signal, "signal", lambda *_: None)
    host.main()
    said = capsys.readouterr().out
    assert all(name in said for name in NODES)


def test_a_word_that_is_no_ros_argument_is_refused(monkeypatch) -> None:
    said = said_by(monkeypatch, "rate:=5", names=["frames"])
    assert said.startswith("frames: found rate:=5; expected nothing before --ros-args")
    assert "found frame; expected" in said_by(monkeypatch, "frame", "--help")
