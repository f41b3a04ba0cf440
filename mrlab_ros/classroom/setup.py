"""The set-up of a class: the settings of every check, and the key of its results."""

from __future__ import annotations

import hashlib
import pickle
from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from functools import cached_property
from pathlib import Path
from typing import Any

import mrlab_ros
from mrlab_ros.adapters import share
from mrlab_ros.adapters.robots.library import RobotLibrary
from mrlab_ros.app.check.file import Setting, entry_of
from mrlab_ros.app.check.stage import Stage
from mrlab_ros.classroom.rubrics.rubric import Rubric
from mrlab_ros.core.checking.report import digest
from mrlab_ros.core.conversion.options import Options
from mrlab_ros.core.scene import document as scene_document
from mrlab_ros.core.scene.document import SceneDocument

MiB = 1 << 20


class SteadyLibrary(RobotLibrary):
    """A library whose files do not change while a class is checked: each is read once."""

    def __init__(self, folder: Path) -> None:
        super().__init__(folder)
        self._facts: dict[str, dict[str, Any]] = {}
        self._described: dict[tuple[str, str], str] = {}

    def facts(self, robot_id: str) -> dict[str, Any]:
        """Return the content of robot.yaml."""
        if robot_id not in self._facts:
            self._facts[robot_id] = super().facts(robot_id)
        return self._facts[robot_id]

    def description(self, robot_id: str, end_effector: str | None = None) -> str:
        """Return the URDF of a robot with its end effector."""
        asked = (robot_id, end_effector or "")
        if asked not in self._described:
            self._described[asked] = super().description(robot_id, end_effector)
        return self._described[asked]


@dataclass(frozen=True)
class Bounds:
    """Limits of one submission. memory: bytes; time: s of a processor."""

    memory: int = 3072 * MiB
    time: float = 60.0

    @property
    def wall(self) -> float:
        """Return after how many s, on however busy a machine, a submission is given up."""
        return 10 * self.time + 30


@dataclass(frozen=True)
class Setup:
    """How a class is checked. reference: name and bytes of the solution, None where there is none.

    beside: names and bytes of the motions of a reference that is a cell. pages: write a page for
    each. It travels to the processes that check, so it holds everything.
    """

    rubric: Rubric
    scene: SceneDocument
    options: Options = field(default_factory=Options)
    reference: tuple[str, bytes] | None = None
    bounds: Bounds = field(default_factory=Bounds)
    pages: bool = True
    beside: tuple[tuple[str, bytes], ...] = ()

    @property
    def references(self) -> tuple[tuple[str, bytes], ...]:
        """Return all files of the solution, the one that is marked first."""
        return (self.reference, *self.beside) if self.reference is not None else ()

    @cached_property
    def digest(self) -> str:
        """Return the sha256 of all that marks depend on beside the submission."""
        reference = [
            [name, hashlib.sha256(content).hexdigest()] for name, content in self.references
        ]
        return digest([self.ground, described(self.rubric), reference])

    @cached_property
    def ground(self) -> str:
        """Return the sha256 of all that a check depends on beside the submission, without what
        the rubric makes of it."""
        folder = share.directory()
        setting = self.setting(folder)
        entry = entry_of(setting)
        inputs = {}
        if entry.model:
            stage = setting.stage
            robot = stage.robot(entry.name, entry.model, entry.end_effector, entry.pose)
            inputs = stage.inputs([robot], self.scene)
        return digest(
            {
                "version": mrlab_ros.__version__,
                "asked": [self.rubric.robot, self.rubric.tool, self.rubric.closest],
                "scene": scene_document.plain(self.scene),
                "options": {k: v for k, v in vars(self.options).items() if v},
                "inputs": inputs,
            }
        )

    def setting(self, folder: Path) -> Setting:
        """Return the setting of a check. folder: the package's share."""
        rubric = self.rubric
        return Setting(
            Stage(folder, SteadyLibrary(folder / "robots")), self.scene, rubric.scene,
            rubric.robot, rubric.tool, self.options, rubric.closest,
        )  # fmt: skip

    @cached_property
    def packed(self) -> bytes:
        """Return the setup as it travels."""
        return pickle.dumps(replace(self))


def described(rubric: Rubric) -> Mapping[str, Any]:
    """Return what a rubric was read from; of one that was not read its tests and its limits.

    A measure holds functions, whose addresses differ from process to process.
    """
    if rubric.plain is not None:
        return rubric.plain
    tests = [[t.name, t.expect, t.points, t.hint, t.hidden, t.partial] for t in rubric.tests]
    return {"tests": tests, "robot": rubric.robot, "tool": rubric.tool, "closest": rubric.closest}


@dataclass(frozen=True)
class Task:
    """One submission to check. shown: what its motion is called on pages, without folder.

    files: name and bytes of the candidates; the first that holds a motion is taken. changes:
    points that a teacher gives, by test; comment: the teacher's. evidence: what an earlier check
    of these files left, so that nothing is simulated; empty: none. late: days that have begun
    since it was due.
    """

    key: str
    shown: str
    files: tuple[tuple[str, bytes], ...]
    changes: Mapping[str, float] = field(default_factory=dict)
    comment: str = ""
    evidence: bytes = b""
    late: int = 0

    def digest(self, setup: str) -> str:
        """Return the sha256 by which the result of a task is known again."""
        own = [self.shown, self._parts, dict(self.changes), self.comment, self.late]
        return digest([setup, *own])

    def checked(self, ground: str) -> str:
        """Return the sha256 by which the evidence of a task is known again."""
        return digest([ground, self._parts])

    @property
    def _parts(self) -> list[list[str]]:
        return [[name, hashlib.sha256(data).hexdigest()] for name, data in self.files]
