"""How figures are shown: a table a question, beside those of an earlier run, and kept as JSON."""

from __future__ import annotations

import os
import platform
from collections.abc import Sequence
from typing import Any

import numpy as np
from rich.console import Console
from rich.table import Table

Rows = Sequence[dict[str, Any]]
# Columns of a terminal that is none: the widest table fits.
WIDTH = 170


def percentiles(values_ms: Sequence[float], prefix: str = "") -> dict[str, float]:
    """Return p50, p99 and max in ms; NaN where there are no values."""
    found = np.percentile(values_ms, [50, 99, 100]) if len(values_ms) else [np.nan] * 3
    names = (f"{prefix}{name} ms" for name in ("p50", "p99", "max"))
    return dict(zip(names, map(float, found), strict=True))


def machine() -> str:
    """Describe the machine and how busy it is: no figure can be read without."""
    load = ", ".join(f"{x:.2f}" for x in os.getloadavg())
    return (
        f"{os.cpu_count()} cores, {platform.machine()}, Python {platform.python_version()}, "
        f"load average {load}"
    )


def show(title: str, rows: Rows, earlier: Rows = ()) -> None:
    """Print rows, all with the same keys; an earlier run's figures follow in brackets."""
    table = Table(title=title, caption=machine(), title_justify="left", caption_justify="left")
    for key, value in rows[0].items():
        table.add_column(key, justify="left" if isinstance(value, str) else "right")
    beside = earlier if len(earlier) == len(rows) else [{}] * len(rows)
    for row, before in zip(rows, beside, strict=True):
        table.add_row(*(_cell(value, before.get(key)) for key, value in row.items()))
    Console(width=None if os.isatty(1) else WIDTH).print(table)


def _cell(value: Any, before: Any) -> str:
    text = f"{value:.3g}" if isinstance(value, float) else str(value)
    shown = isinstance(before, float) and before != value
    return f"{text} ({before:.3g})" if shown else text
