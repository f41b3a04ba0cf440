"""Finds the joint positions in a workspace: what could be them, how likely, and why."""

from __future__ import annotations

import re
from collections import Counter
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mrlab_ros.core.diagnostics import Diagnostic, Refused, finding
from mrlab_ros.core.names import Hint, hint, leaf, words
from mrlab_ros.core.robot_model import RobotModel
from mrlab_ros.core.workspace import Variable, Workspace

# A score from which a matrix is taken or offered, and below which it is not even offered.
PLAUSIBLE, CONCEIVABLE = 0.55, 0.25
# The likeliest is taken over other plausible ones from this lead on.
CLEAR_LEAD = 0.25
NAME_SCORES = {
    Hint.POSITIONS: 0.3,
    Hint.NEUTRAL: 0.0,
    Hint.DOUBTFUL: -0.3,
    Hint.AGAINST: -0.55,
}
# Mean step between samples over the range of a motion; unordered samples have about 1/3.
ROUGH = 0.15
FEW_ROWS = 10
ENOUGH_ROWS = 20
# Share of the samples of a gripper that is open or closed rather than on its way.
SETTLED = 0.8
EVEN_STEPS = 1e-3  # relative deviation of the steps of a time vector
SPARKS = "▁▂▃▄▅▆▇█"
SPARK_WIDTH = 24


@dataclass(frozen=True, eq=False)
class Candidate:
    """A matrix that could be the joint positions; score 0 to 1, minimum and maximum as stored."""

    variable: Variable
    score: float
    why: str
    minimum: float
    maximum: float

    @property
    def path(self) -> str:
        return self.variable.path

    def sparkline(self) -> str:
        """Return the course of the column that moves most, as text."""
        values = self.variable.values
        if values is None or not np.isfinite([self.minimum, self.maximum]).all():
            return ""
        sample = values[np.linspace(0, len(values) - 1, SPARK_WIDTH).astype(int)].astype(float)
        spans = np.ptp(sample, axis=0)
        column = sample[:, int(spans.argmax())]
        span = float(spans.max()) or 1.0
        return "".join(SPARKS[int(7 * (x - column.min()) / span)] for x in column)


def is_numeric(variable: Variable) -> bool:
    return variable.values is not None


def is_time(column: NDArray[Any]) -> bool:
    """Say whether a column rises in even steps, as a clock does."""
    if len(column) < 3 or not np.isfinite(column).all():
        return False
    steps = np.diff(column.astype(np.float64))
    mean = float(steps.mean())
    return mean > 0 and bool(np.abs(steps - mean).max() <= max(EVEN_STEPS * mean, 1e-9))


def is_gripper(column: NDArray[Any]) -> bool:
    """Say whether a column is mostly at one of its two ends, as a gripper is."""
    low, high = float(column.min()), float(column.max())
    if low == high:
        return True
    margin = 0.02 * (high - low)
    settled = np.count_nonzero((column <= low + margin) | (column >= high - margin))
    # a joint that rests at both ends of one motion is told by how evenly it travels between
    between = column[(column > low + margin) & (column < high - margin)]
    return bool(settled >= SETTLED * len(column) and (len(between) <= 0.2 * len(column)))


