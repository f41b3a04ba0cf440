"""The curves of a checked motion: each carries the marks of its own findings."""

from __future__ import annotations

from mrlab_ros.core.checking.diagnostics import COLLISION
from mrlab_ros.core.checking.recording import Distances, Rehearsed
from mrlab_ros.core.physics.engine import Kind, Near
from mrlab_ros.core.show.check import _distances


def test_a_collision_marks_the_curve_of_what_is_touched() -> None:
    recorded = Rehearsed(times=[0.0, 1.0])
    for other in ("can_1", "can_10"):
        series = recorded.distances[("ur5e", (Kind.OBJECT, other))] = Distances()
        for distance in (0.2, 0.0):
            series.add(Near(distance, "wrist"))
    found = COLLISION(
        robot="ur5e", link="wrist", time=1.0, kind="object", other="can_10",
        point=(0.0, 0.0, 0.0), value=0.0,
    )  # fmt: skip
    strips = [strip for strip, _ in _distances([found], recorded, several=False)]
    assert {strip.name: len(strip.marks) for strip in strips} == {
        "wrist to can_1": 0,
        "wrist to can_10": 1,
    }
