"""What every benchmark shares: options, a table with the machine's load, figures as JSON."""

from __future__ import annotations

import argparse
import json
import os
import platform
import tempfile
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any, TypeVar

import numpy as np
from rich.console import Console
from rich.table import Table

Case = TypeVar("Case")


def options(description: str) -> argparse.ArgumentParser:
    """Return the parser with the options that every benchmark has."""
    parser = argparse.ArgumentParser(description=description)
    size = parser.add_mutually_exclusive_group()
    size.add_argument("--quick", action="store_true", help="end within 60 s")
    size.add_argument(
        "--touch", action="store_true", help="see only that it runs: the least of all it measures"
    )
    parser.add_argument("--json", type=Path, metavar="FILE", help="also write the figures here")
    return parser


def scaled(given: argparse.Namespace, touch: Any, quick: Any, full: Any) -> Any:
    """Return the amount that the options ask for."""
    return touch if given.touch else quick if given.quick else full


def some(given: argparse.Namespace, cases: Sequence[Case]) -> Sequence[Case]:
    """Return the cases that the options ask for: all, or the first to see that it runs."""
    return cases[:1] if given.touch else cases


def whole_lab(
    description: str,
    title: str,
    run: Callable[[Path, float], list[dict[str, Any]]],
    quick: float,
    full: float,
) -> None:
    """Run a benchmark of a lab in a folder of its own, and show its rows.

    run: gets the folder, and `quick` or `full` as the options say, 0 to see that it runs.
    """
    # Here: most benchmarks need no ROS.
    import rclpy

    given = options(description).parse_args()
    os.environ.setdefault("ROS_AUTOMATIC_DISCOVERY_RANGE", "LOCALHOST")
    rclpy.init()
    with tempfile.TemporaryDirectory() as folder:
        rows = run(Path(folder), scaled(given, 0, quick, full))
    show(title, rows, given.json)
    rclpy.shutdown()


def percentiles(values: Sequence[float]) -> dict[str, float]:
    """Return p50, p99 and max."""
    p50, p99, high = np.percentile(values, [50, 99, 100])
    return {"p50": float(p50), "p99": float(p99), "max": float(high)}


def machine() -> str:
    """Describe the machine and how busy it is, for a figure cannot be read without."""
    load = ", ".join(f"{x:.2f}" for x in os.getloadavg())
    return (
        f"{os.cpu_count()} cores, {platform.machine()}, Python {platform.python_version()}, "
        f"load average {load}"
    )


def show(title: str, rows: list[dict[str, Any]], file: Path | None) -> None:
    """Print `rows` (all with the same keys) as a table; write them to `file` as JSON."""
    table = Table(title=title, caption=machine(), title_justify="left", caption_justify="left")
    for key in rows[0]:
        table.add_column(key, justify="left" if isinstance(rows[0][key], str) else "right")
    for row in rows:
        table.add_row(*(f"{v:.3g}" if isinstance(v, float) else str(v) for v in row.values()))
    Console(width=None if os.isatty(1) else 120).print(table)
    if file is not None:
        known = json.loads(file.read_text()) if file.exists() else {}
        known[title] = {"machine": machine(), "rows": rows}
        file.write_text(json.dumps(known, indent=1))
