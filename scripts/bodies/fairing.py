"""Fairs measured castings: what slices tore is closed, walls are made even, edges get a fillet.

The casting is sampled as a signed distance on a grid. There, offsets inwards and outwards by the
radius of the founder's fillet close slits and drop slivers thinner than it, whatever their shape,
and leave walls where they are. Halves that are alike within a few mm become equal.
"""

from __future__ import annotations

import numpy as np
from scipy.ndimage import distance_transform_edt, gaussian_filter, map_coordinates
from solids import Array, Solid

COARSE = 4  # cells of a first look, which finds where the surface is
REACH = 2.2  # coarse cells around the surface that are sampled finely
FILLET, FILLETS = 0.0065, (0.0015, 0.007)  # of the longest side; m, radii of edges
EVENED = 0.8  # cells, by which distances are blurred at the end
ALIKE, ALIKE_SHARE = (
    0.004,
    0.95,
)  # m, within which that share of a surface lies of its mirror image


def faired(solid: Solid, cell: float, most: float | None = None) -> Solid:
    """Return the solid with even fillets and without slits and slivers, on a grid of `cell`, m.

    most: of the fillets, m; None: as large as its size lets expect.
    """
    size = float((solid.high - solid.low).max())
    radius = min(float(np.clip(size * FILLET, *FILLETS)), most or FILLETS[1])
    margin = radius + 3 * cell
    low = solid.low - margin
    counts = np.ceil((solid.high - solid.low + 2 * margin) / cell).astype(int) + 1
    values = _outside(_sampled(solid, low, counts, cell), cell) - radius
    values = -_outside(-values, cell) + radius
    values = _outside(values, cell) - _outside(-values, cell)
    values = gaussian_filter(values, EVENED)

    def distance(p: Array) -> Array:
        return np.asarray(map_coordinates(values, ((p - low) / cell).T, order=1, mode="nearest"))

    return mirrored(Solid(distance, solid.low, solid.high), cell)


def mirrored(solid: Solid, cell: float) -> Solid:
    """Return the solid with equal halves about each plane of its frame about which it has nearly.

    Only where the surface and its mirror image lie within ALIKE of each other.
    """
    axes = [np.arange(a, b + cell, 2 * cell) for a, b in zip(solid.low, solid.high, strict=True)]
    grid = np.stack(np.meshgrid(*axes, indexing="ij"), axis=-1).reshape(-1, 3)
    shell = grid[np.abs(solid.distance(grid)) < cell]
    for axis in range(3):
        flip = np.ones(3)
        flip[axis] = -1
        off = np.abs(solid.distance(shell * flip) - solid.distance(shell))
        if len(shell) and (off < ALIKE).mean() > ALIKE_SHARE:
            solid = _halved(solid, flip)
    return solid


def _halved(solid: Solid, flip: Array) -> Solid:
    return Solid(
        lambda p: (solid.distance(p) + solid.distance(p * flip)) / 2, solid.low, solid.high
    )


def _sampled(solid: Solid, low: Array, counts: Array, cell: float) -> Array:
    """Return distances on a grid, coarse ones far from the surface."""
    few = counts // COARSE + 2
    axes = [low[i] + COARSE * cell * np.arange(few[i]) for i in range(3)]
    grid = np.stack(np.meshgrid(*axes, indexing="ij"), axis=-1).reshape(-1, 3)
    rough = solid.distance(grid).reshape(few)
    place = [np.arange(counts[i]) / COARSE for i in range(3)]
    values = rough
    for axis in range(3):
        first = np.minimum(place[axis].astype(int), few[axis] - 2)
        share = (place[axis] - first).reshape([-1 if i == axis else 1 for i in range(3)])
        values = (1 - share) * values.take(first, axis) + share * values.take(first + 1, axis)
    near = np.argwhere(np.abs(values) < REACH * COARSE * cell)
    values[tuple(near.T)] = solid.distance(low + near * cell)
    return np.asarray(values)


def _outside(values: Array, cell: float) -> Array:
    """Return the distance to the surface at which the values of a grid cross 0; 0 below."""
    slope = np.sqrt(sum(part * part for part in np.gradient(values, cell)))
    near = np.clip(values / np.maximum(slope, 0.3), -cell, cell)
    away, nearest = distance_transform_edt(values >= 0, sampling=cell, return_indices=True)
    return np.asarray(np.where(values >= 0, away + near[tuple(nearest)], 0.0))
