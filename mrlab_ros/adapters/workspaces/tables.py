"""Reads CSV and NumPy npz files into the same variables as a workspace."""

from __future__ import annotations

import csv
import io
import re
import zipfile
from typing import Any

import numpy as np

from mrlab_ros.adapters.workspaces.mat5 import INTEGERS, Damaged, Sink, TooLarge, is_vector
from mrlab_ros.adapters.workspaces.view import View

KNOWN_UNITS = {"", "-", "rad", "deg", "grad", "°", "degree", "degrees", "radian", "radians"}
KNOWN_UNITS |= {"s", "sec", "ms", "us", "bool"}
SEPARATOR = re.compile(r"[\"']?sep=(.)[\"']?", re.I)


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
    text = _text(bytes(data)).replace("\r\n", "\n").replace("\r", "\n")
    skipped = 0
    asked = ""
    while (line := text.partition("\n")[0].strip()) and (
        (line.startswith(("#", "%")) and not _is_as_wide(line, text)) or SEPARATOR.fullmatch(line)
    ):
        if match := SEPARATOR.fullmatch(line):
            asked = match[1]
        text = text.partition("\n")[2]
        skipped += 1
    first, _, rest = text.partition("\n")
    separator = next((s for s in (asked, ";", "\t", ",") if s and s in first), None)
    if separator and _all_end_with(text, separator):
        text = "\n".join(line.rstrip().removesuffix(separator) for line in text.split("\n"))
        first, _, rest = text.partition("\n")
    try:
        row = next(csv.reader([first], delimiter=separator)) if separator else first.split()
    except csv.Error as error:
        raise Damaged(f"its first row cannot be read ({error})") from None
    cells = [cell.strip() for cell in row]
    decimal_commas = separator not in (",", None)
    headed = not all(_is_number(c.replace(",", ".") if decimal_commas else c) for c in cells)
    body = rest if headed else text
    second = rest.partition("\n")[0]
    given = [c.strip() for c in (second.split(separator) if separator else second.split())]
    if headed and len(given) == len(cells) and _are_units(given):
        other = next((u for u in given if u.strip("[]() ").lower() not in KNOWN_UNITS), None)
        if other is not None:
            raise Damaged(f"its row of units has '{other}', which is no unit of joint positions")
        # as if each unit stood in its heading, which the headings' own rules then read
        cells = [
            h if u in ("", "-") else _with_unit(h, u) for h, u in zip(cells, given, strict=True)
        ]
        body = rest.partition("\n")[2]
        skipped += 1
    if not body.strip():
        raise Damaged("it holds no row of numbers")
    table = _numbers(body, separator, skipped + (2 if headed else 1))
    headings = cells if headed else []
    time = [i for i, h in enumerate(headings) if h.lower() in ("t", "time", "time_from_start")]
    if len(headings) != table.shape[1]:
        headings = []
    elif len(time) == 1:
        _add(sink, "t", table[:, time])
        table = np.delete(table, time, axis=1)
        del headings[time[0]]
    _add(sink, "q", table, tuple(headings))


def _text(data: bytes) -> str:
    """Return a table's text: UTF-8, UTF-16 with its mark, or Windows-1252 as Excel writes it."""
    if data.startswith((b"\xff\xfe", b"\xfe\xff")):
        try:
            return data.decode("utf-16")
        except UnicodeDecodeError as error:
            raise Damaged(f"byte {error.start} is not UTF-16 text") from None
    try:
        return data.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        start = error.start
    if not any(b < 9 or 14 <= b < 32 for b in data[:65_536]):
        try:
            return data.decode("cp1252")
        except UnicodeDecodeError:
            pass
    raise Damaged(f"byte {start} is not UTF-8 text")


def _is_as_wide(line: str, text: str) -> bool:
    """Say whether a line with a mark of comments is the headings, as rostopic writes them."""
    last = text.rstrip().rpartition("\n")[2]
    return any(s in line and line.count(s) == last.count(s) for s in (";", "\t", ","))


def _all_end_with(text: str, separator: str) -> bool:
    lines = [stripped for line in text.split("\n") if (stripped := line.rstrip(" "))]
    return len(lines) > 1 and all(line.endswith(separator) for line in lines)


def _are_units(cells: list[str]) -> bool:
    """Say whether a row under the headings holds units: short words, and no number."""
    return (
        any(cells)
        and all(len(c) <= 12 for c in cells)
        and not any(_is_number(c.replace(",", ".")) for c in cells)
    )


def _with_unit(heading: str, unit: str) -> str:
    bare = unit.strip("[]() ")
    is_time = heading.lower() in ("t", "time", "time_from_start")
    return heading if is_time and bare == "s" else f"{heading} [{bare}]"


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
