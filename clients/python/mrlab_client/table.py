"""Tables of pandas, which this package does not need."""

from __future__ import annotations

from importlib import import_module
from typing import Any

from mrlab_client.errors import LabError


def data_frame(rows: Any, times: Any, columns: Any = None) -> Any:
    """Return a pandas.DataFrame by `time`, s; raise LabError where pandas is not installed."""
    try:
        pandas = import_module("pandas")
    except ImportError as error:
        raise LabError(
            f"A table needs pandas, which cannot be imported: {error}. "
            "Install it: python -m pip install pandas.",
            "pandas_missing",
        ) from None
    return pandas.DataFrame(rows, index=pandas.Index(times, name="time"), columns=columns)
