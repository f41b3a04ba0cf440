"""The `mrlab` command. What a command needs is imported when it runs, so that help is quick."""

from __future__ import annotations

import signal
import sys
import traceback
from typing import Annotated

import typer

from mrlab_ros.commands import bag, keys, robots, scene, system, users
from mrlab_ros.commands.convert.command import convert
from mrlab_ros.commands.demo.command import demo
from mrlab_ros.commands.open import open_pages
from mrlab_ros.commands.play import play
from mrlab_ros.commands.record import record
from mrlab_ros.commands.replay import replay
from mrlab_ros.commands.show import show
from mrlab_ros.commands.status import status
from mrlab_ros.commands.up.command import up
from mrlab_ros.core.errors import LabError

EPILOG = """
**First steps**

mrlab demo — see everything once: convert, two robots, play, zenoh

mrlab up --robots ur5e — start a lab with a robot; stays until Ctrl-C

mrlab convert run.mat --robot ur5e — what is in a file, and is it right for this robot?

mrlab show run.mat --robot ur5e — see it move, as one HTML file

mrlab play ur5e_1 run.mat — play it (in a second terminal, same ROS_DOMAIN_ID)

mrlab record class.bag — write down what happens; mrlab replay class.bag brings it back

mrlab status — what runs, and how well

**Exit codes**: 0 done, 1 failed (one sentence says why), 2 wrong usage or a choice that
is yours, 130 interrupted
"""

app = typer.Typer(
    name="mrlab",
    no_args_is_help=True,
    add_completion=False,
    pretty_exceptions_enable=False,
    rich_markup_mode="markdown",
    epilog=EPILOG,
)
for command in (up, demo, convert, show, play, record, replay, status):
    app.command(command.__name__)(command)
app.command("open")(open_pages)
app.add_typer(bag.app, name="bag")
app.add_typer(keys.app, name="keys")
app.add_typer(robots.app, name="robots")
app.add_typer(system.app, name="system")
app.add_typer(scene.scene, name="scene")
app.add_typer(scene.objects, name="objects")
app.add_typer(users.app, name="users")


class Settings:
    """What holds for every command."""

    debug = False


@app.callback()
def options(
    debug: Annotated[
        bool, typer.Option("--debug", help="Show where in the program an error arose.")
    ] = False,
) -> None:
    """A mixed-reality robotics laboratory without robots: MATLAB programs become moving robots."""
    Settings.debug = debug


def main() -> None:
    """Run the command; an error becomes one sentence and exit code 1."""
    # In the background of a script SIGINT is ignored at first, and SIGTERM would tidy nothing.
    for number in (signal.SIGINT, signal.SIGTERM):
        signal.signal(number, signal.default_int_handler)
    try:
        app(prog_name="mrlab")
    except LabError as error:
        fail(str(error))
    except KeyboardInterrupt:
        sys.exit(130)
    except Exception as error:
        fail(f"{type(error).__name__}: {error}; mrlab --debug ... shows where")


def fail(sentence: str) -> None:
    """Print one sentence, with the traceback under --debug, and end with 1."""
    if Settings.debug:
        traceback.print_exc()
    print(f"mrlab: {sentence}", file=sys.stderr)
    sys.exit(1)


if __name__ == "__main__":
    main()
