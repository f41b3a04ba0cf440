"""What `mrlab check` does with one file: convert, compute, rehearse, report."""

from __future__ import annotations

import csv
import hashlib
import json
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

from mrlab_ros.adapters.checking.stage import Played, Stage, first_link
from mrlab_ros.adapters.robots.library import RobotLibrary
from mrlab_ros.adapters.scenes import files as scene_files
from mrlab_ros.adapters.scenes.files import SceneFiles
from mrlab_ros.commands.check import cell, words
from mrlab_ros.commands.convert import report as conversion_report
from mrlab_ros.commands.convert.one_file import converted
from mrlab_ros.core.checking import motion
from mrlab_ros.core.checking.hardware import JUMPS
from mrlab_ros.core.checking.motion import CheckedRobot
from mrlab_ros.core.checking.rehearsal import Actor
from mrlab_ros.core.checking.report import CheckReport, digest
from mrlab_ros.core.checking.waypoints import points_from_rows
from mrlab_ros.core.conversion.convert import ConversionResult
from mrlab_ros.core.conversion.options import Options
from mrlab_ros.core.errors import BadInput, Misuse
from mrlab_ros.core.geometry import Pose, Vector
from mrlab_ros.core.scene.document import RobotEntry, SceneDocument
from mrlab_ros.core.systems.cell_file import plain_system
from mrlab_ros.core.trajectory.trajectory import Trajectory
from mrlab_ros.ros import share

READY, REFUSED, COULD_NOT = 0, 1, 2
# A file that the converter refuses for these holds a motion, which is not ready.
OF_THE_MOTION = JUMPS | {"joint_limit", "velocity_limit"}
NO_MOTION = "the file holds no motion that could be rehearsed; mrlab show draws what it holds"
CELLS = (".yaml", ".yml")


@dataclass(frozen=True)
class Request:
    """The arguments of the command; within, closest: m."""

    file: Path
    robot: str
    tool: str
    scene: str
    points: Path | None
    within: float
    closest: float
    out: Path | None
    as_json: bool
    options: Options


def run(request: Request) -> int:
    """Check, print, and return the exit code; raise LabError where nothing can be checked."""
    folder = share.directory()
    library = RobotLibrary(folder / "robots")
    stage = Stage(folder, library)
    scene = scene_of(request.scene, folder)
    if request.file.suffix.lower() in CELLS:
        return _cell(request, stage, scene, folder)
    return _motion(request, stage, scene, folder)


def _motion(request: Request, stage: Stage, scene: SceneDocument, folder: Path) -> int:
    points = _points(request.points)
    entry = _entry(request, scene)
    result = converted(
        request.file, entry.model, entry.end_effector, request.options, stage.library
    )
    t = result.trajectory
    if t is not None:
        entry = _entry(request, scene, t.robot_model, t.end_effector or "")
    robots = [
        stage.robot(e.name, e.model, e.end_effector, e.pose)
        for e in (entry, *(r for r in scene.robots if r.name != entry.name))
    ]
    inputs = {
        **stage.inputs(robots, scene),
        "file": hashlib.sha256(request.file.read_bytes()).hexdigest(),
        "options": {k: v for k, v in vars(request.options).items() if v},
        "points": points,
        "within": request.within,
        "closest": request.closest,
    }
    words_of_scene = scene_words(request.scene, scene)
    if t is None:
        if not any(d.code in OF_THE_MOTION for d in result.diagnostics):
            _say_refused(request, result)
            return COULD_NOT
        report = motion.report_of(
            result, robots[0], None, None, inputs=inputs, scene=words_of_scene
        )
        return _finish(request, report, stage, robots, None, folder, {})
    figures = motion.figures_of(t, robots[0])
    actors = [
        Actor(r.name, r.model.home, t if r is robots[0] else None, first_link=first_link(r))
        for r in robots
    ]
    played = stage.rehearse(robots, actors, scene, drawn=request.out is not None)
    report = motion.report_of(
        result, robots[0], figures, played.recorded, inputs=inputs, scene=words_of_scene,
        graspable=played.graspable, points=points, within=request.within,
        closest=request.closest,
    )  # fmt: skip
    motions = {robots[0].name: (t, figures)}
    return _finish(request, report, stage, robots, played, folder, motions)


def _cell(request: Request, stage: Stage, scene: SceneDocument, folder: Path) -> int:
    if request.robot or request.points is not None:
        option = "--robot" if request.robot else "--points"
        raise Misuse(f"{option} is for one motion; {request.file.name} is a cell of several")
    system, scene = cell.read(request.file, scene, request.scene)
    loaded = cell.load(request.file, system, scene, stage, request.options)
    played, pairs, delay = cell.rehearse(loaded, stage, request.closest)
    inputs = {
        **stage.inputs(loaded.robots, scene),
        "system": digest(plain_system(system)),
        "options": {k: v for k, v in vars(request.options).items() if v},
        "closest": request.closest,
    }
    report, motions = cell.report_of(loaded, played, pairs, delay, inputs, request.closest)
    return _finish(request, report, stage, loaded.robots, played, folder, motions)


