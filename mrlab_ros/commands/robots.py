"""`mrlab robots`: the robot models: list, show, sheet, check, import, export, ..."""

from __future__ import annotations

import json
import math
import os
import sys
import tempfile
from collections.abc import Iterable
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from mrlab_ros.adapters import share
from mrlab_ros.commands import output
from mrlab_ros.commands.diagnostics import (
    AS_TOOL_WITHOUT,
    BAD_ANGLES,
    BAD_PACKAGE_OPTION,
    MESHES_INSTALLED,
    MESHES_NOT_INSTALLED,
    MODEL_REMOVED,
    OWN_MESHES_AGAIN,
    ROBOT_NOT_IMPORTED,
    ROBOTS_HAVE_ERRORS,
)
from mrlab_ros.commands.output import AsJson, print_findings, say
from mrlab_ros.core.base.diagnostic import Fix, Severity, plain
from mrlab_ros.core.base.errors import BadInput, WrongUsage
from mrlab_ros.core.base.foreign_text import for_shell

if TYPE_CHECKING:
    from mrlab_ros.adapters.robots.importing.arm_and_hand import Finger
    from mrlab_ros.adapters.robots.importing.robot import Face
    from mrlab_ros.adapters.robots.library import RobotLibrary

app = typer.Typer(
    help="The robots of the library: list, show, sheet, check, import, export, meshes, remove."
)


def _library() -> RobotLibrary:
    from mrlab_ros.adapters.robots.library import RobotLibrary

    return RobotLibrary(share.directory() / "robots")


@app.callback(invoke_without_command=True)
def overview(
    context: typer.Context,
    as_json: Annotated[
        bool, typer.Option("--json", help="Print JSON instead of a table.")
    ] = False,
) -> None:
    """List the robots: id, class, payload, reach (from kinematics), joints."""
    if context.invoked_subcommand is None:
        list_robots(as_json)


@app.command("list")
def list_robots(
    as_json: Annotated[
        bool, typer.Option("--json", help="Print JSON instead of a table.")
    ] = False,
) -> None:
    """List the robots: id, class, payload, reach (from kinematics), joints."""
    from mrlab_ros.core.robots.reach import reach

    library = _library()
    rows = []
    for robot in library.ids():
        model, facts = library.model(robot), library.facts(robot)
        rows.append(
            {
                "id": robot,
                "product": f"{model.manufacturer} {model.product}",
                "class": model.robot_class,
                "payload_kg": model.payload,
                "reach_mm": round(reach(model, facts["reach_definition"]) * 1e3, 1),
                "joints": len(model.joints),
            }
        )
    sound, problems = library.sound_end_effectors()
    tools = list(sound)
    if as_json:
        found = {"robots": rows, "end_effectors": tools, "problems": plain(problems)}
        sys.stdout.write(json.dumps(found, indent=2) + "\n")
        return
    from rich.table import Table

    table = Table()
    for heading in ("id", "product", "class", "payload, kg", "reach, mm", "joints"):
        table.add_column(heading, no_wrap=heading == "id")
    for row in rows:
        payload = f"{row['payload_kg']:g}" if row["payload_kg"] else "not stated"
        reach_mm = f"{row['reach_mm']:.1f}"
        table.add_row(
            *(str(row[key]) for key in ("id", "product", "class")),
            payload,
            reach_mm,
            str(row["joints"]),
        )
    console = output.console()
    console.print(table)
    console.print(f"end effectors: {', '.join(tools)}")
    print_findings(problems)


