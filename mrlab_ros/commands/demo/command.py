"""`mrlab demo`: the whole lab once, from a workspace file to frames received over zenoh."""

from __future__ import annotations

import json
import sys
import time
from contextlib import ExitStack
from pathlib import Path
from typing import Annotated

import typer

from mrlab_ros.commands import output
from mrlab_ros.commands.diagnostics import NO_DEMO_FILE
from mrlab_ros.commands.up.surroundings import stop_signals
from mrlab_ros.core.base.errors import BadInput


def demo(
    once: Annotated[
        bool, typer.Option("--once", help="End when the run is over, with its verdict.")
    ] = False,
    file: Annotated[
        Path | None, typer.Option(help="Play this workspace file on one robot instead.")
    ] = None,
    robot: Annotated[str, typer.Option(help="The robot that --file is for.")] = "ur5e",
    end_effector: Annotated[str, typer.Option(help="Its end effector; empty: none.")] = "",
    config: Annotated[
        Path | None, typer.Option(help="ROS parameter file; the shipped lab.yaml if not given.")
    ] = None,
    as_json: Annotated[
        bool, typer.Option("--json", help="Print the summary as JSON; all else goes to stderr.")
    ] = False,
) -> None:
    """Show the whole lab at work: a MATLAB file becomes robots that move.

    Starts a lab of its own on a free ROS domain and a free zenoh port, converts the shipped
    hand-over, puts two robots in the scene, lets them play as one system, and counts what arrives
    over zenoh. It stays up until Ctrl-C, and opens its pages where there is a display.

    Ends with 0 when every frame arrived, 1 when anything failed, 130 when interrupted before.
    """

    from mrlab_ros.adapters import share
    from mrlab_ros.commands.demo.lab import running_lab
    from mrlab_ros.commands.demo.report import (
        facts,
        judge,
        print_next_steps,
        print_summary,
    )
    from mrlab_ros.commands.demo.run import (
        DemoRobot,
        Run,
        Stopped,
        handover,
    )

    parts = handover(share.directory() / "examples")
    if file is not None:
        parts = [DemoRobot(file.resolve(), robot, end_effector)]
    for part in parts:
        if not part.file.is_file():
            raise BadInput(NO_DEMO_FILE(path=str(part.file)))
    console = output.console(stderr=as_json)
    with ExitStack() as stack:
        stop = stack.enter_context(stop_signals())
        try:
            stage = stack.enter_context(running_lab(console, config))
            if not once:
                stage.show(console)
            summaries = Run(console, stage, parts, stop).run()
        except Stopped:
            raise typer.Exit(130) from None
        if as_json:
            sys.stdout.write(json.dumps(facts(stage, summaries), indent=2) + "\n")
            sys.stdout.flush()
        else:
            print_summary(console, summaries)
        judge(summaries)
        took = time.monotonic() - stage.begin
        console.print("Every frame arrived.", style="bold green", end="")
        console.print(f" The demo took {took:.0f} s.")
        if not once:
            print_next_steps(console, stage, summaries)
            stage.log.speak = True
            stop.wait()
