"""How many rows of a matrix make a second, as far as the file says so.

A time vector counts before a scalar, a scalar before the rate at which a velocity beside the
matrix is its derivative, that before the duration, and the default comes last.
"""

from __future__ import annotations

import re
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mrlab_ros.core.conversion.assessment import Assessment
from mrlab_ros.core.conversion.joining import first_path
from mrlab_ros.core.conversion.survey import Survey
from mrlab_ros.core.conversion.time_vectors import (
    LEAST_RATE,
    MOST_RATE,
    NAMED_SECONDS,
    PATH_PARAMETERS,
    UNIT_NAMES,
    Clock,
    clock_of,
    counts_rows,
    is_regular,
    is_time_name,
    snapped,
    unit_named,
)
from mrlab_ros.core.conversion.variable_names import Hint, hint, leaf, parts, words
from mrlab_ros.core.conversion.workspace import Variable, Workspace
from mrlab_ros.core.diagnostics import Diagnostic, Fix, finding

RATE_NAMES = words(
    "fs framerate samplerate samplingrate samplefrequency samplingfrequency samplefreq hz fps "
    "fsample fsampling abtastrate abtastfrequenz bildrate controlrate controlfrequency looprate "
    "updaterate ratehz freqhz fshz samplespersecond abtastungen recordrate recordingrate "
    "recordingfrequency publishrate rosrate framespersecond"
)
STEP_NAMES = words(
    "dt ts deltat tstep timestep sampletime samplingtime sampleperiod samplingperiod steptime "
    "tsample tsampling abtastzeit abtastintervall abtastperiode zeitschritt dtime deltatime "
    "controlperiod cycletime zykluszeit sampleinterval tcycle takt takzeit taktzeit dts tabtast"
)
# These are also frequencies of sines, heights, counts and durations: they need a likely value.
UNSURE_RATES = words("f freq frequency frequenz rate samples")
UNSURE_STEPS = words("h step stepsize schrittweite t tau period periode")
LIKELY_RATES = (20.0, 2000.0)  # Hz
LIKELY_STEPS = (5e-4, 0.05)  # s
DURATION_NAMES = words(
    "tf tfinal tend duration dauer totaltime ttotal ttot tmax movetime gesamtzeit endzeit simtime "
    "stoptime tstop tges motiontime t"
)
SPANS = words("tspan timespan tintervall zeitbereich")
LIKELY_OF_DURATION = (5.0, 1000.0)  # Hz
# structures whose steps and rates are not those of a trajectory
FOREIGN = words("controller regler filter emg cam camera kamera force kraft ft imu audio plot")
FOREIGN_ROWS = 20  # of data beside a rate that have their own number of rows
# structures that hold what belongs to the matrix beside them
RELATED = words(
    "info meta metadata param params parameter parameters parameter settings setup config cfg "
    "log logs data daten sim simulation out output header options experiment versuch traj "
    "trajectory trajektorie robot roboter record recording rec result results messung joint "
    "joints arm ref reference state states"
)
COARSE_SINGLE = 1e5  # above it, single precision is no clock of a robot
CONTAINERS = ("table", "timetable", "timeseries", "containers.Map", "dictionary")
AGREES = 0.01  # relative; rates that differ by less are the same
AGREES_WITH_MOTION = 0.05  # the same for a rate from a velocity
MOST_NAMED = 5
# an entry of a containers.Map or of a dictionary
KEY = re.compile(r"""\('([^']+)'\)$|\{"([^"]+)"\}$""")


