"""Judges the matrices of a file: what each of them is, and how much it is like joint positions.

`survey` assesses a workspace once; discovery, layout, frame_rate and explain read from it.
"""

from __future__ import annotations

import re
from collections.abc import Iterable
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mrlab_ros.core.conversion import cartesian, relations, units
from mrlab_ros.core.conversion.cartesian import PoseEvidence
from mrlab_ros.core.conversion.gripper import has_states, is_ramp
from mrlab_ros.core.conversion.headings import describe_table
from mrlab_ros.core.conversion.named_columns import misnamed, names_joints
from mrlab_ros.core.conversion.preview import Preview, preview
from mrlab_ros.core.conversion.relations import PoseMatch
from mrlab_ros.core.conversion.time_vectors import (
    counts_rows,
    is_even,
    is_irregular,
    is_regular,
    is_time_name,
)
from mrlab_ros.core.conversion.units import UnitEvidence
from mrlab_ros.core.conversion.variable_names import (
    ACCELERATIONS,
    CURRENTS,
    POSES,
    TEMPERATURES,
    TORQUES,
    VELOCITIES,
    Hint,
    Name,
    describe,
    parts,
    words,
)
from mrlab_ros.core.conversion.workspace import Variable, Workspace
from mrlab_ros.core.robots.model import RobotModel
from mrlab_ros.core.trajectory.trajectory import Array

NAME_SCORES = {
    Hint.POSITIONS: 0.3,
    Hint.NEUTRAL: 0.0,
    Hint.TWO_FACED: 0.0,
    Hint.DOUBTFUL: -0.3,
    Hint.AGAINST: -0.55,
}
UNNAMED = ("CSV",)  # formats whose matrix is called q by the reader
UNITS_AGAINST = {
    VELOCITIES: frozenset(("rad/s", "deg/s", "°/s", "m/s", "mm/s", "rpm", "1/s")),
    ACCELERATIONS: frozenset(("rad/s^2", "rad/s2", "deg/s^2", "deg/s2", "m/s^2", "m/s2")),
    TORQUES: frozenset(("nm", "n*m", "n m", "n")),
    CURRENTS: frozenset(("a", "ma")),
    POSES: frozenset(("m", "mm", "cm")),
    TEMPERATURES: frozenset(("°c", "degc", "k")),
}
# Mean step between samples over the range of a motion; unordered samples have about 1/3.
ROUGH = 0.15
KEYED = re.compile(r"\{:,.*\}$|\('[^']*'\)$")
FEW_ROWS = 10
ENOUGH_ROWS = 20
SMOOTH_ROWS = 20_000
COARSE = 0.05  # rad from row to row: waypoints, not samples
# A column that counts time and leaves the joint limits by this factor is no joint.
BEYOND = 1.2
# Rows of zeros at an end were never filled where the step to them is so large: rad, usual steps.
UNFILLED_LEAST, UNFILLED_FACTOR = 0.05, 5.0
# Two matrices are the same motion, measured and commanded, where they differ by less, rad.
SAME_MOTION = 0.15
MEASURED_OR_COMMANDED = words(
    "actual act measured meas ist target desired des ref reference soll cmd command commanded "
    "current present set setpoint demand goal feedback fb"
)
# How many matrices are compared with one another.
MOST_COMPARED, MOST_POSES = 8, 4
SPARKS = "▁▂▃▄▅▆▇█"
SPARK_WIDTH = 24
RADIANS, NO_POSES = UnitEvidence("rad"), PoseEvidence()


@dataclass(frozen=True, eq=False)
class Candidate:
    """A matrix that could be the joint positions.

    path: as MATLAB writes it. shape: as MATLAB's size() gives it. score: 0 to 1, larger is
    likelier. minimum, maximum: in the matrix's own unit.
    """

    path: str
    shape: tuple[int, ...]
    score: float
    why: str
    minimum: float
    maximum: float
    preview: Preview

    @property
    def size(self) -> str:
        """Return the dimensions as MATLAB's whos writes them, such as 450x6."""
        return "x".join(str(n) for n in self.shape)

    def sparkline(self) -> str:
        """Return the course of the column that moves most, as text."""
        values = self.preview.values
        if not np.isfinite([self.minimum, self.maximum]).all():
            return ""
        sample = values[np.linspace(0, len(values) - 1, SPARK_WIDTH).astype(int)].astype(float)
        spans = np.ptp(sample, axis=0)
        column = sample[:, int(spans.argmax())]
        span = float(spans.max()) or 1.0
        return "".join(SPARKS[int(7 * (x - column.min()) / span)] for x in column)


