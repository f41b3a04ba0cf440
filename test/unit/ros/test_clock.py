"""What a timer's callback raises while the lab shuts down."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import pytest

from mrlab_ros.ros.clock import every


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
