"""A motion to look at, as a page reads it: MotionDocument of web/src/playback/motion.ts.

Positions are rad (m where prismatic) as float32: a page draws them, nothing computes with them.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import asdict
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mrlab_ros.app.show.packed import packed
from mrlab_ros.core.base.diagnostic import Diagnostic, plain
from mrlab_ros.core.conversion.candidates import Preview
from mrlab_ros.core.conversion.convert import ConversionResult, Outcome
from mrlab_ros.core.conversion.options import DEFAULT_FRAME_RATE
from mrlab_ros.core.robots.model import ShownRobot
from mrlab_ros.core.trajectory.trajectory import Source, Trajectory

SCHEMA = "mrlab.motion.1"
# A longer trajectory is shown by every k-th frame: 200 s at 100 Hz, 0.5 MB of angles.
MOST_FRAMES = 20_000


def motion(
    trajectory: Trajectory,
    robot: ShownRobot,
    *,
    message: str,
    diagnostics: Sequence[Diagnostic] | None = None,
    most_frames: int = MOST_FRAMES,
) -> dict[str, Any]:
    """Return the document of an accepted trajectory.

    message: one sentence. diagnostics: None: the trajectory's own warnings. Of more than
    `most_frames` frames every k-th one is taken, and the last.
    """
    kept = _kept(trajectory.frame_count, most_frames)
    whole = len(kept) == trajectory.frame_count
    gripper, channels = trajectory.gripper, trajectory.channels
    return {
        **_head(trajectory.id, "accepted", message, robot, trajectory.frame_rate),
        "times": None if whole else packed(kept / trajectory.frame_rate, "float64"),
        "rows": None if whole else packed(kept + 1, "uint32"),
        "positions": packed(trajectory.positions[kept], "float32"),
        "gripper": None if gripper is None else packed(gripper[kept], "uint8"),
        "velocities": packed(channels.velocities[kept], "float32"),
        "effort_proxies": packed(channels.effort_proxy[kept], "float32"),
        "findings": findings(trajectory.warnings if diagnostics is None else diagnostics),
        "source": asdict(trajectory.source),
    }


def preview_motion(
    preview: Preview,
    robot: ShownRobot,
    *,
    file: str,
    message: str,
    verdict: str = "refused",
    frame_rate: float = DEFAULT_FRAME_RATE,
    diagnostics: Sequence[Diagnostic] = (),
) -> dict[str, Any] | None:
    """Return the document of some rows of a matrix that was not taken, or None.

    The values count as rad, or as degrees where a finding says that they are; the first columns
    are the joints. None where the matrix has fewer columns than the robot has joints, or fewer
    than two rows: no motion.
    """
    joints = len(robot.joints)
    if len(preview.rows) < 2 or preview.values.shape[1] < joints:
        return None
    values = preview.values[:, :joints]
    if any(_all_degrees(d, preview.variable) for d in diagnostics):
        values = np.radians(values)
    return {
        **_head(file, verdict, message, robot, frame_rate),
        "times": packed((preview.rows.astype(np.float64) - 1) / frame_rate, "float64"),
        "rows": packed(preview.rows, "uint32"),
        "positions": packed(values, "float32"),
        "gripper": None,
        "velocities": None,
        "effort_proxies": None,
        "findings": findings(diagnostics),
        "source": asdict(Source(file, preview.variable, "")),
    }


def _all_degrees(found: Diagnostic, variable: str) -> bool:
    """Return whether a finding says that a matrix is in degrees, and not only some columns."""
    whole = any(fix.option == "units" and fix.value == "deg" for fix in found.fixes)
    return found.code == "degrees" and whole and found.variable in ("", variable)


def of_result(result: ConversionResult, robot: ShownRobot) -> dict[str, Any] | None:
    """Return the document of what became of a file, or None where it held no motion.

    A refused file is shown by its preview, an ambiguous one by its likeliest candidate.
    """
    if result.trajectory is not None:
        return motion(
            result.trajectory, robot, message=result.message, diagnostics=result.diagnostics
        )
    shown = result.preview
    if result.outcome is Outcome.AMBIGUOUS and result.candidates:
        shown = result.candidates[0].preview
    if shown is None:
        return None
    return preview_motion(
        shown,
        robot,
        file=result.file,
        message=result.message,
        verdict="ambiguous" if result.outcome is Outcome.AMBIGUOUS else "refused",
        frame_rate=result.frame_rate or DEFAULT_FRAME_RATE,
        diagnostics=result.diagnostics,
    )


def findings(diagnostics: Sequence[Diagnostic]) -> list[dict[str, Any]]:
    """Return the findings, numbered by their place in the list; NaN and Inf become null."""
    return [plain(d) for d in diagnostics]


def _head(
    title: str, verdict: str, message: str, robot: ShownRobot, frame_rate: float
) -> dict[str, Any]:
    return {
        "schema": SCHEMA,
        "title": title,
        "verdict": verdict,
        "message": message,
        "robot": {
            "model": robot.model,
            "product": robot.product,
            "end_effector": robot.end_effector,
            "urdf": robot.urdf,
            "joints": [asdict(joint) for joint in robot.joints],
        },
        "frame_rate": frame_rate,
    }


def _kept(count: int, most: int) -> NDArray[np.int64]:
    """Return the indices of the frames that are shown: all, or every k-th and the last."""
    step = -(-count // most)
    return np.unique(np.append(np.arange(0, count, step), count - 1))


def _finite(value: float | None) -> float | None:
    return value if value is not None and math.isfinite(value) else None
