"""Fenced blocks of the pages: which are run, and what the pages say that they print.

Above each block of commands or of Python stands one mark:

- `<!-- run -->`: a test runs every line in a lab with one UR5e. `mrlab up` stands for that lab,
  with the robots of `--robots`; a block that makes keys is run where no lab is.
- `<!-- run but for WORD: why -->`: lines that begin with WORD are left out.
- `<!-- run by test/...py -->`: another test does.
- `<!-- not run: why -->`

`<!-- prints -->` above the next block says what a block prints. There a number stands for any
number, and `...` for any text, alone on a line for any lines.
"""

from __future__ import annotations

import re
import shlex
from collections.abc import Iterator
from dataclasses import dataclass
from itertools import takewhile
from pathlib import Path

ROOT = Path(__file__).parents[3]
PAGES = [ROOT / "README.md", *sorted((ROOT / "docs").rglob("*.md"))]
# Languages of blocks that show data, and a page whose blocks are generated.
DATA = ("yaml", "json", "mermaid", "text")
GENERATED = ("protocol.md",)
MARK = re.compile(
    r"<!-- (?:run|prints|run but for (?P<but>\S+): .+|run by (?P<by>test/\S+\.py)|not run: .+) -->"
)
RULE = re.compile("(─|━)+")
NUMBER = re.compile(r"\d+(?:\.\d+)?(?:e-?\d+)?")


@dataclass(frozen=True)
class Block:
    """A fenced block of a page, its mark, and what the page says that it prints."""

    page: str
    line: int
    language: str
    mark: str
    text: str
    printed: str | None = None

    @property
    def run(self) -> bool:
        """Whether a test runs it in the lab."""
        return self.mark == "<!-- run -->" or self.mark.startswith("<!-- run but")

    @property
    def commands(self) -> tuple[tuple[str, ...], ...]:
        """The words of each command that is run."""
        found = MARK.fullmatch(self.mark)
        left_out = found["but"] if found else None
        lines = self.text.replace("\\\n", " ").splitlines()
        words = [tuple(shlex.split(line, comments=True)) for line in lines]
        return tuple(each for each in words if each and each[0] != left_out)


def blocks(page: Path) -> list[Block]:
    """Return all blocks of a page, each with what is printed by it in place of a block."""
    found: list[Block] = []
    before, number = "", 0
    lines = iter(page.read_text().splitlines())
    for line in lines:
        number += 1
        if line.startswith("```"):
            text = list(takewhile(lambda line: line != "```", lines))
            if before == "<!-- prints -->":
                block = found.pop()
                found.append(Block(**{**vars(block), "printed": "\n".join(text)}))
            else:
                found.append(Block(page.name, number, line[3:], before, "\n".join(text)))
            number += len(text) + 1
        before = line
    return found


def all_blocks() -> Iterator[Block]:
    """Yield the blocks of all pages."""
    for page in PAGES:
        yield from blocks(page)


def pattern(printed: str) -> re.Pattern[str]:
    """Return what the output of a block has to match, its spaces put together."""
    parts = []
    for line in printed.splitlines():
        if line.strip() == "...":
            parts.append(r"(?:.*\n)*?")
            continue
        words = _plain_line(line)
        if words:
            parts.append(re.escape(words).replace(re.escape("..."), ".*") + r"\n")
    return re.compile("".join(parts))


def plain(output: str) -> str:
    """Return an output with its spaces and rules put together and 0 for each number."""
    lines = [_plain_line(line) for line in output.splitlines()]
    return "".join(f"{line}\n" for line in lines if line)


def _plain_line(line: str) -> str:
    return NUMBER.sub("0", RULE.sub(r"\1", " ".join(line.split())))