@app.command()
def show(
    robot: Annotated[str, typer.Argument(help="Id of the robot.")],
    end_effector: Annotated[
        str, typer.Option("--end-effector", "--tool", help="Id of an end effector.")
    ] = "",
    joints: Annotated[
        str, typer.Option("--joints", help="Angles in degrees, 0,-90,90,0,0,0; empty: home.")
    ] = "",
    output: Annotated[
        Path | None,
        typer.Option("--out", "--output", "-o", help="A .png, a .html page or a .glb (glTF)."),
    ] = None,
    collision: Annotated[
        bool, typer.Option("--collision", help="Draw the convex hulls instead of the bodies.")
    ] = False,
    opened: Annotated[
        bool, typer.Option("--open/--no-open", help="Open the picture where there is a desktop.")
    ] = True,
    as_json: AsJson = False,
) -> None:
    """Print a robot's data; with --out, or where there is a desktop, draw it with sizes in metres.

    Without --out the picture that the desktop opens is in a temporary folder.
    """
    from mrlab_ros.adapters.robots import drawing

    library = _library()
    positions = _positions(library, robot, joints) if joints else None
    desktop = os.environ.get("DISPLAY") or os.environ.get("WAYLAND_DISPLAY")
    opened = bool(opened and desktop and sys.stdout.isatty()) and not as_json
    if output is None and as_json:
        print(json.dumps(_sheet_facts(library, robot)))
        return
    if output is None:
        _print_sheet(library, robot)
        if not opened:
            print(f"a picture: mrlab robots show {robot} --out {robot}.png")
            return
        output = Path(tempfile.mkdtemp(prefix="mrlab-")) / f"{robot}.png"
    path = output.resolve()
    drawn = drawing.bodies(library, robot, end_effector or None, positions, collision=collision)
    drawing.write(drawn, path)
    _say_path(path, as_json=as_json)
    if opened:
        typer.launch(str(path))


def _sheet_facts(library: RobotLibrary, robot: str) -> dict[str, Any]:
    """Return what the library knows of a robot: m, rad, kg; null: endless, or not stated."""
    from mrlab_ros.adapters.robots import urdf
    from mrlab_ros.core.robots.reach import reach

    model, facts = library.model(robot), library.facts(robot)
    every = urdf.joints(urdf.parse(library.description(robot), robot), robot)
    endless = {joint.name for joint in every if joint.kind == "continuous"}
    return {
        "id": model.id,
        "product": f"{model.manufacturer} {model.product}",
        "class": model.robot_class,
        "payload": model.payload or None,
        "reach": reach(model, facts["reach_definition"]),
        "joints": [
            {
                "name": joint.name,
                "lower": None if joint.name in endless else joint.lower,
                "upper": None if joint.name in endless else joint.upper,
                "max_velocity": joint.max_velocity,
            }
            for joint in model.joints
        ],
    }


def _print_sheet(library: RobotLibrary, robot: str) -> None:
    """Print what the library knows of a robot; limits in degrees, or in metres for a slide."""
    from rich.table import Table

    from mrlab_ros.adapters.robots import urdf
    from mrlab_ros.core.robots.reach import reach

    model, facts = library.model(robot), library.facts(robot)
    reach_mm = reach(model, facts["reach_definition"]) * 1e3
    print(f"{model.id}: {model.manufacturer} {model.product}, {model.robot_class}")
    payload = f"{model.payload:g} kg" if model.payload else "not stated (write it into robot.yaml)"
    print(f"payload {payload}, reach {reach_mm:.1f} mm")
    every = urdf.joints(urdf.parse(library.description(robot), robot), robot)
    endless = {joint.name for joint in every if joint.kind == "continuous"}
    table = Table("joint", "from", "to", "speed", "unit")
    moving = [segment for segment in model.chain.segments if segment.axis is not None]
    for joint, segment in zip(model.joints, moving, strict=True):
        limits = (joint.lower, joint.upper, joint.max_velocity)
        sliding = segment.prismatic
        shown = [f"{v if sliding else math.degrees(v):g}" for v in limits]
        if joint.name in endless:
            shown[:2] = ["endless", ""]
        table.add_row(joint.name, *shown, "m" if sliding else "deg")
    output.console().print(table)


def _positions(library: RobotLibrary, robot: str, text: str) -> dict[str, float]:
    """Return the angles, rad, of the joints that --joints gives in degrees."""
    names = library.model(robot).joint_names
    try:
        degrees = [float(part) for part in text.split(",")]
    except ValueError:
        degrees = []
    if len(degrees) != len(names) or not all(map(math.isfinite, degrees)):
        raise BadInput(BAD_ANGLES(text=text, count=len(names), joints=[*names]))
    return dict(zip(names, map(math.radians, degrees), strict=True))


