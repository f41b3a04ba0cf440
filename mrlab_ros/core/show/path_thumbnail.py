"""Small pictures of the ways of tools, all of a class in one scale, beside the reference's."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence

import numpy as np

from mrlab_ros.core.geometry import Array

WIDTH, HEIGHT, MARGIN = 104.0, 72.0, 7.0
# The view is from the front right and above, like that of the other pictures.
RIGHT = np.array([-0.6, 0.8, 0.0])
UP = np.array([-0.36, -0.27, 0.89])
OUTSIDE = 2.0  # percent of the points at each end that may lie outside of the picture

Path = Sequence[Sequence[float]]


class Thumbnails:
    """Draws ways, (N, 3) m in the world, so that those of a class can be compared by eye."""

    def __init__(self, paths: Mapping[str, Path], reference: Path = ()) -> None:
        """Choose the scale. paths: of the class, by student."""
        flat = [_flat(path) for path in (*_some(paths.values()), reference) if len(path)]
        points = np.concatenate(flat) if flat else np.zeros((1, 2))
        low, high = np.percentile(points, (OUTSIDE, 100.0 - OUTSIDE), axis=0)
        size = np.maximum(high - low, 0.05)
        room = np.array([WIDTH - 2 * MARGIN, HEIGHT - 2 * MARGIN])
        self._scale = float((room / size).min())
        self._middle = (low + high) / 2
        self._reference = self._line(reference, "reference") if len(reference) else ""

    def svg(self, path: Path, lost: Iterable[float] = ()) -> str:
        """Return a way as SVG: a dot where it begins, a ring where it ends.

        lost: the shares of the time, 0 to 1, at which points were lost; each gets a spot.
        """
        points = self._placed(path)
        begin, end = points[0], points[-1]
        at = {min(max(round(share * (len(points) - 1)), 0), len(points) - 1) for share in lost}
        spots = "".join(
            f'<circle class="spot" cx="{points[i][0]:.1f}" cy="{points[i][1]:.1f}" r="4"/>'
            for i in sorted(at)
        )
        return (
            f'<svg class="way" viewBox="0 0 {WIDTH:g} {HEIGHT:g}" aria-hidden="true">'
            f"{self._reference}{self._line(path, 'line')}"
            f'<circle class="end" cx="{end[0]:.1f}" cy="{end[1]:.1f}" r="4"/>'
            f'<circle class="begin" cx="{begin[0]:.1f}" cy="{begin[1]:.1f}" r="3"/>{spots}</svg>'
        )

    def _line(self, path: Path, kind: str) -> str:
        points = " ".join(f"{x:.1f},{y:.1f}" for x, y in self._placed(path))
        return f'<polyline class="{kind}" points="{points}"/>'

    def _placed(self, path: Path) -> Array:
        moved = (_flat(path) - self._middle) * self._scale
        placed: Array = moved * (1.0, -1.0) + (WIDTH / 2, HEIGHT / 2)
        return placed


def _flat(path: Path) -> Array:
    points = np.asarray(path, dtype=float)
    flat: Array = np.stack([points @ RIGHT, points @ UP], axis=1)
    return flat


def _some(paths: Iterable[Path]) -> list[Path]:
    """Return a thousand of the ways at most: a scale needs no more."""
    every = list(paths)
    return every[:: max(1, len(every) // 1000)]
