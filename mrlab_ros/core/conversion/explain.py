"""Says what keeps a workspace or one of its variables from being the trajectory."""

from __future__ import annotations

import re
from collections import Counter
from typing import Any

from mrlab_ros.core.conversion.candidates import FEW_ROWS, columns_of_time, is_time
from mrlab_ros.core.conversion.named_columns import misnamed
from mrlab_ros.core.conversion.variable_names import Hint, hint
from mrlab_ros.core.conversion.workspace import Variable, Workspace
from mrlab_ros.core.diagnostics import Diagnostic, Refused, finding
from mrlab_ros.core.robots.model import RobotModel

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


def holds_samples(variable: Variable) -> bool:
    """Say whether the object is of a class made to hold numbers, or is named like positions."""
    kind = variable.kind
    if kind in OBJECT_CODE or kind.startswith(("Simulink.", "timeseries", "tscollection")):
        return True
    return hint(variable.path) is Hint.POSITIONS and not re.search(
        r"link|robot|tree|quaternion|^se[23]$|^so[23]$|camera", kind, re.I
    )


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
        if (v.is_message or not re.search(r"[({]\d", v.path))
        and (miss := near_miss(v, robot)) is not None
        and (rank := {Hint.POSITIONS: 0, Hint.NEUTRAL: 1}.get(hint(v.path), 9)) < 9
    ]
    misses.sort(key=lambda pair: pair[0])
    opaque = [v for v in workspace.variables if v.is_object and holds_samples(v)]
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
    top = [v for v in workspace.variables if v.is_message or not re.search(r"[.({]", v.path)]
    if not top:
        return "It holds no variable at all."
    listed = ", ".join(f"{v.path} ({' '.join(filter(None, (v.size, v.kind)))})" for v in top[:12])
    more = f" and {len(top) - 12} more" if len(top) > 12 else ""
    return f"It holds: {listed}{more}."


def bad_message(variable: Variable, problem: str) -> Diagnostic:
    """Return the finding for a JointTrajectory that contradicts itself."""
    return finding("bad_message", variable=variable.path, problem=problem)


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
    if variable.is_message and variable.note:
        return bad_message(variable, variable.note)
    if variable.values is not None and (wrong := misnamed(variable, robot)) is not None:
        return wrong
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
    if columns_of_time(variable, robot):
        return _time_finding(variable)
    flipped = Variable(path, variable.kind, shape[::-1], variable.values.T)
    if shape[1] not in widths and columns_of_time(flipped, robot):
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
