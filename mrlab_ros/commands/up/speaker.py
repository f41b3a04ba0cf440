"""The output of a lab: each line with the process that it came from."""

from __future__ import annotations

from typing import TYPE_CHECKING

from mrlab_ros.commands import output
from mrlab_ros.processes.child_process import SELF
from mrlab_ros.processes.lab import PROCESSES

if TYPE_CHECKING:
    from rich.console import Console

PALETTE = ("cyan", "green", "red", "yellow", "bright_cyan", "magenta", "bright_blue")
COLOURS = {SELF: "bold"} | {
    process.name: colour for process, colour in zip(PROCESSES, PALETTE, strict=True)
}


class Speaker:
    """Prints lines with the coloured name of the process that said them."""

    def __init__(self, console: Console | None = None) -> None:

        self._console = console or output.console()

    def __call__(self, name: str, line: str) -> None:
        from rich.text import Text

        text = Text.assemble((f"{name:<9}", COLOURS.get(name, "blue")), Text.from_ansi(line))
        self._console.print(text, soft_wrap=True)
