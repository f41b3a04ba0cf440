"""Read a rubric and mark one file by it; nothing is printed.

Scenes and references that a rubric names are relative to its file.
"""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path, PureWindowsPath

from mrlab_ros.adapters.yaml_files import read_with_lines
from mrlab_ros.app.check.file import CELLS, CheckedFile, Setting, check_file, entry_of, scene_of
from mrlab_ros.app.check.stage import Stage
from mrlab_ros.classroom.diagnostics import (
    CELL_FOR_ONE_ROBOT,
    OF_REFERENCE,
    OF_RUBRIC,
    REFERENCE_NOT_MARKED,
    ROBOT_NOT_SAID,
)
from mrlab_ros.classroom.rubrics import document
from mrlab_ros.classroom.rubrics.marking import Marks, mark
from mrlab_ros.classroom.rubrics.measures.reference import NearReference
from mrlab_ros.classroom.rubrics.rubric import Ground, Rubric
from mrlab_ros.core.base.errors import BadInput, LabError, Misuse
from mrlab_ros.core.conversion.options import Options


def setting_of(rubric: Rubric, stage: Stage, share: Path, options: Options) -> Setting:
    """Return what files are checked in that this rubric marks.

    Raises LabError where its scene, robot or tool is unknown.
    """
    try:
        setting = Setting(
            stage, scene_of(rubric.scene, share), rubric.scene, rubric.robot, rubric.tool,
            options, rubric.closest,
        )  # fmt: skip
        if rubric.robot:
            entry = entry_of(setting)
            stage.robot(entry.name, entry.model, entry.end_effector, entry.pose)
    except LabError as error:
        raise type(error)(OF_RUBRIC(rubric=rubric.origin, why=error.diagnostic)) from None
    return setting


def ground_of(rubric: Rubric, setting: Setting) -> Ground:
    """Return what the sentences of a rubric can be about."""
    scene = setting.scene
    entries = [*scene.robots]
    if rubric.robot:
        own = entry_of(setting)
        entries = [own, *(r for r in entries if r.name != own.name)]
    robots = tuple(setting.stage.robot(r.name, r.model, r.end_effector, r.pose) for r in entries)
    cell = Path(rubric.reference).suffix in CELLS if rubric.reference else None
    return Ground(scene, robots, setting.stage.types(scene), cell, bool(rubric.reference))


def compared(rubric: Rubric) -> bool:
    """Return whether a test of a rubric compares with the reference's motion."""
    return any(isinstance(test.measure, NearReference) for test in rubric.tests)


def reference_of(rubric: Rubric, setting: Setting) -> CheckedFile | None:
    """Return the checked reference solution; None: the rubric names none.

    Raises BadInput where it holds no motion.
    """
    if not rubric.reference:
        return None
    path = Path(rubric.reference)
    try:
        found = check_rubric_file(path, rubric, setting)
    except LabError as error:
        raise BadInput(OF_REFERENCE(rubric=rubric.origin, why=error.diagnostic)) from None
    if found.played is None:
        raise BadInput(REFERENCE_NOT_MARKED(rubric=rubric.origin, file=path.name, why=found.why))
    return found


def check_rubric_file(file: Path, rubric: Rubric, setting: Setting) -> CheckedFile:
    """Check a file as a rubric marks it; a cell brings its robots itself."""
    if file.suffix.lower() in CELLS and rubric.robot:
        raise Misuse(CELL_FOR_ONE_ROBOT(file=file.name, robot=rubric.robot))
    robots = setting.robot or setting.scene.robots
    if not robots and file.suffix.lower() not in (*CELLS, ".json") and file.is_file():
        raise Misuse(ROBOT_NOT_SAID(file=file.name))
    return check_file(file, replace(setting, drawn=True))


def mark_file(
    file: Path, rubric: Rubric, setting: Setting, reference: CheckedFile | None
) -> tuple[CheckedFile, Marks]:
    """Check and mark one file; raise LabError where it cannot even be read."""
    found = check_rubric_file(file, rubric, setting)
    return found, mark(rubric, found.checked, reference.checked if reference else None)


SCENES = (".yaml", ".yml", ".json")


def read_rubric(path: Path, *, beside: bool = False) -> Rubric:
    """Return the rubric in a file, its reference and the file of its scene as paths from here.

    beside: they lie beside the rubric, whatever folders it names, and errors name no folder.
    Raises BadInput that names every mistake with its line.
    """

    def place(named: str) -> str:
        return str(path.parent / (PureWindowsPath(named).name if beside else named))

    origin = path.name if beside else str(path)
    content, lines = read_with_lines(path, origin)
    rubric = document.parse(content, origin, lines)
    scene = rubric.scene
    if scene and (Path(scene).suffix in SCENES or "/" in scene):
        scene = place(scene)
    reference = place(rubric.reference) if rubric.reference else ""
    return replace(rubric, name=rubric.name or path.stem, scene=scene, reference=reference)
