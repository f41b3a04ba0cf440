"""Timers by the monotonic clock: neither a clock that is set nor /clock stops them.

A timer of rclpy goes by its node's clock. A wall clock that is set back by an hour would silence
it for an hour: signs of life, journals and leases would end.
"""

from __future__ import annotations

from collections.abc import Callable

from rclpy.callback_groups import CallbackGroup
from rclpy.clock import Clock
from rclpy.clock_type import ClockType
from rclpy.node import Node
from rclpy.timer import Timer

STEADY = Clock(clock_type=ClockType.STEADY_TIME)


def every(
    node: Node, period: float, callback: Callable[[], object], group: CallbackGroup | None = None
) -> Timer:
    """Call `callback` in the node's executor every `period` s.

    What it raises because the context was shut down beneath it is no mistake, and the executor
    would log it as a fatal one.
    """

    def call() -> None:
        try:
            callback()
        except Exception:
            if node.context.ok():
                raise

    return node.create_timer(period, call, callback_group=group, clock=STEADY)
