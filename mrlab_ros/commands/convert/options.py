"""The options of a conversion, declared once for every command that converts a file."""

from __future__ import annotations

import functools
import inspect
from collections.abc import Callable
from pathlib import Path
from typing import Annotated, Any

import typer

from mrlab_ros.commands import completion
from mrlab_ros.core.base.foreign_text import for_shell
from mrlab_ros.core.conversion.options import Options

# Of commands that take files of motions and recorded bags alike.
ModelOfFile = Annotated[
    str,
    typer.Option(
        help="Robot that a workspace or a table is for, such as ur5e.",
        autocompletion=completion.models,
    ),
]
ToolOfFile = Annotated[
    str, typer.Option(help="End effector; empty: none.", autocompletion=completion.tools)
]

# Options of the command line whose field of Options is called otherwise.
FIELDS = {"rate": "frame_rate"}


def declared(
    variable: Annotated[str, typer.Option(help="The matrix to take, as MATLAB writes it.")] = "",
    columns: Annotated[str, typer.Option(help="Columns that hold the joints: 2:7.")] = "",
    transpose: Annotated[bool, typer.Option("--transpose", help="Samples are columns.")] = False,
    degrees: Annotated[bool, typer.Option("--degrees", help="Values are degrees.")] = False,
    unwrap: Annotated[bool, typer.Option("--unwrap", help="Remove jumps of 2*pi.")] = False,
    units: Annotated[
        str, typer.Option(help="Unit of the joints: rad, deg, mm or counts:N a turn.")
    ] = "",
    join: Annotated[str, typer.Option(help="Join variables, such as q1..q6 or a,b.")] = "",
    gripper: Annotated[
        str, typer.Option(help="Column or variable that holds the gripper, or none.")
    ] = "",
    invert: Annotated[
        bool, typer.Option("--invert", help="Larger means an open gripper.")
    ] = False,
    resample: Annotated[
        bool, typer.Option("--resample", help="Make rows at uneven times even.")
    ] = False,
    rate: Annotated[
        float, typer.Option(help="Frames a second of the file; 0: as it says, or 100.")
    ] = 0.0,
) -> None:
    """Declare the options; the parameters are what counts."""


def with_options(command: Callable[..., None]) -> Callable[..., None]:
    """Give a command the options of a conversion; it gets them as `options`, one Options."""
    own = inspect.signature(command, eval_str=True).parameters.values()
    shared = inspect.signature(declared, eval_str=True).parameters

    @functools.wraps(command)
    def wrapped(**given: Any) -> None:
        values = {FIELDS.get(name, name): given.pop(name) for name in shared}
        command(options=Options(**values), **given)

    parameters = [
        parameter.replace(kind=inspect.Parameter.KEYWORD_ONLY)
        for parameter in (*(p for p in own if p.name != "options"), *shared.values())
    ]
    wrapped.__signature__ = inspect.Signature(parameters)  # type: ignore[attr-defined]
    wrapped.__annotations__ = {p.name: p.annotation for p in parameters}
    return wrapped


def option_words(field: str, value: str) -> list[str]:
    """Return a field of a conversion and its value as words of the command line."""
    name = next((option for option, renamed in FIELDS.items() if renamed == field), field)
    words = [f"--{name}"]
    if not isinstance(getattr(Options(), field), bool):
        words.append(value)
    return words


def words_of(options: Options) -> list[str]:
    """Return the options that were given as words of the command line."""
    given = {k: v for k, v in vars(options).items() if v != getattr(Options(), k)}
    return [
        word
        for field, value in given.items()
        for word in option_words(field, f"{value:g}" if isinstance(value, float) else str(value))
    ]


def command_with(words: list[str], options: Options, field: str, value: str) -> str:
    """Return the command that repeats `words` with the options given and one more.

    value: empty leaves the option out.
    """
    kept = [each for each in vars(options) if each != field]
    rest = Options(**{each: getattr(options, each) for each in kept})
    more = option_words(field, value) if value else []
    return for_shell([*words, *words_of(rest), *more])


def convert_words(file: Path | str, robot: str, end_effector: str = "") -> list[str]:
    """Return the words of the command that converts `file` for a robot model."""
    tool = ["--end-effector", end_effector] if end_effector else []
    return ["mrlab", "convert", str(file), "--robot", robot, *tool]
