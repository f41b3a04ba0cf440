"""A robot system as a file: read as written, refused with the place that is wrong."""

from __future__ import annotations

from contextlib import suppress

import pytest
import yaml
from hypothesis import given
from hypothesis import strategies as st
from refusals import refused

from mrlab_ros.core.base.errors import BadInput
from mrlab_ros.core.scene.document import parse_cell
from mrlab_ros.core.systems.cell_file import MEMBER_FIELDS, SYSTEM_FIELDS, plain_system
from mrlab_ros.core.systems.diagnostics import ENDLESS_HOLD
from mrlab_ros.core.systems.states import Policy
from mrlab_ros.core.systems.timeline import Mode


def read(document):
    (system,) = parse_cell(document, "the system file")
    return system


FULL = """
name: cell
mode: sequential
policy: halt_member
loop: true
members:
  - robot: ur5e_1
    trajectory: handover_ur5e
    dwell: 0.5
    after: kr6_1.frame 120
  - robot: kr6_1
    wait: [object cube_1 held by ur5e_1, object cube_2 free]
    holds:
      - {frame: 200, wait: object cube_1 free, after: ur5e_1.frame 7}
"""


def test_a_hold_without_a_condition_is_refused_with_what_to_add():
    cell = {"members": [{"robot": "a", "holds": [{"frame": 3}]}]}
    with refused(ENDLESS_HOLD, BadInput, frame=3):
        read(cell)


def test_a_full_file_is_read_as_written():
    cell = read(yaml.safe_load(FULL))
    assert (cell.name, cell.mode, cell.policy, cell.loop) == (
        "cell",
        Mode.SEQUENTIAL,
        Policy.HALT_MEMBER,
        True,
    )
    first, second = cell.members
    assert (first.robot, first.trajectory, first.dwell) == ("ur5e_1", "handover_ur5e", 0.5)
    assert list(first.waits) == ["frame 0: after kr6_1.frame 120"]
    assert list(second.waits) == [
        "frame 0: object cube_1 held by ur5e_1",
        "frame 0: object cube_2 free",
        "frame 200: after ur5e_1.frame 7",
        "frame 200: object cube_1 free",
    ]


def test_what_is_written_is_read_back_the_same():
    cell = read(yaml.safe_load(FULL))
    assert read(plain_system(cell)) == cell
    assert parse_cell({"systems": [plain_system(cell)]}, "cell") == (cell,)


def test_mode_and_policy_may_be_numbers_as_in_a_message():
    cell = read({"mode": 1, "policy": 1, "members": [{"robot": "a"}]})
    assert (cell.mode, cell.policy) == (Mode.SEQUENTIAL, Policy.HALT_MEMBER)


def test_the_least_is_a_list_of_robots():
    cell = read({"members": [{"robot": "a"}, {"robot": "b"}]})
    assert (cell.name, cell.mode, cell.policy, cell.loop) == (
        "",
        Mode.PARALLEL,
        Policy.HALT_ALL,
        False,
    )
    assert [m.robot for m in cell.members] == ["a", "b"]


@pytest.mark.parametrize(
    ("text", "says"),
    [
        ("", "the system file is empty; expected a mapping with the fields name, mode"),
        ("members: []", "members is empty; expected a list of at least one robot"),
        ("members: ur5e_1", "members is 'ur5e_1'; expected a list"),
        ("robot: [a]", "'robot' is unknown; expected name, mode"),
        ("robots: [{name: a, model: ur5e}]", "holds robots; a cell has systems alone"),
        ("systems: []", "holds no system"),
        ("mode: true\nmembers: [{robot: a}]", "mode is true; expected parallel or sequential"),
        ("rate: 5\nmembers: [{robot: a}]", "rate is 5; expected a number from 0.1 to 4"),
        ("at: -1\nmembers: [{robot: a}]", "at is -1; expected a number from 0"),
        ("members: [ur5e_1]", "member 1 is 'ur5e_1'; expected a mapping with the fields robot"),
        ("members: [{trajectory: x}]", "member 1: robot is missing"),
        ("members: [{robot: a, trajektory: x}]", "Did you mean 'trajectory'"),
        ("mode: serial\nmembers: [{robot: a}]", "mode is 'serial'; expected parallel or sequent"),
        ("policy: stop\nmembers: [{robot: a}]", "expected halt_all or halt_member"),
        ("loop: often\nmembers: [{robot: a}]", "expected true or false"),
        (
            "members: [{robot: a, dwell: -1}]",
            "member a: dwell is -1; expected a number of",
        ),
        ("members: [{robot: a, dwell: .nan}]", "member a: dwell is nan"),
        ("members: [{robot: a, dwell: long}]", "member a: dwell is 'long'"),
        ("members: [{robot: a, wait: until noon}]", "member a: .* is no wait; expected"),
        ("members: [{robot: a, holds: [{frame: x}]}]", "member a, hold 1: frame is 'x'"),
        ("members: [{robot: a, holds: [{wait: x}]}]", "member a, hold 1: frame is missing"),
        (
            "members: [{robot: a, holds: [{frame: 5}]}]",
            "member a, hold 1: nothing says until when it holds frame 5; add wait",
        ),
        ("members: [{robot: a, holds: 5}]", "member a: holds is 5; expected a list"),
        ("members: [{robot: a, holds: [free]}]", "hold 1 is 'free'; expected a mapping"),
        ("members: [{robot: a, waits: 5}]", "member a: waits is 5; expected"),
        ("members: [{robot: a, wait: {b: c}}]", "member a: wait is .*; expected"),
        ("members: [{robot: 5}]", "member 1: robot is 5; expected"),
        ("members: [{robot: a, dwell: true}]", "member a: dwell is true; expected"),
        ("members: {robot: a}", "members is .*; expected a list"),
        ("name: [a]\nmembers: [{robot: a}]", "name is .*; expected"),
        ("rate: fast\nmembers: [{robot: a}]", "rate is 'fast'; expected"),
        ("rate: -5\nmembers: [{robot: a}]", "0.1 to 4, or its negative"),
        ("members: [5, {robot: a, dwell: x}]", "the system file has 2 mistakes"),
    ],
)
def test_what_is_wrong_is_named_with_its_place(text, says):
    with pytest.raises(BadInput, match=says):
        read(yaml.safe_load(text))


YAML = st.recursive(
    st.none() | st.booleans() | st.integers() | st.floats() | st.text(max_size=5),
    lambda inner: st.lists(inner, max_size=3) | st.dictionaries(st.text(max_size=5), inner),
    max_leaves=4,
)


@given(st.sampled_from(SYSTEM_FIELDS), st.sampled_from(MEMBER_FIELDS), YAML, YAML)
def test_whatever_type_a_value_has_it_is_read_or_named(field, member_field, value, other):
    cell = {"members": [{"robot": "a", member_field: other}], field: value}
    # Anything but a refusal fails the test.
    with suppress(BadInput):
        assert read(cell).members
