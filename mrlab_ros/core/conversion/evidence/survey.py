"""Assesses the matrices of a file, each once, for discovery, layout, frame_rate and explain."""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import cached_property

from mrlab_ros.core.conversion.evidence.assessment import Assessment, blocking_clocks
from mrlab_ros.core.conversion.evidence.clock_columns import time_vectors
from mrlab_ros.core.conversion.evidence.comparison import relate
from mrlab_ros.core.conversion.evidence.labels import name_of
from mrlab_ros.core.conversion.evidence.measuring import fits, measured
from mrlab_ros.core.conversion.evidence.names import Name
from mrlab_ros.core.conversion.evidence.rate_scalars import sure_rates
from mrlab_ros.core.conversion.evidence.scoring import judged
from mrlab_ros.core.conversion.workspace import Variable, Workspace
from mrlab_ros.core.robots.model import RobotModel


@dataclass(frozen=True, eq=False)
class Survey:
    """A workspace and what its matrices are, for one robot.

    columns_asked: a person chose the columns, so that one that may be time is a doubt alone.
    """

    workspace: Workspace
    robot: RobotModel
    fitting: tuple[Assessment, ...]
    columns_asked: bool = False
    _known: dict[int, Assessment] = field(default_factory=dict)

    def of(self, variable: Variable) -> Assessment:
        """Return the assessment of a matrix that has values, with what its company says."""
        known = self._known.get(id(variable))
        if known is None:
            alone = measured(
                variable, self.name(variable), self.robot, self.time_vectors, self.rates
            )
            known = judged(alone, self.robot)
            self._known[id(variable)] = known
        return known

    @cached_property
    def rates(self) -> tuple[float, ...]:
        """The rates, Hz, that numbers of the file say for certain."""
        return sure_rates(self.workspace)

    @cached_property
    def time_vectors(self) -> dict[int, list[Variable]]:
        return time_vectors(self.workspace)

    def name(self, variable: Variable) -> Name:
        """Return what the name of a variable says: its path, label, headings and units."""
        return name_of(variable, self.workspace.file_format, self.robot)

    def ranked(self) -> list[Assessment]:
        """Return the matrices that could be taken as they are, likeliest first.

        Those with NaN come last. Of equal ones those that were measured come before the actions
        that were asked for.
        """
        found = [
            a for a in self.fitting if self.columns_asked or not blocking_clocks(a, self.robot)
        ]
        return sorted(found, key=lambda a: (not a.finite, -a.points, a.path.startswith("action")))


def survey(workspace: Workspace, robot: RobotModel, *, columns_asked: bool = False) -> Survey:
    """Assess the matrices of a workspace that fit the robot, each once, and one with another."""
    vectors = time_vectors(workspace)
    fitting = [v for v in workspace.variables if fits(v, robot)]
    form = workspace.file_format
    rates = sure_rates(workspace)
    found = {v.path: measured(v, name_of(v, form, robot), robot, vectors, rates) for v in fitting}
    relate(found, workspace, robot)
    assessed = {path: judged(a, robot) for path, a in found.items()}
    known = {id(v): assessed[v.path] for v in fitting}
    return Survey(workspace, robot, tuple(assessed.values()), columns_asked, known)
