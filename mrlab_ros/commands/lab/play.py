"""`mrlab play`: one trajectory on one robot of the running lab."""

from __future__ import annotations

import json
import time
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from mrlab_ros.commands import completion, output
from mrlab_ros.commands.convert.options import FIELDS, with_options, words_of
from mrlab_ros.commands.diagnostics import ONLY_FOR_A_FILE
from mrlab_ros.commands.output import say
from mrlab_ros.core.base.errors import WrongUsage
from mrlab_ros.core.conversion.options import Options

if TYPE_CHECKING:
    from rich.console import Console

    from mrlab_ros.client.lab import Lab
    from mrlab_ros.client.robot import LabRobot, Run

# Endings of file names, also of files that do not exist.
ENDINGS = (
    *(".mat", ".csv", ".txt", ".tsv", ".lvm", ".npz", ".npy", ".m", ".json", ".mcap", ".db3"),
    *(".gz", ".zst", ".zstd"),
)


@with_options
def play(
    options: Options,
    robot: Annotated[
        str,
        typer.Argument(
            help="A robot of the scene, such as ur5e_1.", autocompletion=completion.robots
        ),
    ],
    trajectory: Annotated[
        str,
        typer.Argument(
            help="A trajectory of the catalogue, or a file: a workspace, a table, a trajectory "
            "file or a bag. Not given: what is loaded."
        ),
    ] = "",
    speed: Annotated[
        float | None,
        typer.Option(help="Speed, 0.1 to 4; 1 is the declared one, -1 the same backwards."),
    ] = None,
    loop: Annotated[
        bool, typer.Option("--loop", help="Begin again after the last frame.")
    ] = False,
    wait: Annotated[
        bool, typer.Option("--wait/--no-wait", help="Follow the motion to its end.")
    ] = True,
    as_json: Annotated[
        bool, typer.Option("--json", help="Print one JSON object a state.")
    ] = False,
) -> None:
    """Play a trajectory on a robot and follow it to the end.

    A file is converted for the robot first, with the options of mrlab convert. Ctrl-C ends the
    following, not the motion. Ends with 0 when the last frame was played, 2 when the file needs a
    choice, 1 when something kept it from that.
    """

    from mrlab_ros.client.lab import Lab

    console = output.console(stderr=as_json)
    with Lab() as lab:
        found = lab.robot(robot)
        if trajectory:
            pace = ["--speed", f"{speed:g}"] if speed is not None else []
            given = ["mrlab", "play", robot, trajectory, *pace, *(["--loop"] if loop else [])]
            motion = in_catalogue(lab, found, trajectory, options, given, console)
            run = found.play(motion, speed=1.0 if speed is None else speed, loop=loop)
        else:
            _check_no_file_options(options)
            run = found.run() or found.play(speed=speed, loop=loop)
        if not wait:
            # The state that names a motion just loaded may still be on its way.
            name = motion if trajectory else run.follower.state.trajectory_id
            say(f"{robot} plays {name}", as_json=as_json, robot=robot, trajectory=name)
            return
        try:
            follow(console, run, as_json=as_json)
        except KeyboardInterrupt:
            console.print(
                f"{robot} plays on; end it with: mrlab pause {robot}, or mrlab stop {robot}"
            )
            raise typer.Exit(130) from None


def is_file(trajectory: str) -> bool:
    """Return whether this names a file or a folder and no trajectory of the catalogue."""
    path = Path(trajectory)
    if path.suffix.lower() in ENDINGS or path.is_dir():
        return True
    return ("/" in trajectory or path.suffix != "") and path.exists()


def in_catalogue(
    lab: Lab,
    robot: LabRobot,
    trajectory: str,
    options: Options,
    given: list[str],
    console: Console,
) -> str:
    """Return the trajectory's id; convert it first where it is a file, and say what was doubted.

    given: the words of the command, without `options`. A file that is refused is reported with its
    findings and the commands that mend it; the command then ends as mrlab convert does.
    """
    if not is_file(trajectory):
        _check_no_file_options(options, trajectory)
        return trajectory
    from mrlab_ros.client.lab import FileRefused

    try:
        motion = lab.convert(trajectory, robot, options)
    except FileRefused as refusal:
        from mrlab_ros.commands.convert import report
        from mrlab_ros.commands.convert.outcomes import exit_code

        report.show(refusal.result, None, given, options, console)
        raise typer.Exit(exit_code(refusal.result)) from None
    if doubted := [finding for finding in motion.findings if finding.remedy or finding.severity]:
        from mrlab_ros.commands.convert import report

        report.show_findings(doubted, console)
    return motion.id


def _check_no_file_options(options: Options, trajectory: str = "") -> None:
    """Raise Misuse where there are options of a conversion and nothing to convert."""
    if given := words_of(options):
        speed = "--speed" if f"--{_rate_option()}" in given else None
        raise WrongUsage(ONLY_FOR_A_FILE(option=given[0], trajectory=trajectory, speed=speed))


def _rate_option() -> str:
    return next(option for option, field in FIELDS.items() if field == "frame_rate")


def follow(console: Console, run: Run, *, as_json: bool = False) -> None:
    """Show a run until its last frame; raise LabError where it ends before."""
    from rich.progress import BarColumn, Progress, TextColumn

    from mrlab_ros.client.follow import milliseconds

    follower = run.follower
    label = ""
    columns = (
        TextColumn("{task.description}", markup=False),
        BarColumn(),
        TextColumn("{task.fields[words]}", markup=False),
    )
    plain = as_json or not console.is_terminal
    with Progress(*columns, console=console, disable=plain) as bar:
        task = bar.add_task(follower.robot, words="")
        while not run.complete:
            for state in run.advance():
                if state.label != label:
                    _say_state(console, follower.robot, state, plain=plain, as_json=as_json)
                label = state.label
            state = follower.state
            words = f"{state.label}  frame {follower.frame} of {state.frame_count}"
            if follower.errors:
                words += f"  {milliseconds(follower.errors[-1])} late"
            total = max(state.frame_count - 1, 1)
            bar.update(task, completed=follower.frame, total=total, words=words)
            time.sleep(0.05)
    console.print(
        f"{follower.robot} played {state.frame_count} frames; deadline error p50 "
        f"{milliseconds(follower.error_p50)}, max {milliseconds(follower.error_max)}, "
        f"{follower.frames_lost} frames left out"
    )


def _say_state(console: Console, robot: str, state: Any, *, plain: bool, as_json: bool) -> None:
    if as_json:
        facts = {"robot": robot, "state": state.label, "message": state.message}
        print(json.dumps({**facts, "frame": state.frame}), flush=True)
    elif plain:
        console.print(f"{robot} {state.label} {state.message}".rstrip())
