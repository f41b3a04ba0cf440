"""A lab with physics as a student runs it: load a scene, play the hand-over, look at the rod."""

from __future__ import annotations

import json
import signal
import subprocess
import sys
import time
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

from mrlab_ros.commands.demo_lab import claim_free_domain

DEADLINE = 60.0
MRLAB = (sys.executable, "-m", "mrlab_ros.cli")
CELL = Path(__file__).parents[2] / "examples" / "handover_cell.yaml"


def mrlab(*arguments: str) -> subprocess.CompletedProcess[str]:
    return subprocess.run(
        (*MRLAB, *arguments), capture_output=True, text=True, timeout=DEADLINE, check=False
    )


def done(*arguments: str) -> str:
    answer = mrlab(*arguments)
    assert answer.returncode == 0, answer.stdout + answer.stderr
    return answer.stdout


@pytest.fixture
def lab(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[subprocess.Popen[bytes]]:
    monkeypatch.setenv("XDG_RUNTIME_DIR", str(tmp_path))
    monkeypatch.setenv("ROS_AUTOMATIC_DISCOVERY_RANGE", "LOCALHOST")
    monkeypatch.delenv("ROS_DOMAIN_ID", raising=False)
    run_file, domain = claim_free_domain()
    run_file.release()
    monkeypatch.setenv("ROS_DOMAIN_ID", str(domain))
    log = tmp_path / "up.log"
    with log.open("wb") as output:
        process = subprocess.Popen(
            (*MRLAB, "up", "--physics", "--no-bridge"), stdout=output, stderr=subprocess.STDOUT
        )
    try:
        end = time.monotonic() + DEADLINE
        while "is ready" not in log.read_text():
            assert process.poll() is None, log.read_text()
            assert time.monotonic() < end, log.read_text()
            time.sleep(0.05)
        yield process
        process.send_signal(signal.SIGINT)
        assert process.wait(DEADLINE) == 0
        assert "Traceback" not in log.read_text()
    finally:
        process.kill()
        process.wait()


def rod_after_the_hand_over() -> dict[str, Any]:
    assert "loaded handover: 2 robots, 1 objects" in done("scene", "load", "handover")
    done("system", "create", str(CELL))
    assert "handover: PLAYING" in done("system", "play", "handover")
    (rod,) = json.loads(done("objects", "list", "--json"))
    return rod


def test_a_student_hands_a_rod_over(lab: subprocess.Popen[bytes]) -> None:
    rod = rod_after_the_hand_over()
    assert (rod["name"], rod["held_by"]) == ("rod_1", "")
    assert rod["position"] == pytest.approx([0.817, -0.321, 0.08], abs=0.01)
