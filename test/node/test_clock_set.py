"""A wall clock that is set while a system plays, and while physics follows it."""

from __future__ import annotations

import itertools
import time
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
import small_lab
from graph import Graph, wait_for
from mrlab_msgs.srv import Trigger
from small_lab import listen_state, listen_systems, make_system, spawn, state_of

from mrlab_ros.core.base.clock import SECOND
from mrlab_ros.core.playback.stream import Sample
from mrlab_ros.messages.time import time_from_message
from mrlab_ros.nodes.physics.node import PhysicsNode
from mrlab_ros.ros.clock import LabClock

Step = Callable[[int], None]


@pytest.fixture
def step(monkeypatch: pytest.MonkeyPatch) -> Step:
    """Set the wall clock of all nodes by so many seconds."""
    ahead_ns = 0

    def wall_ns() -> int:
        return time.time_ns() + ahead_ns

    def set_clock(seconds: int) -> None:
        nonlocal ahead_ns
        ahead_ns += seconds * SECOND

    defaults = LabClock.__init__.__kwdefaults__
    assert defaults is not None
    monkeypatch.setitem(defaults, "wall_ns", wall_ns)
    return set_clock


def follow(node: Any) -> list[Sample]:
    """Collect what a playback sends from now on."""
    sent: list[Sample] = []
    send = node.player._send
    node.player._send = lambda sample: (sent.append(sample), send(sample))
    return sent


@pytest.mark.parametrize("by", [-600, 600])
def test_nothing_jumps_in_any_state(graph: Graph, step: Step, by: int) -> None:
    lab = small_lab.start(graph)
    physics = graph.add(PhysicsNode)
    robots = [spawn(graph), spawn(graph)]
    members = {robot: listen_state(graph, robot) for robot in robots}
    systems = listen_systems(graph)
    ahead = 0

    def label() -> str:
        return str(state_of(systems).label) if systems and systems[-1].systems else ""

    def command(name: str) -> None:
        answer = graph.call(Trigger, f"/cell/{name}")
        assert answer.success, answer.message

    def set_clock() -> None:
        """Set the clock, and wait until the members are announced with their new stamps."""
        nonlocal ahead
        before = {robot: len(inbox) for robot, inbox in members.items()}
        system = label()
        ahead += by
        step(by)

        def announced() -> bool:
            wall = time.time() + ahead
            return all(
                abs(time_from_message(inbox[-1].header.stamp) / SECOND - wall) < 300
                for robot, inbox in members.items()
                if len(inbox) > before[robot]
            ) and all(len(inbox) > before[robot] for robot, inbox in members.items())

        wait_for(announced, f"the new stamps of the members in {system}")

    def in_line() -> bool:
        """Return whether the members' clocks are the system's."""
        system = state_of(systems).clock
        clocks = [inbox[-1].clock for inbox in members.values()]
        return all((c.stamp, c.position) == (system.stamp, system.position) for c in clocks)

    assert make_system(graph, dict.fromkeys(robots, "long")).success
    wait_for(lambda: len(physics._world.robots) == 2, "the robots in physics")
    sent = {robot: follow(lab.host.nodes[robot]) for robot in robots}
    set_clock()
    assert label() == "READY"
    command("play")
    wait_for(lambda: label() == "STAGING", "the staging")
    set_clock()
    wait_for(lambda: label() == "PLAYING", "the run")
    wait_for(lambda: all(i[-1].frame > 20 for i in members.values()), "frames")
    set_clock()
    wait_for(in_line, "one line of all")
    command("pause")
    wait_for(lambda: {i[-1].label for i in members.values()} == {"PAUSED"}, "the pause")
    set_clock()
    command("play")
    wait_for(lambda: label() == "PLAYING", "the run")
    frame = max(i[-1].frame for i in members.values())
    wait_for(lambda: all(i[-1].frame > frame + 20 for i in members.values()), "frames")
    set_clock()
    wait_for(in_line, "one line of all")
    command("stop")
    for robot in robots:
        _, count, lost = lab.host.nodes[robot].playback.progress()
        assert count
        assert lost == 0
        samples = sent[robot]
        assert all(0 < b.due_ns - a.due_ns < SECOND for a, b in itertools.pairwise(samples))
        ways = [np.abs(b.positions - a.positions).max() for a, b in itertools.pairwise(samples)]
        assert max(ways) < 0.05
        frames = [sample.frame for sample in samples if sample.streamed]
        assert frames == list(range(len(frames)))
        placed = physics._world.robot(robot)
        assert placed.pending is None
        wait_for(
            lambda placed=placed, samples=samples: (
                placed.placed is not None
                and np.abs(samples[-1].positions - placed.placed).max() < 1e-6
            ),
            "the pose in physics",
        )
    assert physics._world.skipped_ns == 0
