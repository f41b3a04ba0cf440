"""The parts of matplotlib that draw here, loaded without the settings of the current folder.

matplotlib would read `matplotlibrc` there first. Beside a file from outside it could start LaTeX,
for one. The settings of the user's own folder hold.
"""

from __future__ import annotations

import os
from pathlib import Path
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from matplotlib.backends.backend_agg import FigureCanvasAgg as FigureCanvasAgg
    from matplotlib.figure import Figure as Figure
    from matplotlib.lines import Line2D as Line2D
    from matplotlib.patches import Patch as Patch
    from matplotlib.ticker import MaxNLocator as MaxNLocator


def _loaded() -> Any:
    here = os.open(".", os.O_PATH | os.O_DIRECTORY)
    try:
        os.chdir(Path(__file__).parent)
        import matplotlib.backends.backend_agg
        import matplotlib.figure
        import matplotlib.lines
        import matplotlib.patches
        import matplotlib.ticker
    finally:
        os.fchdir(here)
        os.close(here)
    matplotlib.rcParams["text.parse_math"] = False  # a $ in a name is no formula
    return matplotlib


_found = _loaded()
if not TYPE_CHECKING:
    FigureCanvasAgg = _found.backends.backend_agg.FigureCanvasAgg
    Figure, Line2D, Patch = _found.figure.Figure, _found.lines.Line2D, _found.patches.Patch
    MaxNLocator = _found.ticker.MaxNLocator
