"""Text tables as spreadsheets, loggers and LabVIEW write them: headings, units, dates, numbers.

What stands above a text table: comments, titles, the header of LabVIEW, and their numbers.
"""

from __future__ import annotations

import csv
import re
from collections import Counter
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mrlab_ros.adapters.workspaces.diagnostics import (
    CELLS_UNREADABLE,
    COMMAS_TWICE,
    EMPTY_CELLS,
    HEADINGS_AGAIN,
    LABVIEW_SEGMENTS,
    LINES_DIFFER,
    NO_NUMBERS,
    TWO_DATES,
    UNITS_UNKNOWN,
    WRONG_CELL,
)
from mrlab_ros.adapters.workspaces.matlab.elements import NotATable
from mrlab_ros.adapters.workspaces.tables.cells import (
    SEPARATORS,
    cells_of,
    decoded,
    is_day,
    is_instant,
    is_number,
    is_value,
    seconds,
    separator_of,
    with_exponents,
)
from mrlab_ros.core.conversion.evidence.units import foreign as against

SEPARATOR = re.compile(r"[\"']?sep=(.)[\"']?", re.I)
END_OF_HEADER = "***End_of_Header***"  # of LabVIEW's measurement files
STATED = re.compile(
    r"\s*(?P<name>[A-Za-z][\w .-]{0,40}?)\s*(\[[^\]]*\]|\([^)]*\))?\s*[:=;,\t]\s*"
    r"(?P<number>[-+]?\d+(?:[.,]\d+)?(?:[eE][-+]?\d+)?)\s*[A-Za-z]{0,3}[;,\t\s]*$"
)
NAMED = re.compile(r"\s*[^\W\d][\w .-]*[:=]\s*[^\W\d°][^;,\t]*$")  # unit: deg
MOST_ABOVE = 200  # lines above a table


def labview(lines: list[str], stated: dict[str, float]) -> tuple[int, str, list[str]]:
    """Return where the table of a LabVIEW file begins, its separator, and its units; else 0."""
    if not lines[0].startswith("LabVIEW Measurement"):
        return 0, "", []
    ends = [i for i, line in enumerate(lines) if line.startswith(END_OF_HEADER)]
    if len(ends) != 2:
        raise NotATable(LABVIEW_SEGMENTS(count=len(ends)))
    units: list[str] = []
    separator = "\t"
    for line in lines[: ends[1]]:
        key, *given = line.rstrip().split("\t" if "\t" in line else ",")
        if key == "Separator":
            separator = "," if given[:1] == ["Comma"] else "\t"
        elif key == "Y_Unit_Label":
            units = given
        elif key == "Delta_X" and given and is_number(given[0].replace(",", ".")):
            stated["dt"] = float(given[0].replace(",", "."))
    return ends[1] + 1, separator, units


def marked(lines: list[str], stated: dict[str, float], comments: list[str]) -> tuple[int, str]:
    """Return how many lines are comments or name the separator, and that separator.

    The comments are added to `comments`, the numbers that they name to `stated`.
    """
    asked = ""
    for number, line in enumerate(map(str.strip, lines)):
        match = SEPARATOR.fullmatch(line)
        if match:
            asked = match[1]
        elif line.startswith(("#", "%")) and not _is_as_wide(line, lines):
            _state(line.lstrip("#% "), stated)
            comments.append(line.lstrip("#% "))
        else:
            return number, asked
    return 0, asked


def _is_as_wide(line: str, lines: list[str]) -> bool:
    """Say whether a line with a mark of comments is the headings, as rostopic writes them."""
    last = next((x for x in reversed(lines) if x.strip()), "")
    return any(s in line and line.count(s) == last.count(s) for s in SEPARATORS)


def _state(line: str, stated: dict[str, float]) -> None:
    match = STATED.match(line)
    if match:
        name = re.sub(r"\W+", "_", match["name"].strip()).strip("_")
        stated.setdefault(name, float(match["number"].replace(",", ".")))


def above_table(
    lines: list[str], separator: str | None, stated: dict[str, float], comments: list[str]
) -> int:
    """Return how many lines stand above the table: texts that have another number of cells.

    The texts are added to `comments`, the numbers that they name to `stated`.
    """
    filled = [line for line in lines[:1000] if line.strip()]
    if len(filled) < 3:
        return next((i for i, line in enumerate(lines) if line.strip()), 0)
    widths = Counter(len(cells_of(line, separator)) for line in filled[-50:])
    width = widths.most_common(1)[0][0]
    for number, line in enumerate(lines[:MOST_ABOVE]):
        cells = cells_of(line, separator)
        titled = 2 * len([c for c in cells if c]) < len(cells)  # a title in the first cell
        if any(cells) and (
            (len(cells) == width and not titled) or all(is_value(c, separator) for c in cells if c)
        ):
            return number
        following = next((x for x in lines[number + 1 :] if x.strip()), "")
        if any(cells) and all(is_value(c, separator) for c in cells_of(following, separator)):
            # headings of another width say nothing, but the rows follow
            _state(line, stated)
            comments.append(line.strip())
            return number
        _state(line, stated)
        comments.append(line.strip())
    return 0


