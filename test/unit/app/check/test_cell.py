"""How the first conflict of two robots of a cell is resolved, said where it is found."""

from __future__ import annotations

from dataclasses import replace

import pytest

from mrlab_ros.app.check.cell import resolution
from mrlab_ros.core.checking.evidence import of_collisions
from mrlab_ros.core.checking.pairs import Delay, Pair
from mrlab_ros.core.checking.rehearsal_record import Collision, Rehearsed
from mrlab_ros.core.physics.engine import Kind

CONFLICT = Pair("ur5e_1", "ur5e_2", 0.0, 1.0, "a", "b", 1.0, 0.2, touches=True)
DELAY = Delay("ur5e_2", "ur5e_1", 80, 0.3, "frame 0: after ur5e_1.frame 80", True, True)


@pytest.mark.parametrize(
    ("robot", "kind", "other", "first"),
    [
        ("ur5e_1", Kind.ROBOT, "ur5e_2", True),
        ("ur5e_2", Kind.ROBOT, "ur5e_1", True),
        ("ur5e_2", Kind.ROBOT, "ur5e_10", False),
        ("ur5e_20", Kind.ROBOT, "ur5e_1", False),
        ("ur5e_1", Kind.OBJECT, "ur5e_2", False),
    ],
)
@pytest.mark.parametrize("time", [0.0, 1.0])
def test_the_wait_is_said_of_the_two_robots_alone(
    robot: str, kind: Kind, other: str, time: float, *, first: bool
) -> None:
    wait = resolution(DELAY, [CONFLICT])
    assert wait is not None
    hit = Collision(time, robot, "wrist", kind, other, "link", (0.0, 0.0, 0.0), 0.01)
    advice = {frozenset((CONFLICT.robot, CONFLICT.other)): wait}
    (found,) = of_collisions(Rehearsed(collisions=[hit]), advice)
    assert found.code == ("collision" if time else "collides_at_start")
    assert (found.robot, found.kind, found.other) == (robot, kind.name.lower(), other)
    assert (found.values.get("advice") == wait) is first


@pytest.mark.parametrize(
    ("delay", "code"),
    [
        (None, "no_wait_helps"),
        (DELAY, "wait_clears"),
        (replace(DELAY, all_clear=False), "wait_clears_two"),
        (replace(DELAY, clears=False), "wait_not_enough"),
    ],
)
def test_what_a_wait_resolves_has_its_code(delay: Delay | None, code: str) -> None:
    found = resolution(delay, [CONFLICT])
    assert found is not None
    assert found.code == code
    assert resolution(delay, []) is None
    assert resolution(delay, [replace(CONFLICT, conflict=None)]) is None
