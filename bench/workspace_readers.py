"""Processor time to read a v7 matrix, N x 7: our reader, scipy's, and the second reading.

Our reader verifies the checksum of the compressed variable; "adler ms" is that part alone. "second
ms" reads the matrix again with scipy and compares every bit.
"""

from __future__ import annotations

import io
import time
import zlib
from collections.abc import Callable
from typing import Any

import numpy as np
import report
import scipy.io

from mrlab_ros.adapters.workspaces.matlab import mat5, second_reader
from mrlab_ros.adapters.workspaces.sinks import Found


class Last:
    """A sink that keeps the last matrix."""

    def add(self, found: Found) -> None:
        if found.data is not None:
            self.values = np.frombuffer(found.data, found.dtype).reshape(found.shape, order="F")


def milliseconds(work: Callable[[], Any], repeats: int) -> float:
    """Return the least processor time of `repeats` runs, ms."""
    least = np.inf
    for _ in range(repeats):
        begin = time.process_time()
        work()
        least = min(least, time.process_time() - begin)
    return round(float(least) * 1e3, 2)


def measure(rows: int, repeats: int) -> dict[str, Any]:
    seconds = np.arange(rows) / 100
    arm = 0.3 * np.sin(seconds[:, None] * np.linspace(0.2, 0.7, 6)) + 0.1
    matrix = np.column_stack([arm, (seconds % 20) > 10])
    file = io.BytesIO()
    scipy.io.savemat(file, {"q": matrix}, do_compression=True)
    data, numbers, sink = memoryview(file.getvalue()), matrix.tobytes(), Last()
    ours = milliseconds(lambda: mat5.Mat5Reader(sink, 1 << 30).read(data), repeats)
    return {
        "rows": rows,
        "MB": round(len(data) / 1e6, 1),
        "ours ms": ours,
        "adler ms": milliseconds(lambda: zlib.adler32(numbers), repeats),
        "scipy ms": milliseconds(lambda: scipy.io.loadmat(io.BytesIO(data)), repeats),
        "second ms": milliseconds(
            lambda: second_reader.disagreement(data, "q", sink.values), repeats
        ),
    }


def main() -> None:
    options = report.options(__doc__).parse_args()
    repeats = report.scaled(options, 1, 1, 3)
    sizes = report.some(options, (1_000, 10_000, 100_000, 1_000_000))
    rows = [measure(count, repeats) for count in sizes]
    report.show("Reading a v7 workspace, N x 7", rows, options.json)


if __name__ == "__main__":
    main()
