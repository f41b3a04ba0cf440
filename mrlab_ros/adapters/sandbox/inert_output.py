"""Output in which nothing acts: what a process prints may hold names and texts of files."""

from __future__ import annotations

import io
import sys
from collections.abc import Iterable
from typing import Any, TextIO

from mrlab_ros.core.base.foreign_text import visible_lines


class GuardedStream:
    """A text stream that writes commands to a terminal as text; rich, which has its own, passes.

    Whoever paints with rich guards what it paints (`commands/output.py`).
    """

    def __init__(self, stream: TextIO) -> None:
        # by which name rich asks for what lies behind a stream
        self.rich_proxied_file = stream

    def write(self, text: str) -> int:
        self.rich_proxied_file.write(visible_lines(text))
        return len(text)

    def writelines(self, lines: Iterable[str]) -> None:
        for line in lines:
            self.write(line)

    def __getattr__(self, name: str) -> Any:
        return getattr(self.rich_proxied_file, name)


def guard() -> None:
    """Let nothing act that this process prints; a terminal that lacks a character shows ?."""
    for name in ("stdout", "stderr"):
        stream = getattr(sys, name)
        if isinstance(stream, io.TextIOWrapper):
            if stream.errors == "strict":
                stream.reconfigure(errors="replace")
            setattr(sys, name, GuardedStream(stream))
