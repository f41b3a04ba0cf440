"""`mrlab show`: one HTML file that shows a motion or a recorded session. Needs no running lab."""

from __future__ import annotations

import json
import os
import sys
import tempfile
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from mrlab_ros.commands.convert.options import ModelOfFile, ToolOfFile, with_options
from mrlab_ros.commands.diagnostics import BAG_OF_REPORT_GONE, PAGE_NAME, REPORT_WITHOUT_BAG
from mrlab_ros.commands.output import AsJson
from mrlab_ros.core.base.errors import BadInput, WrongUsage
from mrlab_ros.core.conversion.options import Options

if TYPE_CHECKING:
    from mrlab_ros.core.conversion.convert import ConversionResult


@with_options
def show(
    options: Options,
    file: Annotated[
        Path,
        typer.Argument(help="Workspace, table, trajectory file, recorded bag, or its report."),
    ],
    robot: ModelOfFile = "",
    end_effector: ToolOfFile = "",
    output: Annotated[
        Path | None,
        typer.Option("--out", "--output", "-o", help="The page; none: FILE with .html, here."),
    ] = None,
    opened: Annotated[
        bool, typer.Option("--open/--no-open", help="Open the page where there is a desktop.")
    ] = True,
    as_json: AsJson = False,
) -> None:
    """Write a page that shows FILE in 3D: a motion, a file that was refused, or a session.

    The page is one file without anything from outside: it opens from a disk, a stick or a mail.
    For a file that is refused it is written all the same, and the command ends as mrlab convert.
    """
    path = output or Path(f"{file.name.split('.')[0] or 'motion'}.html")
    if path.suffix.lower() not in (".html", ".htm"):
        raise WrongUsage(PAGE_NAME(name=path.name))
    from mrlab_ros.adapters.whole_file import write_text
    from mrlab_ros.commands.convert import report

    text, result = _page(file, robot, end_effector, options)
    write_text(path, text)
    if as_json:
        refused = result is not None and result.trajectory is None
        found = report.record(str(file), result, None) if result is not None else {}
        print(json.dumps({"page": str(path.resolve()), "refused": refused, **found}))
    else:
        print(f"{path} ({len(text) / 1e6:.2f} MB)")
    desktop = os.environ.get("DISPLAY") or os.environ.get("WAYLAND_DISPLAY")
    if opened and desktop and sys.stdout.isatty():
        typer.launch(str(path.resolve()))
    if result is not None and result.trajectory is None:
        from mrlab_ros.commands.convert.outcomes import exit_code

        if not as_json:
            words = ["mrlab", "show", str(file), "--robot", robot]
            words += ["--end-effector", end_effector] if end_effector else []
            words += ["--out", str(output)] if output else []
            report.show(result, None, words, options)
        raise typer.Exit(exit_code(result))


def _page(
    file: Path, robot: str, end_effector: str, options: Options
) -> tuple[str, ConversionResult | None]:
    """Return the page, and what became of the file; None for a recorded session."""
    from mrlab_ros.adapters import share
    from mrlab_ros.adapters.robots.library import RobotLibrary
    from mrlab_ros.app.convert import converted
    from mrlab_ros.app.show.motion import motion_page

    folder = share.directory()
    recorded = _recorded(file)
    if recorded is not None:
        return recorded, None
    library = RobotLibrary(folder / "robots")
    result = converted(file, robot, end_effector, options, library)
    if result.trajectory is not None:
        robot = robot or result.trajectory.robot_model
        end_effector = end_effector or result.trajectory.end_effector or ""
    return motion_page(result, robot, end_effector or None, library, folder), result


def _recorded(file: Path) -> str | None:
    """Return the page of a session, or None: it is another file, or a bag of a mere trajectory."""
    from mrlab_ros.commands import sandboxed

    path = bag_at(file)
    if path is None:
        return None
    with tempfile.TemporaryDirectory(prefix="mrlab-") as folder:
        page = Path(folder, "page.html")
        shown = sandboxed.run(
            session_of, str(path), str(page), name=path.name, read=[path], write=[Path(folder)]
        )
        return page.read_text(encoding="utf-8") if shown else None


def session_of(bag: str, page: str) -> bool:
    """Write the page of a session; return whether the bag holds one, not a mere trajectory."""
    from mrlab_ros.adapters import share
    from mrlab_ros.app.show.session import session_page
    from mrlab_ros.commands.bag import opened

    found = opened(bag)
    lab = any(topic.type == "mrlab_msgs/msg/Robots" for topic in found.topics.values())
    if not lab and not Path(bag).is_dir():
        return False
    Path(page).write_text(session_page(found, share.directory()), encoding="utf-8")
    return True


def bag_at(file: Path) -> Path | None:
    """Return where a bag lies that is named by itself or by its report; None: no bag."""
    from mrlab_ros.commands.bag import path_of

    path = _bag_of_report(file) or path_of(str(file))
    return path if path.is_dir() or path.suffix in (".mcap", ".db3") else None


def _bag_of_report(file: Path) -> Path | None:
    """Return the bag of what `mrlab bag report --out` wrote: a folder or its report.json."""
    path = file / "report.json" if file.is_dir() else file
    if path.name != "report.json" or not path.is_file():
        return None
    try:
        bag = Path(json.loads(path.read_bytes())["bag"])
    except (ValueError, KeyError, TypeError):
        raise BadInput(REPORT_WITHOUT_BAG(path=str(path))) from None
    if not bag.exists():
        raise BadInput(BAG_OF_REPORT_GONE(path=str(path), bag=str(bag)))
    return bag