@dataclass(frozen=True, eq=False)
class ClockColumn:
    """A column, from 0, that counts time.

    certain: no joint could have these values. likely: few joints move so; where it is neither, a
    joint at constant speed looks the same, and the column is a doubt alone.
    """

    index: int
    certain: bool
    first: float
    last: float
    why: str
    likely: bool = True


@dataclass(frozen=True, eq=False)
class Assessment:
    """What one matrix is, as far as its numbers, its name and its company say.

    low, high: (C,) range of each column, NaN where it is not finite. clocks: columns that count
    time. fits: it has one column a joint, or one more with a gripper. unit: of its first J
    columns. unfilled: first and last row, from 1, of zeros that were never filled. coarse: its
    rows are waypoints. poses: what speaks for poses. velocity_of: the matrix whose derivative it
    is. rates: Hz, those at which other matrices are its derivatives, with their paths.
    tool_of: the matrix at whose joint positions its points are the tool's. tool_path: the matrix
    of poses that agrees with it. other_tool_path: one that claims to be the tool's path and does
    not agree, with how far it is away. twin: the same motion, measured or commanded.
    objections: why it is no joint positions. doubts: what a person should check. reasons: what
    its points were made from; points: 0 to about 1.5, larger is likelier.
    """

    variable: Variable
    name: Name
    low: Array
    high: Array
    finite: bool
    fits: bool
    by_name: bool
    clocks: tuple[ClockColumn, ...] = ()
    unit: UnitEvidence = RADIANS
    unfilled: tuple[int, int] | None = None
    coarse: bool = False
    still: bool = False
    smooth: bool | None = None
    last_is_joint: bool = False
    poses: PoseEvidence = NO_POSES
    velocity_of: str = ""
    is_acceleration: bool = False
    rates: tuple[tuple[str, float], ...] = ()
    tool_of: str = ""
    tool_path: str = ""
    other_tool_path: tuple[str, PoseMatch] | None = None
    twin: str = ""
    objections: tuple[str, ...] = ()
    doubts: tuple[str, ...] = ()
    reasons: tuple[str, ...] = ()
    points: float = 0.0

    @property
    def score(self) -> float:
        """Return how much it is like joint positions, 0 to 1."""
        return round(min(max(self.points, 0.0), 1.0), 3)

    @property
    def path(self) -> str:
        return self.variable.path

    @property
    def values(self) -> NDArray[Any]:
        assert self.variable.values is not None
        return self.variable.values

    @property
    def rows(self) -> int:
        return self.variable.shape[0]

    @property
    def columns(self) -> int:
        return self.variable.shape[1]

    @property
    def confirmed(self) -> bool:
        """Say whether something beside its name shows that it holds joint positions."""
        return bool(self.tool_path) or self.by_name or self.variable.is_message

    def candidate(self) -> Candidate:
        """Return what a person can choose."""
        reasons = (*self.reasons, *self.doubts, *self.objections)
        return Candidate(
            self.path,
            self.variable.shape,
            self.score,
            "; ".join(reasons),
            float(self.low.min()),
            float(self.high.max()),
            preview(self.variable),
        )


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
            measured = _measured(variable, self.name(variable), self.robot, self.time_vectors)
            known = _judged(measured, self.robot)
            self._known[id(variable)] = known
        return known

    @cached_property
    def time_vectors(self) -> dict[int, list[Variable]]:
        return _time_vectors(self.workspace)

    def name(self, variable: Variable) -> Name:
        """Return what the name of a variable says: its path, label, headings and units."""
        return name_of(variable, self.workspace.file_format, self.robot)

    def ranked(self) -> list[Assessment]:
        """Return the matrices that could be taken as they are, likeliest first."""
        found = [
            a for a in self.fitting if self.columns_asked or not blocking_clocks(a, self.robot)
        ]
        return sorted(found, key=lambda a: -a.points)


