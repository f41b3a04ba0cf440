"""Shown to a person: what a file holds, the matrices to choose from, some rows of one."""

from __future__ import annotations

import re
from collections.abc import Iterable
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mrlab_ros.core.base.diagnostic import MATLAB_PATH, Diagnostic
from mrlab_ros.core.conversion.workspace import ATTRIBUTE, COMMENT, Variable, Workspace, shortened

OBJECT_CODE = {
    "timeseries": "q = {name}.Data; save('traj.mat', 'q', '-v7')",
    "timetable": "q = {name}.Variables; save('traj.mat', 'q', '-v7')",
    "table": "q = {name}{{:, :}}; save('traj.mat', 'q', '-v7')",
    "Simulink.SimulationData.Dataset": "q = {name}{{1}}.Values.Data; save('traj.mat', 'q', '-v7')",
    "Simulink.SimulationData.Signal": "q = {name}.Values.Data; save('traj.mat', 'q', '-v7')",
    "Simulink.SimulationOutput": "q = {name}.get('q').Data; save('traj.mat', 'q', '-v7')",
    "dlarray": "q = extractdata({name}); save('traj.mat', 'q', '-v7')",
    "gpuArray": "q = gather({name}); save('traj.mat', 'q', '-v7')",
    "function_handle": "q = cell2mat(arrayfun(@(s) reshape({name}(s), 1, []), t(:), "
    "'UniformOutput', false)); save('traj.mat', 'q', 't', '-v7')",
}
OPENED = {*OBJECT_CODE, "containers.Map", "dictionary"} - {"function_handle"}
MOST_LISTED, MOST_INSIDE = 12, 6
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


MOST_ROWS, MOST_COLUMNS = 400, 32


@dataclass(frozen=True, eq=False)
class Preview:
    """Some rows of the matrix `variable`, at most MOST_ROWS.

    rows: (K,) which rows, from 1, rising. values: (K, C) in the matrix's own unit, C at most
    MOST_COLUMNS, NaN where not finite.
    """

    variable: str
    rows: NDArray[np.uint32]
    values: NDArray[np.float32]


def preview(variable: Variable, marked: Iterable[int] = ()) -> Preview:
    """Return evenly chosen rows of a variable that has values.

    The first and the last row are among them, and the rows `marked`, from 1, that it has.
    """
    values = variable.values
    assert values is not None
    count = len(values)
    wanted = [row for row in dict.fromkeys(marked) if 1 <= row <= count][: MOST_ROWS // 2]
    even = np.linspace(1, count, min(count, MOST_ROWS - len(wanted))).astype(np.uint32)
    rows = np.union1d(even, np.array(wanted, np.uint32))
    with np.errstate(over="ignore"):
        part = values[rows - 1, :MOST_COLUMNS].astype(np.float32)
    part[~np.isfinite(part)] = np.nan
    return Preview(variable.path, rows, part)


def matlab_name(path: str) -> str:
    """Return what a line of MATLAB calls the variable at `path`: a joined one, or a part, is q."""
    return path if MATLAB_PATH.fullmatch(path) else "q"


def saving(path: str) -> str:
    """Return the line of MATLAB that saves the matrix at `path` as q."""
    taken = "" if matlab_name(path) == "q" else f"q = {path}; "
    return f"{taken}save('traj.mat', 'q', '-v7')"


def contents(workspace: Workspace) -> dict[str, Any]:
    """Return what the file holds, as the values of diagnostics.CONTENTS."""
    top = [
        v
        for v in workspace.variables
        if v.kind not in (COMMENT, ATTRIBUTE) and (v.is_message or not re.search(r"[.({]", v.path))
    ]
    listed = top[:MOST_LISTED]
    opened = tuple(
        v.path for v in listed if v.values is None and not v.is_object and v.kind in OPENED
    )
    inside = [
        f"{v.path} ({v.size})"
        for v in workspace.variables
        if v.values is not None and v.values.size > 1 and v.path.startswith(opened)
    ]
    return {
        "count": len(top),
        "held": [f"{v.path} ({' '.join(filter(None, (v.size, v.kind)))})" for v in listed],
        "more": len(top) - len(listed) or None,
        "inside": shortened(inside, MOST_INSIDE) if opened else [],
    }
