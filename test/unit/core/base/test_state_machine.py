"""The state machines of the lab: all of them, every state with every event, and their one door."""

from __future__ import annotations

import ast
import itertools
from enum import Enum
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st
from refusals import refused

from mrlab_ros.core.base.diagnostics import ILLEGAL_EVENT
from mrlab_ros.core.base.errors import IllegalEvent, Misuse
from mrlab_ros.core.base.state_machine import Machine, Table
from mrlab_ros.core.physics import clearance
from mrlab_ros.core.physics.grasp import states
from mrlab_ros.core.playback import states as playback
from mrlab_ros.core.recording import recorder as recording
from mrlab_ros.core.systems import states as systems

PACKAGE = Path(__file__).parents[4] / "mrlab_ros"
TABLES: dict[str, Table] = {
    "playback": playback.TABLE,
    "system": systems.TABLE,
    "recorder": recording.TABLE,
    "grasp": states.TABLE,
    "clearance": clearance.TABLE,
}


def events_of(table: Table) -> list[Enum]:
    kind = type(next(event for _, event in table.rows))
    return list(kind)


def paths(table: Table) -> dict[Enum, list[Enum]]:
    """The shortest way of events from the initial state to every state that can be reached."""
    found: dict[Enum, list[Enum]] = {table.initial: []}
    waiting = [table.initial]
    while waiting:
        state = waiting.pop(0)
        for (source, event), target in table.rows.items():
            if source is state and target not in found:
                found[target] = [*found[state], event]
                waiting.append(target)
    return found


def in_state(table: Table, state: Enum) -> Machine:
    machine = Machine(table)
    for event in paths(table)[state]:
        machine.fire(event)
    assert machine.state is state
    return machine


@pytest.mark.parametrize("table", TABLES.values(), ids=TABLES)
def test_every_pair_follows_the_table_or_is_refused_and_changes_nothing(table):
    for state, event in itertools.product(type(table.initial), events_of(table)):
        follows(table, state, event)


def follows(table, state, event):
    machine = in_state(table, state)
    if (state, event) in table.rows:
        assert machine.can(event)
        assert machine.check(event) is table.rows[state, event]
        assert machine.state is state
        assert machine.ignores(event) == (state in table.ignored.get(event, ()))
        assert machine.fire(event) is table.rows[state, event]
        assert machine.state is table.rows[state, event]
        return
    assert not machine.can(event)
    assert not machine.ignores(event)
    possible = [each.value for each in machine.possible()]
    for ask in (machine.check, machine.fire):
        with refused(
            ILLEGAL_EVENT, IllegalEvent, event=event.value, state=state.name, possible=possible
        ):
            ask(event)
        assert machine.state is state


@pytest.mark.parametrize("table", TABLES.values(), ids=TABLES)
def test_every_state_can_be_reached_and_left(table):
    states = list(type(table.initial))
    assert set(paths(table)) == set(states)
    for state in states:
        assert any(s is state and target is not state for (s, _), target in table.rows.items())


@pytest.mark.parametrize("table", TABLES.values(), ids=TABLES)
def test_every_event_has_a_row_and_a_text_of_its_own(table):
    events = events_of(table)
    assert {event for _, event in table.rows} == set(events)
    assert len({event.value for event in events}) == len(events)
    assert set(table.commands) <= set(events)


@pytest.mark.parametrize("table", TABLES.values(), ids=TABLES)
@given(data=st.data())
def test_whatever_is_fired_the_machine_stays_in_the_table(table, data):
    machine, state = Machine(table), table.initial
    for event in data.draw(st.lists(st.sampled_from(events_of(table)), max_size=30)):
        try:
            machine.fire(event)
        except IllegalEvent:
            assert (state, event) not in table.rows
        else:
            state = table.rows[state, event]
        assert machine.state is state


class Light(Enum):
    RED = 1
    GREEN = 2


class Change(Enum):
    GO = "go"
    STOP = "stop"
    FLASH = "flash"


LIGHT: Table[Light, Change] = Table(
    initial=Light.RED,
    transitions={
        (Light.RED, Change.GO): Light.GREEN,
        (Light.GREEN, Change.STOP): Light.RED,
        (Light.GREEN, Change.FLASH): Light.RED,
    },
    ignored={Change.STOP: (Light.RED,)},
    commands=(Change.GO, Change.STOP),
)


