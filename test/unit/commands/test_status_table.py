"""What `mrlab status` says of processes that died."""

from __future__ import annotations

import time
from typing import Any

import pytest
from rich.console import Console

from mrlab_ros.commands.status.table import overview
from mrlab_ros.core.watch import Freeze, Sign

RESTARTED = Sign("playback", 1, "SIGKILL").sentence(3.0)
FROZEN = Sign("playback", freeze=Freeze(17.0, 5.0)).sentence(900.0)
SILENT = "no sign of life for 4 s: it died or hangs"


FULL_DISK = "the recording class ended: no space left on the disk"


def shown(trouble: str, phase: str) -> str:
    """Return the overview of a lab whose playback was restarted 3 s ago, and says it or not."""
    process = {
        "name": "playback",
        "pid": 1,
        "phase": phase,
        "since": time.time() - 3.0,
        "restarts": 1,
        "last_exit": "SIGKILL",
    }
    facts = {
        "domain": 3,
        "supervisor": {"pid": 7, "processes": [process]},
        "web": None,
        "robots": [],
        "trajectories": [],
        "systems": [],
        "latency": [],
        "recorder": None,
        "trouble": {"playback": trouble} if trouble else {},
        "restarted": ["playback"] if RESTARTED in trouble else [],
    }
    return printed(facts)


def printed(facts: dict[str, Any]) -> str:
    console = Console(width=120)
    with console.capture() as captured:
        console.print(overview(facts, {}, 120))
    return captured.get()


@pytest.mark.parametrize(
    ("trouble", "phase", "says"),
    [
        (RESTARTED, "running", "nothing was lost"),
        (f"the disk is full; {RESTARTED}", "running", "the disk is full"),
        (SILENT, "waiting", "waiting for 3 s, restarts: 1"),
        ("", "running", "running for 3 s, restarts: 1"),
    ],
)
def test_a_death_is_said_once(trouble, phase, says):
    text = shown(trouble, phase).split("Processes")[0]
    assert text.count("died") == 1
    assert says in text


@pytest.mark.parametrize("trouble", [SILENT, FROZEN])
def test_what_else_is_amiss_with_a_process_that_died_before_is_said_too(trouble):
    text = shown(trouble, "running")
    assert "playback died (SIGKILL); running for 3 s" in text
    assert trouble in text


@pytest.mark.parametrize(
    ("trouble", "says"),
    [
        ({"recorder": FULL_DISK}, f"recorder: {FULL_DISK}"),
        ({}, FULL_DISK),
        ({"playback": SILENT}, FULL_DISK),
    ],
)
def test_why_a_recording_ended_is_said_once(trouble: dict[str, str], says: str) -> None:
    facts = {
        **dict.fromkeys(("robots", "trajectories", "systems", "latency"), ()),
        **dict.fromkeys(("supervisor", "web")),
        "domain": 3,
        "trouble": trouble,
        "recorder": {"state": "STOPPED", "message": FULL_DISK},
    }
    lines = [line.strip() for line in printed(facts).splitlines() if FULL_DISK in line]
    assert lines == [says]
