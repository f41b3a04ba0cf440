"""What a person is offered where a file holds more than one possible trajectory."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from mrlab_ros.core.base.diagnostic import Diagnostic
from mrlab_ros.core.conversion.preview import Preview

SPARKS = "▁▂▃▄▅▆▇█"
SPARK_WIDTH = 24


@dataclass(frozen=True, eq=False)
class Candidate:
    """A matrix that could be the joint positions.

    path: as MATLAB writes it. shape: as MATLAB's size() gives it. score: 0 to 1, larger is
    likelier. reasons: what speaks for and against it. minimum, maximum: of its finite columns, in
    the matrix's own unit; NaN where it has none.
    """

    path: str
    shape: tuple[int, ...]
    score: float
    reasons: tuple[Diagnostic, ...]
    minimum: float
    maximum: float
    preview: Preview

    @property
    def why(self) -> str:
        """Return the reasons as one English text."""
        return "; ".join(map(str, self.reasons))

    @property
    def size(self) -> str:
        """Return the dimensions as MATLAB's whos writes them, such as 450x6."""
        return "x".join(str(n) for n in self.shape)

    def sparkline(self) -> str:
        """Return the course of the column that moves most, as text."""
        values = self.preview.values
        if not np.isfinite([self.minimum, self.maximum]).all():
            return ""
        sample = values[np.linspace(0, len(values) - 1, SPARK_WIDTH).astype(int)].astype(float)
        sample = np.nan_to_num(sample) / 4  # a span of the largest numbers is one, too
        spans = np.ptp(sample, axis=0)
        column = sample[:, int(spans.argmax())]
        span = float(spans.max()) or 1.0
        return "".join(SPARKS[int(7 * (x - column.min()) / span)] for x in column)
