"""Two robots of a cell: how near they come, how fast, and which wait keeps them apart."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass

from mrlab_ros.core.checking.rehearsal_record import Collision, Distances, Rehearsed
from mrlab_ros.core.physics.engine import Kind

# Over so long before a conflict, s, the closing speed is taken.
CLOSING_SPAN = 0.1


@dataclass(frozen=True)
class Pair:
    """Two robots over the whole timeline. distance: the least, m, at `time`, s, between `link` and
    `other_link`; all None where they were never within what is looked for.

    conflict: s, when they first touch or are nearer than allowed; closing: m/s before that.
    """

    robot: str
    other: str
    distance: float | None
    time: float | None
    link: str
    other_link: str
    conflict: float | None
    closing: float | None
    touches: bool


@dataclass(frozen=True)
class Delay:
    """A wait that keeps two robots apart: `robot` stands at its first frame until `other` has
    reached `frame`, so that it begins `seconds` later. text: the wait, as a cell has it.

    clears: whether the rehearsal with it has no conflict of the two; all_clear: no robots touch.
    """

    robot: str
    other: str
    frame: int
    seconds: float
    text: str
    clears: bool
    all_clear: bool


def pairs_of(recorded: Rehearsed, closest: float) -> list[Pair]:
    """Return every pair whose distance was recorded; the earliest conflict first.

    closest: m; two robots that are nearer are in conflict.
    """
    found = []
    for (robot, (kind, other)), series in recorded.distances.items():
        if kind is Kind.ROBOT:
            hits = [c for c in recorded.collisions if _between(c, robot, other)]
            found.append(_pair(robot, other, series, recorded.times, hits, closest))
    return sorted(
        found,
        key=lambda p: (
            p.conflict if p.conflict is not None else float("inf"),
            p.distance if p.distance is not None else float("inf"),
            p.robot,
            p.other,
        ),
    )


def _between(hit: Collision, robot: str, other: str) -> bool:
    return hit.kind is Kind.ROBOT and {hit.robot, hit.other} == {robot, other}


def _pair(
    robot: str,
    other: str,
    series: Distances,
    times: Sequence[float],
    hits: Sequence[Collision],
    closest: float,
) -> Pair:
    at = series.least()
    near = bool(series.links[at])
    below = (t for t, d in zip(times, series.values, strict=False) if d < closest)
    firsts = [*(hit.time for hit in hits), *list(below)[:1]]
    conflict = min(firsts, default=None)
    return Pair(
        robot,
        other,
        series.values[at] if near else None,
        times[at] if near else None,
        series.links[at],
        series.other_links[at],
        conflict,
        None if conflict is None else closing_speed(series.values, times, conflict),
        bool(hits),
    )


def closing_speed(values: Sequence[float], times: Sequence[float], at: float) -> float:
    """Return how fast a distance, m, shrinks in the 0.1 s before `at`, m/s; 0 where it grows."""
    before = [i for i, t in enumerate(times) if t <= at + 1e-9 and i < len(values)]
    since = [i for i in before if times[i] >= at - CLOSING_SPAN - 1e-9]
    if len(since) < 2:
        return 0.0
    first, last = since[0], since[-1]
    return max((values[first] - values[last]) / (times[last] - times[first]), 0.0)


def smallest_delay(
    moves: int, waits: int, clear: Callable[[int, int], bool], most: int
) -> int | None:
    """Return by how many samples one of two must begin later so that they stay clear, from 1.

    moves, waits: samples of the way of the one that goes on, and of the one that waits; before
    and after its way each stands at its ends. clear: whether they are apart with the first at one
    sample and the second at another; it is asked once for each. None: no delay up to `most` does.
    """
    known: dict[tuple[int, int], bool] = {}

    def apart(i: int, j: int) -> bool:
        if (i, j) not in known:
            known[i, j] = clear(i, j)
        return known[i, j]

    for delay in range(1, most + 1):
        steps = range(max(moves, waits + delay))
        if all(apart(min(t, moves - 1), min(max(t - delay, 0), waits - 1)) for t in steps):
            return delay
    return None


def wait_frame(
    delay: float, starts: Mapping[str, float], robot: str, other: str, rate: float, frames: int
) -> int:
    """Return the frame of `other` at which `robot` begins where it waits `delay` s longer.

    starts: when each began, s; rate: Hz of the other's `frames` frames.
    """
    position = starts.get(robot, 0.0) + delay - starts.get(other, 0.0)
    return min(max(-int(-position * rate // 1), 0), frames - 1)
