"""The converter's one use case: a file from outside becomes a checked trajectory."""

from __future__ import annotations

import re
from collections.abc import Callable
from dataclasses import dataclass, replace
from enum import Enum
from pathlib import Path
from typing import Any, Protocol

import numpy as np
import yaml
from numpy.typing import NDArray

from mrlab_ros.core import channels, checks, discovery
from mrlab_ros.core.channels import ProxyCoefficients
from mrlab_ros.core.diagnostics import Diagnostic, Refused, Severity, finding
from mrlab_ros.core.discovery import Candidate, FrameRate
from mrlab_ros.core.errors import BadInput
from mrlab_ros.core.names import Hint, hint
from mrlab_ros.core.robot_model import RobotModel
from mrlab_ros.core.selection import Options, parse_columns
from mrlab_ros.core.trajectory import Array, Source, Trajectory
from mrlab_ros.core.workspace import Variable, Workspace

DEFAULT_FRAME_RATE = 100.0  # Hz
# Two turns: radians that went astray by a full turn stay below it, degrees of a motion do not.
LEAST_DEGREES = 4 * np.pi
ID = re.compile(r"[A-Za-z0-9][A-Za-z0-9._-]{0,127}$")


class Outcome(Enum):
    """How a conversion ended; the values are those of mrlab_msgs/ConvertTrajectory."""

    REJECTED = 0
    ACCEPTED = 1
    AMBIGUOUS = 2


class Reader(Protocol):
    """Reads a workspace file; `adapters.matfile_reader` does so in a walled-off process."""

    def read_file(self, path: Path) -> Workspace:
        """Return the file's variables; raise Refused."""
        ...


@dataclass(frozen=True, eq=False)
class ConversionResult:
    """What became of a file; diagnostics worst first, candidates where a choice is needed."""

    file: str
    outcome: Outcome
    trajectory: Trajectory | None
    candidates: tuple[Candidate, ...]
    diagnostics: tuple[Diagnostic, ...]

    @property
    def message(self) -> str:
        """Return one sentence for a person."""
        if self.trajectory is not None:
            t, warned = self.trajectory, len(self.trajectory.warnings)
            return (
                f"'{t.source.variable}' of '{self.file}' was taken: {t.frame_count} frames at "
                f"{t.frame_rate:g} Hz, {t.duration:.2f} s"
                + (f", with {checks.counted(warned, 'warning')}" if warned else "")
            )
        worst = self.diagnostics[0]
        return f"{worst.message} {worst.remedy}".strip()


def load_coefficients(path: Path) -> ProxyCoefficients:
    """Read config/torque_proxy.yaml; raise BadInput where it is wrong."""
    try:
        values = yaml.safe_load(path.read_text(encoding="utf-8"))
    except (OSError, yaml.YAMLError) as error:
        raise BadInput(f"{path.name} cannot be read: {error}; restore config/") from None
    if not isinstance(values, dict):
        raise BadInput(f"{path.name} holds {values!r}; expected the coefficients by name")
    return ProxyCoefficients.from_mapping(values)


def id_from(file: str) -> str:
    """Return a name for the catalogue from a file's name: its letters, digits, '.', '_', '-'."""
    stem = re.sub(r"(\.(mat|csv|txt|tsv|npz|json|mcap|gz|db3))+$", "", file, flags=re.I)
    cleaned = re.sub(r"[^A-Za-z0-9._-]+", "_", stem).strip("._-")[:128]
    return cleaned or "trajectory"


def convert_file(
    path: Path,
    options: Options,
    robot: RobotModel,
    *,
    reader: Reader,
    coefficients: ProxyCoefficients,
    **words: Any,
) -> ConversionResult:
    """Convert the file at `path` for `robot`; a refusal is a result, never an exception.

    words: what `convert` takes beside the file's contents.
    """
    return convert(
        path.name, lambda: reader.read_file(path), options, robot, coefficients, **words
    )


