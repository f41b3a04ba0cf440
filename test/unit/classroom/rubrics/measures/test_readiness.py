"""The verdict of the check as a test."""

from __future__ import annotations

from dataclasses import replace

from made_motions import checked, outcome

from mrlab_ros.core.checking.diagnostics import COLLISION
from mrlab_ros.core.checking.report import CheckReport

HIT = COLLISION(
    robot="ur5e_1", link="wrist_3_link", kind="object", other="cube_1", time=1.25, end=1.5,
    value=0.01, unit="m", point=(0.4, 0.1, 0.2),
)  # fmt: skip


def test_a_blocking_finding_is_named_with_its_instant():
    assert outcome("ready", checked()).share == 1.0
    hit = replace(checked(), report=CheckReport("made", {}, (), (HIT,)))
    lost = outcome("ready", hit)
    assert (lost.share, lost.time, lost.found.code) == (0.0, 1.25, "not_ready_for_robot")
    assert lost.found.values["why"].code == "collision"