def survey(workspace: Workspace, robot: RobotModel, *, columns_asked: bool = False) -> Survey:
    """Assess the matrices of a workspace that fit the robot, each once, and one with another."""
    vectors = _time_vectors(workspace)
    fitting = [v for v in workspace.variables if fits(v, robot)]
    form = workspace.file_format
    found = {v.path: _measured(v, name_of(v, form, robot), robot, vectors) for v in fitting}
    _relate(found, workspace, robot)
    judged = {path: _judged(a, robot) for path, a in found.items()}
    known = {id(v): judged[v.path] for v in fitting}
    return Survey(workspace, robot, tuple(judged.values()), columns_asked, known)


def fits(variable: Variable, robot: RobotModel) -> bool:
    """Say whether the matrix has samples as rows and the robot's joints as columns.

    Columns that are named as joints count, in any order; their names have to be the robot's.
    """
    if variable.values is None or len(variable.shape) != 2 or variable.shape[0] < 2:
        return False
    if names_joints(variable, robot):
        return misnamed(variable, robot) is None
    return variable.shape[1] - len(robot.joints) in (0, 1)


def blocking_clocks(assessment: Assessment, robot: RobotModel) -> tuple[ClockColumn, ...]:
    """Return the columns of time that keep a matrix from being taken as it is.

    A column that only may be time blocks where the joints are complete without it and where the
    last column does not open and close a gripper: then the time is a column too many.
    """
    joints = len(robot.joints)
    if assessment.by_name or assessment.variable.is_message:
        return ()
    clocks = tuple(c for c in assessment.clocks if c.likely)
    certain = tuple(c for c in assessment.clocks if c.certain)
    if certain or assessment.columns == joints:
        return certain
    if assessment.columns == joints + 1:
        last = assessment.values[:, joints]
        grips = has_states(last) and float(last.min()) < float(last.max())
        return () if grips else clocks
    return clocks


def time_column_names(variable: Variable, index: int) -> bool:
    """Say whether the heading of a column, from 0, says time."""
    return index < len(variable.columns) and is_time_name(variable.columns[index])


def clocks_among(
    variable: Variable,
    robot: RobotModel,
    vectors: dict[int, list[Variable]],
    low: Array,
    high: Array,
) -> tuple[ClockColumn, ...]:
    """Return the columns of a finite matrix that count time."""
    values = variable.values
    assert values is not None
    rows, columns = values.shape
    if rows < 3 or columns > 200:
        return ()
    moves = high > low
    chosen = np.linspace(0, rows - 1, min(rows, 33)).astype(int)
    coarse = np.diff(values[chosen], axis=0)
    one_way = (coarse > 0).all(axis=0) | (coarse < 0).all(axis=0)
    steady = [
        int(c)
        for c in np.flatnonzero(one_way)
        if is_regular(values[:, c], falling=True) or is_irregular(values[:, c])
    ]
    farthest = max((max(abs(j.lower), abs(j.upper)) for j in robot.joints), default=np.pi)
    found = []
    for c in steady:
        column = values[:, c]
        if column[-1] <= column[0]:
            continue
        headed = time_column_names(variable, c)
        first, last = float(column[0]), float(column[-1])
        others = [i for i in range(columns) if i != c and moves[i]]
        why = ""
        if headed:
            why = f"its heading '{variable.columns[c]}' says time"
        else:
            # where most columns are ramps, each may be the time and none need be
            if not others or 2 * sum(i in steady for i in others) >= len(others):
                continue
            twin = next((v for v in vectors.get(rows, ()) if _same_course(column, v)), None)
            if twin is not None:
                why = f"it runs as '{twin.path}' does"
        if why:
            found.append(ClockColumn(c, True, first, last, why))
            continue
        largest = max(abs(first), abs(last))
        within = sum(max(abs(low[i]), abs(high[i])) <= BEYOND * farthest for i in others)
        if largest > BEYOND * farthest and within >= 0.7 * len(others):
            why = "it rises steadily, farther than a joint turns"
            found.append(ClockColumn(c, True, first, last, why))
        elif _begins_like_a_clock(column) and _is_round(column):
            found.append(ClockColumn(c, False, first, last, "it rises steadily in round steps"))
        elif is_irregular(column):
            why = "it rises in irregular steps, as recorded times do"
            found.append(ClockColumn(c, False, first, last, why))
        elif is_even(column) and len(others) >= 2:
            why = "it rises in equal steps throughout"
            found.append(ClockColumn(c, False, first, last, why, likely=False))
    return tuple(found)


