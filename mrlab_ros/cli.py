"""The `mrlab` command. What a command needs is imported when it runs, so that help is quick."""

from __future__ import annotations

import os
import signal
import sys
from collections.abc import Sequence
from types import FrameType
from typing import Annotated

if __name__ == "__main__":
    # Until main() a Ctrl-C ends the program: within an import it would print a traceback.
    signal.signal(signal.SIGINT, signal.SIG_DFL)

import typer

import mrlab_ros
from mrlab_ros.adapters.sandbox.inert_output import guard
from mrlab_ros.adapters.sandbox.python_process import keep_to_installed_modules
from mrlab_ros.commands import completion
from mrlab_ros.commands.output import BROKEN, WRONG_USAGE, Settings, say_problem
from mrlab_ros.core.base.diagnostic import Diagnostic
from mrlab_ros.core.base.errors import LabError, WrongUsage
from mrlab_ros.extensions import extensions, named

EPILOG = """
**First steps**

mrlab demo — see everything once: convert, two robots, play, zenoh

mrlab up --robots ur5e — start a lab with a robot; stays until Ctrl-C

mrlab convert run.mat --robot ur5e — what is in a file, and is it right for this robot?

mrlab show run.mat --robot ur5e — see it move, as one HTML file

mrlab check run.mat --robot ur5e --scene table — is it ready for a robot, and why not?

mrlab capture /joint_states --robot ur5e --against run.mat — what did the real robot do?

mrlab play ur5e_1 run.mat — play it (in a second terminal, same ROS_DOMAIN_ID)

mrlab pause ur5e_1, resume, stop, seek, place, remove — one robot; mrlab system for several

mrlab record class.bag — write down what happens; mrlab replay class.bag brings it back

mrlab status — what runs, and how well; mrlab doctor — what keeps it from running

**Exit codes**: 0 done, 1 failed (one sentence says why), 2 wrong usage or a choice that
is yours, 3 an error of MR-Lab itself, or a missing package, 130 interrupted
"""

# A negative number is no option of these.
TAKE_NEGATIVE = ("rate", "seek")
NEGATIVE = {"ignore_unknown_options": True}
PANELS = {"mrlab_ros.commands.lab.robot": "One robot of the running lab"}
# Modules of the commands of the lab, and of a group its Typer, in the order of the help.
OWN = {
    "up": "up.command:up",
    "demo": "demo.command:demo",
    "convert": "convert.command:convert",
    "show": "show:show",
    "export": "export:export",
    "check": "check.command:check",
    "capture": "compare:capture",
    "compare": "compare:compare",
    "play": "lab.play:play",
    "spawn": "lab.robot:spawn",
    "remove": "lab.robot:remove",
    "place": "lab.robot:place",
    "tool": "lab.robot:tool",
    "load": "lab.robot:load",
    "pause": "lab.robot:pause",
    "resume": "lab.robot:resume",
    "stop": "lab.robot:stop",
    "seek": "lab.robot:seek",
    "rate": "lab.robot:rate",
    "loop": "lab.robot:loop",
    "record": "lab.record:record",
    "replay": "lab.replay:replay",
    "status": "status.command:status",
    "doctor": "doctor:doctor",
    "open": "open:open_pages",
    "bag": "bag:app",
    "keys": "keys:app",
    "robots": "robots:app",
    "system": "lab.system:app",
    "scene": "lab.scene:scene",
    "objects": "lab.scene:objects",
    "users": "users:app",
}
COMMANDS = {name: f"mrlab_ros.commands.{where}" for name, where in OWN.items()}
for _extension in extensions():
    COMMANDS |= _extension.COMMANDS


def make_app(words: Sequence[str] = (), *, completing: bool = False) -> typer.Typer:
    """Return the command line; of `words` that begin with a command, with that command alone.

    One command's imports take a fifth of those of all. completing: it is asked what the words may
    go on with; without a command these are the names of all, and none is imported.
    """
    app = typer.Typer(
        name="mrlab",
        no_args_is_help=True,
        pretty_exceptions_enable=False,
        rich_markup_mode="markdown",
        epilog=EPILOG,
    )
    app.callback()(options)
    asked = next((word for word in words if not word.startswith("-")), "")
    if completing and asked not in COMMANDS:
        for name in COMMANDS:
            app.command(name)(lambda: None)
        return app
    for name in [asked] if asked in COMMANDS else COMMANDS:
        try:
            found = named(COMMANDS[name])
        except ModuleNotFoundError:
            if asked in COMMANDS:
                raise
            found = absent
        if isinstance(found, typer.Typer):
            app.add_typer(found, name=name)
        else:
            settings = NEGATIVE if name in TAKE_NEGATIVE else None
            app.command(
                name,
                rich_help_panel=PANELS.get(COMMANDS[name].partition(":")[0]),
                context_settings=settings,
            )(found)
    return app


