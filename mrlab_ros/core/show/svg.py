"""Plots as SVG: they are in the page from the start, print well and need no script."""

from __future__ import annotations

import math
from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from mrlab_ros.core.foreign_text import for_html as escape

Array = NDArray[np.floating]

WIDTH, HEIGHT = 640.0, 104.0  # of a strip, in its own units
LEFT, RIGHT = 52.0, 92.0  # for the axis and for the last value
TOP, BOTTOM = 8.0, 8.0
MOST_BLOCKS = 250  # about two units of width each
# From here on an axis of time shows minutes and hours, s; and what lies between its marks.
LONG = 100.0
HOUR = 3600
STEPS = (1, 2, 5, 10, 20, 30, 60, 120, 300, 600, 1200, 1800)

# What the forbidden ranges of all plots are filled with.
HATCH = (
    '<svg class="pattern" aria-hidden="true" width="0" height="0"><defs>'
    '<pattern id="hatch" width="7" height="7" patternUnits="userSpaceOnUse" '
    'patternTransform="rotate(45)"><rect class="hatch" width="2" height="7"/></pattern>'
    "</defs></svg>"
)


@dataclass(frozen=True)
class Mark:
    """A finding in a plot: its number, from 1, and the times that it covers, s."""

    number: int
    severity: str
    first: float
    last: float


@dataclass(frozen=True)
class Strip:
    """One signal over time. limits: lower and upper in the same unit, None where there is none.

    reference: what the values should be, at the same times; drawn dashed behind them.
    """

    name: str
    unit: str
    values: Array
    limits: tuple[float | None, float | None] = (None, None)
    colour: int = 1
    marks: tuple[Mark, ...] = ()
    reference: Array | None = None


def strip_svg(strip: Strip, times: Array, duration: float, begin: float = 0.0) -> str:
    """Return one strip: the line, the forbidden ranges hatched and labelled, the findings.

    times: (N,) s of strip.values, (N,). begin: the time at its left edge, s.
    """
    low, high = _span(strip)
    place = _Place(duration, low, high, begin=begin)
    parts = [
        f'<svg class="strip" viewBox="0 0 {WIDTH:g} {HEIGHT:g}" role="img" '
        f'data-left="{LEFT:g}" data-width="{WIDTH - LEFT - RIGHT:g}" '
        f'data-begin="{begin:.3f}" data-duration="{duration:.3f}" '
        f'aria-label="{escape(_words(strip))}">'
    ]
    parts += [_grid(value, place) for value in _ticks(low, high)]
    parts += _forbidden(strip, place)
    for mark in strip.marks:
        x, end = place.x(mark.first), place.x(mark.last)
        parts.append(
            f'<rect class="range {mark.severity}" x="{x - 1:.1f}" y="{TOP:g}" '
            f'width="{max(end - x, 0) + 2:.1f}" height="{HEIGHT - TOP - BOTTOM:g}"/>'
        )
    if strip.reference is not None:
        parts += [
            f'<polyline class="reference" points="{points}"/>'
            for points in _lines(strip.reference, times, place)
        ]
    finite = np.isfinite(strip.values)
    if finite.any():
        parts += [
            f'<polyline class="line joint-{strip.colour}" points="{points}"/>'
            for points in _lines(strip.values, times, place)
        ]
        last = strip.values[finite][-1]
        parts.append(
            f'<text class="value joint-{strip.colour}" x="{WIDTH - RIGHT + 8:g}" '
            f'y="{place.y(last) + 4:.1f}">{_number(last)} {escape(strip.unit)}</text>'
        )
    for mark in strip.marks:
        x = min(max(place.x(mark.first), LEFT + 9), WIDTH - RIGHT - 9)
        parts.append(
            f'<g class="mark {mark.severity}" data-finding="{mark.number}">'
            f'<circle cx="{x:.1f}" cy="{TOP + 9:g}" r="9"/>'
            f'<text x="{x:.1f}" y="{TOP + 13:g}">{mark.number}</text></g>'
        )
    return "".join(parts) + "</svg>"


def time_axis_svg(
    duration: float,
    width: float = WIDTH,
    begin: float = 0.0,
    margins: tuple[float, float] = (LEFT, RIGHT),
) -> str:
    """Return the axis of time that stands below strips of this width; begin: at its left, s.

    margins: what strips leave free at their left and right end.
    """
    left, right = margins

    def x(time: float) -> float:
        share = (time - begin) / duration if duration else 0.0
        return left + share * (width - left - right)

    most = max(int(width / 90), 3)
    end = begin + duration
    long = end >= LONG
    ticks = _moments(begin, end, most) if long else _ticks(begin, end, most)
    ticks = [t for t in ticks if begin <= t <= end]
    unit = " s" if not long else " min" if not ticks or ticks[-1] < HOUR else " h"
    parts = [f'<svg class="axis" viewBox="0 0 {width:g} 24" aria-hidden="true">']
    parts += [
        f'<text x="{x(t):.1f}" y="15">'
        f"{_clock(t, ticks[-1]) if long else _number(t)}{unit * (t == ticks[0])}</text>"
        for t in ticks
    ]
    return "".join(parts) + "</svg>"


def _moments(low: float, high: float, most: int) -> list[float]:
    """Return moments that a clock shows as round, s, `most` of them at most."""
    steps = (*STEPS, *(HOUR * n for n in (1, 2, 6, 12, 24, 24 * 7, 24 * 365)))
    step = next((s for s in steps if (high - low) / s <= most), steps[-1])
    return [n * step for n in range(math.ceil(low / step), math.floor(high / step + 1e-9) + 1)]


