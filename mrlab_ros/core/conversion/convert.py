"""The converter's one use case: a file from outside becomes a checked trajectory."""

from __future__ import annotations

import contextlib
import re
from collections.abc import Callable
from dataclasses import dataclass, field, replace
from enum import Enum
from typing import Any

from mrlab_ros.core.base.diagnostic import MATLAB_PATH, Diagnostic, Fix, Severity
from mrlab_ros.core.base.errors import BadInput
from mrlab_ros.core.conversion import (
    discovery,
    kinematics_match,
    motion_checks,
    picking,
    questions,
    resampling,
)
from mrlab_ros.core.conversion.candidates import Candidate, Preview, contents, preview
from mrlab_ros.core.conversion.diagnostics import (
    DISCONTINUITY,
    DOUBTFUL_VALUES,
    JUMP_FULL_TURN,
    NO_MOTION,
    REPEATED_PIECES,
    RESAMPLED,
    TOO_MANY_ROWS,
    TRAJECTORY_TAKEN,
    WAYPOINTS,
)
from mrlab_ros.core.conversion.evidence import joining, other_columns
from mrlab_ros.core.conversion.evidence.assessment import Assessment
from mrlab_ros.core.conversion.evidence.headings import split_tables, with_stamps
from mrlab_ros.core.conversion.evidence.joint_order import with_headings, with_statements
from mrlab_ros.core.conversion.evidence.survey import Survey, fits, survey
from mrlab_ros.core.conversion.layout import Layout, lay_out
from mrlab_ros.core.conversion.options import DEFAULT_FRAME_RATE, MOST_ROWS, Options
from mrlab_ros.core.conversion.picking import Chosen, pick, reshaped
from mrlab_ros.core.conversion.workspace import Variable, Workspace
from mrlab_ros.core.robots.model import RobotModel
from mrlab_ros.core.trajectory import derived_signals
from mrlab_ros.core.trajectory.catalogue import LONGEST_NAME, checked_id, spelled
from mrlab_ros.core.trajectory.derived_signals import ProxyCoefficients
from mrlab_ros.core.trajectory.trajectory import Array, Source, Trajectory

OF_PYTHON = (".npy", ".npz", ".json")


class Outcome(Enum):
    """How a conversion ended; the values are those of mrlab_msgs/ConvertTrajectory."""

    REJECTED = 0
    ACCEPTED = 1
    AMBIGUOUS = 2


@dataclass(frozen=True, eq=False)
class ConversionResult:
    """What became of a file; diagnostics worst first, candidates where a choice is needed.

    preview: some rows of the matrix that was refused, where one was found; frame_rate: theirs, Hz,
    0: not known.
    """

    file: str
    outcome: Outcome
    trajectory: Trajectory | None
    candidates: tuple[Candidate, ...]
    diagnostics: tuple[Diagnostic, ...]
    preview: Preview | None = None
    frame_rate: float = 0.0

    @property
    def said(self) -> Diagnostic:
        """Return what a person is told first: that it was taken, or why not."""
        t = self.trajectory
        if t is None:
            return self.diagnostics[0]
        return TRAJECTORY_TAKEN(
            variable=t.source.variable,
            file=self.file,
            frames=t.frame_count,
            rate=t.frame_rate,
            duration=t.duration,
            warnings=len(t.warnings) or None,
        )

    @property
    def message(self) -> str:
        """Return the English text of what is said."""
        return str(self.said)


