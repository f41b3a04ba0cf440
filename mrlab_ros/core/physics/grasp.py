"""What a gripper does: four states, one table, and when fingers count as stalled."""

from __future__ import annotations

from collections.abc import Sequence
from enum import Enum

from mrlab_ros.core.clock import SECOND
from mrlab_ros.core.errors import IllegalEvent
from mrlab_ros.core.physics.engine import Finger, FingerState, Kind, Touch
from mrlab_ros.core.physics.poses import dot

# Two fingers oppose each other when the cosine between their contact normals is below this;
# three fingers 120 degrees apart have -0.5.
OPPOSED = -0.4


class Gripper(Enum):
    """How an end effector holds."""

    NONE = "none"
    FINGERS = "fingers"
    VACUUM = "vacuum"


class Grasp(Enum):
    """The states; the values are those of mrlab_msgs/Grasp."""

    OPEN = 0
    CLOSING = 1
    HOLDING = 2
    EMPTY = 3


class GraspEvent(Enum):
    """What can happen to a gripper. The value says it as a person would."""

    CLOSE = "close"
    OPEN = "open"
    SEIZED = "hold an object"
    SHUT = "close on nothing"
    LOST = "lose the object"


G, E = Grasp, GraspEvent
TRANSITIONS: dict[tuple[Grasp, GraspEvent], Grasp] = {
    (G.OPEN, E.OPEN): G.OPEN,
    (G.OPEN, E.CLOSE): G.CLOSING,
    (G.OPEN, E.SEIZED): G.HOLDING,
    (G.CLOSING, E.CLOSE): G.CLOSING,
    (G.CLOSING, E.OPEN): G.OPEN,
    (G.CLOSING, E.SEIZED): G.HOLDING,
    (G.CLOSING, E.SHUT): G.EMPTY,
    (G.HOLDING, E.CLOSE): G.HOLDING,
    (G.HOLDING, E.OPEN): G.OPEN,
    (G.HOLDING, E.LOST): G.EMPTY,
    (G.EMPTY, E.CLOSE): G.EMPTY,
    (G.EMPTY, E.OPEN): G.OPEN,
    (G.EMPTY, E.SEIZED): G.HOLDING,
}
del G, E


def after(state: Grasp, event: GraspEvent) -> Grasp:
    """Return the state that `event` leads to; raise IllegalEvent where the table has none."""
    try:
        return TRANSITIONS[state, event]
    except KeyError:
        possible = ", ".join(e.value for e in GraspEvent if (state, e) in TRANSITIONS)
        raise IllegalEvent(
            f"the gripper cannot {event.value} while {state.name}; possible now: {possible}"
        ) from None


def mermaid() -> str:
    """Draw the table as a Mermaid state diagram."""
    lines = ["stateDiagram-v2", "    [*] --> OPEN"]
    for (state, event), target in TRANSITIONS.items():
        lines.append(f"    {state.name} --> {target.name}: {event.value}")
    return "\n".join(lines)


class StallWatch:
    """Tells which fingers make no progress: less than `distance` (m or rad) in `span_ns`."""

    def __init__(self, fingers: Sequence[Finger], distance: float, span_ns: int) -> None:
        self._fingers = tuple(fingers)
        self._distance = distance
        self._span_ns = span_ns
        self._from: list[tuple[int, float]] | None = None
        self._all_since_ns: int | None = None

    def reset(self) -> None:
        self._from = None
        self._all_since_ns = None

    def look(self, now_ns: int, states: Sequence[FingerState]) -> frozenset[str]:
        """Return the links of the fingers that are stalled at `now_ns`."""
        if self._from is None:
            self._from = [(now_ns, state.position) for state in states]
        stalled = set()
        for i, state in enumerate(states):
            since_ns, position = self._from[i]
            if abs(state.position - position) > self._distance:
                self._from[i] = (now_ns, state.position)
            elif now_ns - since_ns >= self._span_ns:
                stalled.add(self._fingers[i].link)
        if len(stalled) < len(self._fingers):
            self._all_since_ns = None
        elif self._all_since_ns is None:
            self._all_since_ns = now_ns
        return frozenset(stalled)

    def all_stalled_for(self, now_ns: int) -> float:
        """Return how long all fingers have been stalled, s."""
        return 0.0 if self._all_since_ns is None else (now_ns - self._all_since_ns) / SECOND

    def shut(self, states: Sequence[FingerState]) -> bool:
        """Return whether all fingers are at their closed end."""
        return all(
            f.upper - s.position <= self._distance
            for f, s in zip(self._fingers, states, strict=True)
        )


def pinched(touches: Sequence[Touch], stalled: frozenset[str]) -> str | None:
    """Return the object that two opposing stalled fingers touch; the first by name, or None."""
    by_object: dict[str, list[Touch]] = {}
    for touch in touches:
        if touch.kind is Kind.OBJECT and touch.link in stalled:
            by_object.setdefault(touch.other, []).append(touch)
    for name in sorted(by_object):
        found = by_object[name]
        for i, a in enumerate(found):
            for b in found[i + 1 :]:
                if a.link != b.link and dot(a.normal, b.normal) < OPPOSED:
                    return name
    return None