KNOWN_UNITS = {"", "-", "rad", "deg", "grad", "°", "degree", "degrees", "radian", "radians"}
KNOWN_UNITS |= {"s", "sec", "ms", "us", "bool"}
TIMES = ("t", "time", "time_from_start")
# A spreadsheet's text for a cell without a value, in its own language.
SHEET_ERROR = re.compile(r"\s*(#(?:N/?[A-Z]+|[^\W\d_]+(?:/0)?[!?]))(?=[\s;,]|$)")
LABVIEW_X, LABVIEW_COMMENT = "x_value", "comment"


@dataclass(frozen=True, eq=False)
class TextTable:
    """A table of numbers, (N, C), and what its text says of them.

    headings: C texts with their units in brackets, or none. instants: the column, from 0, whose
    dates or times of day became s since the first of them, or None. stated: numbers that lines
    above the table name. comments: those lines.
    """

    values: NDArray[np.float64]
    headings: tuple[str, ...]
    instants: int | None
    stated: dict[str, float] = field(default_factory=dict)
    comments: list[str] = field(default_factory=list)


def parsed(data: bytes) -> TextTable:
    """Return the table in a text; raise NotATable with the line that does not fit.

    The separator is a comma, semicolon, tab or blanks; decimals may be commas where the columns
    are separated by something else, or where the numbers are quoted.
    """
    text = with_exponents(decoded(data)).replace("\r\n", "\n").replace("\r", "\n")
    lines = text.split("\n")
    # A spreadsheet writes rows of empty cells below the table as far as it was ever edited.
    while len(lines) > 1 and not lines[-1].strip('\t ;,"'):
        lines.pop()
    stated: dict[str, float] = {}
    comments: list[str] = []
    while len(lines) > 1 and (lines[-1].lstrip()[:1] in ("#", "%", "") or NAMED.match(lines[-1])):
        below = lines.pop().strip().lstrip("#% ")
        if below:
            _state(below, stated)
            comments.append(below)
    begin, asked, units = labview(lines, stated)
    if not begin:
        begin, asked = marked(lines, stated, comments)
    lines = lines[begin:]
    separator = separator_of(lines, asked)
    above = above_table(lines, separator, stated, comments)
    lines, begin = lines[above:], begin + above
    if separator and _all_end_with(lines, separator):
        lines = [line.rstrip().removesuffix(separator) for line in lines]
    first = next(iter(lines), "")
    cells = cells_of(first, separator)
    headed = not all(is_value(c, separator) for c in cells)
    if headed and [c.lower() for c in cells][:1] == [LABVIEW_X]:
        units = [*units, *[""] * len(cells)]
        cells = ["t", *(_with_unit(h, u) for h, u in zip(cells[1:], units, strict=False))]
    lines, cells = _with_days(lines, cells, separator, headed)
    if headed:
        lines, begin = lines[1:], begin + 1
        given = cells_of(lines[0], separator) if lines else []
        if len(given) == len(cells) and _are_units(given):
            cells = _with_units(cells, given)
            lines, begin = lines[1:], begin + 1
    headings = cells if headed else []
    if headed and headings[-1].lower() == LABVIEW_COMMENT:
        lines, headings = _without_comments(lines, separator, len(headings)), headings[:-1]
    if not any(line.strip() for line in lines):
        raise NotATable(NO_NUMBERS())
    _refuse_repeated(lines, headings, separator, begin)
    values, instants = _numbers(lines, separator, begin + 1, len(headings))
    if len(headings) != values.shape[1]:
        headings = []
    return TextTable(values, tuple(headings), instants, stated, comments)


def _refuse_repeated(
    lines: list[str], headings: list[str], separator: str | None, begin: int
) -> None:
    """Refuse a table in which the headings stand again: several recordings in one file."""
    if headings:
        for number, line in enumerate(lines, begin + 1):
            if headings[0] in line and cells_of(line, separator) == headings:
                raise NotATable(HEADINGS_AGAIN(line=number, headings=headings[:8]))


def _all_end_with(lines: list[str], separator: str) -> bool:
    filled = [stripped for line in lines if (stripped := line.rstrip(" "))]
    return len(filled) > 1 and all(line.endswith(separator) for line in filled)


def _are_units(cells: list[str]) -> bool:
    """Say whether a row under the headings holds units: short words, and no number."""
    return (
        any(cells)
        and all(len(c) <= 12 for c in cells)
        and not any(is_number(c.replace(",", ".")) or is_instant(c) for c in cells)
    )


def _with_units(headings: list[str], units: list[str]) -> list[str]:
    """Return headings as if each unit stood in brackets, which the headings' own rules read."""
    bare = [u.strip("[](){} ") for u in units]
    other = next((u for u in bare if u.lower() not in KNOWN_UNITS and not against(u)), None)
    if other is not None:
        raise NotATable(UNITS_UNKNOWN(found=other))
    return [_with_unit(h, u) for h, u in zip(headings, bare, strict=True)]


def _with_unit(heading: str, unit: str) -> str:
    bare = unit.strip("[](){} ")
    if bare in ("", "-") or (heading.lower() in TIMES and bare == "s"):
        return heading
    return f"{heading} [{bare}]"