def test_the_refusal_says_why_where_the_owner_knows():
    machine = Machine(LIGHT, lambda state, event: "somebody crosses")
    with refused(ILLEGAL_EVENT, Misuse, reason="somebody crosses", possible=["go", "stop"]):
        machine.fire(Change.FLASH)


def test_the_state_cannot_be_assigned():
    machine = Machine(LIGHT)
    with pytest.raises(AttributeError):
        machine.state = Light.GREEN  # type: ignore[misc]
    with pytest.raises(AttributeError):
        machine.other = Light.GREEN  # type: ignore[attr-defined]
    with pytest.raises(TypeError):
        LIGHT.rows[Light.RED, Change.FLASH] = Light.RED  # type: ignore[index]


def test_a_row_cannot_be_ignored_and_a_transition_at_once():
    with pytest.raises(ValueError, match="both a transition and ignored"):
        Table(
            initial=Light.RED,
            transitions={(Light.RED, Change.GO): Light.GREEN},
            ignored={Change.GO: (Light.RED,)},
            commands=(),
        )


def test_the_diagram_has_one_arrow_for_each_pair_of_states():
    assert LIGHT.mermaid().splitlines() == [
        "```mermaid",
        "stateDiagram-v2",
        "    [*] --> RED",
        "    RED --> GREEN: go",
        "    GREEN --> RED: stop, flash",
        "```",
    ]


def test_the_page_s_table_has_every_pair():
    assert LIGHT.markdown().splitlines() == [
        "| event | `RED` | `GREEN` |",
        "|---|---|---|",
        "| go | `GREEN` | — |",
        "| stop | · | `RED` |",
        "| flash | — | `RED` |",
    ]


def assigned_attributes(source: str) -> list[tuple[int, str]]:
    """The attributes that `source` assigns, in any way, with the line."""
    found = []
    sets = "setattr" in source
    for node in ast.walk(ast.parse(source)):
        targets: list[ast.expr] = []
        if isinstance(node, ast.Assign):
            targets = node.targets
        elif isinstance(node, (ast.AugAssign, ast.AnnAssign, ast.NamedExpr, ast.For)):
            targets = [node.target]
        elif isinstance(node, ast.With):
            targets = [item.optional_vars for item in node.items if item.optional_vars]
        for target in targets:
            for part in ast.walk(target):
                if isinstance(part, ast.Attribute):
                    found.append((part.lineno, ast.unparse(part)))
        if sets and isinstance(node, ast.Call) and "setattr" in ast.unparse(node.func):
            name = node.args[1] if len(node.args) > 1 else None
            if isinstance(name, ast.Constant):
                found.append((node.lineno, f"{ast.unparse(node.args[0])}.{name.value}"))
    return found


MODULES = sorted(path for path in PACKAGE.rglob("*.py") if path.name != "state_machine.py")


def test_no_module_of_the_core_assigns_a_state():
    wrong = [
        f"{path.relative_to(PACKAGE)}:{line} assigns {name}"
        for path in MODULES
        if path.is_relative_to(PACKAGE / "core")
        for line, name in assigned_attributes(path.read_text())
        if name.split(".")[-1] in ("state", "_state")
    ]
    assert wrong == []


def test_no_module_assigns_into_a_machine():
    machines = {
        ast.unparse(node.targets[0]).split(".")[-1]
        for path in MODULES
        if "Machine(" in path.read_text()
        for node in ast.walk(ast.parse(path.read_text()))
        if isinstance(node, ast.Assign)
        and isinstance(node.value, ast.Call)
        and ast.unparse(node.value.func) == "Machine"
    }
    assert len(machines) >= 2
    wrong = [
        f"{path.relative_to(PACKAGE)}:{line} assigns {name}"
        for path in MODULES
        for line, name in assigned_attributes(path.read_text())
        if machines & set(name.split(".")[:-1])
    ]
    assert wrong == []


def test_assignments_are_found_in_every_form():
    source = (
        "a.state = 1\n(b.state, c) = 1, 2\nd.state: int = 1\ne.state += 1\n"
        "setattr(f, 'state', 1)\nobject.__setattr__(g, '_state', 1)\nfor h.state in i:\n    pass\n"
    )
    assert [name for _, name in sorted(assigned_attributes(source))] == [
        "a.state", "b.state", "d.state", "e.state", "f.state", "g._state", "h.state",
    ]  # fmt: skip
