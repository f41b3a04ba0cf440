"""What stands above a text table: comments, titles, the header of LabVIEW, and their numbers."""

from __future__ import annotations

import re
from collections import Counter

from mrlab_ros.adapters.workspaces.diagnostics import LABVIEW_SEGMENTS
from mrlab_ros.adapters.workspaces.mat5 import NotATable
from mrlab_ros.adapters.workspaces.table_cells import SEPARATORS, cells_of, is_number, is_value

SEPARATOR = re.compile(r"[\"']?sep=(.)[\"']?", re.I)
END_OF_HEADER = "***End_of_Header***"  # of LabVIEW's measurement files
STATED = re.compile(
    r"\s*(?P<name>[A-Za-z][\w .-]{0,40}?)\s*(\[[^\]]*\]|\([^)]*\))?\s*[:=;,\t]\s*"
    r"(?P<number>[-+]?\d+(?:[.,]\d+)?(?:[eE][-+]?\d+)?)\s*[A-Za-z]{0,3}[;,\t\s]*$"
)
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


def marked(lines: list[str], stated: dict[str, float]) -> tuple[int, str]:
    """Return how many lines are comments or name the separator, and that separator."""
    asked = ""
    for number, line in enumerate(map(str.strip, lines)):
        match = SEPARATOR.fullmatch(line)
        if match:
            asked = match[1]
        elif line.startswith(("#", "%")) and not _is_as_wide(line, lines):
            _state(line.lstrip("#% "), stated)
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


def above_table(lines: list[str], separator: str | None, stated: dict[str, float]) -> int:
    """Return how many lines stand above the table: texts that have another number of cells."""
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
            return number
        _state(line, stated)
    return 0
