"""A process of the lab that is stopped while it starts ends at once and prints nothing."""

from __future__ import annotations

import signal
import subprocess
import sys

import pytest

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
