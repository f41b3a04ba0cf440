"""Reads CSV and NumPy npz files into the same variables as a workspace."""

from __future__ import annotations

import io
import zipfile
from typing import Any

import numpy as np

from mrlab_ros.adapters.workspaces import table_text
from mrlab_ros.adapters.workspaces.mat5 import INTEGERS, Damaged, TooLarge, is_vector
from mrlab_ros.adapters.workspaces.sink import Found, Sink
from mrlab_ros.adapters.workspaces.view import View

TIME_HEADINGS = ("t", "time", "time_from_start")


def _add(sink: Sink, name: str, values: Any, columns: tuple[str, ...] = ()) -> None:
    kinds = {"f8": "double", "f4": "single"}
    kind = kinds.get(values.dtype.str[1:], values.dtype.name)
    if values.dtype.kind == "c":
        sink.add(Found(name, "double", values.shape, note="complex"))
        return
    if values.dtype.kind == "b":
        values, kind = values.astype(np.uint8), "logical"
    shape = values.shape if values.ndim >= 2 else (values.size, 1)
    kept = kind in ("double", "single") or (
        kind in (*INTEGERS, "logical")
        and is_vector(shape)
        and values.size > 1 - (kind != "logical")
    )
    data = np.asfortranarray(values).tobytes(order="F") if kept else None
    sink.add(Found(name, kind, shape, data, values.dtype.str, columns=columns))


def read_csv(data: memoryview, sink: Sink) -> None:
    """Hand the table to the sink as the matrix `q` with its headings, a time column as `t`.

    Numbers that lines above the table name, such as a sample rate, are scalars of those names.
    Raises NotATable with the line that is not numbers.
    """
    table = table_text.parsed(bytes(data))
    for name, number in table.stated.items():
        _add(sink, name, np.array([number]))
    values, headings = table.values, list(table.headings)
    time = table.instants
    if time is None and len(headings) == values.shape[1]:
        named = [i for i, h in enumerate(headings) if h.lower() in TIME_HEADINGS]
        time = named[0] if len(named) == 1 else None
    if time is not None:
        _add(sink, "t", values[:, [time]])
        values = np.delete(values, time, axis=1)
        headings = headings[:time] + headings[time + 1 :]
    _add(sink, "q", values, tuple(headings) if len(headings) == values.shape[1] else ())


def read_npz(data: memoryview, sink: Sink, limit: int) -> None:
    """Hand every array of an npz file to the sink; nothing pickled is opened."""
    try:
        with zipfile.ZipFile(io.BufferedReader(View(data))) as archive:
            for entry in archive.infolist():
                if entry.file_size > limit:
                    raise TooLarge(
                        f"'{entry.filename}' inflates to {entry.file_size / 2**20:.0f} MiB"
                    )
                with archive.open(entry) as file:
                    values = np.lib.format.read_array(file, allow_pickle=False)
                _add(sink, entry.filename.removesuffix(".npy"), values)
    except (TooLarge, MemoryError):
        raise
    except Exception as error:
        # damage, encryption and foreign kinds of compression each raise another error
        raise Damaged(f"the npz archive cannot be read ({error})") from error
