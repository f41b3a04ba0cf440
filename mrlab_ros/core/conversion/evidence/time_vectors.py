"""Rising numbers as time: their unit, their rate, and how even they are."""

from __future__ import annotations

import re
from dataclasses import dataclass
from functools import lru_cache
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mrlab_ros.core.conversion.evidence import units
from mrlab_ros.core.conversion.evidence.glossary import Class
from mrlab_ros.core.conversion.evidence.names import described, leaf, parts, without_numbers, words
from mrlab_ros.core.trajectory.trajectory import Array

SECONDS = {"s": 1.0, "ms": 1e-3, "us": 1e-6, "ns": 1e-9, "days": 86_400.0}
# units that only a name says, which may mean a minimum or a height as well
NAMED_SECONDS = {**SECONDS, "min": 60.0, "h": 3600.0}
UNIT_WORDS = units.spellings(units.TIMES)
TIME_NAMES = words(
    "t time tout timevec timevector times tvec timecont ts tq tt tsamples trajtimes timestamp "
    "timestamps tspan tspace zeit zeiten zeitvektor zeitstempel zeitpunkte tlog tsim ttraj "
    "ttotal elapsed elapsedtime clock stamp stamps datenum datetime duration tdata xdata tgrid "
    "timefromstart"
)
TIME_PARTS = words(
    "t time times timestamp timestamps zeit zeiten zeitstempel stamp stamps clock datenum elapsed"
)
OF_CLOCKS = (Class.CLOCK, Class.KEPT, Class.ROLE, Class.ABOUT, Class.SAMPLING, Class.ARM)
# parameters along a path run from 0 to 1 and are no time
PATH_PARAMETERS = words("s u lambda sigma tau param parameter progress fraction alpha percent")

# Hz; a rate outside is not one that joints are sampled with
LEAST_RATE, MOST_RATE = 0.1, 10_000.0
LEAST_STEP = 1e-15  # s; smaller ones, down to denormal numbers, are no time
EVEN_STEPS = 0.01  # of a step; what even steps may differ by
SAME_STEP = 0.05  # of the usual step; a step that is the usual one
MANY, FEW = 0.8, 0.05  # shares of the steps
EPOCH = {"s": (1e9, 3e9), "ms": (1e12, 3e12), "us": (1e15, 3e15), "ns": (1e18, 3e18)}
DATENUM = (6.5e5, 8.0e5)  # days since the year 0: 1780 to 2190
ROUNDINGS = (10.0, 1.0, 0.1, 0.01, 1e-3, 1e-4)
ROUNDED_TO, LEAST_STEP_ROUNDED = 0.0101, 1e-7  # s; coarser times are no rounding of even ones
ROUNDED_ALIKE = 0.9  # of the rows; so many even times have to be these once they are rounded
COARSEST = 0.2  # of a step; the last digit of times that are rounded
# change from step to step over the spread of the steps: 1.4 where they are independent
IRREGULAR = 1.1
REGULAR = 0.9  # share of the steps of a clock that are near its usual one
SAMPLE = 257


@dataclass(frozen=True, eq=False)
class Clock:
    """A vector of times.

    source: the variable, as MATLAB writes it. times: (N,) s from the first one on. unit: that of
    the source, a key of SECONDS, or empty where the numbers count rows. unit_known: the name or
    the numbers leave no doubt of it. rate: Hz; 0 where the unit is not known. named: its name
    says time. least, most: s, the smallest and the largest step; deviation: s, how far a row is
    from where an even rate puts it, at most, at row worst_row (from 1). repeated, backward: rows
    (from 1) whose time is that of the row before, or earlier. rounded: s, what even times were
    rounded to, where their steps differ by that alone; 0 where they were not.
    """

    source: str
    times: Array
    unit: str
    unit_known: bool
    rate: float
    named: bool
    least: float
    most: float
    deviation: float
    worst_row: int
    repeated: tuple[int, ...]
    backward: tuple[int, ...]
    rounded: float = 0.0

    @property
    def even(self) -> bool:
        """Say whether the steps are equal, within a hundredth or the digits they are given to."""
        return not (self.repeated or self.backward) and self.worst_row == 0


def snapped(rate: float, tolerance: float = 1e-6) -> float:
    """Return the whole number that `rate` is within `tolerance`, relative, or `rate`."""
    whole = round(rate)
    return float(whole) if whole and abs(rate - whole) <= tolerance * whole else rate


def unit_named(name: str) -> str:
    """Return the unit of time that a name ends in, a key of SECONDS, or empty."""
    said = parts(name)
    for unit, names in UNIT_WORDS.items():
        if len(said) > 1 and said[-1] in names:
            return unit
        if said[-1:] == ["datenum"]:
            return "days"
    return ""


