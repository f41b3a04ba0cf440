"""Joint states of a bag as the motion of a robot whose joints they name."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mrlab_ros.adapters.workspaces.sinks import Found, Sink
from mrlab_ros.core.conversion.evidence.glossary import Class
from mrlab_ros.core.conversion.evidence.headings import prefixes
from mrlab_ros.core.conversion.evidence.names import described
from mrlab_ros.core.conversion.workspace import EARLIER, JOINT_STATE, JOINT_TRAJECTORY

SECOND = 1_000_000_000  # ns


@dataclass
class RecordedStates:
    """The joint states of one topic, in the order in which they were recorded.

    A message may name some of the joints only: the others keep the positions that they had. Each
    row is the state of all joints that are known then. times: ns. moved: the joints of each
    message.
    """

    known: dict[str, float] = field(default_factory=dict)
    times: list[int] = field(default_factory=list)
    rows: list[tuple[float, ...]] = field(default_factory=list)
    moved: list[frozenset[str]] = field(default_factory=list)

    def add(self, state: Any, recorded_ns: int) -> None:
        """Take a message; one without a stamp is of the time at which it was recorded."""
        stamp = state.header.stamp.sec * SECOND + state.header.stamp.nanosec
        given = dict(zip(state.name, map(float, state.position), strict=False))
        if given:
            self.known.update(given)
            self.times.append(stamp or recorded_ns)
            self.rows.append(tuple(self.known.values()))
            self.moved.append(frozenset(given))

    def hand_over(self, topic: str, joints: Sequence[str], sink: Sink) -> None:
        """Hand the motion of each robot with these joints to the sink.

        Its path is the topic, and where several robots have it the topic and their prefix.
        """
        names = list(self.known)
        found = prefixes(joints, names)
        if not found:
            sink.add(Found(topic, JOINT_STATE, (len(self.rows), len(names)), columns=tuple(names)))
        for prefix in found:
            path = topic if len(found) == 1 else f"{topic}/{prefix.strip('_/.')}".rstrip("/")
            wanted = [prefix + joint for joint in joints]
            columns = [names.index(name) for name in wanted]
            kept = list(self._rows_of(frozenset(wanted), max(columns)))
            values = np.array([[self.rows[i][c] for c in columns] for i in kept], "<f8")
            data = values.tobytes("F")
            named = tuple(joints)
            sink.add(Found(path, JOINT_TRAJECTORY, values.shape, data, "<f8", columns=named))
            elapsed = np.array([self.times[i] - self.times[kept[0]] for i in kept]) / SECOND
            beside = {
                "time_from_start": elapsed,
                EARLIER: np.array([self._earlier(wanted)], "<f8"),
            }
            beside |= self._grippers(prefix if len(found) > 1 else "", wanted, kept)
            for name, held in beside.items():
                shape = (len(held), 1)
                sink.add(Found(f"{path}.{name}", "double", shape, held.tobytes(), "<f8"))

    def _grippers(
        self, prefix: str, wanted: Sequence[str], kept: list[int]
    ) -> dict[str, NDArray[np.float64]]:
        """Return the positions of the other joints that are called as those of a gripper."""
        found = {}
        for column, name in enumerate(self.known):
            of_gripper = any(w.can_be(Class.GRIPPER) for w in described(name))
            known = kept and column < len(self.rows[kept[0]])
            if of_gripper and known and name not in wanted and name.startswith(prefix):
                found[name] = np.array([self.rows[i][column] for i in kept], "<f8")
        return found

    def _earlier(self, names: Sequence[str]) -> float:
        """Return how many messages of these joints have an earlier stamp than the one before."""
        times = [t for t, m in zip(self.times, self.moved, strict=True) if m & set(names)]
        return float(np.count_nonzero(np.diff(times) < 0))

    def _rows_of(self, names: frozenset[str], last: int) -> Iterator[int]:
        """Yield the rows with a new position of one of these joints, once all are known.

        last: the greatest column of them. A row that is not later than the one before is left
        out.
        """
        before = 0
        for number, (time, row) in enumerate(zip(self.times, self.rows, strict=True)):
            if last < len(row) and time > before and names & self.moved[number]:
                before = time
                yield number
