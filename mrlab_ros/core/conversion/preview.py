"""Some rows of a matrix, for a picture of it."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from mrlab_ros.core.conversion.workspace import Variable

MOST_ROWS, MOST_COLUMNS = 400, 32


@dataclass(frozen=True, eq=False)
class Preview:
    """Some rows of the matrix `variable`, at most MOST_ROWS.

    rows: (K,) which rows, from 1, rising. values: (K, C) in the matrix's own unit, C at most
    MOST_COLUMNS, NaN where not finite.
    """

    variable: str
    rows: NDArray[np.uint32]
    values: NDArray[np.float32]


def preview(variable: Variable, marked: Iterable[int] = ()) -> Preview:
    """Return evenly chosen rows of a variable that has values.

    The first and the last row are among them, and the rows `marked`, from 1, that it has.
    """
    values = variable.values
    assert values is not None
    count = len(values)
    wanted = [row for row in dict.fromkeys(marked) if 1 <= row <= count][: MOST_ROWS // 2]
    even = np.linspace(1, count, min(count, MOST_ROWS - len(wanted))).astype(np.uint32)
    rows = np.union1d(even, np.array(wanted, np.uint32))
    with np.errstate(over="ignore"):
        part = values[rows - 1, :MOST_COLUMNS].astype(np.float32)
    part[~np.isfinite(part)] = np.nan
    return Preview(variable.path, rows, part)
