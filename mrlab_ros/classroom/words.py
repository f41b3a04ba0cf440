"""Reports of `mrlab class` and `mrlab rubric` on a terminal."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from pathlib import Path

from rich.console import Console
from rich.table import Table
from rich.text import Text

from mrlab_ros.classroom.marks.gradebook import number, text
from mrlab_ros.classroom.marks.graded import GradedClass
from mrlab_ros.classroom.marks.matching import FILE, Unmatched
from mrlab_ros.classroom.marks.result import FAILED, MARKED, NO_FILE, REFUSED, TO_REPEAT
from mrlab_ros.classroom.rubrics.document import at
from mrlab_ros.classroom.rubrics.marking import Flaw, Mark, Marks
from mrlab_ros.classroom.rubrics.measures import FAMILIES
from mrlab_ros.classroom.rubrics.rubric import Rubric
from mrlab_ros.classroom.trials import Trial
from mrlab_ros.commands import output
from mrlab_ros.core.base.diagnostic import Diagnostic
from mrlab_ros.core.base.phrase import phrase
from mrlab_ros.core.checking.check_record import Checked
from mrlab_ros.core.runtime.colours import OUTCOME_STYLES, SEVERITY_STYLES

UNMARKED = {
    REFUSED: ("refused", OUTCOME_STYLES["rejected"]),
    FAILED: ("failed", OUTCOME_STYLES["rejected"]),
    NO_FILE: ("no file", OUTCOME_STYLES["ambiguous"]),
    TO_REPEAT: ("to be repeated", OUTCOME_STYLES["ambiguous"]),
}
MOST_ROWS, MOST_LEFT_OUT, MOST_MISTAKES = 20, 10, 5


def show(
    graded: GradedClass, out: Path, key_table: Path | None, problems: list[Diagnostic]
) -> None:
    """Print the class in short."""
    console = output.console(width=output.REPORT_WIDTH)

    def say(text: str) -> None:
        console.print(text, soft_wrap=True)

    _unmatched(graded.unmatched, console, say)
    students, figures = graded.students, graded.statistics()
    named = "a folder or file for each student" if graded.form == "folder" else graded.form
    say(f"{len(students)} students, read as {named} (--form changes that); {graded.rubric.name}")
    say(
        f"mean {figures.mean:.3g}, median {figures.median:.3g} of "
        f"{number(graded.rubric.points)} points; {figures.full} with all points"
    )
    if graded.left_out:
        console.print("\nleft out", style="bold")
        for each in graded.left_out[:MOST_LEFT_OUT]:
            say(f"  {each.path}: {each.why}")
        if len(graded.left_out) > MOST_LEFT_OUT:
            say(f"  and {len(graded.left_out) - MOST_LEFT_OUT} more")
    unmarked = [s for s in students if s.result.outcome != MARKED]
    if unmarked:
        console.print("\nnot marked", style="bold")
        table = Table(box=None, show_header=False)
        for student in unmarked[:MOST_ROWS]:
            word, style = UNMARKED[student.result.outcome]
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


def _unmatched(found: Sequence[Unmatched], console: Console, say: Callable[[str], None]) -> None:
    """Print what could not be matched, with the proposals, before all else."""
    if not found:
        return
    console.print("not matched", style="bold")
    table = Table(box=None, show_header=False)
    for each in found[:MOST_ROWS]:
        near = f"{each.proposed} ({each.proposal})" if each.proposal else "nobody is near"
        why = "is named as nobody's" if each.kind == FILE else "is not in the worksheet"
        table.add_row(Text(each.name), why, Text(near))
    console.print(table)
    if len(found) > MOST_ROWS:
        say(f"  and {len(found) - MOST_ROWS} more; class.json has all")
    if any(each.proposal for each in found):
        say("  --accept takes these proposals")
    say("  --match 'FILE OR STUDENT=STUDENT OR ROW' decides one; with nothing behind =, nobody\n")


OK, NOT = OUTCOME_STYLES["accepted"], OUTCOME_STYLES["rejected"]
PARTLY = OUTCOME_STYLES["ambiguous"]


def marks(file: Path, rubric: Rubric, found: Marks, checked: Checked) -> None:
    """Print what a file gets."""
    console = output.console(width=output.REPORT_WIDTH)
    style = OK if not found.lost else PARTLY if found.points else NOT
    console.print(f"{found.points:g} of {found.of:g} points", style=style, end="")
    console.print(f": {file.name}, {rubric.name}\n")
    if found.note:
        console.print(f"{found.note}\n")
    table = Table("", "points", box=None)
    table.columns[1].justify = "right"
    table.add_column("test", overflow="fold", max_width=34)
    table.add_column("time", justify="right")
    table.add_column("found", min_width=30)
    for mark in found.tests:
        word, style = _verdict(mark)
        table.add_row(
            Text(word, style),
            f"{mark.points:g}/{mark.of:g}",
            f"{mark.name}{' (hidden)' if mark.hidden else ''}",
            "" if mark.time is None else f"{mark.time:.2f} s",
            mark.found.message,
        )
        if not mark.passed and mark.hint:
            table.add_row("", "", "", "", Text(mark.hint, "dim"))
    console.print(table)
    for hint in found.hints:
        console.print(f"hint: {hint}")
    console.print(f"\ncheck {checked.document['hash']}", soft_wrap=True)


def _verdict(mark: Mark) -> tuple[str, str]:
    if mark.passed:
        return "ok", OK
    return ("partly", PARTLY) if mark.points else ("NOT", NOT)


def flaws(rubric: Rubric, found: Sequence[Flaw], reference: Marks | None) -> None:
    """Print the flaws of a rubric, as editors read them: file, line, what."""
    console = output.console(width=output.REPORT_WIDTH)
    for flaw in found:
        severity = flaw.found.severity.name.lower()
        where = at(rubric.origin, flaw.line)
        test = f"test '{flaw.test}': " if flaw.test else ""
        console.print(f"{where}: ", end="", soft_wrap=True)
        console.print(severity, style=SEVERITY_STYLES[severity], end="")
        console.print(f": {test}{output.with_fixes(flaw.found)}", soft_wrap=True)
    errors = sum(flaw.found.refuses for flaw in found)
    tests = phrase("{count:count test|tests}").fill({"count": len(rubric.tests)})
    style = NOT if errors else OK
    verdict = "does not work" if errors else "works"
    got = f"; the reference gets {reference.points:g}" if reference is not None else ""
    console.print(verdict, style=style, end="")
    console.print(f": {rubric.name}, {tests}, {rubric.points:g} points{got}", soft_wrap=True)


def trials(rubric: Rubric, made: Sequence[Trial]) -> None:
    """Print the marks of motions that are made from the reference."""
    if not made:
        return
    table = Table("made from the reference", "points", "tests that earn points", box=None)
    table.columns[1].justify = "right"
    for trial in made:
        earned = [f"{m.name} {m.points:g}" for m in trial.marks.tests if m.points]
        whole = trial.marks.points >= rubric.points
        shown = "all" if whole else ", ".join(earned)
        table.add_row(trial.name, f"{trial.marks.points:g}/{rubric.points:g}", shown)
    console = output.console(width=output.REPORT_WIDTH)
    console.print()
    console.print(table)


def measures() -> None:
    """Print all forms of `expect`, by families."""
    console = output.console(width=output.REPORT_WIDTH)
    for family, forms in FAMILIES.items():
        console.print(family, style="bold")
        table = Table(box=None, show_header=False, padding=(0, 2))
        table.add_column(min_width=38, overflow="fold")
        table.add_column()
        for form in forms:
            rule = f" Partial: {', '.join(form.rules)}." if form.rules else ""
            table.add_row(form.text, f"{form.about}{rule}")
        console.print(table)
