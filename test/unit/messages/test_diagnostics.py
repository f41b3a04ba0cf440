"""The level of a sign of life, and who counts as living."""

from __future__ import annotations

from diagnostic_msgs.msg import DiagnosticStatus

from mrlab_ros.core.watch import Sign
from mrlab_ros.messages.diagnostics import living_in, signs_to_message


def test_a_failure_is_an_error_of_a_process_that_lives():
    sign = Sign("recorder", 1, "SIGKILL", ("2 s of class",), ("the disk is full",))
    message = signs_to_message(0, sign, 100.0, {"physics": 4.0})
    own, other = message.status
    assert (own.level, other.level) == (DiagnosticStatus.ERROR, DiagnosticStatus.ERROR)
    assert own.message == "the disk is full; 2 s of class"
    assert [v.value for v in own.values if v.key == "failed 1"] == ["the disk is full"]
    assert living_in(message) == ["recorder"]
