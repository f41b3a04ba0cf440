"""Ways of tools as a class draws them: seen from one place, by the points that tell most of a way.

web/src/report/plot/way.ts reads them.
"""

from __future__ import annotations

import heapq
from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from mrlab_ros.core.base.geometry import Array

Whole = NDArray[np.int64]

# The view is from the front right and above, like that of the other pictures.
RIGHT, UP = (-0.6, 0.8, 0.0), (-0.36, -0.27, 0.89)
LEAST = 1e-12  # m2, of a line
FIRST, BITS = 63, 5  # of encoded polylines: the first character, and what one holds


def telling(way: Array, count: int, close: float = 0.0) -> Whole:
    """Return up to `count` places of a way, in order, straight lines between which are near it.

    way: (N, D). What is nearer than `close` to such a line adds no place.
    """
    last = len(way) - 1
    if last < 1:
        return np.arange(len(way))
    kept = [0, last]
    waiting = [_farthest(way, 0, last)]
    while waiting and len(kept) < count:
        away, place, before, after = heapq.heappop(waiting)
        if -away <= close:
            break
        kept.append(place)
        for start, end in ((before, place), (place, after)):
            if end - start > 1:
                heapq.heappush(waiting, _farthest(way, start, end))
    return np.array(sorted(kept))


def _farthest(way: Array, start: int, end: int) -> tuple[float, int, int, int]:
    """Return the place that is farthest from the line of two others: minus how far, where."""
    along = way[end] - way[start]
    rows = way[start : end + 1] - way[start]
    share = np.clip(rows @ along / max(float(along @ along), LEAST), 0.0, 1.0)
    away = np.linalg.norm(rows - share[:, None] * along, axis=1)
    place = int(away.argmax())
    return -float(away[place]), start + place, start, end


def drawn(way: Sequence[Sequence[float]], count: int, step: float) -> str:
    """Return a way as it is seen, of up to `count` points, empty where there is none.

    way: (N, 3) m in world. Three whole numbers a point say how far on in `way`, and how far to
    the right and up in `step` (m), it is from the point before, the first from zero. They are
    written as Google's encoded polylines have them.
    """
    points: Array = np.array(way, dtype=float).reshape(-1, 3) @ np.array([RIGHT, UP]).T
    places = telling(points, count, step / 2)
    rows = np.column_stack([places, (points[places] / step).round()])
    numbers = np.diff(rows, axis=0, prepend=0.0).astype(np.int64).ravel()
    return "".join(_encoded(int(number)) for number in numbers)


def _encoded(number: int) -> str:
    left, text = 2 * number if number >= 0 else -2 * number - 1, ""
    more = 1 << BITS
    while left >= more:
        text += chr(FIRST + (more | left & (more - 1)))
        left >>= BITS
    return text + chr(FIRST + left)
