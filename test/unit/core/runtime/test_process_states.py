"""Deaths in reports on processes, and which process holds a node."""

from __future__ import annotations

from dataclasses import replace

import pytest

from mrlab_ros.core.runtime.process_states import Deaths, Phase, ProcessState, Thaws

PLAYBACK = ProcessState("playback", Phase.RUNNING.value, 7, 0, 0.0, "", nodes=("playback_host",))
DEAD = replace(PLAYBACK, phase=Phase.WAITING.value, pid=None, down_steady_ns=500)


def test_a_death_is_found_once():
    deaths = Deaths(100)
    assert deaths.new([PLAYBACK]) == []
    assert deaths.new([DEAD]) == [DEAD]
    back = replace(DEAD, phase=Phase.RUNNING.value, restarts=1)
    assert deaths.new([back]) == []
    again = replace(back, phase=Phase.FROZEN.value, down_steady_ns=900)
    assert deaths.new([again]) == [again]
    assert again.frozen


def test_a_death_is_found_in_a_report_that_follows_the_restart():
    back = replace(DEAD, phase=Phase.RUNNING.value, restarts=1)
    assert Deaths(100).new([back]) == [back]


def test_a_death_before_the_start_concerns_nobody():
    assert Deaths(501).new([DEAD]) == []


@pytest.mark.parametrize(
    ("node", "held"),
    [
        ("/playback_host", True),
        ("/playback_host/lab_7", True),
        ("/playback_host_2", False),
        ("/coordinator", False),
    ],
)
def test_a_process_holds_its_nodes_and_the_names_below_them(node, held):
    assert PLAYBACK.holds(node) is held


def test_the_end_of_a_freeze_is_found_once():
    thaws = Thaws()
    frozen = replace(PLAYBACK, phase=Phase.FROZEN.value)
    found = [thaws.new([each]) for each in (PLAYBACK, frozen, PLAYBACK, PLAYBACK, frozen, DEAD)]
    assert found == [[], [], [PLAYBACK], [], [], []]
