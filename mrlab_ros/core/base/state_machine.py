"""State machines: an Enum of states, an Enum of events, one table, and one door.

A `Table` is data. A `Machine` stands in one state of a table, and `fire` is the only way to
another: the state is a property without a setter. Owners check the event first, do what can
fail, and fire last, so a command that is refused has changed nothing.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from enum import Enum
from types import MappingProxyType
from typing import Generic, TypeVar

from mrlab_ros.core.base.diagnostic import Code, Diagnostic
from mrlab_ros.core.base.diagnostics import ILLEGAL_EVENT
from mrlab_ros.core.base.errors import IllegalEvent

S = TypeVar("S", bound=Enum)
E = TypeVar("E", bound=Enum)


@dataclass(frozen=True)
class Table(Generic[S, E]):
    """The rows of a state machine: which event leads from which state to which.

    transitions: the rows that do something, in the order in which the diagram draws them.
    ignored: for an event the states in which it is legal and nothing happens; these rows keep
        the state and are left out of the diagram.
    commands: the events that a person can ask for; a refusal lists those that are possible.
    refusal: what IllegalEvent says, with the values of ILLEGAL_EVENT.

    An event's value says it in words, as the refusal needs it: "cannot <value> in <STATE>".
    """

    initial: S
    transitions: Mapping[tuple[S, E], S]
    commands: tuple[E, ...]
    ignored: Mapping[E, tuple[S, ...]] = field(default_factory=dict)
    refusal: Code = ILLEGAL_EVENT
    # The transitions and the ignored events, which keep their state.
    rows: Mapping[tuple[S, E], S] = field(init=False, repr=False)

    def __post_init__(self) -> None:
        ignored = {
            (state, event): state for event in self.ignored for state in self.ignored[event]
        }
        if twice := ignored.keys() & self.transitions.keys():
            raise ValueError(f"both a transition and ignored: {sorted(map(str, twice))}")
        object.__setattr__(self, "rows", MappingProxyType({**self.transitions, **ignored}))

    def possible(self, state: S) -> tuple[E, ...]:
        """Return the commands that `state` allows, in the order of `commands`."""
        return tuple(event for event in self.commands if (state, event) in self.rows)

    def refused(self, state: S, event: E, reason: Diagnostic | str = "") -> IllegalEvent:
        """Return the error that says why `event` is illegal in `state` and what is possible."""
        return IllegalEvent(
            self.refusal(
                event=event.value,
                state=state.name,
                reason=reason or None,
                possible=[e.value for e in self.possible(state)],
            )
        )

    def mermaid(self) -> str:
        """Draw the transitions as a Mermaid state diagram, one arrow for each pair of states."""
        arrows: dict[tuple[S, S], list[str]] = {}
        for (state, event), target in self.transitions.items():
            arrows.setdefault((state, target), []).append(event.value)
        lines = ["```mermaid", "stateDiagram-v2", f"    [*] --> {self.initial.name}"]
        for (state, target), events in arrows.items():
            lines.append(f"    {state.name} --> {target.name}: {', '.join(events)}")
        return "\n".join([*lines, "```"])

    def markdown(self) -> str:
        """Write all rows as a Markdown table: events down, states across, the next state inside.

        An em dash is an event that the state refuses, a dot one that changes nothing.
        """
        states = list(type(self.initial))
        known = {event for _, event in self.rows}
        events = [event for event in type(next(iter(known))) if event in known]
        lines = [
            "| event | " + " | ".join(f"`{state.name}`" for state in states) + " |",
            "|---" * (len(states) + 1) + "|",
        ]
        for event in events:
            cells = [self._cell(state, event) for state in states]
            lines.append(f"| {event.value} | " + " | ".join(cells) + " |")
        return "\n".join(lines)

    def _cell(self, state: S, event: E) -> str:
        if state in self.ignored.get(event, ()):
            return "·"
        target = self.rows.get((state, event))
        return "—" if target is None else f"`{target.name}`"


def _no_reason(state: Enum, event: Enum) -> Diagnostic | str:
    return ""


class Machine(Generic[S, E]):
    """A state of a table, which only fire() changes. It knows no lock: that is its owner's.

    reason: says why an event is refused in a state, for the error; may be empty.
    """

    __slots__ = ("_reason", "_state", "_table")

    def __init__(
        self, table: Table[S, E], reason: Callable[[S, E], Diagnostic | str] = _no_reason
    ) -> None:
        """Stand in the table's initial state."""
        self._table = table
        self._reason = reason
        self._state = table.initial

    @property
    def state(self) -> S:
        """The present state."""
        return self._state

    def can(self, event: E) -> bool:
        """Return whether the table has a row for `event` in the present state."""
        return (self._state, event) in self._table.rows

    def check(self, event: E) -> S:
        """Return the state that `event` would lead to; raise IllegalEvent where it is illegal."""
        target = self._table.rows.get((self._state, event))
        if target is None:
            reason = self._reason(self._state, event)
            raise self._table.refused(self._state, event, reason)
        return target

    def fire(self, event: E) -> S:
        """Go to the state that `event` leads to and return it.

        Raises IllegalEvent where the table has no row for it; the state stays as it is.
        """
        self._state = self.check(event)
        return self._state

    def ignores(self, event: E) -> bool:
        """Return whether `event` is legal in the present state and nothing happens."""
        return self._state in self._table.ignored.get(event, ())

    def possible(self) -> tuple[E, ...]:
        """Return the commands that the present state allows."""
        return self._table.possible(self._state)
