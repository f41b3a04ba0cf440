"""How figures are shown: a table a question, beside those of an earlier run, and kept as JSON.

All tables are on one page, too, with what got worse at its top.
"""

from __future__ import annotations

import io
import os
import platform
import re
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np
from rich.console import Console
from rich.table import Table

Rows = Sequence[dict[str, Any]]
# Columns of a terminal that is none: the widest table fits.
WIDTH = 170
# A figure that got worse by more than this share is marked.
WORSE = 0.15
# Ends of columns' names: of what is better where it is smaller, and where it is larger.
SMALLER = re.compile(r"(^| )(ms|s|us|MB|MiB|%|cores|lost|[a-zµ]+/(message|frame|step|min).*)$")
LARGER = re.compile(r"(messages|received|frames|poses|calls)/s$|real time")


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


class Page:
    """Tables on the terminal, and all of them on one page.

    worse: a line for each figure that got worse by more than WORSE.
    """

    def __init__(self) -> None:
        self._tables: list[Table] = []
        self.worse: list[str] = []

    def show(self, title: str, rows: Rows, earlier: Rows = (), machine_then: str = "") -> None:
        """Print rows, all with the same keys; an earlier run's figures follow in brackets."""
        caption = machine() + (f"\nin brackets: {machine_then}" if machine_then else "")
        table = Table(title=title, caption=caption, title_justify="left", caption_justify="left")
        for key, value in rows[0].items():
            table.add_column(key, justify="left" if isinstance(value, str) else "right")
        beside = earlier if len(earlier) == len(rows) else [{}] * len(rows)
        for row, before in zip(rows, beside, strict=True):
            table.add_row(*(_cell(key, value, before.get(key)) for key, value in row.items()))
            name = ", ".join(value for value in row.values() if isinstance(value, str))
            self.worse += [
                f"{title}: {name}: {key} {_cell(key, value, before[key])}"
                for key, value in row.items()
                if got_worse(key, value, before.get(key))
            ]
        self._tables.append(table)
        Console(width=None if os.isatty(1) else WIDTH).print(table)

    def write(self, path: Path) -> None:
        """Write the page: HTML without a script."""
        console = Console(record=True, width=WIDTH, file=io.StringIO())
        for line in self.worse or [
            "No figure got worse by more than 15 % against those in brackets."
        ]:
            console.print(line)
        for table in self._tables:
            console.print(table)
        path.parent.mkdir(parents=True, exist_ok=True)
        console.save_html(str(path))


def got_worse(key: str, value: Any, before: Any) -> bool:
    """Return whether a figure is worse than the earlier one by more than WORSE."""
    if not (isinstance(value, int | float) and isinstance(before, int | float)):
        return False
    if SMALLER.search(key):
        return value > before * (1 + WORSE)
    return bool(LARGER.search(key)) and value < before * (1 - WORSE)


def _cell(key: str, value: Any, before: Any) -> str:
    text = f"{value:.3g}" if isinstance(value, float) else str(value)
    if not isinstance(before, int | float) or before == value:
        return text
    shown = f"{text} ({before:.3g})"
    return f"[bold red]{shown} worse[/]" if got_worse(key, value, before) else shown
