"""How many rows of a matrix make a second, as far as the file says so.

A time vector counts before a scalar, a scalar before the rate at which a velocity beside the
matrix is its derivative, that before the duration, and the default comes last.
"""

from __future__ import annotations

import re
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mrlab_ros.core.base.diagnostic import Diagnostic
from mrlab_ros.core.conversion import rate_findings
from mrlab_ros.core.conversion.diagnostics import (
    RATE_DEFAULT,
    RATE_FOUND,
    RATE_OF_VELOCITY,
    TIME_UNIT,
)
from mrlab_ros.core.conversion.evidence import rate_scalars
from mrlab_ros.core.conversion.evidence.assessment import Assessment
from mrlab_ros.core.conversion.evidence.joining import first_path
from mrlab_ros.core.conversion.evidence.names import Hint, describe, hint, leaf, parts, words
from mrlab_ros.core.conversion.evidence.rate_scalars import Scalar, Thinning
from mrlab_ros.core.conversion.evidence.survey import Survey
from mrlab_ros.core.conversion.evidence.time_vectors import (
    PATH_PARAMETERS,
    Clock,
    clock_of,
    counts_rows,
    is_regular,
    is_time_name,
    unit_named,
)
from mrlab_ros.core.conversion.workspace import Variable, Workspace

# structures that hold what belongs to the matrix beside them
RELATED = words(
    "info meta metadata param params parameter parameters parameter settings setup config cfg "
    "log logs data daten sim simulation out output header options experiment versuch traj "
    "trajectory trajektorie robot roboter record recording rec result results messung joint "
    "joints arm ref reference state states"
)
OF_MOTION = ("velocities", "joint_velocities", "angular_velocities", "pixels")
AGREES_WITH_MOTION = 0.05  # the same for a rate from a velocity


@dataclass
class Rate:
    """The frame rate, Hz, the times of the rows where they are known, and what to say."""

    rate: float
    clock: Clock | None = None
    notes: list[Diagnostic] = field(default_factory=list)


def time_beside(workspace: Workspace, path: str) -> Variable | None:
    """Return the own time of the matrix at `path`, else that of the structure it lies in."""
    path = first_path(path)
    variable = workspace.find(path)
    if variable is not None and variable.time:
        return workspace.find(variable.time)
    match = re.match(r"(.*?)\.signals(?:\(\d+\))?\.values$", path)
    outer = match.group(1) if match else path.rpartition(".")[0]
    if not outer:
        return None
    for v in workspace.variables:
        above, _, name = v.path.rpartition(".")
        if above != outer or v.values is None or not is_time_name(name):
            continue
        if min(v.shape) == 1 and v.values.size > 1:
            return v
    return None


