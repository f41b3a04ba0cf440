"""A process that ends with the launcher that named itself in the environment."""

from __future__ import annotations

import signal
import subprocess
import sys

import pytest

CHILD = """
import signal, sys
signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGTERM})
from mrlab_ros.adapters.launcher import end_with_launcher
end_with_launcher()
print("runs", flush=True)
found = signal.sigtimedwait({signal.SIGTERM}, float(sys.argv[1]))
print("ends" if found else "goes on", flush=True)
"""
LAUNCHER = """
import os, signal, subprocess, sys
from mrlab_ros.adapters.launcher import LAUNCHER
named = {"itself": str(os.getpid()), "another": "1"}.get(sys.argv[1])
environment = {**os.environ, **({LAUNCHER: named} if named else {})}
subprocess.Popen([sys.executable, "-c", sys.argv[2], sys.argv[3]], env=environment)
signal.pause()
"""


@pytest.mark.parametrize(
    ("named", "patience", "then"),
    [("itself", "20", "ends"), ("another", "0.1", "goes on"), ("", "0.1", "goes on")],
)
def test_a_process_ends_with_the_launcher_that_named_itself(named, patience, then):
    words = [sys.executable, "-c", LAUNCHER, named, CHILD, patience]
    launcher = subprocess.Popen(words, stdout=subprocess.PIPE, text=True)
    assert launcher.stdout is not None
    assert launcher.stdout.readline() == "runs\n"
    launcher.send_signal(signal.SIGKILL)
    # The child has the pipe, too.
    assert launcher.stdout.read() == f"{then}\n"
    launcher.stdout.close()
    launcher.wait()