def _begins_like_a_clock(column: NDArray[Any]) -> bool:
    step = (float(column[-1]) - float(column[0])) / (len(column) - 1)
    return abs(float(column[0])) <= 1.5 * step or counts_rows(column)


def _is_round(column: NDArray[Any]) -> bool:
    """Say whether the steps of a column, or its end, are round decimals or rates."""
    step = (float(column[-1]) - float(column[0])) / (len(column) - 1)

    def is_short(number: float) -> bool:
        digits = float(f"{number:.3g}")
        return abs(number - digits) <= 1e-6 * abs(number)

    jitters = float(np.abs(np.diff(column.astype(np.float64)) - step).max()) > 1e-3 * step
    rate = 1 / step
    return (
        is_short(step)
        or is_short(float(column[-1]))
        or (rate >= 1 and abs(rate - round(rate)) <= 1e-4 * rate)
        or jitters
    )


def _same_course(column: NDArray[Any], vector: Variable) -> bool:
    """Say whether a column rises as a vector does, in any unit and from any start."""
    assert vector.values is not None
    other = vector.values.reshape(-1)
    chosen = np.linspace(0, len(column) - 1, min(len(column), 64)).astype(int)
    a, b = column[chosen].astype(np.float64), other[chosen].astype(np.float64)
    if not np.isfinite(b).all() or b[-1] <= b[0]:
        return False
    a, b = (a - a[0]) / (a[-1] - a[0]), (b - b[0]) / (b[-1] - b[0])
    scale = float(column[-1] - column[0]) / float(other[-1] - other[0])
    known = [1.0, 1e-3, 1e3, 1e-6, 1e6, 1e9, 1e-9, 86_400.0, 1 / 86_400]
    return bool(np.abs(a - b).max() <= 1e-6 and any(abs(scale / k - 1) <= 1e-3 for k in known))


def _time_vectors(workspace: Workspace) -> dict[int, list[Variable]]:
    """Return the vectors whose names say time, by the number of their elements."""
    found: dict[int, list[Variable]] = {}
    for v in workspace.variables:
        if (
            v.values is not None
            and len(v.shape) == 2
            and min(v.shape) == 1
            and v.values.size >= 3
            and is_time_name(v.path)
        ):
            found.setdefault(v.values.size, []).append(v)
    return found


def name_of(variable: Variable, file_format: str, robot: RobotModel) -> Name:
    """Return what path, label, headings and units of a variable say.

    The path of a table without headings was given by the reader and says nothing.
    """
    if names_joints(variable, robot):
        return Name(Hint.POSITIONS)
    of_units = _said_by_units(variable.units)
    if of_units.hint is Hint.AGAINST:
        return of_units
    said = describe(variable.path)
    if KEYED.search(variable.path):
        # the columns of a table or an entry of a map: what holds them has any name
        of_columns = describe_table(variable) if variable.columns else None
        said = of_columns or describe(variable.label)
    elif variable.label and said.hint in (Hint.NEUTRAL, Hint.TWO_FACED):
        said = describe(variable.label)
    elif file_format in UNNAMED:
        of_headings = describe_table(variable)
        if of_headings is not None:
            said = of_headings
        elif not variable.columns and variable.path == "q":
            said = Name(Hint.NEUTRAL)
    elif variable.columns and said.hint is not Hint.AGAINST:
        said = describe_table(variable) or said
    return replace(said, unit=of_units.unit) if of_units.unit else said