@app.command()
def check(
    robots: Annotated[list[str] | None, typer.Argument(help="Ids; none: all robots.")] = None,
    as_json: AsJson = False,
) -> None:
    """Check robots: meshes, limits, inertias, units, hulls. Ends with 1 where one has an error."""
    from mrlab_ros.adapters.robots import checks, hulls

    library = _library()
    worst = 0
    findings = {}
    for robot in robots or library.ids():
        text = library.description(robot)
        origin = f"{robot}/robot.urdf"
        found = checks.check(text, origin, library.mesh_path, library.hand(robot))
        if not checks.errors(found):
            library.model(robot)
            found += hulls.check(text, origin, library.mesh_path)
        shown = [one for one in found if one.severity is not Severity.INFO]
        worst += len(checks.errors(found))
        findings[robot] = plain(shown)
        if not as_json:
            print(f"{robot}: {'ok' if not shown else ''}".rstrip())
            print_findings(shown)
    if as_json:
        print(json.dumps({"findings": findings}))
    if worst:
        raise BadInput(ROBOTS_HAVE_ERRORS(count=worst))


SOURCE_HELP = (
    "A URDF or a .xacro, the name of a ROS package, or PACKAGE/PATH of a file in it; behind it "
    "the arguments of a xacro as NAME:=VALUE."
)
Source = Annotated[list[str], typer.Argument(metavar="SOURCE [NAME:=VALUE]...", help=SOURCE_HELP)]


@app.command("import")
def import_robot(
    source: Source,
    robot_id: Annotated[str, typer.Option("--id", help="Id in the lab; empty: the name.")] = "",
    tip: Annotated[
        str, typer.Option(help="Last link of the arm; empty: a tool frame, or where it ends.")
    ] = "",
    srdf: Annotated[
        Path | None,
        typer.Option(help="SRDF whose groups name the arm; not given: the one nearby, if any."),
    ] = None,
    speed: Annotated[
        float, typer.Option(min=0.0, help="rad/s or m/s of the arm's joints that state none.")
    ] = 0.0,
    tool: Annotated[
        str,
        typer.Option(
            help="What it holds with in place of fingers, along z of its tip: cup or magnet."
        ),
    ] = "",
    lip: Annotated[
        str, typer.Option(help="With --tool: radius of the lip or the face, such as 20mm.")
    ] = "20mm",
    force: Annotated[
        float, typer.Option(min=0.1, help="With --tool: N with which it holds.")
    ] = 45.0,
    as_tool: Annotated[
        bool, typer.Option("--as-tool", help="A hand alone: an end effector that robots carry.")
    ] = False,
    sheet: Annotated[
        Path | None,
        typer.Option(help="A .png or .html for the sheet with picture, axes, limits and hand."),
    ] = None,
    package: Annotated[
        list[str] | None,
        typer.Option(
            "--package",
            help="NAME=FOLDER for package:// and $(find); repeatable. Packages of the source "
            "tree around the file are found without it.",
        ),
    ] = None,
    as_json: AsJson = False,
) -> None:
    """Check a robot description and install it as a robot of the lab.

    The arm and the hand are told apart: the motion's columns are the arm's joints, and one more
    column opens and closes the hand. The sheet that is printed says what was understood.
    """
    from mrlab_ros.adapters.robots import checks
    from mrlab_ros.adapters.robots.importing.diagnostics import ARMS_BRANCH
    from mrlab_ros.adapters.robots.importing.robot import import_robot as taken_in
    from mrlab_ros.adapters.robots.importing.source import find_description
    from mrlab_ros.adapters.robots.sheet import checked_format
    from mrlab_ros.core.base.checks import Number, between, checked

    checked("--speed", speed, Number(between(0.0, 1e3)))
    checked("--force", force, Number(between(0.1, 1e5), "N"))
    of_arms = [name for name, on in (("--tip", tip), ("--srdf", srdf), ("--sheet", sheet)) if on]
    if as_tool and of_arms:
        raise WrongUsage(AS_TOOL_WITHOUT(options=of_arms))
    if sheet is not None:
        checked_format(sheet)
    path = find_description(source[0])
    library = _library()
    wanted = robot_id or path.name.split(".")[0].lower().replace("-", "_")
    if as_tool:
        _import_tool(
            path, wanted, library, _folders(package), source[1:], speed, force,
            _face(tool, lip, force), as_json,
        )  # fmt: skip
        return
    try:
        imported = taken_in(
            path,
            wanted,
            library,
            _folders(package),
            arguments=source[1:],
            tip=tip,
            srdf=srdf,
            speed=speed,
            face=_face(tool, lip, force),
        )
    except BadInput as error:
        found = error.diagnostic
        if found.code != ARMS_BRANCH.code:
            raise
        options = ["--id", robot_id] * bool(robot_id)
        options += [word for pair in package or () for word in ("--package", pair)]
        again = for_shell([*source, *options, "--tip", str(found.values["tip"])])
        fix = Fix(command=f"mrlab robots import {again}")
        raise BadInput(replace(found, fixes=(fix,))) from None
    if not as_json:
        print_findings(imported.findings)
    wrong = checks.errors(imported.findings)
    if wrong:
        if as_json:
            print(json.dumps({"findings": plain(imported.findings)}))
        raise BadInput(ROBOT_NOT_IMPORTED(file=path.name, count=len(wrong)))
    assert imported.split is not None
    if sheet is not None:
        from mrlab_ros.adapters.robots import sheet as sheets

        sheets.write(library, wanted, sheet.resolve())
    if as_json:
        known = {"findings": plain(imported.findings), **_sheet_facts(library, wanted)}
        files = {"folder": str(library.imported / wanted), "sheet": sheet and str(sheet.resolve())}
        hand = [finger.name for finger in imported.fingers]
        print(json.dumps({**known, "tip": imported.split.tip, "hand": hand, **files}))
        return
    _print_sheet(library, wanted)
    print(f"the arm: {imported.split.why}; its tip is {imported.split.tip} (--tip changes it)")
    _print_fingers(imported.fingers)
    print(f"{wanted} is a robot of the lab; its files: {library.imported / wanted}")
    if sheet is None:
        print(f"with a picture of it: mrlab robots sheet {wanted} --out {wanted}.html")
    else:
        print(sheet.resolve())