def id_from(file: str) -> str:
    """Return a name for the catalogue from a file's name."""
    endings = r"(\.(mat|csv|txt|tsv|lvm|npz|npy|m|json|mcap|gz|zstd?|db3|cdr))+$"
    stem = re.sub(endings, "", file, flags=re.I)
    return spelled(re.sub("[/@]+", "_", stem))[:LONGEST_NAME] or "trajectory"


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
    most_rows: int = MOST_ROWS,
) -> ConversionResult:
    """Convert what `read` returns, a file called `file`; a refusal is a result, not an exception.

    read: returns the file's variables or raises BadInput, as WorkspaceReader.read_file does.
    trajectory_id: name in the catalogue, empty: from the file's name; raises BadInput where it
    cannot be a name. default_frame_rate: Hz, where neither the options nor the file have one.
    most_rows: a matrix with more samples is refused.
    """
    trajectory_id = checked_id(trajectory_id or id_from(file))
    found = _Found(of_python=file.lower().endswith(OF_PYTHON))

    def tried(refused: ConversionResult) -> ConversionResult:
        """Return a refusal with those of its fixes that lead to a motion."""
        if found.workspace is None or found.workspace.count > questions.MOST_VALUES:
            return refused
        alone = replace(found.workspace, confirm=None)

        def attempt(changed: Options) -> tuple[Diagnostic, ...]:
            sizes: dict[str, Any] = {"default_frame_rate": default_frame_rate, "rows": most_rows}
            return _findings(file, alone, changed, robot, **sizes)

        said = questions.vetted(refused.diagnostics, options, attempt)
        return replace(refused, diagnostics=tuple(found.said(list(said))))

    try:
        options.checked_rate()
        options.factor()
        checked = _as_it_lies(
            found,
            file,
            read,
            options,
            robot,
            default_frame_rate=default_frame_rate,
            rows=most_rows,
        )
        if isinstance(checked, ConversionResult):
            return tried(checked)
        # the numbers are not needed any more, and may be many
        found.variable = found.workspace = None
        arm, rate = checked.layout.arm, checked.rate
        trajectory = Trajectory(
            id=trajectory_id,
            robot_model=robot.id,
            end_effector=end_effector or None,
            joint_names=robot.joint_names,
            frame_rate=rate,
            positions=arm,
            gripper=checked.layout.gripper,
            channels=derived_signals.derive(arm, rate, coefficients),
            source=checked.source,
            created_ns=created_ns,
            warnings=_worst_first([n for n in found.notes if n.severity is Severity.WARNING]),
        )
    except BadInput as refused:
        found.notes.append(refused.diagnostic)
        notes = picking.with_lines(found.notes, found.squeezed)
        return tried(_rejected(file, found.said(notes), found.variable))
    return ConversionResult(file, Outcome.ACCEPTED, trajectory, (), _worst_first(found.notes))


def _findings(
    file: str,
    workspace: Workspace,
    options: Options,
    robot: RobotModel,
    *,
    default_frame_rate: float,
    rows: int,
) -> tuple[Diagnostic, ...]:
    """Return the findings of a conversion, worst first, without its trajectory."""
    found = _Found()
    try:
        checked = _as_it_lies(
            found,
            file,
            lambda: workspace,
            options,
            robot,
            default_frame_rate=default_frame_rate,
            rows=rows,
        )
    except BadInput as refused:
        return _worst_first([*found.notes, refused.diagnostic])
    if isinstance(checked, ConversionResult):
        return checked.diagnostics
    return _worst_first(found.notes)


@dataclass(eq=False)
class _Found:
    """What a conversion has found until it ends: what to say, and the matrix it is about.

    workspace: as it was read; None once it is not needed any more.
    unspeakable: paths of variables that MATLAB would take for more than a name. of_python: the
    file was written by Python.
    """

    notes: list[Diagnostic] = field(default_factory=list)
    workspace: Workspace | None = None
    variable: Variable | None = None
    squeezed: dict[str, picking.Squeezed] = field(default_factory=dict)
    unspeakable: tuple[str, ...] = ()
    of_python: bool = False

    def said(self, notes: list[Diagnostic]) -> list[Diagnostic]:
        """Return the notes without the lines of MATLAB that hold such a path, or help nobody.

        Their reader pastes them: a variable of a file may be called `q; system('...')`. A file
        of Python has none.
        """
        if not (self.unspeakable or self.of_python):
            return notes
        return [
            replace(note, fixes=tuple(filter(None, map(self._without, note.fixes))))
            for note in notes
        ]

    def _without(self, fix: Fix) -> Fix | None:
        acts = self.of_python or any(path in fix.matlab for path in self.unspeakable)
        if acts and not (fix.option or fix.command):
            return None
        return replace(fix, matlab="") if acts else fix


@dataclass(frozen=True, eq=False)
class _Checked:
    """A matrix that can be played."""

    layout: Layout
    rate: float
    source: Source


