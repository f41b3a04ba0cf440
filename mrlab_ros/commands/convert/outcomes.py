"""The exit codes of commands that convert files."""

from __future__ import annotations

from mrlab_ros.adapters.workspaces.diagnostics import CONVERTER_FAILED, LAB_FAILED
from mrlab_ros.commands.output import BROKEN
from mrlab_ros.core.conversion.convert import ConversionResult, Outcome

EXIT_CODES = {Outcome.ACCEPTED: 0, Outcome.REJECTED: 1, Outcome.AMBIGUOUS: 2}
# from good to bad: of a batch the worst counts, a refusal more than a choice that is open
BADNESS = (0, 2, 1, BROKEN)


def exit_code(result: ConversionResult) -> int:
    """Return the exit code for what became of a file; BROKEN where the file is not at fault."""
    if result.said.code in (CONVERTER_FAILED.code, LAB_FAILED.code):
        return BROKEN
    return EXIT_CODES[result.outcome]
