"""Fenced command blocks of the pages that are run, and what the pages say that they print.

`<!-- run -->` above a block says that a test runs it in a lab with one UR5e; `<!-- prints -->`
above the block that follows it says what it prints. There a number stands for any number, and
`...` for any text, alone on a line for any lines.
"""

from __future__ import annotations

import re
import shlex
from collections.abc import Iterator
from dataclasses import dataclass, replace
from itertools import takewhile
from pathlib import Path

ROOT = Path(__file__).parents[1]
PAGES = [ROOT / "README.md", *sorted((ROOT / "docs").glob("*.md"))]
NUMBER = re.compile(r"\d+(?:\.\d+)?(?:e-?\d+)?")


@dataclass(frozen=True)
class Block:
    """A block: the words of each `mrlab` command, and the lines that all of them print."""

    page: str
    commands: tuple[tuple[str, ...], ...]
    printed: str


def blocks() -> list[Block]:
    """Return the blocks that are run, in the order of pages."""
    return [block for page in PAGES for block in _of(page)]


def _of(page: Path) -> list[Block]:
    found: list[Block] = []
    lines = iter(page.read_text().splitlines())
    for line in lines:
        if line == "<!-- run -->":
            text = "\n".join(_fenced(lines)).replace("\\\n", " ")
            commands = tuple(
                tuple(shlex.split(each, comments=True)[1:])
                for each in text.splitlines()
                if each.startswith("mrlab ")
            )
            found.append(Block(page.name, commands, "..."))
        elif line == "<!-- prints -->":
            found[-1] = replace(found[-1], printed="\n".join(_fenced(lines)))
    return found


def _fenced(lines: Iterator[str]) -> list[str]:
    """Return the lines of the block that begins with the next line."""
    assert next(lines).startswith("```")
    return list(takewhile(lambda line: line != "```", lines))


def pattern(printed: str) -> re.Pattern[str]:
    """Return what the output of a block has to match, its spaces put together."""
    parts = []
    for line in printed.splitlines():
        if line.strip() == "...":
            parts.append(r"(?:.*\n)*?")
            continue
        words = NUMBER.sub("0", " ".join(line.split()))
        parts.append(re.escape(words).replace(re.escape("..."), ".*") + r"\n")
    return re.compile("".join(parts))


def plain(output: str) -> str:
    """Return an output with its spaces put together and 0 for each number."""
    lines = [" ".join(line.split()) for line in output.splitlines()]
    return "".join(f"{NUMBER.sub('0', line)}\n" for line in lines if line)
