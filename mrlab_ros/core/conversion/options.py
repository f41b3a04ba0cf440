"""What a person can ask of the converter, and columns written as in MATLAB."""

from __future__ import annotations

import itertools
import math
import re
from dataclasses import dataclass

from mrlab_ros.core.base.errors import BadInput
from mrlab_ros.core.conversion.diagnostics import (
    BAD_COLUMNS,
    BAD_OPTION,
    BAD_RATE,
    COUNTS_OF_WHAT,
    NO_INDEX,
    NO_INDICES,
    OUT_OF_RANGE,
    STEP_OF_ZERO,
    UNITS_CONTRADICT,
    UNKNOWN_UNIT,
)
from mrlab_ros.core.conversion.evidence import units

TERM = re.compile(r"(\d+|end)(?:\s*:\s*(?:(\d+)\s*:\s*)?(\d+|end))?$")
DEFAULT_FRAME_RATE = 100.0  # Hz
MOST_ROWS = 5_000_000  # of a matrix, if not said otherwise: almost 14 hours at 100 Hz
LEAST_RATE, MOST_RATE = 0.1, 100_000.0  # Hz
UNITS = ("rad", "deg", "mrad", "gon", "turn", "halfturn", "ddeg", "cdeg", "mdeg", "mm")
MOST_COUNTS = 1e9  # a turn; encoders have at most 2^30
NO_GRIPPER = "none"


@dataclass(frozen=True)
class Options:
    """What was asked for explicitly; nothing of it is ever assumed.

    The fields are those of the request of mrlab_msgs/ConvertTrajectory. variable: the matrix, as
    MATLAB writes it, also a part such as q(1:200, :); empty: found. join: matrices or vectors to
    join, such as q1..q6; empty: none. columns: which columns hold the joints, as in MATLAB,
    after `transpose`; empty: all. gripper: the gripper's column, or a vector of the file, or
    none; empty: the column after the joints. invert: larger values of the gripper mean open.
    units: rad, deg or another unit of angles (`evidence.units`), counts:N with N counts a turn, or
    mm for joints in m; empty: as the file states, else rad. frame_rate: Hz; 0: from the file.
    resample: rows at uneven times become frames at an even rate.
    """

    variable: str = ""
    columns: str = ""
    transpose: bool = False
    degrees: bool = False
    unwrap: bool = False
    frame_rate: float = 0.0
    resample: bool = False
    join: str = ""
    gripper: str = ""
    invert: bool = False
    units: str = ""

    def checked_rate(self) -> float:
        """Return the frame rate, Hz, 0 where none was asked for; raise BadInput if impossible."""
        rate = self.frame_rate
        if rate and not (math.isfinite(rate) and LEAST_RATE <= rate <= MOST_RATE):
            raise BadInput(BAD_RATE(value=rate, least=LEAST_RATE, most=MOST_RATE))
        return rate

    def factor(self) -> tuple[str, float]:
        """Return the unit of the joints, empty where none was named, and its factor to rad or m.

        The unit is one of angles, counts or mm. Raises BadInput where it is none of
        these, or where `degrees` and `units` contradict each other.
        """
        text = self.units.strip().lower()
        if self.degrees and text not in ("", "deg"):
            why = UNITS_CONTRADICT(found=self.units)
            raise BadInput(BAD_OPTION(option="units", found=self.units, why=why))
        if self.degrees or text == "deg":
            return "deg", math.pi / 180
        if text in ("", "rad"):
            return text, 1.0
        if text == "mm":
            return "mm", 1e-3
        stated = units.parse(text)
        # A word whose plural is another unit is not taken: grad is a degree, grads are gradians.
        plural = units.parse(f"{text}s") or stated
        if stated and stated.is_angle and stated.factor and stated == plural:
            return stated.name, stated.factor
        name, _, number = text.partition(":")
        try:
            counts = float(number)
        except ValueError:
            counts = math.nan
        if name == "counts" and 1 <= counts <= MOST_COUNTS:
            return "counts", 2 * math.pi / counts
        known = [*UNITS, "counts:N"]
        why = COUNTS_OF_WHAT() if name == "counts" else UNKNOWN_UNIT(known=known)
        raise BadInput(BAD_OPTION(option="units", found=self.units, why=why))


def parse_columns(text: str, width: int, variable: str, size: str) -> list[int]:
    """Return the indices, from 0, of columns such as '2:7', '[1 3 5]' or '2:end'.

    Raises BadInput where `text` is no such list or a column is not among the `width`.
    """
    try:
        return indices(text, width, "column")
    except BadInput as error:
        raise BadInput(
            BAD_COLUMNS(variable=variable, columns=text, size=size, why=error, limit=float(width))
        ) from None


def indices(text: str, count: int, axis: str) -> list[int]:
    """Return the indices, from 0, that `text` lists as MATLAB does.

    axis: row or column. Raises BadInput where it is no list or one is not among the `count`.
    """
    found: list[int] = []
    cleaned = re.sub(r"\s*:\s*", ":", text.strip().removeprefix("[").removesuffix("]"))
    for term in re.split(r"[,\s]+", cleaned.strip()):
        match = TERM.match(term)
        if match is None:
            raise BadInput(NO_INDEX(term=term, axis=axis))
        first, step, last = match.groups()
        start = count if first == "end" else int(first)
        stop = start if last is None else count if last == "end" else int(last)
        if step == "0":
            raise BadInput(STEP_OF_ZERO())
        if not (start >= 1 and max(start, stop) <= count):
            raise BadInput(OUT_OF_RANGE(axis=axis, count=count))
        found += range(start - 1, stop, int(step or 1))
    if not found:
        raise BadInput(NO_INDICES(axis=axis))
    return found


def columns_text(indices: list[int]) -> str:
    """Return columns, from 0, as MATLAB writes them: 2:7, or [1 3 4]."""
    if len(indices) > 1 and all(b - a == 1 for a, b in itertools.pairwise(indices)):
        return f"{indices[0] + 1}:{indices[-1] + 1}"
    numbers = " ".join(str(i + 1) for i in indices)
    return numbers if len(indices) == 1 else f"[{numbers}]"
