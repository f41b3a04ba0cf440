"""The findings of a cell: which of them are of the first conflict of two robots."""

from __future__ import annotations

import pytest

from mrlab_ros.commands.check.cell import _is_first
from mrlab_ros.core.base.diagnostic import Severity
from mrlab_ros.core.checking.findings import Finding
from mrlab_ros.core.checking.pairs import Pair

CONFLICT = Pair("ur5e_1", "ur5e_2", 0.0, 1.0, "a", "b", 1.0, 0.2, touches=True)


@pytest.mark.parametrize(
    ("robot", "kind", "other", "first"),
    [
        ("ur5e_1", "robot", "ur5e_2", True),
        ("ur5e_2", "robot", "ur5e_1", True),
        ("ur5e_2", "robot", "ur5e_10", False),
        ("ur5e_20", "robot", "ur5e_1", False),
        ("ur5e_1", "object", "ur5e_2", False),
    ],
)
def test_a_finding_of_the_first_conflict_is_of_its_two_robots(
    robot: str, kind: str, other: str, *, first: bool
) -> None:
    said = f"wrist touches link of {other}, near ur5e_1 and ur5e_2"
    found = Finding("collision", Severity.ERROR, said, robot=robot, kind=kind, other=other)
    assert _is_first(found, [CONFLICT]) is first
    assert not _is_first(found, [])
