"""`mrlab class`: marks all submissions of an export by a rubric, without a running lab."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from mrlab_ros.commands.classroom.diagnostics import OPTION_OUT_OF_RANGE
from mrlab_ros.commands.convert.options import with_options
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
        typer.Option(help="Moodle's grading worksheet, to be filled by its identifiers."),
    ] = None,
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
    from mrlab_ros.adapters.rubrics import files
    from mrlab_ros.app.check.file import scene_of
    from mrlab_ros.commands.classroom import run
    from mrlab_ros.commands.classroom.setup import Bounds, MiB

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
        read = files.read(rubric)
        setup = run.of_rubric(
            read,
            scene_of(read.scene, share.directory()),
            options,
            Bounds(memory * MiB, time_limit),
            pages=pages,
        )
        request = run.Request(
            source, setup, out or source.with_name(f"{source.stem}-marked"), jobs, backend,
            scheduler, pseudonyms, as_json, fresh, csv_template,
        )  # fmt: skip
        code = run.run(request)
    except LabError as error:
        say_problem(error.diagnostic)
        raise typer.Exit(COULD_NOT) from None
    raise typer.Exit(code)
