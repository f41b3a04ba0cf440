"""Instants and stamps of a node's clock; a timer's callback that fails at the shutdown."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import pytest

from mrlab_ros.core.base.clock import SECOND
from mrlab_ros.ros.clock import LabClock, every


class Machine:
    """A machine whose clocks a test moves."""

    def __init__(self) -> None:
        self.steady_ns, self.wall_ns = 5 * SECOND, 1_800_000_000 * SECOND
        self.clock = LabClock(wall_ns=lambda: self.wall_ns, steady_ns=lambda: self.steady_ns)

    def wait(self, seconds: float) -> None:
        self.steady_ns += round(seconds * SECOND)
        self.wall_ns += round(seconds * SECOND)


@pytest.mark.parametrize("step", [-600, -1, 1, 600])
def test_a_clock_that_is_set_moves_stamps_and_no_instant(step: int) -> None:
    machine = Machine()
    clock = machine.clock
    before = clock.instant_ns()
    machine.wait(2.0)
    machine.wall_ns += step * SECOND
    assert clock.instant_ns() == before + 2 * SECOND
    assert clock.now_ns() == machine.wall_ns
    # What was stored before, and a stamp that arrives after it.
    assert clock.stamp(before) == machine.wall_ns - 2 * SECOND
    machine.wall_ns += step * SECOND
    assert clock.instant(machine.wall_ns) == before + 2 * SECOND


@pytest.mark.parametrize("step", [-600, -1, 1, 600])
def test_a_stamp_on_its_way_while_the_clock_is_set_keeps_its_instant(step: int) -> None:
    machine = Machine()
    clock = machine.clock
    sent, ahead = clock.now_ns(), clock.now_ns() + SECOND // 10
    machine.wall_ns += step * SECOND
    machine.wait(0.01)
    assert clock.instant(sent) == clock.instant_ns() - SECOND // 100
    assert clock.instant(ahead) == clock.instant_ns() + 9 * SECOND // 100


def fail() -> None:
    raise RuntimeError("rcl node's context is invalid")


@pytest.mark.parametrize("up", [True, False])
def test_only_a_context_that_is_up_lets_the_executor_log_the_failure(up):
    made: list[Any] = []
    node: Any = SimpleNamespace(
        context=SimpleNamespace(ok=lambda: up),
        create_timer=lambda period, callback, **_: made.append(callback),
    )
    every(node, 1.0, fail)
    if up:
        with pytest.raises(RuntimeError):
            made[0]()
    else:
        made[0]()
