"""Writes a trajectory in the formats of other tools, and plots it."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

import numpy as np
import scipy.io

from mrlab_ros.adapters.trajectories import json_file
from mrlab_ros.adapters.workspaces import joint_trajectories
from mrlab_ros.core.conversion.preview import Preview
from mrlab_ros.core.diagnostics import Diagnostic, Severity
from mrlab_ros.core.errors import BadInput
from mrlab_ros.core.robots.model import RobotModel
from mrlab_ros.core.trajectory.trajectory import Array, Trajectory

Writer = Callable[[Trajectory, Path], Path]
DOWNSAMPLED = 2000  # points of a plotted line: more than a screen has
MOST_MARKED = 12  # findings that are marked in a picture


def positions_with_gripper(trajectory: Trajectory) -> Array:
    """Return (N, J) rad, or (N, J + 1) with the gripper last, 0 open and 1 closed."""
    if trajectory.gripper is None:
        return trajectory.positions
    return np.column_stack([trajectory.positions, trajectory.gripper])


def times(trajectory: Trajectory) -> Array:
    """Return t_i = i / frame_rate, (N,) s."""
    return np.arange(trajectory.frame_count) / trajectory.frame_rate


def write_json(trajectory: Trajectory, folder: Path) -> Path:
    """Write the trajectory file of trajectory.schema.json."""
    path = folder / f"{trajectory.id}.json"
    json_file.write(trajectory, path)
    return path


def write_csv(trajectory: Trajectory, folder: Path) -> Path:
    """Write a table: t in s, one column a joint in rad, gripper; with headings."""
    path = folder / f"{trajectory.id}.csv"
    headings = ["t", *trajectory.joint_names]
    if trajectory.gripper is not None:
        headings.append("gripper")
    table = np.column_stack([times(trajectory), positions_with_gripper(trajectory)])
    # 17 digits bring every double back exactly
    np.savetxt(path, table, fmt="%.17g", delimiter=",", header=",".join(headings), comments="")
    return path


def write_mat(trajectory: Trajectory, folder: Path) -> Path:
    """Write a v7 workspace with q (rad), qd (rad/s), t (s) and fs (Hz)."""
    path = folder / f"{trajectory.id}.mat"
    content = {
        "q": positions_with_gripper(trajectory),
        "qd": trajectory.channels.velocities,
        "t": times(trajectory)[:, np.newaxis],
        "fs": trajectory.frame_rate,
    }
    scipy.io.savemat(path, content, do_compression=True)
    return path


def write_npz(trajectory: Trajectory, folder: Path) -> Path:
    """Write NumPy arrays with the names that write_mat has."""
    path = folder / f"{trajectory.id}.npz"
    np.savez_compressed(
        path,
        q=positions_with_gripper(trajectory),
        qd=trajectory.channels.velocities,
        t=times(trajectory),
        fs=trajectory.frame_rate,
    )
    return path


def write_joint_trajectory(trajectory: Trajectory, folder: Path) -> Path:
    """Write a rosbag2 bag with one trajectory_msgs/JointTrajectory."""
    path = folder / f"{trajectory.id}.mcap"
    joint_trajectories.write_bag(trajectory, path)
    return path


WRITERS: dict[str, Writer] = {
    "json": write_json,
    "csv": write_csv,
    "mat": write_mat,
    "npz": write_npz,
    "jointtrajectory": write_joint_trajectory,
}


def writer(name: str) -> Writer:
    """Return the writer of the format `name`; raise BadInput that lists the formats."""
    if name not in WRITERS:
        raise BadInput(f"'{name}' is no format that is written; there are: {', '.join(WRITERS)}")
    return WRITERS[name]


def plot(trajectory: Trajectory, robot: RobotModel, path: Path) -> None:
    """Draw angles and velocities against the limits, and the proxies, as PNG or SVG."""
    stride = max(1, trajectory.frame_count // DOWNSAMPLED)
    t = times(trajectory)[::stride]
    channels = trajectory.channels
    rows: list[tuple[str, Array, list[tuple[float, float]]]] = [
        (
            "angle, deg",
            np.degrees(trajectory.positions[::stride]),
            [(np.degrees(j.lower), np.degrees(j.upper)) for j in robot.joints],
        ),
        (
            "velocity, deg/s",
            np.degrees(channels.velocities[::stride]),
            [(-np.degrees(j.max_velocity), np.degrees(j.max_velocity)) for j in robot.joints],
        ),
        ("torque proxy, N*m nominal", channels.effort_proxy[::stride], []),
    ]
    figure = _figure(9)
    axes: Any = figure.subplots(len(rows), 1, sharex=True)
    for axis, (label, values, limits) in zip(axes, rows, strict=True):
        for joint, name in enumerate(trajectory.joint_names):
            (line,) = axis.plot(t, values[:, joint], linewidth=1.2, label=name)
            low, high = float(values.min()), float(values.max())
            for limit in limits[joint] if limits else ():
                # a limit far from the motion would only squeeze the lines
                if low - 0.3 * (high - low + 1) <= limit <= high + 0.3 * (high - low + 1):
                    axis.axhline(limit, color=line.get_color(), linestyle=":", linewidth=0.8)
        axis.set_ylabel(label)
        axis.grid(alpha=0.3)
    axes[-1].set_xlabel("time, s")
    axes[0].legend(loc="upper right", fontsize="small", ncols=3)
    figure.suptitle(f"{trajectory.source.variable} of {trajectory.source.file} on {robot.id}")
    _save(figure, path)


def plot_refused(
    shown: Preview, findings: Sequence[Diagnostic], file: str, robot: RobotModel, path: Path
) -> None:
    """Draw the columns of a matrix that was not taken, and mark the rows that findings name."""
    figure = _figure(5)
    axis: Any = figure.subplots()
    for column in range(shown.values.shape[1]):
        axis.plot(shown.rows, shown.values[:, column], linewidth=1.2, label=f"column {column + 1}")
    marked = [d for d in findings if d.first_row and d.severity is Severity.ERROR]
    for found in marked[:MOST_MARKED]:
        axis.axvspan(found.first_row - 0.5, found.last_row + 0.5, color="red", alpha=0.2)
        axis.axvline(found.first_row, color="red", linestyle="--", linewidth=1.0)
        place = f"row {found.first_row}: {found.code}"
        axis.annotate(
            place, (found.first_row, 0.98), xycoords=("data", "axes fraction"), color="red",
            fontsize="small", rotation=90, ha="right", va="top",
        )  # fmt: skip
    axis.set_xlabel("row")
    axis.set_ylabel("value as stored")
    axis.grid(alpha=0.3)
    axis.legend(loc="upper right", fontsize="small", ncols=3)
    axis.set_title(f"{shown.variable} of {file}: not taken for {robot.id}", fontsize="medium")
    _save(figure, path)


def _figure(height: float) -> Any:
    """Return a figure 10 inches wide; its margins are fixed, as a computed layout takes longer."""
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure

    figure = Figure(figsize=(10, height))
    FigureCanvasAgg(figure)
    figure.subplots_adjust(0.08, 0.07 * 9 / height, 0.98, 1 - 0.06 * 9 / height, hspace=0.08)
    return figure


def _save(figure: Any, path: Path) -> None:
    path.parent.mkdir(parents=True, exist_ok=True)
    figure.savefig(path)