def _as_it_lies(
    found: _Found,
    file: str,
    read: Callable[[], Workspace],
    options: Options,
    robot: RobotModel,
    **sizes: Any,
) -> _Checked | ConversionResult:
    """Do what _checked() does; where only a layout can be meant, with that layout."""
    checked, refused = None, None
    try:
        checked = _checked(found, file, read, options, robot, **sizes)
        if isinstance(checked, _Checked):
            return checked
        said = checked.diagnostics
    except BadInput as error:
        refused = error
        said = _worst_first([*found.notes, error.diagnostic])
    workspace, changed = found.workspace, questions.layout(said, options)
    if workspace is not None and changed is not None:
        again = replace(found, notes=[], variable=None)
        with contextlib.suppress(BadInput):
            other = _as_it_lies(again, file, lambda: workspace, changed, robot, **sizes)
            notes = questions.read_so(again.notes, said[0])
            if isinstance(other, _Checked) and notes is not None:
                found.notes = notes
                return other
    if refused is not None:
        raise refused
    assert checked is not None
    return checked


def _checked(
    found: _Found,
    file: str,
    read: Callable[[], Workspace],
    options: Options,
    robot: RobotModel,
    *,
    default_frame_rate: float,
    rows: int,
) -> _Checked | ConversionResult:
    """Find the matrix and check it; return it, or the result where there is none to play."""
    notes = found.notes
    held = found.workspace = read()
    paths = [v.path for v in held.variables]
    found.unspeakable = tuple(p for p in paths if not MATLAB_PATH.fullmatch(p))
    stored, squeezed = picking.flattened(held, robot)
    found.squeezed = squeezed
    workspace, wanted = _prepared(stored, options, robot, file)
    pieces = joining.expanded(options.join) if options.join else []
    if len(set(pieces)) < len(pieces):
        why = REPEATED_PIECES(join=options.join)
        notes.append(DOUBTFUL_VALUES(variable=options.join, why=[why]))
    chosen, survey, offered = _find(workspace, wanted, options, robot, file, notes)
    if chosen is None:
        said = found.said(picking.with_lines(notes, squeezed))
        if not offered:
            return _rejected(file, said, survey.workspace.find(notes[-1].variable))
        candidates = tuple(a.candidate() for a in offered)
        return ConversionResult(file, Outcome.AMBIGUOUS, None, candidates, _worst_first(said))
    variable = found.variable = chosen.variable
    count = variable.shape[0] if variable.shape else 0
    if count > rows:
        raise BadInput(TOO_MANY_ROWS(variable=variable.path, rows=count, most=rows))
    sources = joining.sources(variable.path, options.join)
    for path in sources:
        matrix = stored.find(path)
        if path in squeezed and matrix is not None:
            notes.append(picking.squeezed_finding(path, squeezed[path], matrix))
    if options.columns and not options.transpose and not variable.is_message:
        notes += picking.doubts(chosen, robot)
    if workspace.confirm is not None and variable.values is not None:
        # before the joints are copied, as the second reader needs memory as well
        workspace.confirm(sources)
    notes += questions.asked(workspace, variable, survey.name(variable), robot, options, file)
    layout = lay_out(chosen, survey, options, notes)
    points = layout.arm
    layout, rate = resampling.at_a_rate(
        survey, chosen, layout, options, default_frame_rate, file, notes
    )
    notes += joining.rows_left_out(stored, wanted, transposed=options.transpose)
    notes += questions.unread(survey, variable, rate, options, notes)
    against = _against_robot(points, layout, rate, variable.path, robot, notes)
    notes += [motion_checks.of_columns(d) for d in against] if options.transpose else against
    notes += kinematics_match.findings(workspace, robot)
    found.notes = notes = found.said(picking.with_lines(notes, squeezed))
    errors = [n for n in notes if n.severity is Severity.ERROR]
    if errors and all(n.code in questions.ANSWERS for n in errors):
        asked = (survey.of(variable).candidate(),)
        return ConversionResult(file, Outcome.AMBIGUOUS, None, asked, _worst_first(notes))
    if errors:
        return replace(_rejected(file, notes, variable), frame_rate=rate)
    return _Checked(layout, rate, Source(file, variable.path, workspace.sha256))


