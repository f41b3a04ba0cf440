"""How many rows of a matrix make a second, as far as the file says so."""

from __future__ import annotations

import re
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mrlab_ros.core.conversion.variable_names import leaf, words
from mrlab_ros.core.conversion.workspace import Variable, Workspace
from mrlab_ros.core.diagnostics import Diagnostic, finding

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


def time_beside(workspace: Workspace, path: str) -> Variable | None:
    """Return the own time of the matrix at `path`, else that of the structure it lies in."""
    variable = workspace.find(path)
    if variable is not None and variable.time:
        return workspace.find(variable.time)
    match = re.match(r"(.*?)\.signals(?:\(\d+\))?\.values$", path)
    outer = match.group(1) if match else path.rpartition(".")[0]
    if not outer:
        return None
    for name in ("time", "t", "Time"):
        found = workspace.find(f"{outer}.{name}")
        if found is not None and found.values is not None:
            return found
    return None


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


def agreed(found: list[FrameRate], default: float, file: str) -> tuple[float, list[Diagnostic]]:
    """Return the frame rate, Hz: the first that was found, or the default; and what to say."""
    if not found:
        return default, [finding("rate_default", file=file, rate=default)]
    best = found[0]
    notes = [finding("rate_found", variable=best.source, rate=best.rate)]
    for other in found[1:]:
        if abs(other.rate - best.rate) > 0.01 * best.rate:
            clash: dict[str, Any] = {
                "rate": best.rate,
                "other": other.source,
                "other_rate": other.rate,
            }
            notes.append(finding("rate_conflict", variable=best.source, **clash))
            break
    if best.uneven:
        least, most = best.uneven
        notes.append(
            finding("time_uneven", variable=best.source, least=least, most=most, rate=best.rate)
        )
    return best.rate, notes
