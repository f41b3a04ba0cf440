from __future__ import annotations

import pytest

from mrlab_ros.gateway.lab.connection import matches

pytestmark = pytest.mark.fast


@pytest.mark.parametrize(
    ("expression", "key", "expected"),
    [
        ("robots", "robots", True),
        ("*/joint_states", "ur5e_1/joint_states", True),
        ("*/joint_states", "campus/ur5e_1/joint_states", False),
        ("**/joint_states", "campus/ur5e_1/joint_states", True),
        ("assets/**", "assets", True),
        ("a.c", "abc", False),
    ],
)
def test_a_star_is_one_part_two_are_any(expression: str, key: str, expected: bool) -> None:
    assert matches(expression, key) is expected