def _said_by_units(given: tuple[str, ...]) -> Name:
    plain = {u.strip().lower().strip("[]()") for u in given if u.strip()}
    if len(plain) != 1:
        return Name(Hint.NEUTRAL)
    unit = plain.pop()
    for what, names in UNITS_AGAINST.items():
        if unit in names:
            return Name(Hint.AGAINST, what)
    return Name(Hint.NEUTRAL, "", "deg" if unit in ("deg", "degree", "degrees", "°") else "")


def _measured(
    variable: Variable, name: Name, robot: RobotModel, vectors: dict[int, list[Variable]]
) -> Assessment:
    """Return what the numbers and the name of one matrix say by themselves."""
    values = variable.values
    assert values is not None
    rows, columns = values.shape
    joints = len(robot.joints)
    with np.errstate(all="ignore"):
        low, high = (f(axis=0).astype(np.float64) for f in (values.min, values.max))
    finite = bool(np.isfinite(low).all() and np.isfinite(high).all())
    by_name = names_joints(variable, robot) and not variable.is_message
    does_fit = fits(variable, robot)
    base = Assessment(variable, name, low, high, finite, does_fit, by_name)
    if not finite or rows < 2:
        return base
    clocks = clocks_among(variable, robot, vectors, low, high)
    base = replace(base, clocks=clocks)
    if not does_fit or by_name or variable.is_message:
        return base
    arm = values[:, :joints]
    steps = np.abs(np.diff(arm[relations.busiest(arm, SMOOTH_ROWS)].astype(np.float64), axis=0))
    span = high[:joints] - low[:joints]
    moving = span > 1e-6
    smooth = None
    if moving.any() and rows >= ENOUGH_ROWS:
        smooth = float((steps[:, moving].mean(axis=0) / span[moving]).mean()) <= ROUGH
    usual = np.median(steps[:, moving], axis=0) if moving.any() else np.zeros(1)
    last_is_joint = False
    if columns > joints:
        last = values[:, joints]
        in_radians = float(np.abs([low[:joints], high[:joints]]).max()) <= units.LEAST_DEGREES
        last_is_joint = not (has_states(last) or (is_ramp(last) and in_radians))
    return replace(
        base,
        unit=units.evidence(arm, low[:joints], high[:joints], robot, name.unit),
        unfilled=_unfilled(arm, steps),
        coarse=bool(usual.max() > COARSE),
        still=not span.any(),
        smooth=smooth,
        last_is_joint=last_is_joint,
        poses=cartesian.evidence(values, robot),
    )


def _unfilled(arm: NDArray[Any], steps: Array) -> tuple[int, int] | None:
    """Return the first and last row, from 1, of zeros at an end that the motion jumps to."""
    usual = float(np.quantile(steps.max(axis=1), 0.75)) if len(steps) else 0.0
    least = max(UNFILLED_LEAST, UNFILLED_FACTOR * usual)
    for backwards in (True, False):
        ordered = arm[::-1] if backwards else arm
        if ordered[0].any():
            continue
        filled = np.flatnonzero(ordered.any(axis=1))
        if not len(filled):
            return None
        zeros = int(filled[0])
        if zeros >= 2 and float(np.abs(ordered[zeros]).max()) > least:
            return (len(arm) - zeros + 1, len(arm)) if backwards else (1, zeros)
    return None


def _relate(found: dict[str, Assessment], workspace: Workspace, robot: RobotModel) -> None:
    """Add to the assessments what the matrices say about one another."""
    joints = len(robot.joints)
    usable = [
        a
        for a in found.values()
        if a.finite and not a.variable.is_message and not a.still and a.rows >= FEW_ROWS
    ]
    usable.sort(key=lambda a: -NAME_SCORES[a.name.hint])
    compared = usable[:MOST_COMPARED]
    _relate_derivatives(found, compared, workspace, joints)
    _relate_twins(found, compared, joints)
    if robot.chain is not None:
        _relate_poses(found, compared, workspace, robot)


