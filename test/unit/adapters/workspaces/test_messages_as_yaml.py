"""Messages as `ros2 topic echo` prints them, and goals of actions."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
import pytest

from mrlab_ros.adapters.workspaces.diagnostics import (
    LIBRARY_FAILED,
    NO_MESSAGES,
    UNREADABLE,
)
from mrlab_ros.adapters.workspaces.reader import WorkspaceReader
from mrlab_ros.core.base.errors import BadInput

ECHOED = """\
header:
  stamp:
    sec: 0
    nanosec: 0
  frame_id: ''
joint_names:
- a
- b
points:
- positions:
  - 0.0
  - 1.5
  velocities: []
  accelerations: []
  effort: []
  time_from_start:
    sec: 0
    nanosec: 0
- positions: [1e-1, 1.25]
  time_from_start: {sec: 0, nanosec: 500000000}
---
"""
GOAL = "trajectory:\n" + "".join(f"  {line}\n" for line in ECHOED.splitlines()[:-1])
STATES = "---\n".join(
    f"header:\n  stamp: {{sec: 7, nanosec: {number}00000000}}\n"
    f"name: [a, b]\nposition: [{number}.0, 2]\nvelocity: []\n"
    for number in range(3)
)


@pytest.fixture(scope="module")
def reader():
    with WorkspaceReader() as reader:
        yield reader


@pytest.mark.parametrize("text", [ECHOED, GOAL, f"goal:\n- {{request: 1}}\n---\n{ECHOED}"])
def test_a_trajectory_is_read_wherever_it_stands(reader: WorkspaceReader, text: str) -> None:
    found = reader.read_bytes(text.encode(), "goal.yaml")
    matrix = found.find("trajectory")
    assert matrix.columns == ("a", "b")
    np.testing.assert_array_equal(matrix.values, [[0.0, 1.5], [0.1, 1.25]])
    times = found.find("trajectory.time_from_start").values
    np.testing.assert_array_equal(times.ravel(), [0.0, 0.5])


def test_what_stands_beside_a_trajectory_is_read_too(reader: WorkspaceReader) -> None:
    text = f"# positions in degrees\nunits: deg\nmeta: {{robot: ur10e, scale: 0.5}}\n{ECHOED}"
    found = reader.read_bytes(text.encode(), "goal.yaml")
    assert {v.path: v.text for v in found.variables if v.text} == {
        "comment{1}": "positions in degrees",
        "units": "deg",
        "meta.robot": "ur10e",
    }
    assert found.find("meta.scale").values.tolist() == [[0.5]]


def test_several_trajectories_are_numbered(reader: WorkspaceReader) -> None:
    found = reader.read_bytes((ECHOED * 2).encode(), "echoed.yml")
    assert found.find("trajectory(1)") is not None
    assert found.find("trajectory(2)") is not None


@pytest.mark.parametrize(
    ("text", "why"),
    [
        ("a: [1, 2", LIBRARY_FAILED),
        ("robots: [{name: a}]\n", NO_MESSAGES),
        (ECHOED.replace("- 1.5", "- '...'"), LIBRARY_FAILED),
        ("joint_names: [a]\npoints: [1]\n", LIBRARY_FAILED),
        # Aliases of a list that holds itself, and a few that stand for 9**9 values.
        (f"&a [{'*a,' * 100}]", LIBRARY_FAILED),
        (
            "a: &a [1, 2, 3]\n"
            + "".join(f"{new}: &{new} [{f'*{old},' * 9}]\n" for old, new in pairwise("abcdefghi")),
            LIBRARY_FAILED,
        ),
        ("joint_names: [a]\npoints: [{positions: [1], time_from_start: 3}]\n", LIBRARY_FAILED),
    ],
)
def test_what_holds_no_message_is_told(reader: WorkspaceReader, text: str, why: object) -> None:
    with pytest.raises(BadInput) as caught:
        reader.read_bytes(text.encode(), "cell.yaml")
    assert caught.value.diagnostic.code == UNREADABLE.code
    assert caught.value.diagnostic.values["why"]["code"] == why.code
