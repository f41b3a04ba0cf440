"""The level of a sign of life, what it says, and who counts as living."""

from __future__ import annotations

import time
from dataclasses import replace

import pytest
from diagnostic_msgs.msg import DiagnosticStatus
from mrlab_msgs.msg import LabProcess

from mrlab_ros.core.base.diagnostic import Severity, of_text
from mrlab_ros.core.runtime.process_states import Phase, ProcessState
from mrlab_ros.core.runtime.watch import Sign
from mrlab_ros.core.systems.diagnostics import SYSTEM_LOST
from mrlab_ros.messages.status import (
    living_in,
    processes_from_message,
    processes_to_message,
    signs_to_message,
    troubles_in,
)


def test_a_failure_is_an_error_of_a_process_that_lives():
    full = of_text("the disk is full")
    sign = Sign("recorder", 1, "SIGKILL", (SYSTEM_LOST(system="cell"),), (full,))
    message = signs_to_message(0, sign, 100.0, {"physics": 4.0})
    own, other = message.status
    assert (own.level, other.level) == (DiagnosticStatus.ERROR, DiagnosticStatus.ERROR)
    assert living_in(message) == ["recorder"]
    said = troubles_in(message)
    assert (said["recorder"].code, said["recorder"].severity) == ("and_also", Severity.ERROR)
    assert '"system_lost"' in said["recorder"].values["then"]
    assert (said["physics"].code, said["physics"].values["silent"]) == ("process_silent", "4")


def test_a_process_that_is_well_says_nothing():
    assert troubles_in(signs_to_message(0, Sign("lab"), 100.0, {})) == {"lab": None}


def test_a_restart_is_a_warning_with_its_values():
    said = troubles_in(signs_to_message(0, Sign("lab", 1, "SIGKILL"), 5.0, {}))["lab"]
    assert (said.code, said.severity) == ("died", Severity.WARNING)
    assert (said.values["last_exit"], said.values["ago"]) == ("SIGKILL", "5")


def test_processes_come_back_as_they_were_without_their_ids():
    dead = ProcessState(
        "playback",
        Phase.WAITING.value,
        7,
        2,
        12.5,
        "SIGKILL",
        -9,
        ("playback_host",),
        12.5,
        77,
        0.4,
    )
    message = processes_to_message(
        0, [dead, ProcessState("web", "running", 8, 0, 1.0, "")], "ours"
    )
    assert message.lab == "ours"
    assert [one.state for one in message.processes] == [LabProcess.WAITING, LabProcess.RUNNING]
    back = processes_from_message(message)
    assert back[0] == replace(dead, pid=None)
    assert (back[1].down, back[1].nodes) == (0.0, ())


def test_a_death_on_another_machine_is_told_by_the_wall_clock():
    died = ProcessState("playback", Phase.WAITING.value, 7, 2, time.time() - 2.0, "", -9, (),
                        time.time() - 2.0, 77)  # fmt: skip
    # A lab on several machines has no id.
    (here,) = processes_from_message(processes_to_message(0, [died], ""))
    assert time.monotonic_ns() - here.down_steady_ns == pytest.approx(2e9, abs=0.5e9)
