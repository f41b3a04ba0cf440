"""Numbers of a workspace that say how fast a matrix is: rates, steps and durations, by name."""

from __future__ import annotations

import re
from dataclasses import dataclass

import numpy as np

from mrlab_ros.core.conversion.joining import first_path
from mrlab_ros.core.conversion.time_vectors import LEAST_RATE, MOST_RATE, snapped, unit_named
from mrlab_ros.core.conversion.variable_names import leaf, parts, words
from mrlab_ros.core.conversion.workspace import Workspace

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


def scalars(workspace: Workspace, path: str, rows: int, coarse: bool) -> list[Scalar]:
    """Return the numbers that are named like a rate or a step, those beside the matrix first.

    coarse: the rows are waypoints, between which seconds may pass.
    """
    near = first_path(path).rpartition(".")[0]
    found: list[tuple[bool, bool, Scalar]] = []
    for v in workspace.variables:
        number = workspace.scalar(v)
        name = scalar_name(v.path)
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


def of_duration(workspace: Workspace, path: str, rows: int) -> Scalar | None:
    """Return the rate that follows from a duration, where it comes out as a usual one."""
    near = first_path(path).rpartition(".")[0]
    for v in workspace.variables:
        number = workspace.scalar(v)
        name = scalar_name(v.path)
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


def scalar_name(path: str) -> str:
    """Return the name of a number, such as fs of `m('fs')`; empty for an element of a list."""
    key = KEY.search(path)
    outer = path[: key.start()] if key else path
    if re.search(r"[({]", outer):
        return ""
    return key[1] or key[2] if key else leaf(path)


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


def _is_near(path: str, container: str) -> bool:
    return path.rpartition(".")[0] in ("", container)
