"""An array with its rate as a file that the converter reads: Python's own door to it."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from numpy.typing import ArrayLike

from mrlab_ros.adapters.diagnostics import ARRAY_RATE, ARRAY_SHAPE
from mrlab_ros.core.base.errors import BadInput


def write(folder: Path, q: ArrayLike, fs: ArrayLike | None, name: str = "array") -> Path:
    """Write `name`.npz with all bits of the numbers; return its path.

    q: (N, J) or (N, J + 1) rad, m where prismatic; a row a frame, the gripper last. fs: Hz, or
    (N,) s, the time of each row; None: not known. Raises BadInput where q is no matrix of reals,
    or fs no rate.
    """
    rows = np.asarray(q)
    if rows.ndim != 2 or rows.dtype.kind not in "fiu":
        raise BadInput(ARRAY_SHAPE(shape=list(rows.shape), kind=str(rows.dtype)))
    times = None if fs is None else np.asarray(fs)
    if times is not None:
        real = times.dtype.kind in "fiu" and times.ndim < 2 and bool(np.isfinite(times).all())
        one = times.size == 1
        if not real or (one and float(times.item()) <= 0) or not (one or times.size == len(rows)):
            raise BadInput(ARRAY_RATE(found=repr(fs)[:60], rows=len(rows)))
    path = folder / f"{name}.npz"
    values = rows.astype(np.float64)
    if times is None:
        np.savez(path, q=values)
    elif times.size == 1:
        np.savez(path, q=values, fs=times.astype(np.float64).reshape(()))
    else:
        np.savez(path, q=values, t=times.astype(np.float64))
    return path