@dataclass(frozen=True)
class Scalar:
    """A number of the file that may be the rate.

    sure: its name means nothing else. foreign: it lies beside other data.
    """

    path: str
    rate: float
    sure: bool
    foreign: bool = False


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
    column: NDArray[Any] | None,
    default: float,
    file: str,
) -> Rate:
    """Return the frame rate of the matrix at `path` with `rows` rows.

    chosen: its assessment, where it was found by its numbers. column: the column of it that
    counts time, or None. default: Hz.
    """
    workspace = survey.workspace
    coarse = chosen is not None and chosen.coarse
    motion = chosen.rates if chosen is not None else ()
    if not coarse:
        # velocities a row, as jtraj gives them without times, say nothing of a second
        motion = tuple((p, r) for p, r in motion if abs(r - 1) > AGREES_WITH_MOTION)
    scalars = _scalars(workspace, path, rows, coarse)
    likely = tuple(s.rate for s in scalars if s.sure) + tuple(r for _, r in motion)
    clocks = _clocks(workspace, path, rows, column, coarse, likely)
    usable = [c for c in clocks if c.rate]
    notes: list[Diagnostic] = []
    if usable:
        near = first_path(path).rpartition(".")[0]
        return _by_clock(usable, scalars, motion, notes, near)
    unusable = next((c for c in clocks if not c.rate and c.named), None)
    known = [s for s in scalars if s.sure]
    if unusable is not None and not (known or motion):
        notes.append(_counting(unusable, default))
    wrong_length = _of_other_length(workspace, path, rows)
    if known:
        return _by_scalar(known, motion, notes)
    if motion:
        source, rate = motion[0]
        rate = _nice(rate)
        notes.append(
            finding("rate_of_velocity", variable=source, value=rate, unit="Hz", rate=rate)
        )
        return Rate(rate, None, notes)
    if wrong_length is not None:
        notes.append(wrong_length)
    unsure = [s for s in scalars if not s.sure]
    likely_ones = [
        s
        for s in unsure
        if not s.foreign and s.rate and LIKELY_RATES[0] <= s.rate <= LIKELY_RATES[1]
    ]
    if likely_ones:
        best = likely_ones[0]
        notes.append(_assumed(best.path, best.rate, default))
        return Rate(best.rate, None, notes)
    of_duration = _of_duration(workspace, path, rows)
    if of_duration is not None:
        notes.append(_assumed(of_duration.path, of_duration.rate, default))
        return Rate(of_duration.rate, None, notes)
    if unsure:
        notes.append(
            finding(
                "rate_unclear",
                variable=unsure[0].path,
                value=default,
                unit="Hz",
                found=", ".join(f"'{s.path}'" for s in unsure[:MOST_NAMED]),
                rate=default,
                fixes=tuple(
                    _rate_fix(r) for r in dict.fromkeys([default, *(s.rate for s in unsure)]) if r
                ),
            )
        )
    elif (unused := _unused(workspace, path, rows, clocks, default)) is not None:
        notes.append(unused)
    notes.append(finding("rate_default", file=file, rate=default, value=default, unit="Hz"))
    return Rate(default, None, notes)


def _by_clock(
    clocks: list[Clock],
    scalars: list[Scalar],
    motion: tuple[tuple[str, float], ...],
    notes: list[Diagnostic],
    near: str,
) -> Rate:
    best = clocks[0]
    rate = best.rate
    notes.append(finding("rate_found", variable=best.source, value=rate, unit="Hz", rate=rate))
    confirmed = [s for s in scalars if abs(s.rate - rate) <= AGREES * rate] if scalars else []
    by_motion = bool(motion) and _fits_motion(rate, motion[0][1])
    if not (best.unit_known or confirmed or by_motion):
        notes.append(
            finding(
                "time_unit",
                variable=best.source,
                value=rate,
                unit="Hz",
                what=UNIT_NAMES[best.unit],
                rate=rate,
                step=_step_in_unit(best),
                fixes=(_rate_fix(rate),),
            )
        )
    elsewhere = _is_elsewhere(best.source, near)
    if not ((best.named and not elsewhere) or confirmed or by_motion):
        notes.append(_assumed(best.source, rate, None))
    rivals = [(c.source, c.rate) for c in clocks[1:]]
    rivals += [(s.path, s.rate) for s in scalars if s.sure]
    for other, other_rate in rivals:
        if abs(other_rate - rate) > AGREES * rate:
            notes.append(_conflict(best.source, rate, other, other_rate))
            break
    else:
        if motion and not by_motion:
            notes.append(_conflict(best.source, rate, motion[0][0], _nice(motion[0][1])))
    notes += flaws(best)
    return Rate(rate, best, notes)