def is_time_name(path: str) -> bool:
    """Say whether the name of the variable at `path`, or a heading, says time."""
    return _is_time_name(without_numbers(path))


@lru_cache(maxsize=4096)
def _is_time_name(path: str) -> bool:
    name = re.sub(r"[({\[].*$", "", leaf(path))
    said = parts(name)
    for names in UNIT_WORDS.values():
        if len(said) > 1 and said[-1] in names:
            said = said[:-1]
    whole = "".join(said).rstrip("0123456789")
    if whole in TIME_NAMES or TIME_PARTS.intersection(said):
        return True
    found = described("_".join(said))
    clock = any(w.can_be(Class.CLOCK) and len(w.text) > 1 for w in found)
    return clock and all(w.can_be(*OF_CLOCKS) for w in found)


def is_regular(column: NDArray[Any], *, falling: bool = False) -> bool:
    """Say whether a column rises steadily, as a clock does, also one that jitters.

    falling: a column that falls steadily counts as well. A joint that speeds up and slows down
    has steps of many sizes and is not regular.
    """
    if len(column) < 3:
        return False
    if _rounded(column.astype(np.float64)) is not None:
        return True
    chosen = np.linspace(0, len(column) - 1, min(len(column), SAMPLE)).astype(int)
    coarse = np.diff(column[chosen].astype(np.float64))
    if not np.isfinite(coarse).all():
        return False
    if not ((coarse > 0).all() or (falling and (coarse < 0).all())):
        return False
    steps = np.abs(np.diff(column.astype(np.float64)))
    usual = float(np.median(steps))
    near = np.count_nonzero(np.abs(steps - usual) <= 0.5 * usual)
    return bool(near >= REGULAR * len(steps))


def is_even(column: NDArray[Any]) -> bool:
    """Say whether a column rises in equal steps."""
    if len(column) < 3:
        return False
    steps = np.diff(column.astype(np.float64))
    mean = float(steps.mean())
    return mean > 0 and bool(np.abs(steps - mean).max() <= max(1e-3 * mean, 1e-9))


def is_irregular(column: NDArray[Any]) -> bool:
    """Say whether a column rises from row to row in steps that have nothing to do with another.

    Times that are stamped whenever a message comes do so; the steps of a joint resemble the steps
    before them.
    """
    if len(column) < 20:
        return False
    steps = np.diff(column.astype(np.float64))
    if not (steps > 0).all():
        return False
    spread = float(steps.std())
    changes = float(np.diff(steps).std())
    return spread > 1e-6 * float(steps.mean()) and changes > IRREGULAR * spread


def counts_rows(column: NDArray[Any]) -> bool:
    """Say whether a column is 0, 1, 2 ... or 1, 2, 3 ..."""
    first = float(column[0])
    expected = first + np.arange(len(column))
    return first in (0.0, 1.0) and bool((column == expected).all())


def clock_of(
    values: NDArray[Any],
    source: str,
    *,
    named: bool,
    coarse: bool = False,
    unit: str = "",
    likely_rates: tuple[float, ...] = (),
) -> Clock | None:
    """Return the times that `values` are, or None where they are none.

    named: the name says time, so that a few steps back are flaws of a clock and not the end of
    one. coarse: the rows are waypoints, far from one another. unit: what the name says, or empty.
    likely_rates: Hz, from elsewhere in the file; the unit that gives one of them is right.
    """
    t = np.asarray(values, dtype=np.float64).reshape(-1)
    if len(t) < 2 or not np.isfinite(t).all():
        return None
    rounded = _rounded(t)
    steps = np.diff(t)
    back = np.flatnonzero(steps < 0)
    same = np.flatnonzero(steps == 0)
    if t[-1] <= t[0] and not (named and len(back)):
        return None
    if len(back) > (FEW * len(steps) if named else 0):
        return None
    if len(same) > 0.5 * len(steps) and rounded is None:
        return None
    forward = steps[steps > 0]
    if not len(forward):
        return None
    usual = float(np.median(forward))
    if unit:
        known = unit in SECONDS
    else:
        unit, known = _unit(t, usual, coarse, likely_rates)
    scale = NAMED_SECONDS.get(unit, 1.0)
    if rounded is not None and unit and LEAST_STEP_ROUNDED < rounded[0] * scale <= ROUNDED_TO:
        return _evened(t, source, rounded, unit, known, named)
    times = (t - t[0]) * scale
    usual *= scale
    steps = steps * scale
    span = float(times[-1])
    usually = np.count_nonzero(np.abs(steps - usual) <= SAME_STEP * usual) >= MANY * len(steps)
    resolution = _resolution(t, steps / scale) * scale
    mean = span / len(steps) if not len(back) else usual
    step = usual if usually and abs(mean - usual) > EVEN_STEPS * usual else mean
    if step < LEAST_STEP:
        return None
    rate = snapped(1 / step, max(1e-6, resolution / max(span, step)))
    deviations = np.abs(times - np.arange(len(times)) / rate)
    flawed = np.abs(steps - 1 / rate)
    allowed = max(EVEN_STEPS / rate, 1.01 * resolution)
    uneven = bool(flawed.max() > allowed) or bool(
        deviations.max() > max(0.5 / rate, 2 * resolution)
    )
    worst = int(flawed.argmax()) + 1 if uneven else 0
    if unit and not LEAST_RATE <= rate <= MOST_RATE:
        return None
    return Clock(
        source,
        times,
        unit,
        known,
        rate if unit else 0.0,
        named,
        float(steps.min()),
        float(steps.max()),
        float(deviations.max()),
        worst,
        tuple(int(i) + 2 for i in same[:100]),
        tuple(int(i) + 2 for i in back[:100]),
    )


