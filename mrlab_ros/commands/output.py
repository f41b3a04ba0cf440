"""The one door to a terminal: what commands print comes through here.

Names and texts of files pass it, too: a `console` takes nothing for markup, and shows what acts on
a terminal. So does `print`, whose streams `cli.main` guards (`adapters/sandbox/inert_output.py`).
"""

from __future__ import annotations

import json
import sys
import traceback
from collections.abc import Iterable, Iterator
from typing import TYPE_CHECKING, Annotated, Any

import typer

from mrlab_ros.core.base.diagnostic import Diagnostic, Fix, Severity, plain
from mrlab_ros.core.base.foreign_text import visible, visible_lines

if TYPE_CHECKING:
    from rich.console import Console


# Exit codes. BROKEN is neither a refusal (1) nor wrong usage, which are verdicts of `mrlab check`
# and others.
WRONG_USAGE, BROKEN = 2, 3


class Settings:
    """Options that hold for every command."""

    debug = False


WORDS = {Severity.INFO: "note", Severity.WARNING: "warning", Severity.ERROR: "error"}
REPORT_WIDTH = 120  # of reports, where nothing says how wide the output is
AsJson = Annotated[bool, typer.Option("--json", help="Print one JSON object.")]


def say(said: Diagnostic | str, *, as_json: bool, **facts: object) -> None:
    """Print what is said, or a JSON object with its text, code and values, and `facts`."""
    found: dict[str, object] = {"message": str(said)}
    if isinstance(said, Diagnostic):
        found |= {"code": said.code, "values": plain(said.values)}
    if as_json:
        print(json.dumps({**plain(facts), **found}), flush=True)
    else:
        print(with_fixes(said) if isinstance(said, Diagnostic) else said, flush=True)


def say_error(sentence: str) -> None:
    """Print an error; a line end may come from a file's name: no other line begins like ours."""
    print("mrlab: " + sentence.replace("\n", "\n  "), file=sys.stderr)


def say_problem(found: Diagnostic) -> None:
    """Print why something was refused, and the commands that mend it.

    Under --debug the traceback of the error that is being handled is printed, too.
    """
    if Settings.debug and sys.exc_info()[0]:
        traceback.print_exc()
    say_error(str(found))
    for line in _tries(found):
        print(line, file=sys.stderr)


def with_fixes(found: Diagnostic) -> str:
    """Return what is said, and the commands that mend it in lines of their own."""
    return "\n".join((str(found), *_tries(found)))


def print_findings(found: Iterable[Diagnostic]) -> None:
    """Print a line for each finding, and the commands that mend it."""
    for one in found:
        print(f"  {WORDS[one.severity]}: {with_fixes(one)}")


def _tries(found: Diagnostic) -> list[str]:
    # A name of a file in a command may have a line end.
    commands = dict.fromkeys(fix.command for fix in all_fixes(found) if fix.command)
    return [f"  try: {visible(command)}" for command in commands]


def all_fixes(found: object) -> Iterator[Fix]:
    """Yield the fixes of a diagnostic and of those among its values."""
    found = getattr(found, "diagnostic", found)
    if isinstance(found, Diagnostic):
        yield from found.fixes
        for value in found.values.values():
            yield from all_fixes(value)
    elif isinstance(found, list | tuple):
        for each in found:
            yield from all_fixes(each)


def console(*, stderr: bool = False, width: int | None = None) -> Console:
    """Return a console for tables and colours, which takes nothing for markup.

    width: characters, where it is no terminal.
    """
    # rich takes a while to import, and not every command needs it
    from rich.console import Console
    from rich.segment import Segment

    class Guarded(Console):
        """Renders text of any origin: as text."""

        def render(self, *args: Any, **options: Any) -> Iterable[Segment]:
            for text, style, control in super().render(*args, **options):
                yield Segment(text if control else visible_lines(text), style, control)

    made = Guarded(stderr=stderr, markup=False, emoji=False, highlight=False)
    if width is not None and not made.is_terminal:
        made.width = width
    return made