def _relate_derivatives(
    found: dict[str, Assessment], compared: list[Assessment], workspace: Workspace, joints: int
) -> None:
    shorter = [
        v
        for v in workspace.variables
        if v.values is not None
        and len(v.shape) == 2
        and v.shape[1] == joints
        and any(v.shape[0] == a.rows - 1 for a in compared)
    ][:MOST_COMPARED]
    derivatives: dict[tuple[str, str], float] = {}
    for rows in {a.rows for a in compared}:
        same = [a for a in compared if a.rows == rows]
        short = [v for v in shorter if v.shape[0] == rows - 1]
        if len(same) + len(short) < 2:
            continue
        part = relations.busiest(same[0].values)
        courses = {a.path: relations.course(a.values[:, :joints], part) for a in same}
        of_short = {v.path: relations.course(_matrix(v), part) for v in short}
        for path, first in courses.items():
            for other, course in (*courses.items(), *of_short.items()):
                if first is None or course is None or other == path:
                    continue
                rate = relations.derivative_rate(first, course, shorter=other in of_short)
                if rate is not None:
                    derivatives[path, other] = rate
    for (path, derivative), rate in derivatives.items():
        if (derivative, path) in derivatives:
            continue  # exponentials are derivatives of one another
        own = found[path]
        found[path] = replace(own, rates=(*own.rates, (derivative, rate)))
        if derivative in found:
            found[derivative] = replace(found[derivative], velocity_of=path)
    for path, own in found.items():
        if own.velocity_of and found[own.velocity_of].velocity_of:
            found[path] = replace(own, is_acceleration=True)


def _matrix(variable: Variable) -> NDArray[Any]:
    assert variable.values is not None
    return variable.values


def _relate_twins(found: dict[str, Assessment], compared: list[Assessment], joints: int) -> None:
    for i, a in enumerate(compared):
        for b in compared[i + 1 :]:
            if a.rows != b.rows or found[b.path].twin or not _are_twins(a.path, b.path):
                continue
            rows = np.linspace(0, a.rows - 1, min(a.rows, 256)).astype(int)
            one, other = (m.values[rows, :joints].astype(np.float64) for m in (a, b))
            moves = float(np.ptp(one, axis=0).max())
            if float(np.abs(one - other).max()) <= min(SAME_MOTION, 0.25 * moves):
                found[b.path] = replace(found[b.path], twin=a.path)
                found[a.path] = replace(found[a.path], twin=b.path)


def _are_twins(one: str, other: str) -> bool:
    """Say whether two names differ in words for measured and commanded alone."""
    a, b = ({*parts(path)} for path in (one, other))
    return bool(a != b and (a ^ b) <= MEASURED_OR_COMMANDED)


def _relate_poses(
    found: dict[str, Assessment],
    compared: list[Assessment],
    workspace: Workspace,
    robot: RobotModel,
) -> None:
    joints = len(robot.joints)
    lengths = {a.rows for a in compared}
    posed = []
    for v in workspace.variables:
        if v.values is None or 1 in v.shape:
            continue
        own = found.get(v.path)
        if own is not None and not (
            own.name.what == POSES or own.poses.possible or own.poses.strong
        ):
            continue
        points = relations.tool_points(v.values)
        if points is not None and len(points) in lengths:
            posed.append((v, points))
    posed.sort(key=lambda pair: describe(pair[0].path).what != POSES)
    for a in compared[:MOST_POSES]:
        own = found[a.path]
        if own.velocity_of or own.unit.unit not in ("rad", "deg") or own.name.hint is Hint.AGAINST:
            continue
        rows = relations.rows_to_compare(a.rows)
        arm = a.values[rows, :joints].astype(np.float64)
        poses = robot.chain.tool0(np.radians(arm) if own.unit.unit == "deg" else arm)
        for v, points in posed[:MOST_POSES]:
            if v.path == a.path or len(points) != a.rows:
                continue
            match = relations.compare_poses(poses, points[rows])
            if match is None:
                continue
            if match.agrees:
                found[a.path] = own = replace(own, tool_path=v.path, other_tool_path=None)
                if v.path in found:
                    found[v.path] = replace(found[v.path], tool_of=a.path)
            elif match.differs and describe(v.path).what == POSES and not own.tool_path:
                found[a.path] = own = replace(own, other_tool_path=(v.path, match))


