"""The record of one file's check, for marking."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

from mrlab_ros.core.checking.motion import CheckedRobot, MotionFigures
from mrlab_ros.core.checking.rehearsal_record import Rehearsed
from mrlab_ros.core.checking.report import CheckReport
from mrlab_ros.core.physics.catalogue import ObjectType
from mrlab_ros.core.scene.document import SceneDocument
from mrlab_ros.core.trajectory.trajectory import Trajectory


@dataclass(frozen=True, eq=False)
class Motion:
    """A robot's motion and what it is by itself. start: s, when it begins on the timeline."""

    robot: CheckedRobot
    trajectory: Trajectory
    figures: MotionFigures
    start: float = 0.0


@dataclass(frozen=True, eq=False)
class Checked:
    """One file as it was checked: a motion, or a cell of several.

    document: the report as JSON has it. motions: in the order of the robots; none where the
    conversion refused the file. recorded: None where nothing was rehearsed. scene: what it moved
    in; objects: the types of those in it, by name.
    """

    report: CheckReport
    document: Mapping[str, Any]
    motions: tuple[Motion, ...] = ()
    recorded: Rehearsed | None = None
    scene: SceneDocument = field(default_factory=SceneDocument)
    objects: Mapping[str, ObjectType] = field(default_factory=dict)

    @property
    def trajectory(self) -> Trajectory | None:
        """Return the motion of the only robot, or of the first."""
        return self.motions[0].trajectory if self.motions else None

    @property
    def figures(self) -> MotionFigures | None:
        """Return the figures of the only robot, or of the first."""
        return self.motions[0].figures if self.motions else None

    @property
    def mode(self) -> str:
        """Return how a cell is played, parallel or sequential; empty: it is no cell."""
        return str(self.report.extras.get("system", {}).get("mode", ""))

    @property
    def stuck(self) -> Mapping[str, str]:
        """Return the wait that held a robot of a cell for ever, by robot."""
        return self.recorded.stuck if self.recorded is not None else {}

    def played(self, robot: str) -> tuple[Motion, ...]:
        """Return the motions of a robot as `of` does; none where one was not played to its end."""
        motions = self.of(robot)
        return () if any(m.robot.name in self.stuck for m in motions) else motions

    def of(self, robot: str) -> tuple[Motion, ...]:
        """Return the motions of a robot, named or by its model; empty: all."""
        return tuple(m for m in self.motions if robot in ("", m.robot.name, m.robot.model.id))