def scene_of(name: str, folder: Path) -> SceneDocument:
    """Return a scene by its name or its file; empty: none. Raises BadInput."""
    if not name:
        return SceneDocument()
    path = Path(name)
    if path.suffix in (*CELLS, ".json") or "/" in name:
        return scene_files.read(path)
    own = Path.home() / ".local" / "share" / "mrlab" / "scenes"
    return SceneFiles(folder / "config" / "scenes", own).load(name)


def scene_words(name: str, scene: SceneDocument) -> str:
    """Return what a motion goes through, for a person."""
    if not name:
        return "an empty room with a floor"
    count = len(scene.objects)
    return f"the scene {name} with {count} object{'' if count == 1 else 's'}"


def _entry(
    request: Request, scene: SceneDocument, model: str = "", end_effector: str = ""
) -> RobotEntry:
    """Return the robot that the motion is for: the scene's first of that model, or one at the
    origin of a scene without robots."""
    model = request.robot or model
    own = [r for r in scene.robots if r.model == model or not model]
    if own:
        entry = own[0]
        tool = request.tool or entry.end_effector
        return RobotEntry(entry.name, entry.model, tool, entry.pose)
    if scene.robots and model:
        there = ", ".join(sorted({r.model for r in scene.robots}))
        raise Misuse(
            f"the scene {request.scene} has no robot {model}, so its place there is not known; "
            f"its robots: {there}. Take one of these, or another scene"
        )
    return RobotEntry(f"{model or 'robot'}_1", model, request.tool or end_effector, Pose())


def _points(path: Path | None) -> tuple[Vector, ...]:
    if path is None:
        return ()
    try:
        with path.open(newline="", encoding="utf-8-sig") as file:
            return points_from_rows(list(csv.reader(file)), path.name)
    except (OSError, UnicodeDecodeError, csv.Error) as error:
        reason = error.strerror if isinstance(error, OSError) else error
        raise BadInput(
            f"the points in {path} cannot be read: {reason}; expected a CSV with x, y, z in m"
        ) from None


def _say_refused(request: Request, result: ConversionResult) -> None:
    """Say why nothing could be checked, with the commands that mend it."""
    if request.as_json:
        print(json.dumps(conversion_report.record(str(request.file), result, None)))
        return
    given = ["mrlab", "check", str(request.file), "--robot", request.robot]
    given += ["--tool", request.tool] if request.tool else []
    given += ["--scene", request.scene] if request.scene else []
    conversion_report.show(result, None, given, request.options)


def _finish(
    request: Request,
    report: CheckReport,
    stage: Stage,
    robots: list[CheckedRobot],
    played: Played | None,
    folder: Path,
    motions: Mapping[str, tuple[Trajectory, motion.MotionFigures]],
) -> int:
    """Print the report and write its page; return the exit code. motions: by robot."""
    document = report.document()
    if request.as_json:
        print(json.dumps(document))
    else:
        words.show(report, document)
    if request.out is not None and played is not None:
        _write_page(request, report, document["hash"], stage, robots, played, folder, motions)
    elif request.out is not None and not request.as_json:
        print(f"no page is written: {NO_MOTION}")
    return REFUSED if report.refusing else READY


def _write_page(
    request: Request,
    report: CheckReport,
    digest: str,
    stage: Stage,
    robots: list[CheckedRobot],
    played: Played,
    folder: Path,
    motions: Mapping[str, tuple[Trajectory, motion.MotionFigures]],
) -> None:
    from mrlab_ros.adapters.pages.check import check_page
    from mrlab_ros.core.show.check import PlayedRobot

    assert request.out is not None
    shown = [
        PlayedRobot(
            r.name,
            r.model.id,
            r.end_effector,
            stage.library.description(r.model.id, r.end_effector or None),
            (*r.model.joint_names, *played.fingers[r.name]),
            (*r.pose.position, *r.pose.orientation),
            *motions.get(r.name, (None, None)),
        )
        for r in robots
    ]
    text = check_page(
        report, digest, played.recorded, shown, played.objects, stage.library, folder
    )
    try:
        request.out.parent.mkdir(parents=True, exist_ok=True)
        request.out.write_text(text, encoding="utf-8")
    except OSError as error:
        raise BadInput(f"{request.out} cannot be written: {error.strerror}") from None
    if not request.as_json:
        print(f"{request.out} ({len(text) / 1e6:.2f} MB)")
