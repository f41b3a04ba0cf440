"""MATLAB code that is data alone: numbers, texts and matrices of numbers, each under a name.

Nothing is run: a line that computes refuses the file, as it may change what stands above it.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from typing import Any

import numpy as np

from mrlab_ros.adapters.workspaces.diagnostics import LINES_DIFFER, MATLAB_COMPUTES
from mrlab_ros.adapters.workspaces.matlab.elements import NotATable
from mrlab_ros.adapters.workspaces.tables.cells import decoded, is_number, with_exponents

BLOCK_COMMENT = re.compile(r"^[ \t]*%\{[ \t]*\n.*?^[ \t]*%\}[ \t]*$", re.M | re.S)
COMMENT = re.compile(r"%[^\n]*")
TEXT = re.compile(r"(?<![\w\])}'.])'[^'\n]*'|\"[^\"\n]*\"")
CONTINUED = re.compile(r"\.\.\.[^\n]*\n")
NAME = r"[A-Za-z]\w*(?:\.[A-Za-z]\w*)*"
STATEMENT = re.compile(
    rf"[\s;,]*(?P<name>{NAME})[ \t]*=[ \t]*"
    r"(?:\[(?P<matrix>[^\[\]]*)\](?P<turned>\.?')?|'(?P<text>[^'\n]*)'|\"(?P<string>[^\"\n]*)\"|"
    r"(?P<number>[-+.\w]+))[ \t]*(?=[;,\n]|$)"
)
NOTHING_ELSE = re.compile(r"(?:[\s;,]|\b(?:clear|clc|close)\b(?:[ \t]+all)?)*")


def comments(data: bytes) -> list[str]:
    """Return the comments of a file, a line each, without their marks."""
    text = decoded(data).replace("\r\n", "\n").replace("\r", "\n")
    blocks = [line for found in BLOCK_COMMENT.finditer(text) for line in found[0].split("\n")]
    lines = COMMENT.findall(BLOCK_COMMENT.sub("", TEXT.sub("''", text)))
    said = (line.strip(" \t%{}") for line in (*blocks, *lines))
    return [line for line in said if line]


def statements(data: bytes) -> Iterator[tuple[str, Any]]:
    """Yield the names of a file and their values: arrays, or texts as str.

    Raises NotATable with the line of the first statement that is no data.
    """
    text = with_exponents(decoded(data).replace("\r\n", "\n").replace("\r", "\n"))
    # what is taken out keeps its lines, which errors name
    text = BLOCK_COMMENT.sub(lambda found: "\n" * found[0].count("\n"), text)
    text = CONTINUED.sub(" ", COMMENT.sub("", text))
    at = 0
    while (at := _skipped(text, at)) < len(text):
        match = STATEMENT.match(text, at)
        number = match["number"] if match else None
        if match is None or (number is not None and not is_number(number)):
            line = text.count("\n", 0, at) + 1
            raise NotATable(MATLAB_COMPUTES(line=line, found=text[at : at + 40].split("\n")[0]))
        at = match.end()
        yield match["name"], _value(match, text)


def _skipped(text: str, at: int) -> int:
    match = NOTHING_ELSE.match(text, at)
    return match.end() if match else at


def _value(match: re.Match[str], text: str) -> Any:
    for kind in ("text", "string"):
        if match[kind] is not None:
            return match[kind]
    if match["number"] is not None:
        return np.array([float(match["number"])])
    first = text.count("\n", 0, match.start("matrix")) + 1
    rows: list[list[float]] = []
    for number, line in enumerate(match["matrix"].split("\n"), first):
        for row in line.split(";"):
            cells = row.replace(",", " ").split()
            if not cells:
                continue
            if not all(map(is_number, cells)):
                raise NotATable(MATLAB_COMPUTES(line=number, found=row.strip()[:40]))
            if rows and len(cells) != len(rows[0]):
                raise NotATable(LINES_DIFFER(line=number, count=len(cells), first=len(rows[0])))
            rows.append([float(cell) for cell in cells])
    values = np.array(rows, dtype=np.float64).reshape(len(rows), -1 if rows else 0)
    return values.T if match["turned"] else values
