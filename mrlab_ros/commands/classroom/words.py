"""How `mrlab class` reports to a person."""

from __future__ import annotations

from pathlib import Path

from rich.table import Table
from rich.text import Text

from mrlab_ros.commands import output
from mrlab_ros.core.base.diagnostic import Diagnostic
from mrlab_ros.core.classroom.gradebook import number, text
from mrlab_ros.core.classroom.graded import GradedClass
from mrlab_ros.core.classroom.result import FAILED, MARKED
from mrlab_ros.core.runtime.colours import OUTCOME_STYLES

MOST_ROWS, MOST_LEFT_OUT, MOST_MISTAKES = 20, 10, 5


def show(
    graded: GradedClass, out: Path, key_table: Path | None, problems: list[Diagnostic]
) -> None:
    """Print the class in short."""
    console = output.console(width=output.REPORT_WIDTH)

    def say(text: str) -> None:
        console.print(text, soft_wrap=True)

    students, figures = graded.students, graded.statistics()
    named = "a folder or file for each student" if graded.form == "folder" else graded.form
    say(f"{len(students)} students, read as {named}; {graded.rubric.name}")
    say(
        f"mean {figures.mean:.3g}, median {figures.median:.3g} of "
        f"{number(graded.rubric.points)} points; {figures.full} with all points"
    )
    unmarked = [s for s in students if s.result.outcome != MARKED]
    if unmarked:
        console.print("\nnot checked", style="bold")
        table = Table(box=None, show_header=False)
        for student in unmarked[:MOST_ROWS]:
            failed = student.result.outcome == FAILED
            style = OUTCOME_STYLES["rejected" if failed else "ambiguous"]
            word = "failed" if failed else "no file"
            table.add_row(Text(word, style), student.submission.name, text(student.result.found))
        console.print(table)
        if len(unmarked) > MOST_ROWS:
            say(f"  and {len(unmarked) - MOST_ROWS} more; {out}/index.html has all")
    if figures.tests:
        console.print("\nwhere points were lost", style="bold")
        for test in figures.tests[:MOST_MISTAKES]:
            say(f"  {test.students:4d}  {test.name}")
    groups = graded.similar().groups
    if groups:
        count = sum(len(g.keys) for g in groups)
        say(f"\n{count} motions are nearly the same as another one; the page shows them")
    if graded.left_out:
        console.print("\nleft out", style="bold")
        for path, why in graded.left_out[:MOST_LEFT_OUT]:
            say(f"  {path}: {why}")
        if len(graded.left_out) > MOST_LEFT_OUT:
            say(f"  and {len(graded.left_out) - MOST_LEFT_OUT} more")
    reference = graded.reference
    if reference is not None and reference.points < reference.of:
        say(
            f"\nthe reference solution gets {number(reference.points)} of "
            f"{number(reference.of)} points; mrlab rubric lint says why"
        )
    console.print()
    for problem in problems:
        say(str(problem))
    say(f"{out}/index.html")
    if key_table is not None:
        say(f"who is who stands in {key_table} alone; keep it, and do not pass it on")