def score(variable: Variable, robot: RobotModel, *, has_time: bool = False) -> Candidate:
    """Judge a matrix with as many columns as the robot has joints, or one more."""
    values = variable.values
    assert values is not None
    rows, columns = values.shape
    joints = len(robot.joints)
    reasons: list[str] = []
    points = 0.5
    said = hint(variable.path)
    points += NAME_SCORES[said]
    reasons.append(said.value)
    minimum, maximum = float(values.min()), float(values.max())
    if not np.isfinite([minimum, maximum]).all():
        reasons.append("it holds NaN or Inf")
        return Candidate(variable, _bounded(points), "; ".join(reasons), minimum, maximum)
    arm = values[:, :joints]
    low, high = arm.min(axis=0), arm.max(axis=0)
    limits = np.array([(j.lower, j.upper) for j in robot.joints])
    if (low >= limits[:, 0] - 1e-3).all() and (high <= limits[:, 1] + 1e-3).all():
        points += 0.1
    else:
        points -= 0.2
        reasons.append("it leaves the joint limits")
    span = high.astype(np.float64) - low
    if not span.any():
        points -= 0.2
        reasons.append("it never moves")
    elif rows >= ENOUGH_ROWS:
        sample = arm[:20_000].astype(np.float64)
        moving = span > 1e-6
        travel = np.abs(np.diff(sample[:, moving], axis=0)).mean(axis=0)
        if float((travel / span[moving]).mean()) > ROUGH:
            points -= 0.25
            reasons.append("its rows do not follow one another like a motion")
        else:
            points += 0.1
            reasons.append("it moves smoothly")
    elif rows < FEW_ROWS:
        points -= 0.15
        reasons.append(f"it has {rows} rows only")
    if rows == columns:
        points -= 0.2
        reasons.append("it is square")
    if columns > joints and not is_gripper(values[:, joints]):
        points -= 0.1
        reasons.append("its last column is not a gripper's")
    if has_time:
        points += 0.05
        reasons.append("it has a time vector")
    return Candidate(variable, _bounded(points), "; ".join(reasons), minimum, maximum)


def _bounded(points: float) -> float:
    return round(min(max(points, 0.0), 1.0), 3)


def fits(variable: Variable, robot: RobotModel) -> bool:
    """Say whether the matrix has samples as rows and the robot's joints as columns."""
    joints = len(robot.joints)
    return (
        is_numeric(variable)
        and variable.shape[0] >= 2
        and variable.shape[1]
        in (
            joints,
            joints + 1,
        )
    )


def time_beside(workspace: Workspace, path: str) -> Variable | None:
    """Return the `time` of the Simulink structure that `path` lies in, if it does."""
    match = re.match(r"(.*?)\.signals(?:\(\d+\))?\.values$", path)
    outer = match.group(1) if match else path.rpartition(".")[0]
    if not outer:
        return None
    for name in ("time", "t", "Time"):
        found = workspace.find(f"{outer}.{name}")
        if found is not None and found.values is not None:
            return found
    return None


def candidates(workspace: Workspace, robot: RobotModel) -> list[Candidate]:
    """Return the matrices that fit the robot, likeliest first."""
    found = [
        score(v, robot, has_time=time_beside(workspace, v.path) is not None)
        for v in workspace.variables
        if fits(v, robot) and not _columns_of_time(v, robot)
    ]
    return sorted(found, key=lambda c: -c.score)


def _columns_of_time(variable: Variable, robot: RobotModel) -> bool:
    """Say whether column 1 is time and the joints begin at column 2."""
    values, joints = variable.values, len(robot.joints)
    if values is None or values.shape[0] < 3 or not is_time(values[:, 0]):
        return False
    if values.shape[1] == joints + 1:
        return not is_gripper(values[:, joints])
    return values.shape[1] == joints + 2 and is_gripper(values[:, joints + 1])


