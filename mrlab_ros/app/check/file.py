"""Checks one file, a motion or a cell."""

from __future__ import annotations

import hashlib
from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path

from mrlab_ros.adapters.scenes import files as scene_files
from mrlab_ros.adapters.scenes.files import SceneFiles
from mrlab_ros.app.check import cell
from mrlab_ros.app.check.diagnostics import MODEL_NOT_IN_SCENE, MOTION_OF_ANOTHER_ROBOT
from mrlab_ros.app.check.stage import Played, Stage, first_link
from mrlab_ros.app.convert import bag_in, converted, held_to_robot, is_trajectory_file
from mrlab_ros.core.base.diagnostic import Diagnostic, Fix
from mrlab_ros.core.base.errors import BadInput, Misuse
from mrlab_ros.core.base.foreign_text import file_name
from mrlab_ros.core.base.geometry import Pose, Vector
from mrlab_ros.core.checking import motion
from mrlab_ros.core.checking.check_record import Checked, Motion
from mrlab_ros.core.checking.diagnostics import IN_EMPTY_ROOM, IN_SCENE
from mrlab_ros.core.checking.evidence import CLOSE
from mrlab_ros.core.checking.motion import CheckedRobot
from mrlab_ros.core.checking.rehearsal import Actor
from mrlab_ros.core.checking.report import JUMPS, RANGES, SPEEDS, digest
from mrlab_ros.core.conversion.convert import ConversionResult, Outcome
from mrlab_ros.core.conversion.options import Options
from mrlab_ros.core.scene.document import RobotEntry, SceneDocument
from mrlab_ros.core.systems.cell_file import plain_system
from mrlab_ros.core.trajectory.trajectory import Trajectory

CELLS = (".yaml", ".yml")
# A file that the converter refuses for these holds a motion, which is not ready.
OF_THE_MOTION = JUMPS | RANGES | SPEEDS


@dataclass(frozen=True)
class Setting:
    """The surroundings in which files are checked; one for many files.

    scene_name: what the scene was asked for by, empty: none. points: m in world, that tool0 shall
    pass within `within` m. closest: m. enclosed: a cell reaches only files beside it.
    drawn: record where everything was. convert: what reads a file; see `app.convert.converted`.
    progress: is called with the time of a motion that was rehearsed, s, and its whole duration.
    """

    stage: Stage
    scene: SceneDocument
    scene_name: str = ""
    robot: str = ""
    tool: str = ""
    options: Options = field(default_factory=Options)
    closest: float = CLOSE
    points: tuple[Vector, ...] = ()
    within: float = 0.005
    drawn: bool = True
    convert: cell.Convert = converted
    enclosed: bool = False
    progress: Callable[[float, float], None] | None = None


@dataclass(frozen=True, eq=False)
class CheckedFile:
    """A file as it was checked. result: of its conversion, None for a cell. played: what was
    rehearsed, None where the file holds no motion that could be."""

    checked: Checked
    robots: tuple[CheckedRobot, ...]
    played: Played | None
    result: ConversionResult | None = None

    @property
    def holds_motion(self) -> bool:
        """Return whether there is a motion to judge, though it may be refused."""
        return self.played is not None or (
            self.result is not None
            and any(d.code in OF_THE_MOTION for d in self.result.diagnostics)
        )

    @property
    def why(self) -> Diagnostic | None:
        """Return why its conversion refused it; None: it did not."""
        found = self.result.diagnostics if self.result is not None else ()
        return next((d for d in found if d.refuses), None)


def check_file(file: Path, setting: Setting) -> CheckedFile:
    """Convert, compute, and rehearse one file; a file that is refused is checked too.

    Raises LabError where the setting does not fit: no such file, robot or scene, no pybullet.
    """
    file = bag_in(file)
    if file.suffix.lower() in CELLS:
        return _cell(file, setting)
    stage, scene = setting.stage, setting.scene
    entry = entry_of(setting)
    result, held = _converted(file, entry, setting)
    t = result.trajectory
    if held is None and not entry.model:
        raise BadInput(result.diagnostics[0])
    if held is not None:
        entry = entry_of(setting, held.robot_model, held.end_effector or "")
        if held.robot_model != entry.model:
            result, t = _of_another_robot(held, file_name(file.name), entry.model), None
    robots = tuple(
        stage.robot(e.name, e.model, e.end_effector, e.pose)
        for e in (entry, *(r for r in scene.robots if r.name != entry.name))
    )
    moving = robots[0]
    inputs = {
        **stage.inputs(robots, scene),
        "file": hashlib.sha256(file.read_bytes()).hexdigest(),
        "options": {k: v for k, v in vars(setting.options).items() if v},
        "points": setting.points,
        "within": setting.within,
        "closest": setting.closest,
    }
    shown = shown_scene(setting.scene_name, scene)
    if t is None:
        report = motion.report_of(result, moving, None, None, inputs=inputs, scene=shown)
        refused = Checked(report, report.document(), scene=scene)
        return CheckedFile(refused, robots, None, result)
    figures = motion.figures_of(t, moving)
    actors = [
        Actor(r.name, r.model.home, t if r is moving else None, first_link=first_link(r))
        for r in robots
    ]
    told = setting.progress
    played = stage.rehearse(
        robots, actors, scene, drawn=setting.drawn,
        progress=None if told is None else lambda seconds: told(seconds, t.duration),
    )  # fmt: skip
    report = motion.report_of(
        result, moving, figures, played.recorded, inputs=inputs, scene=shown,
        graspable=played.graspable, points=setting.points, within=setting.within,
        closest=setting.closest,
    )  # fmt: skip
    checked = Checked(
        report, report.document(), (Motion(moving, t, figures),), played.recorded, scene,
        played.objects,
    )  # fmt: skip
    return CheckedFile(checked, robots, played, result)