def _clock(seconds: float, last: float) -> str:
    """Return 2:05 of 125 s, and 0:02:05 where the last moment of the axis is beyond an hour."""
    whole = round(seconds)
    if last < HOUR:
        return f"{whole // 60}:{whole % 60:02d}"
    return f"{whole // HOUR}:{whole // 60 % 60:02d}:{whole % 60:02d}"


@dataclass(frozen=True)
class _Place:
    duration: float
    low: float
    high: float
    begin: float = 0.0

    def x(self, time: float) -> float:
        share = (time - self.begin) / self.duration if self.duration else 0.0
        return LEFT + share * (WIDTH - LEFT - RIGHT)

    def y(self, value: float) -> float:
        share = (value - self.low) / (self.high - self.low)
        return HEIGHT - BOTTOM - share * (HEIGHT - TOP - BOTTOM)


def _span(strip: Strip) -> tuple[float, float]:
    """Return the range of the axis: the values, and a limit that they come near or pass."""
    finite = strip.values[np.isfinite(strip.values)]
    if strip.reference is not None:
        finite = np.concatenate([finite, strip.reference[np.isfinite(strip.reference)]])
    low, high = (float(finite.min()), float(finite.max())) if len(finite) else (0.0, 0.0)
    near = 0.35 * (high - low) + 1e-9
    lower, upper = strip.limits
    shown = [low, high]
    shown += [v for v in (lower, upper) if v is not None and low - near <= v <= high + near]
    low, high = min(shown), max(shown)
    # What differs by rounding alone stands still.
    still = high - low < 1e-6 * max(abs(high), 1.0)
    room = max(abs(high) * 0.1, 0.5) if still else 0.08 * (high - low)
    return low - room, high + room


def _forbidden(strip: Strip, place: _Place) -> list[str]:
    parts = []
    for limit, above in zip(strip.limits, (False, True), strict=True):
        if limit is None or not place.low < limit < place.high:
            continue
        y = place.y(limit)
        top, height = (TOP, y - TOP) if above else (y, HEIGHT - BOTTOM - y)
        text = f"limit {_number(limit)} {strip.unit}"
        parts.append(
            f'<rect class="forbidden" x="{LEFT:g}" y="{top:.1f}" '
            f'width="{WIDTH - LEFT - RIGHT:g}" height="{max(height, 0):.1f}"/>'
            f'<line class="limit" x1="{LEFT:g}" x2="{WIDTH - RIGHT:g}" y1="{y:.1f}" y2="{y:.1f}"/>'
            f'<text class="limit" x="{LEFT + 6:g}" y="{y - 3 if above else y + 11:.1f}">'
            f"{escape(text)}</text>"
        )
    return parts


def _grid(value: float, place: _Place) -> str:
    y = place.y(value)
    return (
        f'<line class="grid" x1="{LEFT:g}" x2="{WIDTH - RIGHT:g}" y1="{y:.1f}" y2="{y:.1f}"/>'
        f'<text class="tick" x="{LEFT - 8:g}" y="{y + 4:.1f}">{_number(value)}</text>'
    )


def _lines(values: Array, times: Array, place: _Place) -> list[str]:
    """Return the points of straight lines, a new one after each gap; long series as envelope."""
    values, times = _envelope(values, times)
    finite = np.isfinite(values)
    edges = np.flatnonzero(np.diff(np.concatenate(([False], finite, [False])).astype(np.int8)))
    lines = []
    for begin, end in edges.reshape(-1, 2):
        since = times[begin:end] - place.begin
        x = LEFT + since / (place.duration or 1.0) * (WIDTH - LEFT - RIGHT)
        share = (values[begin:end] - place.low) / (place.high - place.low)
        y = HEIGHT - BOTTOM - share * (HEIGHT - TOP - BOTTOM)
        lines.append(" ".join(f"{a:.1f},{b:.1f}" for a, b in zip(x, y, strict=True)))
    return lines


def _envelope(values: Array, times: Array) -> tuple[Array, Array]:
    """Return all values, or of many the least and greatest of each block in their order."""
    if len(values) <= 2 * MOST_BLOCKS:
        return values, times
    unknown = np.isnan(values)
    low, high = np.where(unknown, np.inf, values), np.where(unknown, -np.inf, values)
    edges = np.linspace(0, len(values), MOST_BLOCKS + 1).astype(int).tolist()
    kept = [0, len(values) - 1]
    for begin, end in pairwise(edges):
        # of a block without a number the first twice: a gap
        kept.append(begin + int(low[begin:end].argmin()))
        kept.append(begin + int(high[begin:end].argmax()))
    chosen = np.unique(kept)
    return values[chosen], times[chosen]


def _ticks(low: float, high: float, most: int = 3) -> list[float]:
    """Return round numbers from `low` to `high`, about `most` of them."""
    if not high > low:
        return [low]
    rough = (high - low) / most
    power = 10.0 ** math.floor(math.log10(rough))
    step = next(f * power for f in (1, 2, 2.5, 5, 10) if f * power >= rough * 0.999)
    first = math.ceil(low / step)
    return [n * step for n in range(first, math.floor(high / step + 1e-9) + 1)]


def _number(value: float) -> str:
    """Return a number as a person reads it: four digits, and nothing below a ten-thousandth."""
    value = round(value, 4) + 0.0  # no -0
    return f"{value:.4g}" if abs(value) < 1000 else f"{value:,.0f}"


def _words(strip: Strip) -> str:
    finite = strip.values[np.isfinite(strip.values)]
    if not len(finite):
        return f"{strip.name}: no number"
    low, high = _number(float(finite.min())), _number(float(finite.max()))
    return f"{strip.name}, from {low} to {high} {strip.unit}"