def _with_days(
    lines: list[str], cells: list[str], separator: str | None, headed: bool
) -> tuple[list[str], list[str]]:
    """Return rows and headings with a column of days put before that of the times behind it."""
    first = next((line for line in lines[headed:] if line.strip()), "")
    given = cells_of(first, separator)
    column = next(
        (i for i, c in enumerate(given[:-1]) if is_day(c) and is_instant(given[i + 1])), -1
    )
    if column < 0 or separator is None:
        return lines, cells
    joined = []
    for line in lines[headed:]:
        row = line.split(separator)
        if len(row) > column + 1:
            row[column : column + 2] = [f"{row[column].strip()} {row[column + 1].strip()}"]
        joined.append(separator.join(row))
    kept = cells[:column] + cells[column + 1 :] if len(cells) == len(given) else cells
    return [*lines[:headed], *joined], kept


def _without_comments(lines: list[str], separator: str | None, width: int) -> list[str]:
    """Return rows of a LabVIEW table without the comments behind their numbers."""
    if separator is None:
        return lines
    return [separator.join(line.split(separator)[: width - 1]) for line in lines]


def _numbers(
    lines: list[str], separator: str | None, first_line: int, headings: int
) -> tuple[NDArray[np.float64], int | None]:
    """Return the rows of a table and the column of its instants, or None.

    first_line: the line of the file that `lines` begin at. headings: how many there are. Raises
    NotATable with the first line that does not fit.
    """
    lines, separator, instants = _plain(lines, separator, first_line)
    for number, line in enumerate(lines, first_line):
        # loadtxt takes a line that begins with # for a comment.
        if error := SHEET_ERROR.match(line):
            raise NotATable(WRONG_CELL(line=number, found=error[1], expected="number"))
    try:
        values = np.loadtxt(lines, delimiter=separator, ndmin=2, dtype=np.float64)
    except ValueError:
        raise _misfit(lines, separator, first_line) from None
    if separator == ",":
        _refuse_two_commas(lines, values, headings)
    return values, instants


def _plain(
    lines: list[str], separator: str | None, first_line: int
) -> tuple[list[str], str | None, int | None]:
    """Return rows without quotes, decimal commas and instants, and what separates them."""
    if any('"' in line for line in lines[:2]):
        try:
            rows = list(csv.reader(lines, delimiter=separator or " "))
        except csv.Error as error:
            raise NotATable(CELLS_UNREADABLE(error=str(error))) from None
        lines, separator = ["\t".join(c.strip() for c in row) for row in rows], "\t"
    first = next((line for line in lines if line.strip()), "")
    columns = [i for i, c in enumerate(cells_of(first, separator)) if is_instant(c)]
    if separator != "," and any("," in line for line in lines):
        lines = [line.replace(",", ".") for line in lines]
    if not columns:
        return lines, separator, None
    if len(columns) > 1:
        raise NotATable(TWO_DATES(count=len(columns)))
    column = columns[0]
    rows = [cells_of(line, separator) if line.strip() else [] for line in lines]
    elapsed = iter(seconds([row[column] if column < len(row) else "" for row in rows if row]))
    joined = []
    for number, row in enumerate(rows):
        if row:
            time = next(elapsed)
            if time is None:
                wrong = row[column] if column < len(row) else ""
                line = first_line + number
                raise NotATable(WRONG_CELL(line=line, found=wrong[:40], expected="date"))
            row[column] = repr(time)
        joined.append((separator or " ").join(row))
    return joined, separator, column


def _refuse_two_commas(lines: list[str], values: NDArray[Any], headings: int) -> None:
    """Refuse a table whose commas are decimal ones and separators at once."""
    width = values.shape[1]
    twice = width == 2 * headings if headings else width % 2 == 0 and width >= 4
    if not twice:
        return
    behind = set()
    for line in [x for x in lines if x.strip()][:50]:
        cells = [c.strip() for c in line.split(",")]
        if not all(re.fullmatch(r"[-+]?\d+", c) for c in cells):
            return
        if not all(c.isdigit() for c in cells[1::2]):
            return
        behind |= {len(c) for c in cells[1::2]}
    if headings or (len(behind) == 1 and min(behind) >= 2):
        raise NotATable(COMMAS_TWICE(count=width, headings=headings or None))


def _misfit(lines: list[str], separator: str | None, first_line: int) -> NotATable:
    """Return what names the first line that does not fit."""
    width = None
    for number, line in enumerate(lines, first_line):
        cells = [c.strip() for c in (line.split(separator) if separator else line.split())]
        if not any(cells):
            if line.strip():
                return NotATable(EMPTY_CELLS(line=number))
            continue
        width = width or len(cells)
        wrong = next((c for c in cells if not is_number(c)), None)
        if wrong is not None:
            return NotATable(WRONG_CELL(line=number, found=wrong[:40], expected="number"))
        if len(cells) != width:
            return NotATable(LINES_DIFFER(line=number, count=len(cells), first=width))
    return NotATable(NO_NUMBERS())