def _converted(
    file: Path, entry: RobotEntry, setting: Setting
) -> tuple[ConversionResult, Trajectory | None]:
    """Return what became of a file, and the trajectory in it, also where its robot cannot play it.

    A trajectory file that is damaged is refused as others are.
    """
    library = setting.stage.library
    try:
        found = setting.convert(file, entry.model, entry.end_effector, setting.options, library)
        fit = held_to_robot(found, library) if is_trajectory_file(file) else found
        return fit, found.trajectory
    except BadInput as error:
        if not is_trajectory_file(file) or not file.is_file():
            raise
        return _refused(file_name(file.name), error.diagnostic), None


def _of_another_robot(t: Trajectory, file: str, model: str) -> ConversionResult:
    """Return the refusal of a trajectory file that is for another robot than is checked."""
    fixes = (Fix(command=f"mrlab convert FILE --robot {model}"),)
    return _refused(
        file, MOTION_OF_ANOTHER_ROBOT(file=file, found=t.robot_model, model=model, fixes=fixes)
    )


def _refused(file: str, why: Diagnostic) -> ConversionResult:
    return ConversionResult(file, Outcome.REJECTED, None, (), (why,))


def _cell(file: Path, setting: Setting) -> CheckedFile:
    system, scene = cell.read(file, setting.scene, setting.scene_name)
    loaded = cell.load(
        file, system, scene, setting.stage, setting.options, setting.convert,
        enclosed=setting.enclosed,
    )  # fmt: skip
    played, pairs, delay = cell.rehearse(loaded, setting.stage, setting.closest)
    inputs = {
        **setting.stage.inputs(loaded.robots, scene),
        "system": digest(plain_system(system)),
        "options": {k: v for k, v in vars(setting.options).items() if v},
        "closest": setting.closest,
    }
    report, motions = cell.report_of(loaded, played, pairs, delay, inputs, setting.closest)
    starts = played.recorded.starts
    checked = Checked(
        report,
        report.document(),
        tuple(
            Motion(r, *motions[r.name], starts.get(r.name, 0.0))
            for r in loaded.robots
            if r.name in motions
        ),
        played.recorded,
        scene,
        played.objects,
    )
    return CheckedFile(checked, tuple(loaded.robots), played)


def entry_of(setting: Setting, model: str = "", end_effector: str = "") -> RobotEntry:
    """Return the robot that a motion is for: the scene's first of that model, or one at the
    origin of a scene without robots.

    model, end_effector: what a file names, where the setting names none. Raises Misuse.
    """
    model = setting.robot or model
    own = [r for r in setting.scene.robots if r.model == model or not model]
    if own:
        entry = own[0]
        tool = setting.tool or entry.end_effector
        return RobotEntry(entry.name, entry.model, tool, entry.pose)
    if setting.scene.robots and model:
        there = sorted({r.model for r in setting.scene.robots})
        raise Misuse(MODEL_NOT_IN_SCENE(scene=setting.scene_name, robot=model, robots=there))
    return RobotEntry(f"{model or 'robot'}_1", model, setting.tool or end_effector, Pose())


def scene_of(name: str, folder: Path) -> SceneDocument:
    """Return a scene by its name or its file; empty: none. Raises BadInput."""
    if not name:
        return SceneDocument()
    path = Path(name)
    if path.suffix in (*CELLS, ".json") or "/" in name:
        return scene_files.read(path)
    own = Path.home() / ".local" / "share" / "mrlab" / "scenes"
    return SceneFiles(folder / "config" / "scenes", own).load(name)


def shown_scene(name: str, scene: SceneDocument) -> Diagnostic:
    """Return what a motion goes through."""
    return IN_SCENE(scene=name, objects=len(scene.objects)) if name else IN_EMPTY_ROOM()