def _print_fingers(fingers: Iterable[Finger]) -> None:
    for finger in fingers:
        follows = f", follows {finger.mimics}" if finger.mimics else ""
        turned = ", axis turned round" if finger.flipped else ""
        print(
            f"the hand: {finger.name}, open at {finger.lower:g}, closed at "
            f"{finger.upper:g}{follows}{turned}"
        )


def _import_tool(
    path: Path,
    wanted: str,
    library: RobotLibrary,
    packages: dict[str, Path],
    arguments: list[str],
    speed: float,
    force: float,
    face: Face | None,
    as_json: bool,
) -> None:
    from mrlab_ros.adapters.robots import checks
    from mrlab_ros.adapters.robots.importing.end_effector import import_end_effector

    done = import_end_effector(
        path, wanted, library, packages, arguments=arguments, speed=speed, force=force, face=face
    )
    wrong = checks.errors(done.findings)
    if as_json:
        hand = [finger.name for finger in done.fingers]
        print(json.dumps({"id": wanted, "findings": plain(done.findings), "hand": hand}))
    else:
        print_findings(done.findings)
    if wrong:
        raise BadInput(ROBOT_NOT_IMPORTED(file=path.name, count=len(wrong)))
    if not as_json:
        _print_fingers(done.fingers)
        print(f"{wanted} is an end effector of the lab: mrlab tool ROBOT {wanted}")


def _face(tool: str, lip: str, force: float) -> Face | None:
    """Return what --tool, --lip and --force say; None without --tool."""
    from mrlab_ros.adapters.robots.importing.robot import Face
    from mrlab_ros.commands.check.command import metres
    from mrlab_ros.core.base.checks import bad_value
    from mrlab_ros.core.base.diagnostics import ONE_OF
    from mrlab_ros.core.physics.grasp.kinds import KINDS

    if not tool:
        return None
    pulling = [kind.name for kind in KINDS.values() if kind.pulls]
    if tool not in pulling:
        raise bad_value("--tool", tool, ONE_OF(choices=pulling))
    return Face(tool, force, metres(lip, "lip"))


