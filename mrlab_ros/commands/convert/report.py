"""How `mrlab convert` reports the result for a file: as text with colours, or as JSON."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import zip_longest
from math import isfinite
from pathlib import Path
from typing import Any

from rich.console import Console
from rich.table import Table

from mrlab_ros.commands import output
from mrlab_ros.commands.convert.options import command_with
from mrlab_ros.core.base.diagnostic import Diagnostic, plain
from mrlab_ros.core.base.foreign_text import visible
from mrlab_ros.core.conversion.candidates import SPARK_WIDTH
from mrlab_ros.core.conversion.convert import ConversionResult
from mrlab_ros.core.conversion.options import Options
from mrlab_ros.core.runtime.colours import OUTCOME_STYLES, SEVERITY_STYLES


def record(given: str, result: ConversionResult, written: Path | None) -> dict[str, Any]:
    """Return what --json prints for a file."""
    t = result.trajectory
    gripper = t is not None and t.gripper is not None
    return {
        "file": given,
        "outcome": result.outcome.name.lower(),
        "variable": t.source.variable if t else None,
        "shape": [t.frame_count, len(t.joint_names) + gripper] if t else None,
        "has_gripper": gripper if t else None,
        "frame_rate": t.frame_rate if t else None,
        "candidates": [
            {
                "variable": c.path,
                "shape": list(c.shape),
                "score": c.score,
                "why": c.why,
                "reasons": plain(c.reasons),
                "minimum": c.minimum if isfinite(c.minimum) else None,
                "maximum": c.maximum if isfinite(c.maximum) else None,
                "sparkline": c.sparkline(),
            }
            for c in result.candidates
        ],
        "diagnostics": plain(result.diagnostics),
        "message": result.message,
        "said": plain(result.said),
        "trajectory": str(written) if written else None,
    }


def show(
    result: ConversionResult,
    written: Path | None,
    words: list[str],
    options: Options,
    console: Console | None = None,
) -> None:
    """Print what became of a file, every finding, and what there is to choose from.

    words: of the command that was given, without its `options`; findings name it with one more.
    console: None: standard output.
    """
    console = console or output.console()
    outcome = result.outcome.name.lower()
    console.print(outcome, style=OUTCOME_STYLES[outcome], end="  ")
    console.print(visible(result.message if result.trajectory else result.file))
    next_words = words if result.trajectory is None else []
    show_findings(result.diagnostics, console, next_words, options)
    if result.candidates:
        console.print(_choices(result))
        if not any(fix.option == "variable" for d in result.diagnostics for fix in d.fixes):
            likeliest = result.candidates[0].path
            _say_next(console, command_with(words, options, "variable", likeliest))
    if written:
        console.print(f"  written to {visible(str(written))}")


def show_findings(
    findings: Sequence[Diagnostic],
    console: Console,
    words: list[str] | None = None,
    options: Options | None = None,
) -> None:
    """Print findings with their remedies and a line of MATLAB, with `words` commands as well."""
    for d, following in zip_longest(findings, findings[1:]):
        severity = d.severity.name.lower()
        label, style = f"  {severity} {d.code}: ", SEVERITY_STYLES[severity]
        console.print(label + d.message, style=style)
        if following and _advice(following) == _advice(d):
            continue  # said once, below the last of them
        if d.remedy:
            console.print(f"      {visible(d.remedy)}")
        for fix in d.fixes if words else ():
            if fix.command:
                _say_next(console, fix.command)
            if fix.option:
                command = command_with(words or [], options or Options(), fix.option, fix.value)
                _say_next(console, command)
        line = next((fix.matlab for fix in d.fixes if fix.matlab), "")
        if line:
            console.print(f"      in MATLAB: {visible(line)}", soft_wrap=True)


def _advice(d: Diagnostic) -> tuple[str, str, list[tuple[str, str]]]:
    return d.code, d.remedy, [(fix.option, fix.value) for fix in d.fixes if fix.option]


def _say_next(console: Console, command: str) -> None:
    console.print(f"      try: {command}", soft_wrap=True)


def _choices(result: ConversionResult) -> Table:
    table = Table("--variable", "size", "from", "to", box=None)
    table.add_column("course", no_wrap=True, min_width=SPARK_WIDTH)
    table.add_column("score")
    table.add_column("why")
    for c in result.candidates:
        table.add_row(
            c.path,
            c.size,
            *(f"{end:.3g}" if isfinite(end) else "-" for end in (c.minimum, c.maximum)),
            c.sparkline(),
            f"{c.score:.2f}",
            c.why,
        )
    return table


def summarise(results: list[ConversionResult]) -> None:
    """Print a table with a line a file."""
    console = output.console()
    table = Table("file", "outcome", "variable", "frames", "Hz", "finding", box=None)
    for r in results:
        t = r.trajectory
        codes = ", ".join(dict.fromkeys(d.code for d in r.diagnostics if d.severity > 0))
        table.add_row(
            r.file,
            r.outcome.name.lower(),
            t.source.variable if t else "",
            str(t.frame_count) if t else "",
            f"{t.frame_rate:g}" if t else "",
            codes,
        )
    console.print()
    console.print(table)
