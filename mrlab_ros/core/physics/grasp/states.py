"""The states of a gripper in one table, and when fingers count as stalled."""

from __future__ import annotations

from collections.abc import Sequence
from enum import Enum

from mrlab_ros.core.base.clock import SECOND
from mrlab_ros.core.base.geometry import dot
from mrlab_ros.core.base.state_machine import Table
from mrlab_ros.core.physics.engine import Finger, FingerState, Kind, Touch

# Two fingers oppose each other when the cosine between their contact normals is below this;
# three fingers 120 degrees apart have -0.5.
OPPOSED = -0.4
# A finger that closed by less than this share of its range is at its open end.
LEAST_WAY = 0.002
# Cosine between a contact and the way a finger closes, from which on its inner side touches: 60
# degrees, for the normal of a contact between two edges lies anywhere between their faces.
INWARDS = 0.5


class Grasp(Enum):
    """The states; the values are those of mrlab_msgs/Grasp."""

    OPEN = 0
    CLOSING = 1
    HOLDING = 2
    EMPTY = 3


class GraspEvent(Enum):
    """Events of a gripper. The value is the verb in "cannot <value> while <STATE>"."""

    CLOSE = "close"
    OPEN = "open"
    SEIZED = "hold an object"
    SHUT = "close on nothing"
    LOST = "lose the object"


G, E = Grasp, GraspEvent
TABLE: Table[Grasp, GraspEvent] = Table(
    initial=G.OPEN,
    transitions={
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
    },
    # A face that grasped nothing in time stays switched on.
    ignored={E.SHUT: (G.EMPTY,)},
    commands=tuple(GraspEvent),
)
del G, E


def opposed(a: Touch, b: Touch) -> bool:
    """Return whether two contacts of an object press against each other."""
    return dot(a.normal, b.normal) < OPPOSED


def _oppose(some: Sequence[Sequence[Touch]], others: Sequence[Sequence[Touch]]) -> bool:
    return any(opposed(a[0], b[0]) for a in some for b in others)


class StallWatch:
    """Detects fingers that make no progress, and records what they touched.

    A finger is stalled when it closed by less than `share` of what it would have covered freely
    in `span_ns`. Contacts count for the same span: a finger pressed against something hard loses
    touch with it every few steps. palm: the links of the hand itself, which a jaw closes against.
    """

    def __init__(
        self, fingers: Sequence[Finger], palm: frozenset[str], share: float, span_ns: int
    ) -> None:
        self._fingers = tuple(fingers)
        self._least = [share * f.max_velocity * span_ns / SECOND for f in self._fingers]
        self._span_ns = span_ns
        self._links = frozenset(finger.link for finger in self._fingers)
        self._palm = palm - self._links
        self.reset()

    def reset(self) -> None:
        self._from: list[tuple[int, float]] | None = None
        self._stalled: set[str] = set()
        self._all_since_ns: int | None = None
        self._touched: dict[tuple[str, str], tuple[int, list[Touch]]] = {}

    def update(
        self, now_ns: int, states: Sequence[FingerState], touches: Sequence[Touch]
    ) -> frozenset[str]:
        """Return the links of the fingers that are stalled at `now_ns`."""
        for touch in touches:
            if touch.kind is not Kind.OBJECT or touch.held:
                continue
            if touch.link in self._palm or (touch.link in self._links and touch.grip >= INWARDS):
                key = (touch.link, touch.other)
                if self._touched.get(key, (0, []))[0] != now_ns:
                    self._touched[key] = (now_ns, [])
                self._touched[key][1].append(touch)
        if self._from is None:
            self._from = [(now_ns, state.position) for state in states]
        for i, (finger, state) in enumerate(zip(self._fingers, states, strict=True)):
            since_ns, position = self._from[i]
            if finger.closes * (state.position - position) > self._least[i]:
                self._stalled.discard(finger.link)
                self._from[i] = (now_ns, state.position)
            elif now_ns - since_ns >= self._span_ns:
                self._stalled.add(finger.link)
                self._from[i] = (now_ns, state.position)
        if len(self._stalled) < len(self._fingers):
            self._all_since_ns = None
        elif self._all_since_ns is None:
            self._all_since_ns = now_ns
        return frozenset(self._stalled)

    def all_stalled_for(self, now_ns: int) -> float:
        """Return how long all fingers have been stalled, s."""
        return 0.0 if self._all_since_ns is None else (now_ns - self._all_since_ns) / SECOND

    def shut(self, states: Sequence[FingerState]) -> bool:
        """Return whether all fingers are at their closed end."""
        return all(
            finger.upper - finger.lower - finger.closed_by(state.position) <= least
            for finger, state, least in zip(self._fingers, states, self._least, strict=True)
        )

    def pinched(self, now_ns: int) -> tuple[str, tuple[Sequence[Touch], ...]] | None:
        """Return the first object, by name, between two opposing stalled fingers, or one and the
        hand itself, and the newest touches of each of these."""
        by_object: dict[str, list[Sequence[Touch]]] = {}
        for (link, other), (seen_ns, touches) in self._touched.items():
            stalled = link in self._stalled or link in self._palm
            if stalled and now_ns - seen_ns <= self._span_ns:
                by_object.setdefault(other, []).append(touches)
        for name in sorted(by_object):
            pressed = [of for of in by_object[name] if of[0].link in self._links]
            palm = [of for of in by_object[name] if of not in pressed]
            if _oppose(pressed, pressed):
                return name, tuple(pressed)
            if _oppose(pressed, palm):
                return name, tuple(pressed + palm)
        return None

    def between(self, now_ns: int) -> list[str]:
        """Return the names of all objects that a stalled finger touches inwards."""
        return sorted(
            {
                other
                for (link, other), (seen_ns, _) in self._touched.items()
                if link in self._stalled and now_ns - seen_ns <= self._span_ns
            }
        )

    def wedged(self, states: Sequence[FingerState]) -> bool:
        """Return whether a finger is at its open end: what lies between them is too wide."""
        return any(
            finger.closed_by(state.position) < LEAST_WAY * (finger.upper - finger.lower)
            for finger, state in zip(self._fingers, states, strict=True)
        )
