"""The verbs for one robot of the running lab: spawn, place, load, pause, stop and so on."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import TYPE_CHECKING, Annotated

import typer

from mrlab_ros.commands import completion, output
from mrlab_ros.commands.convert.options import with_options
from mrlab_ros.commands.diagnostics import BAD_AT, YAW_WITHOUT_PLACE
from mrlab_ros.commands.output import AsJson, say
from mrlab_ros.core.base.errors import BadInput, WrongUsage
from mrlab_ros.core.conversion.options import Options

if TYPE_CHECKING:
    from mrlab_ros.client.lab import Lab
    from mrlab_ros.client.robot import LabRobot

Name = Annotated[
    str,
    typer.Argument(
        metavar="ROBOT",
        help="A robot of the scene, as ur5e_1.",
        autocompletion=completion.robots,
    ),
]
Yaw = Annotated[float, typer.Option(help="Turn about the vertical, degrees.")]


def spawn(
    model: Annotated[
        str,
        typer.Argument(
            metavar="MODEL",
            help="A robot model; mrlab robots lists them.",
            autocompletion=completion.models,
        ),
    ],
    at: Annotated[
        str, typer.Option("--at", help="Where its base goes, X,Y in m; not given: a free place.")
    ] = "",
    yaw: Yaw = 0.0,
    tool: Annotated[
        str,
        typer.Option(
            "--tool", help="An end effector; empty: none.", autocompletion=completion.tools
        ),
    ] = "",
    name: Annotated[str, typer.Option(help="Its name; empty: the model and a number.")] = "",
    as_json: AsJson = False,
) -> None:
    """Put a robot into the scene of the running lab."""
    from mrlab_ros.client.lab import Lab

    place = _place(at)[:2] if at else None
    if place is None and yaw:
        raise WrongUsage(YAW_WITHOUT_PLACE(yaw=yaw))
    with Lab() as lab:
        robot = lab.spawn(model, at=place, yaw=math.radians(yaw), end_effector=tool, name=name)
    _say(robot.name, robot.message, as_json=as_json)


def remove(robot: Name, as_json: AsJson = False) -> None:
    """Take a robot out of the scene."""
    _do(robot, lambda _, found: found.remove(), as_json=as_json)


def place(
    robot: Name,
    at: Annotated[str, typer.Option("--at", help="Where its base goes: X,Y or X,Y,Z in m.")],
    yaw: Yaw = 0.0,
    as_json: AsJson = False,
) -> None:
    """Move a robot's base to another place."""
    x, y, z = _place(at)
    _do(robot, lambda _, found: found.place(x, y, math.radians(yaw), z), as_json=as_json)


def tool(
    robot: Name,
    end_effector: Annotated[
        str,
        typer.Argument(
            help="An end effector; none: a bare flange.", autocompletion=completion.tools
        ),
    ] = "",
    as_json: AsJson = False,
) -> None:
    """Exchange a robot's end effector."""
    wanted = "" if end_effector == "none" else end_effector
    _do(robot, lambda _, found: found.set_end_effector(wanted), as_json=as_json)


@with_options
def load(
    options: Options,
    robot: Name,
    trajectory: Annotated[
        str, typer.Argument(help="A trajectory of the catalogue, or a file as for mrlab play.")
    ],
    as_json: AsJson = False,
) -> None:
    """Load a trajectory into a robot; mrlab resume then plays it."""

    def load_it(lab: Lab, found: LabRobot) -> str:

        from mrlab_ros.commands.lab.play import in_catalogue

        given = ["mrlab", "load", robot, trajectory]
        console = output.console(stderr=as_json)
        return found.load(in_catalogue(lab, found, trajectory, options, given, console))

    _do(robot, load_it, as_json=as_json)


def pause(robot: Name, as_json: AsJson = False) -> None:
    """Pause a robot; `mrlab resume` continues."""
    _do(robot, lambda _, found: found.pause(), as_json=as_json)


def resume(robot: Name, as_json: AsJson = False) -> None:
    """Play on from where a robot stands, or what is loaded, and do not wait for the end."""
    _do(robot, lambda _, found: found.resume(), as_json=as_json)


def stop(robot: Name, as_json: AsJson = False) -> None:
    """End a robot's run; after a collision its arm goes back to the first frame."""
    _do(robot, lambda _, found: found.stop(), as_json=as_json)


def seek(
    robot: Name,
    position: Annotated[float, typer.Argument(help="Place on the trajectory, s.")],
    as_json: AsJson = False,
) -> None:
    """Go to another place on the trajectory at once."""
    _do(robot, lambda _, found: found.seek(position), as_json=as_json)


def rate(
    robot: Name,
    speed: Annotated[
        float, typer.Argument(help="0.1 to 4; 1 is the declared speed, -1 the same backwards.")
    ],
    as_json: AsJson = False,
) -> None:
    """Set the speed at which a robot plays."""
    _do(robot, lambda _, found: found.set_speed(speed), as_json=as_json)


def loop(
    robot: Name,
    on: Annotated[bool, typer.Argument(help="true or false.")] = True,
    as_json: AsJson = False,
) -> None:
    """Have a robot start over after its last frame, or not."""
    _do(robot, lambda _, found: found.set_loop(on), as_json=as_json)


def _do(robot: str, work: Callable[[Lab, LabRobot], str], *, as_json: bool) -> None:
    from mrlab_ros.client.lab import Lab

    with Lab() as lab:
        said = work(lab, lab.robot(robot))
    _say(robot, said, as_json=as_json)


def _say(robot: str, message: str, *, as_json: bool) -> None:
    words = message if as_json or robot in message else f"{robot}: {message}"
    say(words, as_json=as_json, robot=robot)


def _place(text: str) -> tuple[float, float, float]:
    """Return X,Y or X,Y,Z as three numbers, z 0 where there is none; raise BadInput."""
    try:
        numbers = [float(part) for part in text.split(",")]
    except ValueError:
        numbers = []
    if len(numbers) not in (2, 3) or not all(map(math.isfinite, numbers)):
        raise BadInput(BAD_AT(found=text))
    x, y, *rest = numbers
    return x, y, rest[0] if rest else 0.0
