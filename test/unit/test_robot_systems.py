"""Systems: who may be a member, what the table allows."""

from __future__ import annotations

import pytest

from mrlab_ros.core.errors import BadInput, IllegalEvent, Misuse
from mrlab_ros.core.robot_systems import (
    TRANSITIONS,
    Member,
    SystemEvent,
    Systems,
    SystemState,
    after,
)

ROBOTS = frozenset({"a", "b", "c"})


@pytest.mark.parametrize("event", SystemEvent)
@pytest.mark.parametrize("state", SystemState)
def test_every_pair_has_one_answer(state, event):
    if (state, event) in TRANSITIONS:
        assert after(state, event) is TRANSITIONS[state, event]
    else:
        with pytest.raises(IllegalEvent, match=f"cannot {event.value} in {state.name}"):
            after(state, event)


def test_a_robot_is_in_one_system_at_a_time():
    systems = Systems()
    cell = systems.create("cell", [Member("a"), Member("b")], ROBOTS)
    assert systems.of("a") is cell
    assert systems.of("c") is None
    with pytest.raises(Misuse, match="'b' is a member of system 'cell'"):
        systems.create("other", [Member("c"), Member("b")], ROBOTS)
    assert [s.name for s in systems] == ["cell"]
    systems.dissolve("cell")
    assert systems.of("a") is None
    systems.create("other", [Member("b")], ROBOTS)


def test_names_are_given_and_checked():
    systems = Systems()
    assert systems.create("", [Member("a")], ROBOTS).name == "system_1"
    assert systems.create("", [Member("b")], ROBOTS).name == "system_2"
    for taken in ("system_1", "a"):
        with pytest.raises(BadInput, match=f"'{taken}' is taken"):
            systems.create(taken, [Member("c")], ROBOTS)


@pytest.mark.parametrize(
    ("members", "says"),
    [
        ([], "at least one member"),
        ([Member("x")], "no robot 'x' is in the scene; there are: a, b, c"),
        ([Member("a"), Member("a")], "named 2 times"),
    ],
)
def test_members_that_cannot_be_are_refused(members, says):
    systems = Systems()
    with pytest.raises(BadInput, match=says):
        systems.create("cell", members, ROBOTS)
    assert list(systems) == []


def test_an_unknown_system_is_named_with_those_that_are_there():
    with pytest.raises(Misuse, match="no system 'cell'; there are: none"):
        Systems().get("cell")


def test_the_longest_member_ends_the_timeline():
    members = [Member("a", duration=2.0), Member("b", duration=5.0)]
    assert Systems().create("cell", members, ROBOTS).duration == 5.0
