"""`mrlab rubric`: lint a rubric, mark a file by it, print an example and all measures."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Annotated

import typer

from mrlab_ros.commands.convert.options import with_options
from mrlab_ros.commands.diagnostics import PAGE_NAME
from mrlab_ros.commands.output import say_problem
from mrlab_ros.core.base.errors import LabError, Misuse
from mrlab_ros.core.conversion.options import Options

COULD_NOT = 2
app = typer.Typer(
    no_args_is_help=True, help="Named tests with points: lint, mark, example, measures."
)


@contextmanager
def _said() -> Iterator[None]:
    """Let what cannot be done end with 2, as in mrlab check."""
    try:
        yield
    except LabError as error:
        say_problem(error.diagnostic)
        raise typer.Exit(COULD_NOT) from None


@app.command()
@with_options
def lint(
    options: Options,
    rubric: Annotated[Path, typer.Argument(help="The rubric, a YAML file.")],
    as_json: Annotated[bool, typer.Option("--json", help="Print the flaws as JSON.")] = False,
) -> None:
    """Say what a rubric cannot measure, and run its reference solution, which must get full marks.

    Ends with 0: it works, 1: a flaw keeps points out of reach, 2: it could not be read.
    """
    from mrlab_ros.commands.rubric import run

    with _said():
        raise typer.Exit(run.lint(rubric, options, as_json=as_json))


@app.command()
@with_options
def mark(
    options: Options,
    file: Annotated[Path, typer.Argument(help="What is handed in: a motion, or a cell (.yaml).")],
    rubric: Annotated[Path, typer.Option("--rubric", "-r", help="The rubric, a YAML file.")],
    out: Annotated[
        Path | None,
        typer.Option("--out", "-o", help="Write a page, lost points on its timeline: FILE.html."),
    ] = None,
    report: Annotated[
        bool, typer.Option("--report", help="Print the report of the check before the marks.")
    ] = False,
    public: Annotated[
        bool,
        typer.Option("--public", help="As a student sees it: of hidden tests the hints alone."),
    ] = False,
    as_json: Annotated[bool, typer.Option("--json", help="Print the marks as JSON.")] = False,
) -> None:
    """Mark a file by a rubric: what each test found, and the instant of each lost point.

    Ends with 0: full marks, 1: points were lost, 2: it could not be marked.
    """
    from mrlab_ros.commands.rubric import run

    with _said():
        if out is not None and out.suffix.lower() not in (".html", ".htm"):
            raise Misuse(PAGE_NAME(name=out.name))
        raise typer.Exit(
            run.mark(file, rubric, options, out, report=report, public=public, as_json=as_json)
        )


@app.command()
def example(
    as_json: Annotated[bool, typer.Option("--json", help="Print what it holds as JSON.")] = False,
) -> None:
    """Print a rubric with comments, to begin with: mrlab rubric example > rubric.yaml."""
    from mrlab_ros.commands.rubric import run

    with _said():
        print(run.example(as_json=as_json), end="\n" if as_json else "")


@app.command()
def measures(
    as_json: Annotated[bool, typer.Option("--json", help="Print them as JSON.")] = False,
) -> None:
    """List everything that `expect` may say."""
    from mrlab_ros.commands.rubric import run, words

    if as_json:
        print(run.measures())
    else:
        words.measures()