def find(
    survey: Survey,
    chosen: Assessment | None,
    path: str,
    rows: int,
    column: tuple[str, NDArray[Any]] | None,
    default: float,
    file: str,
) -> Rate:
    """Return the frame rate of the matrix at `path` with `rows` rows.

    chosen: its assessment, where it was found by its numbers. column: the column of it that
    counts time, as MATLAB writes it and its values, or None. default: Hz.
    """
    workspace = survey.workspace
    coarse = chosen is not None and chosen.coarse
    motion = chosen.rates if chosen is not None else ()
    motion = tuple((p, r) for p, r in motion if describe(p).what in ("", *OF_MOTION))
    if not coarse:
        # velocities a row, as jtraj gives them without times, say nothing of a second
        motion = tuple((p, r) for p, r in motion if abs(r - 1) > AGREES_WITH_MOTION)
    scalars = rate_scalars.scalars(workspace, path, rows, coarse)
    notes: list[Diagnostic] = []
    if scalars and (thinned := rate_scalars.thinning(workspace, path)) is not None:
        scalars = _thinned(scalars, thinned, notes)
    likely = tuple(s.rate for s in scalars if s.sure) + tuple(r for _, r in motion)
    clocks = _clocks(workspace, path, rows, column, coarse, likely)
    usable = [c for c in clocks if c.rate]
    if usable:
        near = first_path(path).rpartition(".")[0]
        return _by_clock(usable, scalars, motion, notes, near)
    unusable = next((c for c in clocks if not c.rate and c.named), None)
    known = [s for s in scalars if s.sure]
    if unusable is not None and not (known or motion):
        notes.append(rate_findings.counting(unusable, default))
    wrong_length = rate_findings.of_other_length(workspace, path, rows)
    if known:
        return _by_scalar(known, motion, notes)
    if motion:
        source, rate = motion[0]
        rate = _nice(rate)
        notes.append(RATE_OF_VELOCITY(variable=source, value=rate, unit="Hz", rate=rate))
        return Rate(rate, None, notes)
    if wrong_length is not None:
        notes.append(wrong_length)
    unsure = [s for s in scalars if not s.sure]
    likely_ones = [
        s
        for s in unsure
        if not s.foreign
        and s.rate
        and rate_scalars.LIKELY_RATES[0] <= s.rate <= rate_scalars.LIKELY_RATES[1]
    ]
    if likely_ones:
        best = likely_ones[0]
        notes.append(rate_findings.assumed(best.path, best.rate, default))
        return Rate(best.rate, None, notes)
    by_duration = rate_scalars.of_duration(workspace, path, rows)
    if by_duration is not None:
        notes.append(rate_findings.assumed(by_duration.path, by_duration.rate, default))
        return Rate(by_duration.rate, None, notes)
    by_text = next(iter(rate_scalars.in_texts(workspace, path)), None)
    if by_text is not None:
        notes.append(rate_findings.assumed(by_text.path, by_text.rate, default))
        return Rate(by_text.rate, None, notes)
    if unsure:
        notes.append(rate_findings.unclear([(s.path, s.rate) for s in unsure], default))
    elif (
        unused := rate_findings.unused_times(workspace, path, rows, clocks, default)
    ) is not None:
        notes.append(unused)
    notes.append(RATE_DEFAULT(file=file, rate=default, value=default, unit="Hz"))
    return Rate(default, None, notes)


def _thinned(scalars: list[Scalar], by: Thinning, notes: list[Diagnostic]) -> list[Scalar]:
    """Return the rates of a file whose rows were thinned out, which never are for certain.

    A plain rate may be that of the rows as they are: then it is taken and the other one is named.
    """
    first = scalars[0]
    if first.sure and not by.skipped:
        conflict = rate_findings.conflict(first.path, first.rate, by.path, first.rate / by.every)
        notes.append(conflict)
        return scalars
    return [replace(s, rate=s.rate / by.every, sure=False) for s in scalars]


def _by_clock(
    clocks: list[Clock],
    scalars: list[Scalar],
    motion: tuple[tuple[str, float], ...],
    notes: list[Diagnostic],
    near: str,
) -> Rate:
    best = clocks[0]
    rate = best.rate
    notes.append(RATE_FOUND(variable=best.source, value=rate, unit="Hz", rate=rate))
    confirmed = (
        [s for s in scalars if abs(s.rate - rate) <= rate_findings.AGREES * rate]
        if scalars
        else []
    )
    by_motion = bool(motion) and _fits_motion(rate, motion[0][1])
    if not (best.unit_known or confirmed or by_motion):
        notes.append(
            TIME_UNIT(
                variable=best.source,
                value=rate,
                unit="Hz",
                taken=best.unit,
                rate=rate,
                step=rate_findings.step_in_unit(best),
                fixes=(rate_findings.rate_fix(rate),),
            )
        )
    elsewhere = _is_elsewhere(best.source, near)
    if not ((best.named and not elsewhere) or confirmed or by_motion):
        notes.append(rate_findings.assumed(best.source, rate, None))
    rivals = [(c.source, c.rate) for c in clocks[1:]]
    rivals += [(s.path, s.rate) for s in scalars if s.sure]
    for other, other_rate in rivals:
        if abs(other_rate - rate) > rate_findings.AGREES * rate:
            notes.append(rate_findings.conflict(best.source, rate, other, other_rate))
            break
    else:
        if motion and not by_motion:
            notes.append(
                rate_findings.conflict(best.source, rate, motion[0][0], _nice(motion[0][1]))
            )
    notes += rate_findings.flaws(best)
    return Rate(rate, best, notes)


