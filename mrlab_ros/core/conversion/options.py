"""What a person can ask of the converter, and columns written as in MATLAB."""

from __future__ import annotations

import math
import re
from dataclasses import dataclass

from mrlab_ros.core.diagnostics import Refused, finding

TERM = re.compile(r"(\d+|end)(?:\s*:\s*(?:(\d+)\s*:\s*)?(\d+|end))?$")


@dataclass(frozen=True)
class Options:
    """What was asked for explicitly; nothing of it is ever assumed.

    The fields are those of the request of mrlab_msgs/ConvertTrajectory. variable: the matrix, as
    MATLAB writes it; empty: found. columns: which columns hold the joints, as in MATLAB, after
    `transpose`; empty: all. frame_rate: Hz; 0: from the file.
    """

    variable: str = ""
    columns: str = ""
    transpose: bool = False
    degrees: bool = False
    unwrap: bool = False
    frame_rate: float = 0.0

    def checked_rate(self) -> float:
        """Return the frame rate, Hz, 0 where none was asked for; raise Refused if impossible."""
        rate = self.frame_rate
        if rate and not (math.isfinite(rate) and 0 < rate <= 100_000):
            raise Refused(finding("bad_rate", value=rate))
        return rate


def parse_columns(text: str, width: int, variable: str, size: str) -> list[int]:
    """Return the indices, from 0, of columns such as '2:7', '[1 3 5]' or '2:end'.

    Raises Refused where `text` is no such list or a column is not among the `width`.
    """

    def refuse(problem: str) -> Refused:
        return Refused(
            finding("bad_columns", variable=variable, columns=text, size=size, problem=problem)
        )

    indices: list[int] = []
    cleaned = re.sub(r"\s*:\s*", ":", text.strip().removeprefix("[").removesuffix("]"))
    for term in re.split(r"[,\s]+", cleaned.strip()):
        match = TERM.match(term)
        if match is None:
            raise refuse(f"'{term}' is no column")
        first, step, last = match.groups()
        start = width if first == "end" else int(first)
        stop = start if last is None else width if last == "end" else int(last)
        if step == "0":
            raise refuse("a step of 0 leads nowhere")
        if not (start >= 1 and max(start, stop) <= width):
            raise refuse(f"there are the columns 1 to {width}")
        indices += range(start - 1, stop, int(step or 1))
    if not indices:
        raise refuse("that is no column at all")
    return indices
