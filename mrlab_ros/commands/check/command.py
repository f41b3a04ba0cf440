"""`mrlab check`: evidence of a motion before a robot moves, without a running lab."""

from __future__ import annotations

import re
from pathlib import Path
from typing import Annotated

import typer

from mrlab_ros.commands import completion
from mrlab_ros.commands.check.diagnostics import LENGTH_WITHOUT_UNIT, NO_LENGTH
from mrlab_ros.commands.convert.options import with_options
from mrlab_ros.commands.diagnostics import PAGE_NAME
from mrlab_ros.commands.output import say_problem
from mrlab_ros.core.base.errors import LabError, WrongUsage
from mrlab_ros.core.conversion.options import Options

COULD_NOT = 2
LENGTH = re.compile(r"\s*([0-9.]+)\s*(mm|cm|m)?\s*")
UNITS = {"mm": 1e-3, "cm": 1e-2, "m": 1.0, None: 1.0}
# A longer length, m, without its unit was meant in mm.
LONGEST_BARE = 0.5


@with_options
def check(
    options: Options,
    file: Annotated[
        Path, typer.Argument(help="Workspace, table or trajectory file; or a cell (.yaml).")
    ],
    robot: Annotated[
        str,
        typer.Option(
            help="Robot that the motion is for, such as ur5e.", autocompletion=completion.models
        ),
    ] = "",
    tool: Annotated[
        str,
        typer.Option(
            "--tool",
            "--end-effector",
            help="End effector; empty: that of the scene, or none.",
            autocompletion=completion.tools,
        ),
    ] = "",
    scene: Annotated[
        str, typer.Option(help="Scene that it moves in: a name, or a file; empty: a floor alone.")
    ] = "",
    points: Annotated[
        Path | None,
        typer.Option(help="CSV of points that tool0 shall pass, in order: x, y, z, m in world."),
    ] = None,
    within: Annotated[str, typer.Option(help="How near it shall pass them, such as 5mm.")] = "5mm",
    closest: Annotated[
        str,
        typer.Option(help="What comes nearer without touching is a warning; empty: 10mm."),
    ] = "",
    out: Annotated[
        Path | None, typer.Option("--out", "-o", help="Write a page with 3D and plots: FILE.html.")
    ] = None,
    as_json: Annotated[bool, typer.Option("--json", help="Print the report as JSON.")] = False,
) -> None:
    """Check whether a motion can run on a real robot: limits, collisions, grasps.

    The motion goes through the lab's physics headless, faster than real time. Ends with 0: no
    blocking findings, 1: blocking findings, 2: it could not be checked. The same inputs give the
    same hash.
    """
    from mrlab_ros.commands.check import run

    try:
        if out is not None and out.suffix.lower() not in (".html", ".htm"):
            raise WrongUsage(PAGE_NAME(name=out.name))
        request = run.Request(
            file, robot, tool, scene, points, metres(within, "within"),
            metres(closest, "closest") if closest else None, out, as_json, options,
        )  # fmt: skip
        code = run.run(request)
    except LabError as error:
        say_problem(error.diagnostic)
        raise typer.Exit(COULD_NOT) from None
    raise typer.Exit(code)


def metres(text: str, option: str) -> float:
    """Return a length with its unit in m; raise WrongUsage where it is none."""
    match = LENGTH.fullmatch(text)
    try:
        value = float(match[1]) * UNITS[match[2]] if match else -1.0
    except ValueError:
        value = -1.0
    if not 0 <= value <= 10:
        raise WrongUsage(NO_LENGTH(option=option, text=text))
    if match and not match[2] and value > LONGEST_BARE:
        raise WrongUsage(LENGTH_WITHOUT_UNIT(option=option, text=text))
    return value
