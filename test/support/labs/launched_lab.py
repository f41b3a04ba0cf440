"""A `mrlab up` of its own for a system test, and the `mrlab` command beside it."""

from __future__ import annotations

import signal
import subprocess
import sys
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import pytest
from child_process import start_child
from own_domain import own_domain
from own_port import free_endpoint

DEADLINE = 60.0
MRLAB = (sys.executable, "-m", "mrlab_ros.cli")


def mrlab(*arguments: str | Path) -> subprocess.CompletedProcess[str]:
    """Run a command to its end."""
    return subprocess.run(
        (*MRLAB, *map(str, arguments)),
        capture_output=True,
        text=True,
        timeout=DEADLINE,
        check=False,
    )


def done(*arguments: str | Path) -> str:
    """Run a command that has to succeed; return what it printed."""
    answer = mrlab(*arguments)
    assert answer.returncode == 0, answer.stdout + answer.stderr
    return answer.stdout


@contextmanager
def launched_lab(
    folder: Path, monkeypatch: pytest.MonkeyPatch, *options: str | Path
) -> Iterator[None]:
    """Run a lab on a free ROS domain, which commands then talk to; it has to end well.

    It has no pages, unless the options say where, no frames, unless they ask for them, and a port
    of its own for zenoh.
    """
    if not {"--zenoh-listen", "--no-bridge"}.intersection(options):
        options = (*options, "--zenoh-listen", free_endpoint())
    if "--frames" not in options:
        options = (*options, "--no-frames")
    if "--http" not in options:
        options = (*options, "--no-web")
    monkeypatch.setenv("XDG_RUNTIME_DIR", str(folder))
    monkeypatch.setenv("ROS_AUTOMATIC_DISCOVERY_RANGE", "LOCALHOST")
    with own_domain() as domain:
        monkeypatch.setenv("ROS_DOMAIN_ID", str(domain))
        log = folder / "up.log"
        with log.open("wb") as output:
            process = start_child(
                *MRLAB, "up", *map(str, options), stdout=output, stderr=subprocess.STDOUT
            )
        try:
            end = time.monotonic() + DEADLINE
            while "is ready" not in log.read_text():
                assert process.poll() is None, log.read_text()
                assert time.monotonic() < end, log.read_text()
                time.sleep(0.05)
            yield
            process.send_signal(signal.SIGINT)
            assert process.wait(DEADLINE) == 0, log.read_text()
            assert "Traceback" not in log.read_text(), log.read_text()
        finally:
            process.kill()
            process.wait()
