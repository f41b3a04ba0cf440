"""What is said of times and rates that are doubtful, contradict each other or give none."""

from __future__ import annotations

import re

import numpy as np

from mrlab_ros.core.base.diagnostic import Diagnostic, Fix
from mrlab_ros.core.conversion.rate_scalars import RATE_NAMES, STEP_NAMES, scalar_name
from mrlab_ros.core.conversion.time_vectors import (
    NAMED_SECONDS,
    Clock,
    clock_of,
    is_time_name,
    unit_named,
)
from mrlab_ros.core.conversion.variable_names import leaf, parts
from mrlab_ros.core.conversion.workspace import Variable, Workspace
from mrlab_ros.core.diagnostics import finding

COARSE_SINGLE = 1e5  # above it, single precision is no clock of a robot
CONTAINERS = ("table", "timetable", "timeseries", "containers.Map", "dictionary")
AGREES = 0.01  # relative; rates that differ by less are the same


def flaws(clock: Clock) -> list[Diagnostic]:
    """Return what is to say of times that are uneven, repeated or go back."""
    notes = []
    if clock.rounded:
        words = {"value": clock.rounded, "rounded": clock.rounded, "rate": clock.rate}
        notes.append(finding("time_rounded", variable=clock.source, unit="s", **words))
    resample = Fix("resample", "true", _interpolation(clock))
    if clock.backward:
        row = clock.backward[0]
        notes.append(
            finding(
                "time_backward",
                variable=clock.source,
                where=f"row {row}",
                first_row=row,
                last_row=clock.backward[-1],
                value=clock.least,
                unit="s",
                count=_counted(len(clock.backward), "row"),
                row=row,
                last=row - 1,
                rate=clock.rate,
                fixes=(Fix(matlab=f"[t, order] = sort({clock.source}); q = q(order, :);"),),
            )
        )
    elif clock.repeated:
        row = clock.repeated[0]
        notes.append(
            finding(
                "time_repeated",
                variable=clock.source,
                where=f"row {row}",
                first_row=row,
                last_row=clock.repeated[-1],
                value=0.0,
                unit="s",
                count=_counted(len(clock.repeated), "row"),
                row=row,
                rate=clock.rate,
                fixes=(resample,),
            )
        )
    if clock.worst_row and not clock.backward:
        notes.append(
            finding(
                "time_uneven",
                variable=clock.source,
                where=f"row {clock.worst_row}",
                first_row=clock.worst_row,
                last_row=clock.worst_row,
                value=clock.deviation,
                unit="s",
                least=clock.least,
                most=clock.most,
                row=clock.worst_row,
                deviation=clock.deviation,
                rate=clock.rate,
                fixes=(resample,),
            )
        )
    return notes


def _interpolation(clock: Clock) -> str:
    t = clock.source
    return f"[tu, k] = unique({t}); q = interp1(tu, q(k, :), (tu(1):1/{clock.rate:g}:tu(end))');"


def step_in_unit(clock: Clock) -> str:
    """Return the usual step of times, in their own unit."""
    usual = float(np.median(np.diff(clock.times)))
    return f"{usual / NAMED_SECONDS[clock.unit]:.4g}"


def _counted(number: int, noun: str) -> str:
    return f"{number} {noun}{'' if number == 1 else 's'}"


def rate_fix(rate: float) -> Fix:
    """Return the fix that names a rate, Hz."""
    return Fix("frame_rate", f"{rate:.6g}", f"fs = {rate:.6g}; save('traj.mat', 'q', 'fs')")


def conflict(source: str, rate: float, other: str, other_rate: float) -> Diagnostic:
    """Return what to say of a rate, Hz, that another source of the file contradicts."""
    return finding(
        "rate_conflict",
        variable=source,
        value=rate,
        limit=other_rate,
        unit="Hz",
        rate=rate,
        other=other,
        other_rate=other_rate,
        fixes=tuple(rate_fix(r) for r in (rate, other_rate)),
    )


def assumed(source: str, rate: float, default: float | None) -> Diagnostic:
    """Return what to say of a rate, Hz, that was taken without being sure; default: Hz."""
    fixes = [rate_fix(rate)]
    if default is not None and abs(default - rate) > AGREES * rate:
        fixes.append(rate_fix(default))
    return finding(
        "rate_assumed", variable=source, value=rate, unit="Hz", rate=rate, fixes=tuple(fixes)
    )


