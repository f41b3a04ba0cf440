"""What `mrlab status` says of processes that died."""

from __future__ import annotations

import time
from typing import Any

import pytest
from rich.console import Console

from mrlab_ros.commands.status.table import overview
from mrlab_ros.core.base.diagnostic import Diagnostic, of_text, plain
from mrlab_ros.core.runtime.diagnostics import PROCESS_SILENT
from mrlab_ros.core.runtime.watch import Freeze, Sign, joined

RESTARTED = Sign("playback", 1, "SIGKILL").trouble(3.0)
FROZEN = Sign("playback", freeze=Freeze(17.0, 5.0)).trouble(900.0)
SILENT = PROCESS_SILENT(silent=4)
FULL_DISK = of_text("the recording class ended: no space left on the disk")
BOTH = joined([FULL_DISK, RESTARTED])
DOWN = 1_700_000_000.0
AT = time.strftime("%H:%M:%S", time.localtime(DOWN))


def shown(trouble: Diagnostic | None, phase: str, *, down: float = DOWN) -> str:
    """Return the overview of a lab whose playback was restarted 3 s ago, and says it or not.

    down: when it ended or froze last.
    """
    process = {
        "name": "playback",
        "pid": 1,
        "phase": phase,
        "since": time.time() - 3.0,
        "restarts": 1,
        "last_exit": "SIGKILL",
        "down": down,
        "restart_in": 5.0,
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
        "trouble": {"playback": plain(trouble)} if trouble else {},
        "restarted": ["playback"] if trouble in (RESTARTED, BOTH) else [],
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
        (BOTH, "running", str(FULL_DISK)),
        (SILENT, "waiting to restart", f"playback died at {AT} (SIGKILL), back in 2.0 s"),
        (None, "running", "running for 3 s, restarts: 1"),
    ],
)
def test_a_death_is_said_once(trouble, phase, says):
    text = shown(trouble, phase).split("Processes")[0]
    assert text.count("died") == 1
    assert says in text


@pytest.mark.parametrize("trouble", [SILENT, FROZEN])
def test_what_else_is_amiss_with_a_process_that_died_before_is_said_too(trouble):
    text = shown(trouble, "running")
    assert f"playback died at {AT} (SIGKILL); running for 3 s" in text
    assert str(trouble) in text


def test_a_freeze_after_a_death_is_not_when_it_died():
    freeze = time.time() + 5000.0
    text = shown(None, "running", down=freeze)
    assert text.count("playback died at") == 1
    assert time.strftime("%H:%M:%S", time.localtime(freeze)) not in text


def test_a_process_that_a_signal_stopped_is_named():
    assert f"playback does not run since {AT}" in shown(None, "stopped by a signal")


@pytest.mark.parametrize(
    ("trouble", "says"),
    [
        ({"recorder": FULL_DISK}, f"recorder: {FULL_DISK}"),
        ({}, str(FULL_DISK)),
        ({"playback": SILENT}, str(FULL_DISK)),
    ],
)
def test_why_a_recording_ended_is_said_once(trouble: dict[str, Diagnostic], says: str) -> None:
    facts = {
        **dict.fromkeys(("robots", "trajectories", "systems", "latency"), ()),
        **dict.fromkeys(("supervisor", "web")),
        "domain": 3,
        "trouble": plain(trouble),
        "recorder": {"state": "STOPPED", "message": str(FULL_DISK)},
    }
    lines = [line.strip() for line in printed(facts).splitlines() if str(FULL_DISK) in line]
    assert lines == [says]