def choose(
    workspace: Workspace, robot: RobotModel, file: str, ranked: list[Candidate]
) -> tuple[Candidate | None, list[Candidate], list[Diagnostic]]:
    """Choose the trajectory without being told which it is.

    Returns the choice, or None and the candidates to choose from (empty: none), with findings;
    where nothing was chosen the last one is the reason.
    """
    plausible = [c for c in ranked if c.score >= PLAUSIBLE]
    conceivable = [c for c in ranked if c.score >= CONCEIVABLE]
    objects = [v for v in workspace.variables if v.is_object]
    hidden = [v for v in objects if hint(v.path) is Hint.POSITIONS and _holds_samples(v)]
    notes: list[Diagnostic] = []
    if plausible:
        best, others = plausible[0], plausible[1:]
        clear = not others or best.score - others[0].score >= CLEAR_LEAD
        named = hint(best.path) is Hint.POSITIONS
        rivals = [v for v in workspace.variables if _rival(v, best, robot)]
        if clear and (named or not (hidden or rivals or conceivable[1:])):
            if others:
                names = ", ".join(f"'{c.path}'" for c in others[:5])
                notes.append(finding("other_candidates", variable=best.path, found=names))
            if hidden or objects:
                notes.append(object_finding("object_ignored", hidden or objects, file))
            return best, [], notes
    if conceivable and not (hidden and not plausible):
        listed = "; ".join(f"'{c.path}' ({c.variable.size}, {c.why})" for c in conceivable[:5])
        count = f"{len(conceivable)} matrices" if len(conceivable) > 1 else "One matrix"
        notes.append(finding("ambiguous", file=file, count=count, found=listed))
        return None, conceivable, notes
    return None, [], [refusal(workspace, robot, file)]


def _rival(variable: Variable, best: Candidate, robot: RobotModel) -> bool:
    """Say whether another matrix is laid out as samples by joints in some other way."""
    return (
        variable is not best.variable
        and is_numeric(variable)
        and variable.shape[0] in (len(robot.joints), len(robot.joints) + 1)
        and variable.shape[1] >= FEW_ROWS
        and hint(variable.path) is not Hint.NEUTRAL
    )


def _holds_samples(variable: Variable) -> bool:
    """Say whether the object is of a class made to hold numbers, or is named like positions."""
    kind = variable.kind
    if kind in OBJECT_CODE or kind.startswith(("Simulink.", "timeseries", "tscollection")):
        return True
    return hint(variable.path) is Hint.POSITIONS and not re.search(
        r"link|robot|tree|quaternion|^se[23]$|^so[23]$|camera", kind, re.I
    )


OBJECT_CODE = {
    "timeseries": "q = {name}.Data; save('traj.mat', 'q')",
    "timetable": "q = {name}.Variables; save('traj.mat', 'q')",
    "table": "q = {name}{{:, :}}; save('traj.mat', 'q')",
    "Simulink.SimulationData.Dataset": "q = {name}{{1}}.Values.Data; save('traj.mat', 'q')",
    "Simulink.SimulationData.Signal": "q = {name}.Values.Data; save('traj.mat', 'q')",
    "Simulink.SimulationOutput": "q = {name}.get('q').Data; save('traj.mat', 'q')",
    "dlarray": "q = extractdata({name}); save('traj.mat', 'q')",
    "gpuArray": "q = gather({name}); save('traj.mat', 'q')",
}


def object_finding(code: str, objects: list[Variable], file: str) -> Diagnostic:
    """Return a finding that lists objects by name and class, with the MATLAB line for one."""
    ordered = sorted(objects, key=lambda v: (v.kind not in OBJECT_CODE, v.path))
    listed = ", ".join(f"'{v.path}' ({v.kind})" for v in ordered[:6])
    if len(ordered) > 6:
        listed += f" and {len(ordered) - 6} more"
    first = ordered[0]
    line = OBJECT_CODE.get(first.kind, "q = ...; save('traj.mat', 'q')").format(name=first.path)
    return finding(code, variable=first.path, file=file, found=listed, code=line)


def refusal(workspace: Workspace, robot: RobotModel, file: str) -> Diagnostic:
    """Say why nothing in the workspace could be the trajectory, by the nearest miss."""
    joints = len(robot.joints)
    misses = [
        (rank, miss)
        for v in workspace.variables
        if not re.search(r"[({]\d", v.path)
        and (miss := near_miss(v, robot)) is not None
        and (rank := {Hint.POSITIONS: 0, Hint.NEUTRAL: 1}.get(hint(v.path), 9)) < 9
    ]
    misses.sort(key=lambda pair: pair[0])
    opaque = [v for v in workspace.variables if v.is_object and _holds_samples(v)]
    named = [miss for rank, miss in misses if rank == 0]
    if named:
        return named[0]
    if opaque and (any(hint(v.path) is Hint.POSITIONS for v in opaque) or not misses):
        return object_finding("unsupported_object", opaque, file)
    series = _series(workspace, joints)
    if series is not None:
        path, code = series
        return finding("inside_container", variable=path, found=f"'{path}'", code=code)
    if misses:
        return misses[0][1]
    return finding(
        "no_trajectory", file=file, robot=robot.id, joints=joints, found=contents(workspace)
    )


