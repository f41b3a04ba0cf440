"""Remedies for a page: without the options of the command line, which have buttons there."""

from __future__ import annotations

import re

# An option with its value, such as --units deg or --variable 'q(1:200, :)'.
OPTION = r"--[a-z][a-z-]*(?: (?:'[^']*'|[\w.:]*\w))?"
# What goes, in this order; each leaves a sentence.
LEFT_OUT: tuple[tuple[re.Pattern[str], str], ...] = tuple(
    (re.compile(pattern), instead)
    for pattern, instead in (
        (rf",? or convert with the option \w+ \({OPTION}\)", ""),
        (rf"(?: with the option \w+| with the option)? \({OPTION}\)", ""),
        (rf",? or use {OPTION}(?:; else say the rate: {OPTION})?", ""),
        (r", --row-limit of mrlab convert", ""),
        (r" with --resample(?= \()", ""),
        # a sentence that only says when to use an option
        (rf"(?:^|(?<=[.!?;]) *)(?:If|To|For|Only)\b[^.!?]*?: {OPTION}\.", ""),
        (rf"(?:^|(?<=[.!?]) *)If[^.!?]*, say the rate: {OPTION}\.", ""),
        (rf": {OPTION}, or another number", ""),
        (rf": {OPTION}", ""),
    )
)


def for_page(remedy: str) -> str:
    """Return a remedy as a page says it."""
    for pattern, instead in LEFT_OUT:
        remedy = pattern.sub(instead, remedy)
    return remedy.strip()