def _by_scalar(
    known: list[Scalar], motion: tuple[tuple[str, float], ...], notes: list[Diagnostic]
) -> Rate:
    best = known[0]
    notes.append(
        finding("rate_found", variable=best.path, value=best.rate, unit="Hz", rate=best.rate)
    )
    rivals = [(s.path, s.rate) for s in known[1:] if abs(s.rate - best.rate) > AGREES * best.rate]
    rivals += [(path, _nice(rate)) for path, rate in motion if not _fits_motion(best.rate, rate)]
    if rivals:
        notes.append(_conflict(best.path, best.rate, *rivals[0]))
    return Rate(best.rate, None, notes)


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


def resampling_rate(clock: Clock) -> float:
    """Return an even rate, Hz, for rows at uneven times: a whole one where it is 2 or more."""
    return float(round(clock.rate)) if clock.rate >= 2 else clock.rate


def _interpolation(clock: Clock) -> str:
    t = clock.source
    return f"[tu, k] = unique({t}); q = interp1(tu, q(k, :), (tu(1):1/{clock.rate:g}:tu(end))');"


def _step_in_unit(clock: Clock) -> str:
    usual = float(np.median(np.diff(clock.times)))
    return f"{usual / NAMED_SECONDS[clock.unit]:.4g}"


def _counted(number: int, noun: str) -> str:
    return f"{number} {noun}{'' if number == 1 else 's'}"


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


def _rate_fix(rate: float) -> Fix:
    return Fix("frame_rate", f"{rate:.6g}", f"fs = {rate:.6g}; save('traj.mat', 'q', 'fs')")


def _conflict(source: str, rate: float, other: str, other_rate: float) -> Diagnostic:
    return finding(
        "rate_conflict",
        variable=source,
        value=rate,
        limit=other_rate,
        unit="Hz",
        rate=rate,
        other=other,
        other_rate=other_rate,
        fixes=tuple(_rate_fix(r) for r in (rate, other_rate)),
    )


def _assumed(source: str, rate: float, default: float | None) -> Diagnostic:
    fixes = [_rate_fix(rate)]
    if default is not None and abs(default - rate) > AGREES * rate:
        fixes.append(_rate_fix(default))
    return finding(
        "rate_assumed", variable=source, value=rate, unit="Hz", rate=rate, fixes=tuple(fixes)
    )


def _counting(clock: Clock, default: float) -> Diagnostic:
    return finding(
        "time_counts_rows",
        variable=clock.source,
        value=1.0,
        rate=default,
        fixes=tuple(_rate_fix(rate) for rate in dict.fromkeys([1.0, 1000.0, default])),
    )


