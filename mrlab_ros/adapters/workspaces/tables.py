"""Reads CSV and NumPy npz files into the same variables as a workspace."""

from __future__ import annotations

import csv
import io
import zipfile
from typing import Any

import numpy as np

from mrlab_ros.adapters.workspaces.mat5 import INTEGERS, Damaged, Sink, TooLarge, is_vector
from mrlab_ros.adapters.workspaces.view import View


def _add(sink: Sink, name: str, values: Any, columns: tuple[str, ...] = ()) -> None:
    kinds = {"f8": "double", "f4": "single"}
    kind = kinds.get(values.dtype.str[1:], values.dtype.name)
    if values.dtype.kind == "c":
        sink.add(name, "double", values.shape, note="complex")
        return
    shape = values.shape if values.ndim >= 2 else (values.size, 1)
    kept = kind in ("double", "single") or (kind in INTEGERS and is_vector(shape))
    data = np.asfortranarray(values).tobytes(order="F") if kept else None
    sink.add(name, kind, shape, data, values.dtype.str, columns=columns)


def read_csv(data: memoryview, sink: Sink) -> None:
    """Hand the table to the sink as the matrix `q` with its headings, a time column as `t`.

    The first row may be headings; the separator is a comma, semicolon, tab or blanks. Raises
    Damaged with the line that is not numbers.
    """
    try:
        text = bytes(data).decode("utf-8-sig")
    except UnicodeDecodeError as error:
        raise Damaged(f"byte {error.start} is not UTF-8 text") from None
    text = text.replace("\r\n", "\n").replace("\r", "\n")
    first, _, rest = text.partition("\n")
    separator = next((s for s in (";", "\t", ",") if s in first), None)
    try:
        row = next(csv.reader([first], delimiter=separator)) if separator else first.split()
    except csv.Error as error:
        raise Damaged(f"its first row cannot be read ({error})") from None
    cells = [cell.strip() for cell in row]
    decimal_commas = separator not in (",", None)
    headed = not all(_is_number(c.replace(",", ".") if decimal_commas else c) for c in cells)
    body = rest if headed else text
    if not body.strip():
        raise Damaged("it holds no row of numbers")
    table = _numbers(body, separator, 2 if headed else 1)
    headings = cells if headed else []
    time = [i for i, h in enumerate(headings) if h.lower() in ("t", "time", "time_from_start")]
    if len(headings) != table.shape[1]:
        headings = []
    elif len(time) == 1:
        _add(sink, "t", table[:, time])
        table = np.delete(table, time, axis=1)
        del headings[time[0]]
    _add(sink, "q", table, tuple(headings))


def _numbers(body: str, separator: str | None, first_line: int) -> Any:
    """Return the rows of a table; decimals may be commas where the separator is none.

    first_line: the line of the file that `body` begins at. Raises Damaged with the first line
    that does not fit.
    """
    if separator != "," and "," in body:
        body = body.replace(",", ".")
    try:
        return np.loadtxt(io.StringIO(body), delimiter=separator, ndmin=2, dtype=np.float64)
    except ValueError:
        pass
    width = None
    for number, line in enumerate(body.split("\n"), first_line):
        cells = [c.strip() for c in (line.split(separator) if separator else line.split())]
        if not any(cells):
            continue
        width = width or len(cells)
        wrong = next((c for c in cells if not _is_number(c)), None)
        if wrong is not None:
            raise Damaged(f"line {number} has '{wrong[:40]}' where a number is expected")
        if len(cells) != width:
            raise Damaged(f"line {number} has {len(cells)} values and the first {width}")
    raise Damaged("it holds no table of numbers")


def _is_number(text: str) -> bool:
    try:
        float(text)
    except ValueError:
        return False
    return True


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
