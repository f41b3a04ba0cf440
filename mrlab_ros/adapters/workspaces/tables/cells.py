"""Cells of a text table: its characters, its separator, and what a cell can be.

Dates and times of day as text, in seconds since the first of them.
"""

from __future__ import annotations

import csv
import re
from collections.abc import Sequence
from datetime import datetime

from mrlab_ros.adapters.workspaces.diagnostics import CELLS_UNREADABLE, NO_TEXT
from mrlab_ros.adapters.workspaces.matlab.elements import NotATable

CLOCK = r"(?P<hour>\d{1,2}):(?P<minute>\d\d):(?P<second>\d\d)(?:[.,](?P<fraction>\d{1,9}))?"
HALF = r"\s*(?P<half>[AaPp])\.?[Mm]\.?"
ZONE = r"(?:\s*(?:Z|UTC|[+-]\d\d:?\d\d))?"
DATES = (
    r"(?P<year>\d{4})[-/](?P<month>\d\d?)[-/](?P<day>\d\d?)",  # ISO 8601
    r"(?P<day>\d\d?)\.(?P<month>\d\d?)\.(?P<year>\d{4})",  # German
    r"(?P<day>\d\d?)[-/](?P<month>\d\d?)[-/](?P<year>\d{4})",
    r"(?P<day>\d\d?)-(?P<name>[A-Za-z]{3})-(?P<year>\d{4})",  # datetime of MATLAB
)
# who writes a clock of 12 hours writes the month before the day
AMERICAN = rf"(?P<month>\d\d?)/(?P<day>\d\d?)/(?P<year>\d{{4}})[T ]\s*{CLOCK}{HALF}{ZONE}$"
PATTERNS = (
    re.compile(AMERICAN),
    *(re.compile(f"(?:{date}[T ]\\s*)?{CLOCK}(?:{HALF})?{ZONE}$") for date in DATES),
)
DAYS = tuple(re.compile(f"{date}$") for date in DATES)
MONTHS = ("jan", "feb", "mar", "apr", "may", "jun", "jul", "aug", "sep", "oct", "nov", "dec")
DAY = 86_400.0


def is_instant(text: str) -> bool:
    """Say whether a text is a time of day, with or without a date before it."""
    return ":" in text and any(p.match(text) for p in PATTERNS)


def is_day(text: str) -> bool:
    """Say whether a text is a date alone."""
    return any(day.match(text) for day in DAYS)


def seconds(texts: Sequence[str]) -> list[float | None]:
    """Return the time of each text since the first, s; None where one is no instant.

    Times of day without a date pass midnight where they fall by more than half a day.
    """
    pattern = next((p for p in PATTERNS if texts and p.match(texts[0])), None)
    found: list[float | None] = []
    start: float | None = None
    first_day = 0
    passed, before = 0.0, 0.0
    for text in texts:
        match = pattern.match(text) if pattern else None
        if match is None:
            found.append(None)
            continue
        given = match.groupdict()
        now = _hour(given) * 3600.0 + int(given["minute"]) * 60 + int(given["second"])
        now += float(f"0.{given['fraction'] or 0}")
        days = _days(given)
        if days is None:
            passed += DAY if now + passed < before - DAY / 2 else 0.0
            now += passed
        else:
            first_day = days if start is None else first_day
            now += (days - first_day) * DAY
        start = now if start is None else start
        before = now
        found.append(round(now - start, 9))
    return found


def _hour(given: dict[str, str | None]) -> int:
    """Return the hour of a day; of a clock of 12 hours 12 is the first of its half."""
    hour, half = int(str(given["hour"])), given["half"]
    return hour if half is None else hour % 12 + (12 if half in "Pp" else 0)


def _days(given: dict[str, str | None]) -> int | None:
    """Return the days since the year 1 of a date, or None where the text has none."""
    year, day = given.get("year"), given.get("day")
    if year is None or day is None:
        return None
    month = given.get("month")
    number = int(month) if month else MONTHS.index(str(given["name"]).lower()) + 1
    if number > 12:  # the month before the day, as in the United States
        number, day = int(day), str(number)
    return datetime(int(year), number, int(day)).toordinal()


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


EXPONENT = re.compile(r"(?<![\w.])([-+]?(?:\d+[.,]?\d*|[.,]\d+))[dD]([-+]?\d+)(?![\w.])")


def with_exponents(text: str) -> str:
    """Return a text whose numbers have E for the exponent where Fortran writes D."""
    return EXPONENT.sub(r"\1e\2", text)


def is_number(text: str) -> bool:
    """Say whether a text is a number with a decimal point, nan and inf included."""
    try:
        float(text)
    except ValueError:
        return False
    return True