def _judged(a: Assessment, robot: RobotModel) -> Assessment:
    """Return the assessment with its score, its objections and its doubts."""
    if a.variable.is_message:
        return replace(a, points=1.5, reasons=("it is a JointTrajectory for these joints",))
    points = 0.5
    reasons: list[str] = []
    objections: list[str] = []
    doubts: list[str] = []
    hint = a.name.hint
    if a.by_name:
        points += 0.4
        reasons.append("its columns are named as the joints")
    else:
        points += NAME_SCORES[hint]
        reasons.append(a.name.why)
    if not a.finite:
        reasons.append("it holds NaN or Inf")
        return replace(a, points=points, reasons=tuple(reasons))
    if a.fits:
        points += _judge_range(a, reasons)
        points += _judge_motion(a, reasons)
        objections += _objections(a)
        doubts += _doubts(a, robot)
    if a.tool_path:
        points += 0.3
        reasons.append(f"'{a.tool_path}' is the path of the tool at these positions")
    if a.rates and hint in (Hint.POSITIONS, Hint.NEUTRAL, Hint.TWO_FACED):
        points += 0.15
        reasons.append(f"'{a.rates[0][0]}' is its derivative")
    if a.rows == a.columns:
        points -= 0.2
        reasons.append("it is square")
    if a.last_is_joint:
        points -= 0.1
        reasons.append("its last column is not a gripper's")
    may_be_poses = a.poses.possible and hint in (Hint.TWO_FACED, Hint.DOUBTFUL)
    if may_be_poses and a.poses.hints and not a.tool_path:
        points -= 0.25
    if any(c.likely for c in a.clocks) and not a.by_name and a.columns == len(robot.joints):
        points -= 0.3
    if objections:
        points = min(points, 0.2)
    return replace(
        a,
        points=points,
        reasons=tuple(reasons),
        objections=tuple(objections),
        doubts=tuple(doubts),
    )


def _judge_range(a: Assessment, reasons: list[str]) -> float:
    if a.by_name or a.unit.unit == "rad":
        return 0.1
    reasons.append("it leaves the joint limits" if a.unit.unit == "" else a.unit.why)
    return -0.2


def _judge_motion(a: Assessment, reasons: list[str]) -> float:
    if a.still:
        reasons.append("it never moves")
        return -0.2
    if a.smooth is not None:
        reasons.append(
            "it moves smoothly" if a.smooth else "its rows do not follow one another like a motion"
        )
        return 0.1 if a.smooth else -0.25
    if a.rows < FEW_ROWS:
        reasons.append(f"it has {a.rows} rows only")
        return -0.15
    return 0.0


def _objections(a: Assessment) -> Iterable[str]:
    if a.velocity_of:
        what = "accelerations" if a.is_acceleration else "velocities"
        yield f"it holds the {what} of '{a.velocity_of}'"
    if a.tool_of:
        yield f"its columns 1 to 3 are the positions of the tool at '{a.tool_of}'"
    if a.poses.strong:
        yield f"it looks like poses of the tool: {a.poses.strong}"
    if not (a.low.any() or a.high.any()):
        yield "all of it is 0: it was never filled"


def _doubts(a: Assessment, robot: RobotModel) -> Iterable[str]:
    if a.poses.possible and a.poses.hints and not (a.tool_path or a.rates or a.by_name):
        yield f"it may be poses of the tool in m and rad: {' and '.join(a.poses.hints)}"
    for clock in a.clocks:
        if not (a.by_name or clock in blocking_clocks(a, robot)):
            yield f"column {clock.index + 1} may be time and not a joint: {clock.why}"
    if a.still and (a.low.any() or a.high.any()):
        yield "it never moves"
