from __future__ import annotations

import json
import math
from pathlib import Path
from typing import Any

import pytest

from mrlab_ros.gateway.link.clock import ClockOffset, exchange

pytestmark = pytest.mark.fast
VECTORS = Path(__file__).parents[4] / "web" / "test" / "link" / "clock_offset.json"


@pytest.mark.parametrize("case", json.loads(VECTORS.read_text()), ids=lambda case: case["name"])
def test_it_is_the_same_as_in_the_browser(case: dict[str, Any]) -> None:
    clock, exchanges = ClockOffset(), list(case["exchanges"])
    for at, expected in case["reads"]:
        while exchanges and exchanges[0][3] <= at:
            clock.add(exchange(*exchanges.pop(0)))
        assert clock.offset(at) == pytest.approx(expected, abs=1e-9)


def test_nothing_is_known_before_the_first_exchange() -> None:
    clock = ClockOffset()
    assert not clock.known
    assert math.isnan(clock.offset(1.0))
    clock.add(exchange(0.0, 10.0, 10.0, 0.0))
    assert clock.offset(1.0) == 10.0
    clock.clear()
    assert not clock.known