def _clocks(
    workspace: Workspace,
    path: str,
    rows: int,
    column: NDArray[Any] | None,
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
        found.append(clock_of(column, f"{path}, its column of time", named=True, **words))
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


def _of_other_length(workspace: Workspace, path: str, rows: int) -> Diagnostic | None:
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


def _scalar_name(path: str) -> str:
    """Return the name of a number, such as fs of `m('fs')`; empty for an element of a list."""
    key = KEY.search(path)
    outer = path[: key.start()] if key else path
    if re.search(r"[({]", outer):
        return ""
    return key[1] or key[2] if key else leaf(path)


def _unused(
    workspace: Workspace, path: str, rows: int, clocks: list[Clock], default: float
) -> Diagnostic | None:
    """Return what to say of times, steps or a rate of the file that could not be used."""
    said = {c.source for c in clocks}
    for v in workspace.variables:
        name = _scalar_name(v.path)
        if not name or v.path in (path, *said) or not v.shape:
            continue
        words_of = parts(name)
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


def _is_foreign(workspace: Workspace, path: str, near: str, rows: int) -> bool:
    """Say whether the number at `path` belongs to other data: those beside it, or a controller.

    near: the structure that holds the matrix. The data beside it have another number of rows.
    """
    container = path.rpartition(".")[0]
    if not container or f"{near}.".startswith(f"{container}."):
        return False
    if set(parts(leaf(container))) & FOREIGN:
        return True
    sizes = [
        max(v.shape)
        for v in workspace.variables
        if v.shape and v.path.startswith(f"{container}.") and max(v.shape) >= FOREIGN_ROWS
    ]
    return bool(sizes) and rows not in sizes


def _is_elsewhere(path: str, near: str) -> bool:
    """Say whether the times at `path` lie in a structure that has no relation to the matrix."""
    theirs = path.split(".")[:-1]
    ours = near.split(".") if near else []
    while theirs and ours and theirs[0] == ours[0]:
        theirs, ours = theirs[1:], ours[1:]
    return any(not (RELATED & set(parts(name)) or is_time_name(name)) for name in theirs)


def _scalars(workspace: Workspace, path: str, rows: int, coarse: bool) -> list[Scalar]:
    """Return the numbers that are named like a rate or a step, those beside the matrix first.

    coarse: the rows are waypoints, between which seconds may pass.
    """
    near = first_path(path).rpartition(".")[0]
    found: list[tuple[bool, bool, Scalar]] = []
    for v in workspace.variables:
        number = workspace.scalar(v)
        name = _scalar_name(v.path)
        if number is None or not np.isfinite(number) or number <= 0 or not name:
            continue
        said = parts(name)
        unit = unit_named(name)
        whole = re.sub(r"[^a-z]", "", "".join(said))
        stepped = whole[: -len(said[-1])] if unit and len(said) > 1 else whole
        step = number * {"ms": 1e-3, "us": 1e-6, "ns": 1e-9}.get(unit, 1.0)
        rate, sure = 0.0, True
        if whole in RATE_NAMES:
            rate = number
        elif whole in STEP_NAMES or stepped in STEP_NAMES:
            rate = 1 / step
            if not unit and rate < 1 and not (coarse and rate >= LEAST_RATE):
                # 8 is 8 ms rather than 8 s
                rate, sure = (1e3 / step, False) if step <= 100 else (0.0, False)
        elif whole in UNSURE_RATES and number != rows:
            rate, sure = number, False
        elif whole in UNSURE_STEPS:
            likely = LIKELY_STEPS[0] <= step <= LIKELY_STEPS[1]
            rate, sure = (1 / step if likely else 0.0), False
        else:
            continue
        if sure and not ((LEAST_RATE if coarse else 1.0) <= rate <= MOST_RATE):
            rate, sure = 0.0, False
        if rate and not LEAST_RATE <= rate <= MOST_RATE:
            rate = 0.0
        foreign = sure and _is_foreign(workspace, v.path, near, rows)
        sure = sure and not foreign
        scalar = Scalar(v.path, snapped(rate) if rate else 0.0, sure, foreign)
        found.append((not sure, v.path.rpartition(".")[0] != near, scalar))
    found.sort(key=lambda item: item[:2])
    return [scalar for _, _, scalar in found]


def _of_duration(workspace: Workspace, path: str, rows: int) -> Scalar | None:
    """Return the rate that follows from a duration, where it comes out as a usual one."""
    near = first_path(path).rpartition(".")[0]
    for v in workspace.variables:
        number = workspace.scalar(v)
        name = _scalar_name(v.path)
        if number is None and name and v.values is not None and v.values.size == 2:
            # from the begin to the end, as ode45 takes it
            begin, end = (float(x) for x in v.values.reshape(-1))
            number = end - begin if "".join(parts(name)) in SPANS else None
        if number is None or not np.isfinite(number) or number <= 0 or not name:
            continue
        said = "".join(parts(name))
        if said not in DURATION_NAMES | SPANS or not _is_near(v.path, near):
            continue
        # T may be anything: it counts where it is the time of the last row, as in 0:dt:T
        for steps in (rows - 1,) if said == "t" else (rows - 1, rows):
            rate = steps / number
            if (
                LIKELY_OF_DURATION[0] <= rate <= LIKELY_OF_DURATION[1]
                and abs(rate - round(rate)) <= 1e-6 * rate
            ):
                return Scalar(v.path, float(round(rate)), sure=False)
    return None


def _is_near(path: str, container: str) -> bool:
    return path.rpartition(".")[0] in ("", container)