def convert(
    file: str,
    read: Callable[[], Workspace],
    options: Options,
    robot: RobotModel,
    coefficients: ProxyCoefficients,
    *,
    end_effector: str | None = None,
    trajectory_id: str = "",
    created_ns: int = 0,
    default_frame_rate: float = DEFAULT_FRAME_RATE,
) -> ConversionResult:
    """Convert what `read` returns, a file called `file`.

    trajectory_id: name in the catalogue, empty: from the file's name; raises BadInput where it
    cannot be a name. default_frame_rate: Hz, where neither the options nor the file have one.
    """
    trajectory_id = trajectory_id or id_from(file)
    if not ID.match(trajectory_id):
        raise BadInput(
            f"the name '{trajectory_id}' cannot be used; expected letters, digits, '.', '_' and "
            "'-', at most 128, beginning with a letter or digit"
        )
    notes: list[Diagnostic] = []
    offered: list[Candidate] = []
    try:
        options.checked_rate()
        workspace = read()
        variable, offered, found = _find(workspace, options, robot, file)
        notes += found
        if variable is None:
            outcome = Outcome.AMBIGUOUS if offered else Outcome.REJECTED
            return ConversionResult(file, outcome, None, tuple(offered), _worst_first(notes))
        source = Source(file, variable.path, workspace.sha256)
        arm, gripper, times = _matrix(variable, options, robot, notes)
        rate = _frame_rate(workspace, variable, times, options, default_frame_rate, file, notes)
        arm = _apply(arm, options, robot, variable.path, notes)
        notes += checks.against_robot(arm, rate, robot.joints, variable.path, robot.id)
        if any(n.severity is Severity.ERROR for n in notes):
            return ConversionResult(file, Outcome.REJECTED, None, (), _worst_first(notes))
        trajectory = Trajectory(
            id=trajectory_id,
            robot_model=robot.id,
            end_effector=end_effector or None,
            joint_names=robot.joint_names,
            frame_rate=rate,
            positions=arm,
            gripper=gripper,
            channels=channels.derive(arm, rate, coefficients),
            source=source,
            created_ns=created_ns,
            warnings=_worst_first([n for n in notes if n.severity is Severity.WARNING]),
        )
    except Refused as refused:
        notes.append(refused.finding)
        return ConversionResult(file, Outcome.REJECTED, None, (), _worst_first(notes))
    return ConversionResult(file, Outcome.ACCEPTED, trajectory, (), _worst_first(notes))


def _worst_first(notes: list[Diagnostic]) -> tuple[Diagnostic, ...]:
    return tuple(sorted(notes, key=lambda n: -n.severity))


def _find(
    workspace: Workspace, options: Options, robot: RobotModel, file: str
) -> tuple[Variable | None, list[Candidate], list[Diagnostic]]:
    """Return the variable to convert, or what there is to choose from, with the findings."""
    if options.variable:
        variable = discovery.named(workspace, options.variable, file)
        said = hint(variable.path)
        if said in (Hint.AGAINST, Hint.DOUBTFUL):
            return variable, [], [finding("doubtful_name", variable=variable.path, why=said.value)]
        return variable, [], []
    laid_out = workspace
    if options.transpose or options.columns:
        laid_out = _reshaped(workspace, options)
    ranked = discovery.candidates(laid_out, robot)
    choice, offered, notes = discovery.choose(laid_out, robot, file, ranked)
    return workspace.find(choice.path) if choice else None, offered, notes


def _reshaped(workspace: Workspace, options: Options) -> Workspace:
    """Return the workspace as it is once the options that change a shape were applied.

    Matrices that lack the columns are left out: they cannot be what was meant.
    """
    reshaped = []
    for v in workspace.variables:
        if v.values is None or v.values.size == 1 or 1 in v.shape:
            reshaped.append(v)
            continue
        values = v.values.T if options.transpose else v.values
        if options.columns:
            try:
                picked = parse_columns(options.columns, values.shape[1], v.path, v.size)
            except Refused:
                continue
            values = values[:, picked]
        reshaped.append(replace(v, values=values, shape=values.shape))
    return replace(workspace, variables=tuple(reshaped))


def _matrix(
    variable: Variable, options: Options, robot: RobotModel, notes: list[Diagnostic]
) -> tuple[Array, NDArray[np.bool_] | None, NDArray[Any] | None]:
    """Return positions (N, J) as stored, the gripper or None, and a time column or None.

    Applies the options that change a shape. Raises Refused where the outcome does not fit.
    """
    path, joints = variable.path, len(robot.joints)
    if variable.values is None or min(variable.shape) == 0:
        raise Refused(_misfit(variable, robot))
    values, times = variable.values, None
    if options.transpose:
        values = values.T
        notes.append(finding("option_applied", variable=path, what=f"'{path}' was transposed"))
    if options.columns:
        picked = parse_columns(options.columns, values.shape[1], path, variable.size)
        if 0 not in picked and discovery.is_time(values[:, 0]):
            times = values[:, 0]
        values = values[:, picked]
        what = f"columns {options.columns} of '{path}' were taken"
        notes.append(finding("option_applied", variable=path, what=what))
    laid_out = replace(variable, values=values, shape=values.shape)
    if not discovery.fits(laid_out, robot):
        raise Refused(_misfit(laid_out, robot))
    bad = checks.non_finite(values, path)
    if bad is not None:
        raise Refused(bad)
    if not options.columns:
        miss = discovery.near_miss(laid_out, robot)
        if miss is not None and miss.code == "time_column":
            raise Refused(miss)
    arm = np.array(values[:, :joints], dtype=np.float64, order="C")
    if values.shape[1] == joints:
        return arm, None, times
    return arm, _gripper(values[:, joints], options, robot, path, notes), times


