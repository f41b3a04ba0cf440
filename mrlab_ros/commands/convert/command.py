"""`mrlab convert`: workspace files to trajectories, without a running lab."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from mrlab_ros.adapters.workspaces import workers
from mrlab_ros.commands import completion
from mrlab_ros.commands.convert.options import with_options
from mrlab_ros.core.conversion.options import Options


@with_options
def convert(
    options: Options,
    robot: Annotated[
        str,
        typer.Option(
            help="Robot that the trajectory is for, such as ur5e.",
            autocompletion=completion.models,
        ),
    ],
    files: Annotated[
        list[Path] | None, typer.Argument(help="Workspace files, bags, or folders of them.")
    ] = None,
    topic: Annotated[
        str,
        typer.Option(
            help="Take the next JointTrajectory of this topic; with a bag, its messages there."
        ),
    ] = "",
    timeout: Annotated[float, typer.Option(help="How long to wait for the topic, s.")] = 10.0,
    end_effector: Annotated[
        str, typer.Option(help="End effector; empty: none.", autocompletion=completion.tools)
    ] = "",
    out: Annotated[Path | None, typer.Option(help="Folder for what is written.")] = None,
    to: Annotated[str, typer.Option(help="json, csv, mat, npz or jointtrajectory.")] = "json",
    force: Annotated[
        bool, typer.Option("--force", help="Replace files that exist; never one of the inputs.")
    ] = False,
    plot: Annotated[
        Path | None, typer.Option(help="Write plots: a .png, .svg or .html with 3D, or a folder.")
    ] = None,
    as_json: Annotated[bool, typer.Option("--json", help="One JSON object a file.")] = False,
    memory: Annotated[int, typer.Option(help="Memory limit for reading a file, MiB.")] = 1024,
    time_limit: Annotated[float, typer.Option(help="Time limit for reading a file, s.")] = 20.0,
    row_limit: Annotated[
        int, typer.Option(min=2, help="Limit on the samples of a trajectory.")
    ] = 5_000_000,
) -> None:
    """Find the trajectory in a workspace, table or bag, check it against a robot, write it out.

    Ends with 0 when every file was accepted, 2 when you must choose, 1 when one was rejected.
    """
    if files:
        workers.begin()
    from mrlab_ros.commands.convert import batch  # numpy and others; not for a mere --help

    request = batch.Request(
        files=files or [],
        topic=topic,
        timeout=timeout,
        robot=robot,
        options=options,
        end_effector=end_effector,
        out=out,
        to=to,
        force=force,
        plot=plot,
        as_json=as_json,
        memory=memory,
        time_limit=time_limit,
        row_limit=row_limit,
    )
    raise typer.Exit(batch.run(request))


if __name__ == "__main__":
    typer.run(convert)