@app.command()
def sheet(
    robot: Annotated[str, typer.Argument(help="Id of the robot.")],
    output: Annotated[
        Path, typer.Option("--out", "--output", "-o", help="A .png, or a .html page to print.")
    ],
    as_json: AsJson = False,
) -> None:
    """Draw a robot with its numbered axes beside what the lab knows of it: limits, hand, tip."""
    from mrlab_ros.adapters.robots import sheet as sheets

    sheets.write(_library(), robot, output.resolve())
    _say_path(output.resolve(), as_json=as_json)


@app.command()
def export(
    robot: Annotated[str, typer.Argument(help="Id of the robot.")],
    output: Annotated[
        Path, typer.Option("--out", "--output", "-o", help="A new folder for the files.")
    ],
    end_effector: Annotated[
        str, typer.Option("--end-effector", "--tool", help="Id of an end effector.")
    ] = "",
    as_json: AsJson = False,
) -> None:
    """Write a robot for other programs: a URDF with OBJ and STL meshes and relative paths."""
    from mrlab_ros.adapters.robots import exporting

    written = exporting.export(_library(), robot, end_effector or None, output.resolve())
    _say_path(written, as_json=as_json)


@app.command()
def meshes(
    robot: Annotated[
        str, typer.Argument(help="Id of one of the lab's own robots; none: all, with --from.")
    ] = "",
    source: Annotated[
        list[str] | None, typer.Argument(metavar="[SOURCE [NAME:=VALUE]...]", help=SOURCE_HELP)
    ] = None,
    place: Annotated[
        str,
        typer.Option(
            "--from",
            metavar="DIR|GIT",
            help="Clones of the repositories that the robots were taken from, or the address of "
            "one; the commits that robot.yaml states are read, and licences are kept.",
        ),
    ] = "",
    package: Annotated[
        list[str] | None,
        typer.Option("--package", help="NAME=FOLDER for package:// and $(find); repeatable."),
    ] = None,
    collision: Annotated[
        bool, typer.Option("--collision", help="With SOURCE: use its collision meshes too.")
    ] = False,
    as_json: AsJson = False,
) -> None:
    """Show the lab's robots with the meshes of a vendor's description.

    With SOURCE one robot, as the files are. Otherwise those in the clones at --from, thinned, lit
    and packed for pages and headsets.
    """
    from mrlab_ros.adapters.robots import checks, vendor_meshes
    from mrlab_ros.adapters.robots.importing.source import find_description

    library = _library()
    if not source:
        from mrlab_ros.commands import vendor_meshes as dressing

        dressing.dress(library, robot, place, as_json=as_json)
        return
    path = find_description(source[0])
    found = vendor_meshes.use_meshes(
        path,
        robot,
        library,
        _folders(package),
        arguments=source[1:],
        collision=collision,
    )
    if not as_json:
        print_findings(found)
    wrong = checks.errors(found)
    if wrong:
        raise BadInput(MESHES_NOT_INSTALLED(file=path.name, count=len(wrong)))
    done = MESHES_INSTALLED(robot=robot, file=path.name)
    say(done, as_json=as_json, robot=robot, findings=plain(found))


@app.command()
def remove(
    robot: Annotated[str, typer.Argument(help="Id of an imported robot.")], as_json: AsJson = False
) -> None:
    """Remove an imported robot, or the vendor's meshes of a library robot."""
    from mrlab_ros.adapters.robots import vendor_meshes

    library = _library()
    vendor_meshes.remove(robot, library)
    own = robot in library.ids()
    done = OWN_MESHES_AGAIN if own else MODEL_REMOVED
    say(done(robot=robot), as_json=as_json, robot=robot, removed=not own)


def _folders(pairs: list[str] | None) -> dict[str, Path]:
    """Return the folders that --package options name."""
    folders = {}
    for pair in pairs or []:
        name, equals, folder = pair.partition("=")
        if not equals:
            raise BadInput(BAD_PACKAGE_OPTION(text=pair))
        folders[name] = Path(folder)
    return folders


def _say_path(path: Path, *, as_json: bool) -> None:
    print(json.dumps({"path": str(path)}) if as_json else path)
