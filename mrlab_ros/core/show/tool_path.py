"""The way of a tool as SVG, from above, from the side and from the front, in one scale."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from mrlab_ros.core.show.svg import Array

# Of a view, in its own units; below it and to its left stand the numbers of its axes.
WIDTH, LEFT, RIGHT, TOP, BOTTOM = 320.0, 40.0, 6.0, 8.0, 24.0
LEAST, MOST = 120.0, 320.0  # height of a view
MOST_POINTS = 400
# Of each view its title, and the coordinates to the right and upwards.
VIEWS = (("from above", 0, 1), ("from the side", 0, 2), ("from the front", 1, 2))


@dataclass(frozen=True)
class Spot:
    """A numbered place on the way, m. severity: error, warning or info."""

    number: int
    severity: str
    place: tuple[float, float, float]


def tool_path_svg(path: Array, reference: Array | None, spots: Sequence[Spot]) -> str:
    """Return the views, a figure each. path, reference: (N, 3) m in the world, NaN where unknown.

    What is much smaller than a view is wide stands in the middle of a view of at least 5 cm.
    """
    known = path[np.isfinite(path).all(axis=1)]
    everything = [known, *(np.array([spot.place]) for spot in spots)]
    if reference is not None:
        everything.append(reference[np.isfinite(reference).all(axis=1)])
    points = np.concatenate(everything)
    low, high = points.min(axis=0), points.max(axis=0)
    middle, size = (low + high) / 2, np.maximum(high - low, 0.05) * 1.12
    width = WIDTH - LEFT - RIGHT
    room = MOST - TOP - BOTTOM
    scale = min(width / size[0], width / size[1], room / size[1], room / size[2])
    height = max(scale * max(size[1], size[2]), LEAST - TOP - BOTTOM)
    return "".join(
        _view(title, _View(width, height, scale, middle, across, up), path, reference, spots)
        for title, across, up in VIEWS
    )


def _view(
    title: str, view: _View, path: Array, reference: Array | None, spots: Sequence[Spot]
) -> str:
    parts = [
        f'<figure><figcaption>{title}</figcaption><svg class="path" role="img" '
        f'viewBox="0 0 {WIDTH:g} {view.height + TOP + BOTTOM:.0f}" '
        f'aria-label="Way of the tool {title}, in metres">'
    ]
    parts += view.grid()
    if reference is not None:
        parts += view.line(reference, "reference")
    parts += view.line(path, "line")
    parts += view.ends(path[np.isfinite(path).all(axis=1)])
    parts += [view.mark(spot) for spot in spots]
    return "".join(parts) + "</svg></figure>"


@dataclass(frozen=True)
class _View:
    width: float
    height: float
    scale: float
    middle: Array
    across: int
    up: int

    def xy(self, points: Array) -> Array:
        """Return (N, 2) in the picture's units of points (N, 3) m."""
        x = (points[:, self.across] - self.middle[self.across]) * self.scale
        y = (points[:, self.up] - self.middle[self.up]) * self.scale
        found: Array = np.column_stack([x + LEFT + self.width / 2, TOP + self.height / 2 - y])
        return found

    def grid(self) -> list[str]:
        right, bottom = LEFT + self.width, TOP + self.height
        parts = [
            f'<rect class="frame" x="{LEFT:g}" y="{TOP:g}" width="{self.width:.1f}" '
            f'height="{self.height:.1f}" rx="4"/>'
        ]
        step = _step(min(self.width, self.height) / self.scale / 4)
        for axis, extent in ((self.across, self.width), (self.up, self.height)):
            half, centre = extent / self.scale / 2, float(self.middle[axis])
            first = math.ceil((centre - half) / step)
            for k in range(first, math.floor((centre + half) / step) + 1):
                point = self.middle.copy()
                point[axis] = k * step
                x, y = self.xy(point[None])[0]
                label = f"{k * step + 0.0:.3g}"
                if axis == self.across:
                    parts.append(
                        f'<line class="grid" x1="{x:.1f}" x2="{x:.1f}" y1="{TOP:g}" '
                        f'y2="{bottom:.1f}"/><text class="across" x="{x:.1f}" '
                        f'y="{bottom + 15:.1f}">{label}</text>'
                    )
                else:
                    parts.append(
                        f'<line class="grid" x1="{LEFT:g}" x2="{right:.1f}" '
                        f'y1="{y:.1f}" y2="{y:.1f}"/><text class="tick" '
                        f'x="{LEFT - 5:.1f}" y="{y + 4:.1f}">{label}</text>'
                    )
        names = "xyz"
        parts.append(
            f'<text class="tick" x="{right - 4:.1f}" y="{bottom - 6:.1f}">{names[self.across]} m'
            f'</text><text class="name" x="{LEFT + 6:.1f}" y="{TOP + 14:g}">'
            f"{names[self.up]} m</text>"
        )
        return parts

    def line(self, points: Array, kind: str) -> list[str]:
        points = points[:: max(-(-len(points) // MOST_POINTS), 1)]
        finite = np.isfinite(points).all(axis=1)
        edges = np.flatnonzero(np.diff(np.concatenate(([False], finite, [False])).astype(np.int8)))
        return [
            f'<polyline class="{kind}" points="'
            + " ".join(f"{x:.1f},{y:.1f}" for x, y in self.xy(points[begin:end]))
            + '"/>'
            for begin, end in edges.reshape(-1, 2)
        ]

    def ends(self, path: Array) -> list[str]:
        (x, y), (u, v) = self.xy(path[[0, -1]])
        return [
            f'<circle class="first" cx="{x:.1f}" cy="{y:.1f}" r="4.5"/>',
            f'<circle class="last" cx="{u:.1f}" cy="{v:.1f}" r="4.5"/>',
        ]

    def mark(self, spot: Spot) -> str:
        x, y = self.xy(np.array([spot.place]))[0]
        return (
            f'<g class="mark {spot.severity}"><circle cx="{x:.1f}" cy="{y:.1f}" r="8"/>'
            f'<text x="{x:.1f}" y="{y + 4:.1f}">{spot.number}</text></g>'
        )


def _step(rough: float) -> float:
    power = 10.0 ** math.floor(math.log10(rough))
    return next(f * power for f in (1, 2, 5, 10) if f * power >= rough * 0.999)
