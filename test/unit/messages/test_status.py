"""The level of a sign of life, what it says, and who counts as living."""

from __future__ import annotations

from diagnostic_msgs.msg import DiagnosticStatus

from mrlab_ros.core.base.diagnostic import Severity, of_text
from mrlab_ros.core.runtime.watch import Sign
from mrlab_ros.core.systems.diagnostics import SYSTEM_LOST
from mrlab_ros.messages.status import living_in, signs_to_message, troubles_in


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