def _by_scalar(
    known: list[Scalar], motion: tuple[tuple[str, float], ...], notes: list[Diagnostic]
) -> Rate:
    best = known[0]
    notes.append(RATE_FOUND(variable=best.path, value=best.rate, unit="Hz", rate=best.rate))
    rivals = [
        (s.path, s.rate)
        for s in known[1:]
        if abs(s.rate - best.rate) > rate_findings.AGREES * best.rate
    ]
    rivals += [(path, _nice(rate)) for path, rate in motion if not _fits_motion(best.rate, rate)]
    if rivals:
        notes.append(rate_findings.conflict(best.path, best.rate, *rivals[0]))
    return Rate(best.rate, None, notes)


def resampling_rate(clock: Clock) -> float:
    """Return an even rate, Hz, for rows at uneven times: a whole one where it is 2 or more."""
    return float(round(clock.rate)) if clock.rate >= 2 else clock.rate


def _fits_motion(rate: float, factor: float) -> bool:
    """Say whether velocities that are `factor` times the steps, Hz, agree with a rate.

    They may be in deg/s beside positions in rad, or the other way round.
    """
    turns = (1.0, 180 / np.pi, np.pi / 180)
    return any(abs(factor / (rate * k) - 1) <= AGREES_WITH_MOTION for k in turns)


def _nice(rate: float) -> float:
    """Return a rate that was measured as the whole number it is near, where it is near one."""
    whole = float(round(rate))
    if whole >= 2 and abs(rate - whole) <= 0.004 * whole:
        return whole
    return float(f"{rate:.4g}")


def _clocks(
    workspace: Workspace,
    path: str,
    rows: int,
    column: tuple[str, NDArray[Any]] | None,
    coarse: bool,
    likely: tuple[float, ...],
) -> list[Clock]:
    """Return the times that fit `rows` rows, likeliest first.

    The time of the structure that holds the matrix; the matrix' own column; vectors that are
    named as times; vectors that rise steadily, whatever their name.
    """
    words: dict[str, Any] = {"coarse": coarse, "likely_rates": likely}
    found: list[Clock | None] = []
    beside = time_beside(workspace, path)
    if beside is not None and beside.values is not None and beside.values.size == rows:
        unit = unit_named(leaf(beside.path))
        found.append(clock_of(beside.values, beside.path, named=True, unit=unit, **words))
    if column is not None:
        found.append(clock_of(column[1], column[0], named=True, **words))
    named, others = [], []
    for v in workspace.variables:
        if v.values is None or len(v.shape) != 2 or min(v.shape) != 1 or v.values.size != rows:
            continue
        if v is beside or rows < 2 or "{" in v.path:
            continue
        said = "".join(parts(leaf(v.path))).rstrip("0123456789")
        if is_time_name(v.path):
            unit = unit_named(leaf(v.path))
            named.append(clock_of(v.values, v.path, named=True, unit=unit, **words))
        elif (
            rows >= 3
            and "int" not in v.kind
            and said not in PATH_PARAMETERS
            and hint(v.path) in (Hint.NEUTRAL, Hint.DOUBTFUL)
            and is_regular(v.values.reshape(-1))
            and not counts_rows(v.values.reshape(-1))
        ):
            others.append(clock_of(v.values, v.path, named=False, **words))
    near = path.rpartition(".")[0]
    everything = [c for c in (*found, *named, *others) if c is not None]
    # times in the same structure before those of others, named before unnamed
    everything.sort(key=lambda c: (c not in found, not c.named, not _is_beside(c.source, near)))
    return everything


def _is_beside(path: str, container: str) -> bool:
    return path.rpartition(".")[0] == container


def _is_elsewhere(path: str, near: str) -> bool:
    """Say whether the times at `path` lie in a structure that has no relation to the matrix."""
    theirs = path.split(".")[:-1]
    ours = near.split(".") if near else []
    while theirs and ours and theirs[0] == ours[0]:
        theirs, ours = theirs[1:], ours[1:]
    return any(not (RELATED & set(parts(name)) or is_time_name(name)) for name in theirs)