def counting(clock: Clock, default: float) -> Diagnostic:
    """Return what to say of times that count rows; default: the rate that is taken, Hz."""
    return finding(
        "time_counts_rows",
        variable=clock.source,
        value=1.0,
        rate=default,
        fixes=tuple(rate_fix(rate) for rate in dict.fromkeys([1.0, 1000.0, default])),
    )


def of_other_length(workspace: Workspace, path: str, rows: int) -> Diagnostic | None:
    """Return what to say of times that have a few elements more or less than there are rows."""
    for v in workspace.variables:
        if v.values is None or len(v.shape) != 2 or min(v.shape) != 1 or not is_time_name(v.path):
            continue
        size = v.values.size
        if size != rows and size > 2 and abs(size - rows) <= max(2, 0.02 * rows):
            clock = clock_of(v.values, v.path, named=True, unit=unit_named(leaf(v.path)))
            if clock is not None and clock.rate:
                return finding(
                    "time_length",
                    variable=v.path,
                    value=float(size),
                    limit=float(rows),
                    size=size,
                    rows=rows,
                    rate=clock.rate,
                    fixes=(
                        Fix("frame_rate", f"{clock.rate:.6g}", f"{v.path} = {v.path}(1:{rows});"),
                    ),
                )
    return None


def unused_times(
    workspace: Workspace, path: str, rows: int, clocks: list[Clock], default: float
) -> Diagnostic | None:
    """Return what to say of times, steps or a rate of the file that could not be used."""
    said = {c.source for c in clocks}
    for v in workspace.variables:
        name = scalar_name(v.path)
        if not name or v.path in (path, *said) or not v.shape:
            continue
        words_of = parts(name)
        if not words_of:
            continue
        whole = re.sub(r"[^a-z]", "", "".join(words_of))
        if v.kind in CONTAINERS:
            continue
        of_rate = whole in RATE_NAMES | STEP_NAMES or words_of[0] in RATE_NAMES | STEP_NAMES
        count = int(np.prod([float(n) for n in v.shape]))
        problem = ""
        if v.values is None:
            single = count == 1 or v.kind in ("char", "string", "cell")
            if of_rate and single and not v.is_object and v.kind != "struct":
                what = v.note or ("text" if v.text and v.kind != "logical" else v.kind)
                problem = f"it is {what} where a real number is expected"
            elif is_time_name(v.path) and rows in v.shape and v.kind != "struct":
                problem = f"its class is {v.note or v.kind}"
                if v.kind in ("char", "string", "cell"):
                    problem += f" (in MATLAB {v.path} = str2double(string({v.path})))"
        elif count == 1:
            if of_rate:
                problem = f"{float(v.values.reshape(-1)[0]):g} is no rate or step of the rows"
        elif of_rate or is_time_name(v.path):
            problem = _why_unused(v, rows)
        if problem:
            return finding("rate_unused", variable=v.path, problem=problem, rate=default)
    return None


def _why_unused(v: Variable, rows: int) -> str:
    """Return why the vector or matrix `v`, named as times or steps, gives no rate, or nothing."""
    assert v.values is not None
    if v.values.ndim != 2:
        return ""
    if min(v.shape) > 1:
        return f"it is {v.size} where one column is expected" if rows in v.shape else ""
    column = v.values.reshape(-1).astype(np.float64)
    bad = np.flatnonzero(~np.isfinite(column))
    if len(column) == rows and len(bad):
        return f"its row {bad[0] + 1} is {column[bad[0]]:g}"
    if len(column) == rows and v.kind == "single" and float(np.abs(column).max()) > COARSE_SINGLE:
        coarse = float(np.spacing(np.float32(np.abs(column).max())))
        return f"single precision holds such times in steps of {coarse:g} only; save it as double"
    if len(column) == rows:
        return "its values are no times of the rows that rise at a rate of joints"
    if len(column) == 2 or len(column) == rows - 1:
        return f"it has {len(column)} elements, and the trajectory {rows} rows"
    return ""