def _rounded(t: Array) -> tuple[float, float] | None:
    """Return what even times were rounded to, where that makes their steps differ, and the step.

    Both are in the unit of the times. None where rounding does not explain what differs.
    """
    if len(t) < 20 or not np.isfinite(t[0]) or not t[-1] > t[0]:
        return None
    offset = t - np.floor(t[0])
    unit = next(
        (u for u in ROUNDINGS if np.abs(offset / u - np.rint(offset / u)).max() < 1e-3), None
    )
    span = float(t[-1] - t[0])
    if unit is None or unit <= COARSEST * span / (len(t) - 1):
        return None
    rows = np.arange(len(t))
    step, start = np.polyfit(rows, offset, 1)
    if abs(step / unit - np.rint(step / unit)) * len(t) < 1:
        return None  # such times need no rounding, so that is not why their steps differ
    left = offset - (start + step * rows)
    if step <= 0 or np.ptp(left) > 1.1 * unit or np.ptp(left) < 0.1 * unit:
        return None
    middle = (float(left.max()) + float(left.min())) / 2
    expected = np.rint((start + middle + step * rows) / unit)
    right = np.count_nonzero(expected == np.rint(offset / unit))
    return (unit, float(step)) if right >= ROUNDED_ALIKE * len(t) else None


def _evened(
    t: Array,
    source: str,
    rounded: tuple[float, float],
    unit: str,
    known: bool,
    named: bool,
) -> Clock | None:
    """Return the even clock whose times were rounded."""
    scale = NAMED_SECONDS[unit]
    to, step = rounded[0] * scale, rounded[1] * scale
    rate = snapped(1 / step, to / (step * len(t)))
    if not LEAST_RATE <= rate <= MOST_RATE:
        return None
    times = np.arange(len(t)) / rate
    off = float(np.abs((t - t[0]) * scale - times).max())
    steps = np.diff(t) * scale
    ends = float(steps.min()), float(steps.max())
    return Clock(source, times, unit, known, rate, named, *ends, off, 0, (), (), rounded=to)


def _resolution(t: Array, steps: Array) -> float:
    """Return the last decimal that times are given to, in their unit, where that makes steps vary.

    Times written with three decimals at 60 Hz step by 16 and 17 ms: that is rounding.
    """
    least = float(np.median(np.abs(steps)))
    offset = t - np.floor(t[0])
    for digits in range(7):
        unit = 10.0**-digits
        if (
            unit <= COARSEST * least
            and np.abs(offset / unit - np.rint(offset / unit)).max() < 1e-3
        ):
            return unit
    # beside that, doubles far from 0 are coarse
    return float(np.spacing(np.abs(t).max()))


def _unit(
    t: Array, usual: float, coarse: bool, likely_rates: tuple[float, ...]
) -> tuple[str, bool]:
    """Return the unit of times by their size, and whether there is no doubt of it."""
    for unit, (low, high) in EPOCH.items():
        if low <= t[0] <= high and usual * SECONDS[unit] <= 1 / LEAST_RATE:
            return unit, True
    if DATENUM[0] <= t[0] <= DATENUM[1] and usual < 0.01:
        return "days", True
    for unit, scale in SECONDS.items():
        if any(abs(usual * scale * rate - 1) < 0.03 for rate in likely_rates):
            return unit, True
    if 2e-4 <= usual <= 0.5:
        return "s", True
    if usual > 0.5 and coarse:
        return "s", usual <= 10
    if abs(usual - 1) < 1e-9:
        return "", False
    if 0.5 < usual < 1.5:
        return "s", False
    if usual >= 1.5:
        return ("ms" if usual <= 200 else "us" if usual <= 2e5 else "ns"), False
    return ("days" if usual <= 1e-5 else "s"), False