def contents(workspace: Workspace) -> str:
    """Return a sentence that lists the variables of the file."""
    top = [v for v in workspace.variables if not re.search(r"[.({]", v.path)]
    if not top:
        return "It holds no variable at all."
    listed = ", ".join(f"{v.path} ({' '.join(filter(None, (v.size, v.kind)))})" for v in top[:12])
    more = f" and {len(top) - 12} more" if len(top) > 12 else ""
    return f"It holds: {listed}{more}."


def near_miss(variable: Variable, robot: RobotModel) -> Diagnostic | None:
    """Say what keeps a variable from being the trajectory, or None where it is far from one."""
    joints = len(robot.joints)
    widths = (joints, joints + 1)
    shape, path = variable.shape, variable.path
    words: dict[str, Any] = {
        "variable": path,
        "size": variable.size,
        "robot": robot.id,
        "joints": joints,
        "more": joints + 1,
    }
    if len(shape) < 2 or variable.is_object or variable.kind in ("struct", "cell", "char"):
        return None
    if len(shape) > 2:
        if joints in shape:
            hint_text = f" It has {len(shape)} dimensions: try {path} = squeeze({path})."
            return finding("wrong_shape", **words, hint=hint_text)
        return None
    if 0 in shape:
        return finding("empty", **words) if max(shape) in (0, *widths) else None
    matching = shape[1] in widths or shape[0] in widths
    if matching and max(shape) > 1 and variable.note == "complex":
        return finding("not_real", **words)
    if variable.values is None:
        if matching and min(shape) > 1:
            fix = "full" if variable.kind == "sparse" else "double"
            return finding("wrong_class", **words, kind=variable.kind, fix=fix)
        return None
    if min(shape) == 1:
        if max(shape) in widths:
            return finding("single_sample", **words)
        if hint(path) is Hint.POSITIONS and max(shape) > 1:
            return finding("wrong_shape", **words, hint="")
        return None
    if _columns_of_time(variable, robot):
        return _time_finding(variable)
    flipped = Variable(path, variable.kind, shape[::-1], variable.values.T)
    if shape[1] not in widths and _columns_of_time(flipped, robot):
        return finding("transposed", **words, columns=f" --columns 2:{shape[0]}, as row 1 is time")
    long_enough = shape[1] >= FEW_ROWS or hint(path) is Hint.POSITIONS
    if shape[0] in widths and shape[1] not in widths and long_enough:
        return finding("transposed", **words, columns="")
    plausible = 3 <= shape[1] <= 16 and shape[0] >= FEW_ROWS
    if shape[0] > shape[1] and (hint(path) is Hint.POSITIONS or plausible):
        assumed = f" Column 1 looks like time, {shape[1] - 1} columns follow."
        return finding(
            "wrong_shape", **words, hint=assumed if is_time(variable.values[:, 0]) else ""
        )
    return None


def _time_finding(variable: Variable) -> Diagnostic:
    values = variable.values
    assert values is not None
    return finding(
        "time_column",
        variable=variable.path,
        first=float(values[0, 0]),
        last=float(values[-1, 0]),
        columns=f"2:{values.shape[1]}",
    )


