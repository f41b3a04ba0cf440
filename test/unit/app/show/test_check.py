"""What a page shows of a check beside its scene."""

from __future__ import annotations

import numpy as np

from mrlab_ros.app.show.check import _distances
from mrlab_ros.app.show.packed import unpacked
from mrlab_ros.core.checking.rehearsal_record import Distances, Rehearsed
from mrlab_ros.core.physics.engine import Kind, Near


def test_the_least_distance_comes_first_and_what_is_far_is_a_gap() -> None:
    recorded = Rehearsed(times=[0.0, 1.0])
    for other, last in (("can_1", 0.1), ("can_10", 0.0)):
        series = recorded.distances[("ur5e", (Kind.OBJECT, other))] = Distances()
        series.add_far(1, 0.5)
        series.add(Near(last, "wrist"))
    far = recorded.distances[("ur5e", (Kind.OBJECT, "bin_1"))] = Distances()
    far.add_far(2, 0.5)
    found = _distances(recorded)
    assert [(each["part"], each["kind"], each["other"]) for each in found] == [
        ("wrist", "object", "can_10"),
        ("wrist", "object", "can_1"),
    ]
    values = unpacked(found[1]["values"])
    assert np.isnan(values[0])
    assert values[1] == np.float32(0.1)
