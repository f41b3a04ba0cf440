"""An array with its rate as a file that the converter reads: Python's own door to it."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from numpy.typing import ArrayLike

from mrlab_ros.adapters.diagnostics import ARRAY_SHAPE
from mrlab_ros.core.base.errors import BadInput


def write(folder: Path, q: ArrayLike, fs: ArrayLike | None, name: str = "array") -> Path:
    """Write `name`.npz with all bits of the numbers; return its path.

    q: (N, J) or (N, J + 1) rad, m where prismatic; a row a frame, the gripper last. fs: Hz, or
    (N,) s, the time of each row; None: not known. Raises BadInput where q is no matrix of reals.
    """
    rows = np.asarray(q)
    if rows.ndim != 2 or rows.dtype.kind not in "fiu":
        raise BadInput(ARRAY_SHAPE(shape=list(rows.shape), kind=str(rows.dtype)))
    path = folder / f"{name}.npz"
    values = rows.astype(np.float64)
    if fs is None:
        np.savez(path, q=values)
    elif np.ndim(fs) == 0:
        np.savez(path, q=values, fs=np.asarray(fs, np.float64))
    else:
        np.savez(path, q=values, t=np.asarray(fs, np.float64))
    return path