def _series(workspace: Workspace, joints: int) -> tuple[str, str] | None:
    """Return a place such as path.pos(1).q that is repeated, and MATLAB that joins them."""
    seen: Counter[str] = Counter()
    first: dict[str, Variable] = {}
    for v in workspace.variables:
        if (
            v.values is not None
            and sorted(v.shape) == [1, joints]
            and re.search(r"[({]\d", v.path)
        ):
            pattern = re.sub(r"([({])[\d,]+([)}])", r"\1\2", v.path)
            seen[pattern] += 1
            first.setdefault(pattern, v)
    if not seen or seen.most_common(1)[0][1] < 2:
        return None
    pattern = seen.most_common(1)[0][0]
    path = first[pattern].path
    join = "vertcat" if first[pattern].shape[0] == 1 else "horzcat"
    inner = pattern.replace("{}", "{:}").replace("()", "")
    flip = "" if join == "vertcat" else ".'"
    return path, f"q = {join}({inner}){flip}; save('traj.mat', 'q')"


def named(workspace: Workspace, path: str, file: str) -> Variable:
    """Return the variable that was asked for; raise Refused with the names there are."""
    found = workspace.find(path)
    if found is None:
        found_text = contents(workspace)
        raise Refused(finding("unknown_variable", file=file, variable=path, found=found_text))
    return found


RATE_NAMES = words("fs f freq frequency framerate rate samplerate hz fps")
STEP_NAMES = words("dt ts deltat tstep timestep sampletime steptime h")
TIME_NAMES = words("t time tout timevec timevector times tvec timecont ts tq")
RATE_RANGE = (1.0, 10_000.0)


@dataclass(frozen=True)
class FrameRate:
    """A frame rate, Hz, and the variable that it came from."""

    rate: float
    source: str
    uneven: tuple[float, float] | None = None


def snapped(rate: float) -> float:
    """Return the whole number that `rate` is up to rounding, or `rate`."""
    whole = round(rate)
    return float(whole) if whole and abs(rate - whole) < 1e-6 * whole else rate


def rate_of_times(times: NDArray[Any], source: str) -> FrameRate | None:
    """Return the frame rate of a time vector, s, or None where it is none."""
    t = np.asarray(times, dtype=np.float64).reshape(-1)
    if len(t) < 2 or not np.isfinite(t).all():
        return None
    steps = np.diff(t)
    if not (steps >= 0).all() or t[-1] <= t[0]:
        return None
    rate = snapped((len(t) - 1) / float(t[-1] - t[0]))
    if not RATE_RANGE[0] / 10 <= rate <= RATE_RANGE[1]:
        return None
    mean = 1 / rate
    uneven = np.abs(steps - mean).max() > 0.01 * mean
    return FrameRate(rate, source, (float(steps.min()), float(steps.max())) if uneven else None)


def frame_rates(workspace: Workspace, path: str, rows: int) -> list[FrameRate]:
    """Return the frame rates that the file gives for the matrix at `path`, likeliest first.

    The time of the structure that holds the matrix, then scalars that are named like a rate or
    a step, then other time vectors with `rows` elements.
    """
    found: list[FrameRate] = []
    beside = time_beside(workspace, path)
    scalars, vectors = [], []
    for v in workspace.variables:
        if v.values is None or re.search(r"[({]", v.path):
            continue
        name = re.sub(r"[^a-z]", "", leaf(v.path).lower())
        number = workspace.scalar(v)
        if number is not None and np.isfinite(number) and number > 0:
            if name in RATE_NAMES and RATE_RANGE[0] <= number <= RATE_RANGE[1]:
                scalars.append(FrameRate(snapped(number), v.path))
            elif name in STEP_NAMES and RATE_RANGE[0] <= 1 / number <= RATE_RANGE[1]:
                scalars.append(FrameRate(snapped(1 / number), v.path))
        elif name in TIME_NAMES and v.values.size == rows and min(v.shape) == 1:
            of_times = rate_of_times(v.values, v.path)
            if of_times is not None and v is not beside:
                vectors.append(of_times)
    if beside is not None and beside.values is not None and beside.values.size == rows:
        of_times = rate_of_times(beside.values, beside.path)
        if of_times is not None:
            found.append(of_times)
    return found + scalars + vectors
