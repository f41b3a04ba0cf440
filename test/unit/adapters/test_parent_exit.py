"""A process that ends with the launcher that named itself in the environment."""

from __future__ import annotations

import signal
import subprocess
import sys

import pytest

CHILD = """
import signal, sys
signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGTERM})
from mrlab_ros.adapters.parent_exit import end_with_launcher
end_with_launcher()
print("runs", flush=True)
found = signal.sigtimedwait({signal.SIGTERM}, float(sys.argv[1]))
print("ends" if found else "goes on", flush=True)
"""
LAUNCHER = """
import os, shlex, signal, subprocess, sys
from mrlab_ros.adapters.parent_exit import LAUNCHER
named = {"itself": str(os.getpid()), "another": sys.argv[5], "ended": "4194305"}.get(sys.argv[1])
environment = {**os.environ, **({LAUNCHER: named} if named else {})}
words = [*shlex.split(sys.argv[4]), sys.executable, "-c", sys.argv[2], sys.argv[3]]
subprocess.Popen(words, env=environment)
signal.pause()
"""


# A shell that stays between the two, as a terminal or a tracer does.
STAYS = "sh -c '\"$@\"; exit' prefix"
DETACHES = "setsid --fork"


@pytest.fixture
def another():
    """The id of a process that is no ancestor of those of a launcher."""
    process = subprocess.Popen(["sleep", "60"])
    yield str(process.pid)
    process.kill()
    process.wait()


@pytest.mark.parametrize(
    ("named", "prefix", "patience", "then"),
    [
        ("itself", "", "20", "ends"),
        ("itself", "nice -n 1", "20", "ends"),
        ("itself", STAYS, "20", "ends"),
        ("itself", DETACHES, "0.1", "goes on"),
        ("another", "", "0.1", "goes on"),
        ("ended", "", "20", "ends"),
        ("", "", "0.1", "goes on"),
    ],
)
def test_a_process_ends_with_the_launcher_that_named_itself(
    named, prefix, patience, then, another
):
    words = [sys.executable, "-c", LAUNCHER, named, CHILD, patience, prefix, another]
    launcher = subprocess.Popen(words, stdout=subprocess.PIPE, text=True)
    assert launcher.stdout is not None
    assert launcher.stdout.readline() == "runs\n"
    launcher.send_signal(signal.SIGKILL)
    # The child has the pipe, too.
    assert launcher.stdout.read() == f"{then}\n"
    launcher.stdout.close()
    launcher.wait()
