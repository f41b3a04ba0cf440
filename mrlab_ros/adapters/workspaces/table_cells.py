"""Cells of a text table: its characters, its separator, and what a cell can be."""

from __future__ import annotations

import csv
import re

from mrlab_ros.adapters.workspaces.diagnostics import CELLS_UNREADABLE, NO_TEXT
from mrlab_ros.adapters.workspaces.instants import is_instant
from mrlab_ros.adapters.workspaces.mat5 import NotATable

SEPARATORS = (";", "\t", ",")
DAY_AND_TIME = re.compile(r"(\d{4}-\d\d-\d\d|\d\d\.\d\d\.\d{4}) (?=\d\d?:\d\d)")


def decoded(data: bytes) -> str:
    """Return a table's text: UTF-8, UTF-16 with its mark, or Windows-1252 as Excel writes it."""
    if data.startswith((b"\xff\xfe", b"\xfe\xff")):
        try:
            return data.decode("utf-16")
        except UnicodeDecodeError as error:
            raise NotATable(NO_TEXT(byte=error.start, encoding="UTF-16")) from None
    try:
        return data.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        start = error.start
    if not any(b < 9 or 14 <= b < 32 for b in data[:65_536]):
        try:
            return data.decode("cp1252")
        except UnicodeDecodeError:
            pass
    raise NotATable(NO_TEXT(byte=start, encoding="UTF-8"))


def separator_of(lines: list[str], asked: str) -> str | None:
    """Return what separates the columns, None for blanks: what rows have in common."""
    filled = [line for line in lines[:1000] if line.strip()]
    decimal = set()
    for separator in filter(None, (asked, *SEPARATORS)):
        if filled and all(separator in line for line in filled[-min(20, len(filled) // 2 + 1) :]):
            cells = cells_of(filled[-1], separator)
            # blanks may separate numbers with decimal commas
            if separator != "," or 2 * sum(is_value(c, separator) for c in cells) > len(cells):
                return separator
            decimal.add(separator)
    first = filled[0] if filled else ""
    return next((s for s in (asked, *SEPARATORS) if s and s in first and s not in decimal), None)


def cells_of(line: str, separator: str | None) -> list[str]:
    """Return the cells of a row; separator: None: white space. Raises NotATable."""
    if separator is None:
        return DAY_AND_TIME.sub(r"\1T", line).split()
    try:
        row = next(csv.reader([line], delimiter=separator), [])
    except csv.Error as error:
        raise NotATable(CELLS_UNREADABLE(error=str(error))) from None
    return [cell.strip() for cell in row]


def is_value(cell: str, separator: str | None) -> bool:
    """Say whether a cell is a number, which may have a decimal comma, or an instant."""
    number = cell if separator == "," and "," not in cell else cell.replace(",", ".")
    return is_number(number) or is_instant(cell)


def is_number(text: str) -> bool:
    """Say whether a text is a number with a decimal point, nan and inf included."""
    try:
        float(text)
    except ValueError:
        return False
    return True
