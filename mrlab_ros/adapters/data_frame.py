"""Tables of pandas, which is no part of the lab."""

from __future__ import annotations

from importlib import import_module
from typing import Any

from mrlab_ros.adapters.diagnostics import PANDAS_MISSING
from mrlab_ros.core.base.errors import Misuse


def data_frame(rows: Any, times: Any, columns: Any = None) -> Any:
    """Return a pandas.DataFrame by `time`, s; raise Misuse where pandas is not installed.

    rows: (N, C), or a mapping of columns to values for each of the N times.
    """
    try:
        pandas = import_module("pandas")
    except ImportError as error:
        raise Misuse(PANDAS_MISSING(problem=str(error))) from None
    return pandas.DataFrame(rows, index=pandas.Index(times, name="time"), columns=columns)