def _against_robot(
    points: Array,
    layout: Layout,
    rate: float,
    path: str,
    robot: RobotModel,
    notes: list[Diagnostic],
) -> list[Diagnostic]:
    """Return what is said of the frames, at `rate` Hz, against what the robot can do.

    points: (K, J) rad, of which the frames were made: lines between random ones look like a
    motion, and half of a full turn like a jump.
    """
    points_rate = rate * (len(points) - 1) / max(len(layout.arm) - 1, 1)
    why = motion_checks.fault(points, points_rate, robot)
    if why:
        return [NO_MOTION(variable=path, why=why)]
    found = motion_checks.against_robot(layout.arm, rate, robot.joints, path, robot.id)
    if len(points) != len(layout.arm):
        of_points = motion_checks.against_robot(points, points_rate, robot.joints, path, robot.id)
        turns = [f for f in of_points if f.code == JUMP_FULL_TURN.code]
        turned = {f.joint for f in turns}
        jumps = [f for f in found if not (f.code == DISCONTINUITY.code and f.joint in turned)]
        found = [*turns, *jumps]
    if any(n.code == RESAMPLED.code for n in notes):
        found = [motion_checks.with_own_times(f) for f in found]
    if any(n.code == WAYPOINTS.code for n in notes):
        # the time between waypoints is not known, so their speed is not either
        return [f for f in found if f.code != "velocity_limit"]
    return found


def _rejected(file: str, notes: list[Diagnostic], variable: Variable | None) -> ConversionResult:
    found = _worst_first(notes)
    shown = None
    held = None if variable is None else variable.values
    if variable is not None and held is not None and held.ndim == 2 and held.size:
        shown = preview(variable, [row for d in found for row in (d.first_row, d.last_row) if row])
    return ConversionResult(file, Outcome.REJECTED, None, (), found, shown)


def _worst_first(notes: list[Diagnostic]) -> tuple[Diagnostic, ...]:
    return tuple(sorted(notes, key=lambda n: -n.severity))


def _prepared(
    workspace: Workspace, options: Options, robot: RobotModel, file: str
) -> tuple[Workspace, str]:
    """Return the workspace with tables split and joined variables added, and what was asked for.

    The second is the path of the matrix that the options name, or empty.
    """
    workspace = with_stamps(other_columns.with_times(workspace))
    workspace = split_tables(with_headings(workspace, robot), robot)
    wanted = options.variable
    if workspace.find(wanted) is None:
        wanted = wanted.strip()
    if options.join:
        joints = len(robot.joints)
        whole = joining.joined(workspace, options.join, joints, contents(workspace), file)
        workspace = replace(workspace, variables=(whole, *workspace.variables))
        wanted = wanted or whole.path
    if wanted and workspace.find(wanted) is None:
        workspace = joining.part_of(workspace, wanted) or workspace
    return with_statements(workspace, robot, options.join), wanted


def _find(
    workspace: Workspace,
    wanted: str,
    options: Options,
    robot: RobotModel,
    file: str,
    notes: list[Diagnostic],
) -> tuple[Chosen | None, Survey, list[Assessment]]:
    """Return the matrix to convert, or what there is to choose from, adding to `notes`."""
    if wanted:
        variable = discovery.named(workspace, wanted, file)
        chosen = Chosen(variable, variable, [])
        if variable.values is not None and len(variable.shape) == 2:
            chosen = pick(variable, options, workspace, robot)
            others = tuple(v for v in workspace.variables if v.path != variable.path)
            workspace = replace(workspace, variables=(chosen.variable, *others))
        found = survey(workspace, robot, columns_asked=bool(options.columns))
        if chosen.variable.values is not None and fits(chosen.variable, robot):
            notes += discovery.doubts(found.of(chosen.variable), asked=True)
        return chosen, found, []
    laid_out = reshaped(workspace, options, robot)
    found = survey(laid_out, robot, columns_asked=bool(options.columns))
    best, offered, said = discovery.choose(found, file)
    notes += said
    if best is None:
        return None, found, offered
    stored = workspace.find(best.path)
    assert stored is not None
    if stored.values is None or (stored.is_message and not options.gripper):
        return Chosen(stored, best.variable, list(range(best.columns))), found, []
    picked = pick(stored, options, workspace, robot)
    # the variable that was assessed, so that it is not assessed again
    return replace(picked, variable=best.variable), found, []
