"""What is said of times and rates that are doubtful, contradict each other or give none."""

from __future__ import annotations

import re
from collections.abc import Sequence
from typing import Any

import numpy as np

from mrlab_ros.core.base.diagnostic import Diagnostic, Fix
from mrlab_ros.core.conversion.diagnostics import (
    ANOTHER_COUNT,
    COARSE_TIMES,
    NO_COLUMN,
    NO_NUMBER,
    NO_RATE,
    NO_TIMES_OF_ROWS,
    RATE_ASSUMED,
    RATE_CONFLICT,
    RATE_UNCLEAR,
    RATE_UNUSED,
    TIME_BACKWARD,
    TIME_COUNTS_ROWS,
    TIME_LENGTH,
    TIME_NOT_FINITE,
    TIME_REPEATED,
    TIME_ROUNDED,
    TIME_UNEVEN,
    TIMES_OF_CLASS,
    VALUES_OF,
)
from mrlab_ros.core.conversion.evidence.names import leaf, parts
from mrlab_ros.core.conversion.evidence.rate_scalars import RATE_NAMES, STEP_NAMES, scalar_name
from mrlab_ros.core.conversion.evidence.time_vectors import (
    NAMED_SECONDS,
    Clock,
    clock_of,
    is_time_name,
    unit_named,
)
from mrlab_ros.core.conversion.workspace import Variable, Workspace

COARSE_SINGLE = 1e5  # above it, single precision is no clock of a robot
CONTAINERS = ("table", "timetable", "timeseries", "containers.Map", "dictionary")
MOST_NAMED = 5
AGREES = 0.01  # relative; rates that differ by less are the same


def flaws(clock: Clock) -> list[Diagnostic]:
    """Return what is to say of times that are uneven, repeated or go back."""
    notes = []
    if clock.rounded:
        words: dict[str, Any] = {"value": clock.rounded, "rate": clock.rate}
        notes.append(TIME_ROUNDED(variable=clock.source, unit="s", **words))
    resample = Fix("resample", "true", _interpolation(clock))
    if clock.backward:
        row = clock.backward[0]
        notes.append(
            TIME_BACKWARD(
                variable=clock.source,
                first_row=row,
                last_row=clock.backward[-1],
                value=clock.least,
                unit="s",
                count=len(clock.backward),
                last=row - 1,
                rate=clock.rate,
                fixes=(Fix(matlab=f"[t, order] = sort({clock.source}); q = q(order, :);"),),
            )
        )
    elif clock.repeated:
        row = clock.repeated[0]
        notes.append(
            TIME_REPEATED(
                variable=clock.source,
                first_row=row,
                last_row=clock.repeated[-1],
                value=0.0,
                unit="s",
                count=len(clock.repeated),
                rate=clock.rate,
                fixes=(resample,),
            )
        )
    if clock.worst_row and not clock.backward:
        notes.append(
            TIME_UNEVEN(
                variable=clock.source,
                first_row=clock.worst_row,
                last_row=clock.worst_row,
                value=clock.deviation,
                unit="s",
                least=clock.least,
                most=clock.most,
                rate=clock.rate,
                fixes=(resample,),
            )
        )
    return notes


def _interpolation(clock: Clock) -> str:
    t = clock.source
    return f"[tu, k] = unique({t}); q = interp1(tu, q(k, :), (tu(1):1/{clock.rate:g}:tu(end))');"


def step_in_unit(clock: Clock) -> float:
    """Return the usual step of times, in their own unit."""
    usual = float(np.median(np.diff(clock.times)))
    return usual / NAMED_SECONDS[clock.unit]


def rate_fix(rate: float) -> Fix:
    """Return the fix that names a rate, Hz."""
    return Fix("frame_rate", f"{rate:.6g}", f"fs = {rate:.6g}; save('traj.mat', 'q', 'fs', '-v7')")


def conflict(source: str, rate: float, other: str, other_rate: float) -> Diagnostic:
    """Return what to say of a rate, Hz, that another source of the file contradicts."""
    return RATE_CONFLICT(
        variable=source,
        value=rate,
        limit=other_rate,
        unit="Hz",
        rate=rate,
        other=other,
        fixes=tuple(rate_fix(r) for r in (rate, other_rate)),
    )


def assumed(source: str, rate: float, default: float | None) -> Diagnostic:
    """Return what to say of a rate, Hz, that was taken without being sure; default: Hz."""
    fixes = [rate_fix(rate)]
    if default is not None and abs(default - rate) > AGREES * rate:
        fixes.append(rate_fix(default))
    return RATE_ASSUMED(variable=source, value=rate, unit="Hz", rate=rate, fixes=tuple(fixes))


def unclear(found: Sequence[tuple[str, float]], default: float) -> Diagnostic:
    """Return what to say of variables that may say the rate, with the rates, Hz, that follow."""
    return RATE_UNCLEAR(
        variable=found[0][0],
        value=default,
        unit="Hz",
        found=[path for path, _ in found[:MOST_NAMED]],
        rate=default,
        fixes=tuple(rate_fix(r) for r in dict.fromkeys([default, *(r for _, r in found)]) if r),
    )


def counting(clock: Clock, default: float) -> Diagnostic:
    """Return what to say of times that count rows; default: the rate that is taken, Hz."""
    return TIME_COUNTS_ROWS(
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
                return TIME_LENGTH(
                    variable=v.path,
                    value=float(size),
                    limit=float(rows),
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
        why, line = None, ""
        if v.values is None:
            single = count == 1 or v.kind in ("char", "string", "cell")
            if of_rate and single and not v.is_object and v.kind != "struct":
                text = "text" if v.text and v.kind != "logical" else v.kind
                why = NO_NUMBER(found=_kind(v.note or text))
            elif is_time_name(v.path) and rows in v.shape and v.kind != "struct":
                texts = v.kind in ("char", "string", "cell")
                line = f"{v.path} = str2double(string({v.path}))" if texts else ""
                why = TIMES_OF_CLASS(found=_kind(v.note or v.kind))
        elif count == 1:
            if of_rate:
                why = NO_RATE(value=float(v.values.reshape(-1)[0]))
        elif of_rate or is_time_name(v.path):
            why = _why_unused(v, rows)
        if why is not None:
            fixes = (rate_fix(default), *([Fix(matlab=line)] if line else ()))
            return RATE_UNUSED(variable=v.path, why=why, rate=default, fixes=fixes)
    return None


def _kind(found: Diagnostic | str) -> Diagnostic:
    return VALUES_OF(kind=found) if isinstance(found, str) else found


def _why_unused(v: Variable, rows: int) -> Diagnostic | None:
    """Return why the vector or matrix `v`, named as times or steps, gives no rate, or nothing."""
    assert v.values is not None
    if v.values.ndim != 2:
        return None
    if min(v.shape) > 1:
        return NO_COLUMN(size=v.size) if rows in v.shape else None
    column = v.values.reshape(-1).astype(np.float64)
    bad = np.flatnonzero(~np.isfinite(column))
    if len(column) == rows and len(bad):
        return TIME_NOT_FINITE(first_row=int(bad[0]) + 1, value=float(column[bad[0]]))
    if len(column) == rows and v.kind == "single" and float(np.abs(column).max()) > COARSE_SINGLE:
        return COARSE_TIMES(value=float(np.spacing(np.float32(np.abs(column).max()))))
    if len(column) == rows:
        return NO_TIMES_OF_ROWS()
    if len(column) != rows and len(column) > 1:
        return ANOTHER_COUNT(count=len(column), rows=rows)
    return None