def _misfit(variable: Variable, robot: RobotModel) -> Diagnostic:
    joints = len(robot.joints)
    return discovery.near_miss(variable, robot) or finding(
        "wrong_shape",
        variable=variable.path,
        size=" ".join(filter(None, (variable.size, variable.kind))),
        robot=robot.id,
        joints=joints,
        more=joints + 1,
        hint="",
    )


def _gripper(
    column: NDArray[Any],
    options: Options,
    robot: RobotModel,
    path: str,
    notes: list[Diagnostic],
) -> NDArray[np.bool_]:
    """Return true where closed: above the middle of the column's range, open if it is constant."""
    low, high = float(column.min()), float(column.max())
    joints = len(robot.joints)
    where = f"column {joints + 1}"
    if low == high:
        notes.append(finding("gripper_constant", variable=path, where=where, first=low))
        return np.zeros(len(column), dtype=np.bool_)
    if not options.columns and not discovery.is_gripper(column):
        levels = f"{len(np.unique(column))} values"
        words: dict[str, Any] = {"first": float(column[0]), "last": float(column[-1])}
        words |= {"levels": levels, "robot": robot.id, "joints": joints, "column": joints + 1}
        raise Refused(finding("seven_axes", variable=path, where=where, **words))
    threshold = (low + high) / 2
    if (low, high) != (0.0, 1.0):
        notes.append(
            finding(
                "gripper_range",
                variable=path,
                where=where,
                first=low,
                last=high,
                threshold=threshold,
            )
        )
    return np.asarray(column > threshold)


def _apply(
    arm: Array, options: Options, robot: RobotModel, path: str, notes: list[Diagnostic]
) -> Array:
    """Apply the options that change values; raise Refused where degrees were not declared."""
    limits = np.array([(j.lower, j.upper) for j in robot.joints])
    if options.degrees:
        np.radians(arm, out=arm)
        what = f"'{path}' was taken as degrees"
        notes.append(finding("option_applied", variable=path, what=what))
    else:
        low, high = arm.min(axis=0), arm.max(axis=0)
        largest = float(np.abs([low, high]).max())
        inside = (np.radians(low) >= limits[:, 0]).all() and (
            np.radians(high) <= limits[:, 1]
        ).all()
        if inside and largest > max(LEAST_DEGREES, 2 * float(np.abs(limits).max())):
            raise Refused(finding("degrees", variable=path, value=largest, robot=robot.id))
    if options.unwrap:
        arm = np.unwrap(arm, axis=0)
        what = f"jumps of 2*pi in '{path}' were removed"
        notes.append(finding("option_applied", variable=path, what=what))
    return arm


def _frame_rate(
    workspace: Workspace,
    variable: Variable,
    times: NDArray[Any] | None,
    options: Options,
    default: float,
    file: str,
    notes: list[Diagnostic],
) -> float:
    """Return the frame rate, Hz: asked for, from the time column, from the file, the default."""
    if options.frame_rate:
        return options.frame_rate
    rows = variable.shape[1 if options.transpose else 0]
    found = discovery.frame_rates(workspace, variable.path, rows)
    if times is not None:
        column = discovery.rate_of_times(times, f"{variable.path}(:, 1)")
        found = ([column] if column else []) + found
    if not found:
        notes.append(finding("rate_default", file=file, rate=default))
        return default
    best = found[0]
    notes.append(finding("rate_found", variable=best.source, rate=best.rate))
    for other in found[1:]:
        if abs(other.rate - best.rate) > 0.01 * best.rate:
            notes.append(_conflict(best, other))
            break
    if best.uneven:
        least, most = best.uneven
        notes.append(
            finding("time_uneven", variable=best.source, least=least, most=most, rate=best.rate)
        )
    return best.rate


def _conflict(best: FrameRate, other: FrameRate) -> Diagnostic:
    return finding(
        "rate_conflict",
        variable=best.source,
        rate=best.rate,
        other=other.source,
        other_rate=other.rate,
    )
