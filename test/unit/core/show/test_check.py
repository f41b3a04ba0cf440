"""The curves of a checked motion: each carries the marks of its own findings."""

from __future__ import annotations

from mrlab_ros.core.base.diagnostic import Severity
from mrlab_ros.core.checking.findings import Finding
from mrlab_ros.core.checking.recording import Distances, Rehearsed
from mrlab_ros.core.physics.engine import Kind, Near
from mrlab_ros.core.show.check import _distances


def test_a_collision_marks_the_curve_of_what_is_touched() -> None:
    recorded = Rehearsed(times=[0.0, 1.0])
    for other in ("can_1", "can_10"):
        series = recorded.distances[("ur5e", (Kind.OBJECT, other))] = Distances()
        for distance in (0.2, 0.0):
            series.add(Near(distance, "wrist"))
    found = Finding(
        "collision", Severity.ERROR, "wrist touches can_10.",
        robot="ur5e", time=1.0, kind="object", other="can_10",
    )  # fmt: skip
    strips = [strip for strip, _ in _distances([found], recorded, several=False)]
    assert {strip.name: len(strip.marks) for strip in strips} == {
        "wrist to can_1": 0,
        "wrist to can_10": 1,
    }
