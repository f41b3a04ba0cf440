"""A window on lines that are more than the terminal has, moved with keys."""

from __future__ import annotations

import os
import select
import termios
import time
import tty
from types import TracebackType
from typing import TYPE_CHECKING, Any

from rich.segment import Segment, Segments
from rich.text import Text

if TYPE_CHECKING:
    from rich.console import Console, ConsoleOptions, RenderableType, RenderResult

UP, DOWN, PAGE_UP, PAGE_DOWN = b"\x1b[A", b"\x1b[B", b"\x1b[5~", b"\x1b[6~"
LINES = {UP: -1, b"k": -1, DOWN: 1, b"j": 1, b"\r": 1}
PAGES = {PAGE_UP: -1, b"b": -1, PAGE_DOWN: 1, b" ": 1}


class Scroll:
    """Shows the part of a text that fits. Keys are read from `terminal`, none where it is None."""

    def __init__(self, console: Console, terminal: int | None) -> None:
        self._console = console
        self._terminal = terminal
        self._before: Any = None
        self.whole: RenderableType = ""
        self.top = 0
        self.ended = False

    def __enter__(self) -> Scroll:
        if self._terminal is not None:
            self._before = termios.tcgetattr(self._terminal)
            tty.setcbreak(self._terminal)
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        if self._terminal is not None:
            termios.tcsetattr(self._terminal, termios.TCSADRAIN, self._before)

    def take(self, whole: RenderableType) -> None:
        """Show this from now on, at the same place."""
        self.whole = whole

    def key(self, timeout: float) -> bool:
        """Wait up to `timeout` s for a key and do what it says; return whether there was one."""
        if self._terminal is None:
            time.sleep(timeout)
            return False
        if not select.select([self._terminal], [], [], timeout)[0]:
            return False
        self.press(os.read(self._terminal, 16))
        return True

    def press(self, typed: bytes) -> None:
        """Do what a key says; what the terminal has no lines for is not scrolled past."""
        if typed in (b"q", b"Q"):
            self.ended = True
        self.top += LINES.get(typed, 0) + PAGES.get(typed, 0) * (self._console.height - 2)

    def __rich_console__(self, console: Console, options: ConsoleOptions) -> RenderResult:
        lines = console.render_lines(self.whole, options.update(height=None), pad=False)
        height = console.height
        if len(lines) <= height:
            self.top = 0
            footer, shown = None, lines
        else:
            room = height - 1
            self.top = max(0, min(self.top, len(lines) - room))
            shown = lines[self.top : self.top + room]
            last = self.top + len(shown)
            footer = f"lines {self.top + 1} to {last} of {len(lines)}; arrows scroll, q ends"
        for number, line in enumerate(shown):
            yield Segments(line)
            if footer or number < len(shown) - 1:
                yield Segment.line()
        if footer:
            yield Text(footer[: options.max_width], "reverse", end="")
