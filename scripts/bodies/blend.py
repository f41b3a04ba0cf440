"""Blends the sections of a casting: what is between two of them, as the silhouettes tell it.

An outer wall that runs on from one section to the next one follows the silhouette there: both
sections are stretched to it before they are blended, so that a rim leaves no steps. Where the
silhouette has a shoulder, the blend changes over at that height instead. Inner walls know
of neither: they change evenly.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from raster import Raster, ends_at
from scipy.interpolate import PchipInterpolator
from scipy.ndimage import map_coordinates
from solids import Array

STEPS = 10  # between two sections, at which the silhouettes are asked
SPEAKS = 0.45  # of the width of a section, in which a shoulder at its side is as seen there
SHOULDER = 0.0025  # m, between the sides of two sections
JUMP, JUMP_SHARE = 0.004, 0.45  # m, of the way between two sections; a shoulder steps more


class Blend:
    """The signed distance between sections.

    heights: (K,) m, of the sections; stack: (K, U, V) m, their distances on the pixels of
    `raster`; extents: a function of heights (N,) that returns the least and largest u and v of the
    silhouettes there, (N, 4) m.
    """

    def __init__(self, raster: Raster, heights: Array, stack: Array, extents: Any) -> None:
        self.raster, self.heights, self.stack = raster, heights, stack
        count = len(heights)
        self.slope = PchipInterpolator(np.arange(count), stack, axis=0).derivative()(
            np.arange(count)
        )
        places, progress = [heights[0]], [np.zeros(4)]
        for k in range(count - 1):
            inner = heights[k] + np.arange(1, STEPS) / STEPS * (heights[k + 1] - heights[k])
            places += [*inner, heights[k + 1]]
            progress += [*(k + self._progress(k, extents(inner))), np.full(4, k + 1.0)]
        self.places, self.progress = np.array(places), np.array(progress)
        self.sides = np.array([self._sides(values) for values in stack])
        self.wanted, self.flows = self._flowing(extents(self.places))

    def _at(self, k: int, t: float) -> Array:
        a, b, m, n = self.stack[k], self.stack[k + 1], self.slope[k], self.slope[k + 1]
        return (
            (2 * t**3 - 3 * t**2 + 1) * a
            + (t**3 - 2 * t**2 + t) * m
            + (-2 * t**3 + 3 * t**2) * b
            + (t**3 - t**2) * n
        )

    def _sides(self, values: Array) -> Array:
        """Return the least and largest u and v of a section, m; nan where it is empty."""
        ends = [ends_at(self.raster.axes[axis], values.min(axis=1 - axis)) for axis in range(2)]
        return np.array(ends).ravel()

    def _flowing(self, wanted: Array) -> tuple[Array, Array]:
        """Return the extents held between those of the sections, and where they change evenly.

        The second: (sections - 1, 4), 1 where a side flows from one section to the next one, 0
        where it jumps at a shoulder or at a part that only the silhouette shows.
        """
        count = len(self.heights) - 1
        flows = np.zeros((count, 4))
        held = wanted.copy()
        for k in range(count):
            own = slice(k * STEPS, (k + 1) * STEPS + 1)
            two = self.sides[[k, k + 1]]
            held[own] = np.clip(wanted[own], two.min(axis=0), two.max(axis=0))
            steps = np.abs(np.diff(held[own], axis=0))
            even = steps.max(axis=0) < np.maximum(JUMP, JUMP_SHARE * np.abs(two[1] - two[0]))
            flows[k] = even & np.isfinite(steps).all(axis=0)
        return held, flows

    def _progress(self, k: int, wanted: Array) -> Array:
        """Return the share of section k + 1 at heights with the extents `wanted`, by side, (N, 4).

        It is even but at the sides, of the least and largest u and v, that tell of a shoulder.
        """
        even = np.arange(1, STEPS) / STEPS
        tries = np.linspace(0, 1, 21)
        found = np.array([self._sides(self._at(k, t)) for t in tries])
        result = np.repeat(even[:, None], 4, axis=1)
        for side in range(4):
            told = found[:, side], wanted[:, side]
            far = abs(found[-1, side] - found[0, side]) > SHOULDER
            if far and np.isfinite(np.concatenate(told)).all():
                result[:, side] = _course(*told, even, tries)
        return result

    def __call__(self, height: Array, flat: Array) -> Array:
        last = len(self.heights) - 2
        k = np.clip(np.searchsorted(self.heights, height, side="right") - 1, 0, last)
        even = np.clip((height - self.heights[k]) / (self.heights[k + 1] - self.heights[k]), 0, 1)
        shift, total = np.zeros(len(height)), np.full(len(height), 1e-9)
        two = [(np.zeros(flat.shape), np.full(flat.shape, 1e-9)) for _ in range(2)]
        for side in range(4):
            axis, sign = side // 2, 1 - 2 * (side % 2)
            seen = np.interp(height, self.places, self.wanted[:, side])
            width = np.abs(seen - np.interp(height, self.places, self.wanted[:, side + sign]))
            inwards = (flat[:, axis] - seen) * sign
            # A side speaks for the outer part of the section only.
            weight = np.nan_to_num(np.clip(1 - inwards / (width * SPEAKS), 0, 1))
            told = np.interp(height, self.places, self.progress[:, side]) - k
            shift += weight**2 * (told - even)
            total += weight**2
            for n, (moved, part) in enumerate(two):
                off = np.nan_to_num(self.sides[k + n, side] - seen) * self.flows[k, side]
                reach = np.maximum(width * SPEAKS, 2 * np.abs(off))
                weight = np.nan_to_num(np.clip(1 - inwards / reach, 0, 1))
                moved[:, axis] += weight * off
                part[:, axis] += weight
        below, above = (flat + moved / np.maximum(part, 1) for moved, part in two)
        t = even + shift / np.maximum(total, 1)
        apart = 1 - np.minimum(total, 1)
        a, m = self._read(below, k)
        b, n = self._read(above, k + 1)
        # Walls between the sides have no edge at a section.
        smooth = t + apart * (3 * t**2 - 2 * t**3 - t)
        bent = (t**3 - 2 * t**2 + t) * m + (t**3 - t**2) * n
        return np.asarray(a + smooth * (b - a) + apart * bent)

    def _read(self, flat: Array, k: Array) -> tuple[Array, Array]:
        """Return the distances and their slopes along the axis of sections k."""
        spot = [k, *((flat - self.raster.low) / self.raster.cell).T]
        a, m = (
            map_coordinates(values, spot, order=1, mode="nearest")
            for values in (self.stack, self.slope)
        )
        return a, m


def _course(found: Array, wanted: Array, even: Array, tries: Array) -> Array:
    """Return the cheapest of the courses through `tries` that never go back."""
    off = np.minimum(np.abs(found[None, :] - wanted[:, None]), 0.04)
    cost = off + 0.0015 * np.abs(tries[None] - even[:, None])
    best = np.empty_like(cost)
    best[0] = cost[0]
    origin = np.zeros(cost.shape, int)
    for n in range(1, len(cost)):
        running = np.minimum.accumulate(best[n - 1])
        place = np.maximum.accumulate(np.where(best[n - 1] <= running, np.arange(len(tries)), 0))
        best[n], origin[n] = running + cost[n], place
    course = [int(best[-1].argmin())]
    for n in range(len(cost) - 1, 0, -1):
        course.append(int(origin[n][course[-1]]))
    return np.asarray(tries[course[::-1]])
