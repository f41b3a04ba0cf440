"""`mrlab class` marks all submissions of an export by a rubric; `mrlab rubric` is about rubrics.

`mrlab rubric` lints a rubric, marks a file by it, prints an example and lists all measures.
Neither needs a running lab.
"""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Annotated

import typer

from mrlab_ros.classroom.diagnostics import MATCH_NOT_READ, OPTION_OUT_OF_RANGE
from mrlab_ros.commands.convert.options import with_options
from mrlab_ros.commands.diagnostics import PAGE_NAME
from mrlab_ros.commands.output import say_problem
from mrlab_ros.core.base.errors import LabError, Misuse
from mrlab_ros.core.conversion.options import Options

COULD_NOT = 2
LEAST_MEMORY, LEAST_TIME, MOST_LIMIT = 512, 1.0, 1_000_000  # MiB, s, either
MOST_JOBS = 512


@with_options
def grade(
    options: Options,
    source: Annotated[
        Path,
        typer.Argument(
            metavar="FOLDER|ZIP",
            help="Export of Moodle, ILIAS, Canvas or Gradescope; or a folder or file a student.",
        ),
    ],
    rubric: Annotated[Path, typer.Option(help="Rubric by which all are marked (YAML).")],
    out: Annotated[
        Path | None, typer.Option("--out", "-o", help="Folder for pages and tables.")
    ] = None,
    jobs: Annotated[int, typer.Option(help="Processes that check; 0: one a processor.")] = 0,
    backend: Annotated[str, typer.Option(help="loky (this machine), dask or ray.")] = "loky",
    scheduler: Annotated[
        str, typer.Option(help="Address of a running dask or ray cluster.", metavar="ADDRESS")
    ] = "",
    pseudonyms: Annotated[
        bool, typer.Option("--pseudonyms", help="Replace names; who is who stays beside --out.")
    ] = False,
    as_json: Annotated[bool, typer.Option("--json", help="Print class.json.")] = False,
    fresh: Annotated[bool, typer.Option("--fresh", help="Check everything again.")] = False,
    csv_template: Annotated[
        Path | None,
        typer.Option(help="Table of Moodle, Canvas or ILIAS (CSV), to be filled."),
    ] = None,
    form: Annotated[
        str,
        typer.Option(
            help="Form of the export where the recognised one is wrong: moodle, ilias, canvas, "
            "gradescope or folder."
        ),
    ] = "",
    match: Annotated[
        list[str] | None,
        typer.Option(
            help="A file or student that could not be matched, and who it is; repeatable.",
            metavar="WHAT=WHO",
        ),
    ] = None,
    accept: Annotated[
        bool, typer.Option("--accept", help="Take all proposals for what could not be matched.")
    ] = False,
    pages: Annotated[
        bool, typer.Option("--pages/--no-pages", help="A page with 3D for each student.")
    ] = True,
    memory: Annotated[int, typer.Option(help="MiB that one submission may take.")] = 3072,
    time_limit: Annotated[
        float, typer.Option(help="Seconds of a processor that one submission may take.")
    ] = 60.0,
) -> None:
    """Mark a class: a row a student, a column a test, tables for the gradebook.

    Names stay on this machine. What is checked is kept: after an interruption the same command
    goes on where it was. Ends with 0: all are checked, 1: a check failed, 2: nothing was done.
    """
    from mrlab_ros.adapters import share
    from mrlab_ros.app.check.file import scene_of
    from mrlab_ros.classroom import run
    from mrlab_ros.classroom.mark import read_rubric
    from mrlab_ros.classroom.setup import Bounds, MiB
    from mrlab_ros.classroom.who import Decisions

    try:
        for option, value, least, most in (
            ("memory", memory, LEAST_MEMORY, MOST_LIMIT),
            ("time-limit", time_limit, LEAST_TIME, MOST_LIMIT),
            ("jobs", jobs, 0, MOST_JOBS),
        ):
            if not least <= value <= most:
                raise Misuse(
                    OPTION_OUT_OF_RANGE(option=option, value=value, least=least, most=most)
                )
        matches = [each.rpartition("=") for each in match or ()]
        for each in matches:
            if not each[1]:
                raise Misuse(MATCH_NOT_READ(found=each[2]))
        read = read_rubric(rubric)
        setup = run.of_rubric(
            read,
            scene_of(read.scene, share.directory()),
            options,
            Bounds(memory * MiB, time_limit),
            pages=pages,
        )
        request = run.Request(
            source, setup, out or source.with_name(f"{source.stem}-marked"), jobs, backend,
            scheduler, pseudonyms, as_json, fresh, csv_template, run.form_of(form),
            decisions=Decisions(tuple((what, who) for what, _, who in matches), accept),
        )  # fmt: skip
        code = run.run(request)
    except LabError as error:
        say_problem(error.diagnostic)
        raise typer.Exit(COULD_NOT) from None
    raise typer.Exit(code)


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
    from mrlab_ros.classroom import rubric_run

    with _said():
        raise typer.Exit(rubric_run.lint(rubric, options, as_json=as_json))


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
    from mrlab_ros.classroom import rubric_run

    with _said():
        if out is not None and out.suffix.lower() not in (".html", ".htm"):
            raise Misuse(PAGE_NAME(name=out.name))
        raise typer.Exit(
            rubric_run.mark(
                file, rubric, options, out, report=report, public=public, as_json=as_json
            )
        )


@app.command()
def example(
    as_json: Annotated[bool, typer.Option("--json", help="Print what it holds as JSON.")] = False,
) -> None:
    """Print a rubric with comments, to begin with: mrlab rubric example > rubric.yaml."""
    from mrlab_ros.classroom import rubric_run

    with _said():
        print(rubric_run.example(as_json=as_json), end="\n" if as_json else "")


@app.command()
def measures(
    as_json: Annotated[bool, typer.Option("--json", help="Print them as JSON.")] = False,
) -> None:
    """List everything that `expect` may say."""
    from mrlab_ros.classroom import rubric_run, words

    if as_json:
        print(rubric_run.measures())
    else:
        words.measures()