def absent() -> None:
    """Needs ROS 2 and the lab's messages, which are not installed here."""


def _say_version(wanted: bool) -> None:
    if wanted:
        print(f"mrlab {mrlab_ros.__version__}")
        raise typer.Exit


def options(
    debug: Annotated[
        bool, typer.Option("--debug", help="Show where in the program an error arose.")
    ] = False,
    version: Annotated[
        bool,
        typer.Option("--version", help="Print the version.", callback=_say_version, is_eager=True),
    ] = False,
) -> None:
    """A mixed-reality robotics laboratory without robots: MATLAB programs become moving robots."""
    Settings.debug = debug


def main() -> None:
    """Run the command; an error becomes one sentence and an exit code."""
    # In the background of a script SIGINT is ignored at first, and SIGTERM would tidy nothing.
    for number in (signal.SIGINT, signal.SIGTERM):
        signal.signal(number, signal.default_int_handler)
    signal.signal(signal.SIGHUP, hang_up)
    guard()
    keep_to_installed_modules()
    # As pip installs a wheel: its files are in the index of packages below the prefix.
    os.environ.setdefault("AMENT_PREFIX_PATH", sys.prefix)
    if sys.argv[1:] == ["--version"]:  # at once: no command needs to be known for it
        print(f"mrlab {mrlab_ros.__version__}")
        return
    try:
        asked = completion.words()
        if asked is None:
            make_app(sys.argv[1:])(prog_name="mrlab")
        else:
            make_app(asked, completing=True)(prog_name="mrlab")
    except WrongUsage as error:
        fail(error.diagnostic, WRONG_USAGE)
    except LabError as error:
        fail(error.diagnostic)
    except KeyboardInterrupt:
        sys.exit(130)
    except ModuleNotFoundError as error:
        fail(without_graph(error), BROKEN)
    except (OSError, MemoryError) as error:
        fail(*refused(error))
    except Exception as error:
        fail(_fault(error), BROKEN)


def _fault(error: Exception) -> Diagnostic:
    from mrlab_ros.commands.diagnostics import COMMAND_FAULT

    return COMMAND_FAULT(error=f"{type(error).__name__}: {error}")


def refused(error: OSError | MemoryError) -> tuple[Diagnostic, int]:
    """Return what to do where the machine refuses, and the exit code: of other errors BROKEN."""
    from mrlab_ros.commands.diagnostics import DISK_REFUSES, UNNAMED_FILE
    from mrlab_ros.core.base.machine import lacking, remedy

    said = lacking(error)
    if isinstance(error, OSError) and (helps := remedy(error)) is not None:
        file = error.filename or UNNAMED_FILE()
        return DISK_REFUSES(file=file, why=error.strerror, remedy=helps), 1
    return (_fault(error), BROKEN) if said is None else (said, 1)


def without_graph(error: ModuleNotFoundError) -> Diagnostic:
    """Return what to do where a module is missing, of ROS 2 or another one."""
    from mrlab_ros.commands.diagnostics import MODULE_NOT_INSTALLED, NEEDS_ROS

    package = str(error.name).partition(".")[0]
    if package != "rclpy" and not package.endswith(("_msgs", "_interfaces")):
        return MODULE_NOT_INSTALLED(error=str(error))
    return NEEDS_ROS(package=package)


def hang_up(number: int, frame: FrameType | None) -> None:
    """End as at Ctrl-C where the terminal was closed; nothing can be written to it any more."""
    nowhere = os.open(os.devnull, os.O_RDWR)
    for descriptor in range(3):
        os.dup2(nowhere, descriptor)
    signal.default_int_handler(number, frame)


def fail(found: Diagnostic, code: int = 1) -> None:
    """Print what is wrong and the commands that mend it; end with `code`.

    What broke may be older than the sources, as after `git pull`.
    """
    say_problem(found)
    if code == BROKEN:
        from mrlab_ros.adapters.set_up import ROOT, outdated
        from mrlab_ros.core.runtime.diagnostics import SET_UP_OUTDATED

        if steps := outdated():
            say_problem(SET_UP_OUTDATED(folder=str(ROOT), steps=steps))
    sys.exit(code)


if __name__ == "__main__":
    main()
