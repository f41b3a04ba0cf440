"""`mrlab_ros.check`: an array is checked as `mrlab check` checks a file, without a lab."""

from __future__ import annotations

import sys
import tempfile
import time
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike

from mrlab_ros.adapters import share
from mrlab_ros.adapters.data_frame import data_frame
from mrlab_ros.adapters.robots.library import RobotLibrary
from mrlab_ros.adapters.trajectories import array_file
from mrlab_ros.app.check.file import CheckedFile, Setting, check_file, scene_of
from mrlab_ros.app.check.stage import Stage
from mrlab_ros.core.base.diagnostic import Diagnostic
from mrlab_ros.core.base.errors import BadInput
from mrlab_ros.core.base.foreign_text import for_html
from mrlab_ros.core.base.geometry import Array
from mrlab_ros.core.conversion.options import Options
from mrlab_ros.core.trajectory.trajectory import Trajectory

if TYPE_CHECKING:
    from PIL import Image

WIDTH, HEIGHT = 160, 28  # of a sparkline, px
MOST_POINTS = 160
SILENT_S = 3.0


def check(
    q: ArrayLike,
    fs: ArrayLike | None = None,
    robot: str = "",
    *,
    end_effector: str = "",
    scene: str = "",
    options: Options | None = None,
    progress: bool = True,
) -> ArrayCheck:
    """Check whether a robot can run a motion: limits, collisions, grasps.

    q: (N, J) rad, a row a frame and a column a joint; a further column is the gripper. fs: Hz, or
    (N,) s, the time of each row. robot: a model, such as ur5e. scene: a name or a file; empty: a
    floor alone. progress: a check that takes longer than SILENT_S says on stderr how far it is.
    Raises LabError where it cannot be checked, such as an unknown robot.
    """
    folder = share.directory()
    stage = Stage(folder, RobotLibrary(folder / "robots"))
    setting = Setting(
        stage, scene_of(scene, folder), scene, robot, end_effector, options or Options(),
        progress=_told() if progress else None,
    )  # fmt: skip
    with tempfile.TemporaryDirectory(prefix="mrlab-") as made:
        return ArrayCheck(check_file(array_file.write(Path(made), q, fs), setting), stage, folder)


def _told() -> Callable[[float, float], None]:
    """Return what writes once a second which part of a motion was rehearsed, if it takes long."""
    written = time.monotonic() + SILENT_S - 1.0

    def tell(seconds: float, whole: float) -> None:
        nonlocal written
        if time.monotonic() - written >= 1.0:
            written = time.monotonic()
            sys.stderr.write(f"\rchecked {seconds:.0f} of {whole:.0f} s of the motion")
            sys.stderr.flush()

    return tell


@dataclass(frozen=True, eq=False)
class ArrayCheck:
    """What came of a check. Notebooks show it as a table with a line a joint."""

    checked: CheckedFile
    _stage: Stage
    _share: Path

    @property
    def ok(self) -> bool:
        """Return whether no finding blocks the motion."""
        report = self.checked.checked.report
        return self.checked.holds_motion and not report.refusing and self.trajectory is not None

    @property
    def findings(self) -> tuple[Diagnostic, ...]:
        """Return the findings, the gravest kinds first."""
        return tuple(self.checked.checked.report.findings)

    @property
    def trajectory(self) -> Trajectory | None:
        """Return the motion as the lab would play it; None where it is refused."""
        return self.checked.checked.trajectory

    def picture(self, time: float = 0.0) -> Image.Image:
        """Return a picture of the robot at `time` s, the last frame from its end on.

        Raises BadInput where the motion is refused.
        """
        from mrlab_ros.app.show.poster import image  # trimesh is slow to import

        motion = self._motion()
        row = min(max(round(time * motion.frame_rate), 0), motion.frame_count - 1)
        positions = dict(zip(motion.joint_names, motion.positions[row], strict=True))
        return image(self._stage.library, motion.robot_model, motion.end_effector or "", positions)

    def page(self) -> str:
        """Return the report with 3D and plots as one HTML file; raise BadInput without."""
        from mrlab_ros.app.show.check import page_of  # trimesh is slow to import

        return page_of(self.checked, self._stage, self._share)

    def to_dataframe(self) -> Any:
        """Return a pandas.DataFrame of the positions, rad or m: a column a joint, by time, s.

        Raises BadInput where the motion is refused, Misuse without pandas.
        """
        motion = self._motion()
        times = np.arange(motion.frame_count) / motion.frame_rate
        return data_frame(motion.positions, times, motion.joint_names)

    def _motion(self) -> Trajectory:
        if self.trajectory is None:
            raise BadInput(self.checked.why or self.checked.checked.report.summary)
        return self.trajectory

    def __str__(self) -> str:
        lines = [f"  {each.severity.name.lower()}: {each}" for each in self.findings]
        return "\n".join([str(self.checked.checked.report.summary), *lines])

    def _repr_html_(self) -> str:
        rows = "".join(
            f"<tr><td>{each.severity.name.lower()}</td><td>{for_html(each.joint)}</td>"
            f"<td>{each.first_row or ''}</td><td>{for_html(each.message)}</td>"
            f"<td>{for_html(each.remedy)}</td></tr>"
            for each in self.findings
        )
        summary = for_html(str(self.checked.checked.report.summary))
        found = _table(("", "joint", "row", "finding", "remedy"), rows)
        return f"<p>{summary}</p>{self._lines()}{found}"

    def _lines(self) -> str:
        """Return a table with a row a joint: its name, its course, and its range in rad or m."""
        motion = self.trajectory
        if motion is None:
            return ""
        rows = "".join(
            f"<tr><td>{for_html(name)}</td><td>{sparkline(course)}</td>"
            f"<td>{course.min():.3f}</td><td>{course.max():.3f}</td></tr>"
            for name, course in zip(motion.joint_names, motion.positions.T, strict=True)
        )
        return _table(("joint", "course", "least", "most"), rows)


def _table(heads: tuple[str, ...], rows: str) -> str:
    """Return a table of HTML; empty where it has no rows."""
    line = "".join(f"<th>{head}</th>" for head in heads)
    return f"<table><tr>{line}</tr>{rows}</table>" if rows else ""


def sparkline(course: Array) -> str:
    """Return a line through (N,) values as SVG that needs no script."""
    values = course[:: max(1, len(course) // MOST_POINTS)]
    low, high = values.min(), values.max()
    across = np.linspace(1, WIDTH - 1, len(values))
    down = HEIGHT - 2 - (values - low) / max(high - low, 1e-9) * (HEIGHT - 4)
    points = " ".join(f"{x:.1f},{y:.1f}" for x, y in zip(across, down, strict=True))
    return (
        f'<svg width="{WIDTH}" height="{HEIGHT}" role="img"><polyline points="{points}" '
        'fill="none" stroke="currentColor"/></svg>'
    )
