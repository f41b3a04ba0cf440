"""Writes a trajectory in the formats of other tools, and plots it.

Writes and reads the trajectory file of trajectory.schema.json: the format for other tools.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
import orjson
from ament_index_python.packages import PackageNotFoundError, get_package_share_directory

from mrlab_ros.adapters.whole_file import replaced
from mrlab_ros.adapters.workspaces import joint_trajectories
from mrlab_ros.core.base.diagnostic import Diagnostic, Severity
from mrlab_ros.core.base.errors import BadInput
from mrlab_ros.core.base.foreign_text import visible
from mrlab_ros.core.base.names import close_to
from mrlab_ros.core.conversion.candidates import Preview
from mrlab_ros.core.robots.model import RobotModel
from mrlab_ros.core.runtime.colours import JOINTS, SEVERITIES
from mrlab_ros.core.trajectory import document as trajectory_document
from mrlab_ros.core.trajectory.diagnostics import NO_EXPORT_FORMAT, NOT_AS_SCHEMA, NOT_JSON
from mrlab_ros.core.trajectory.trajectory import Array, Trajectory

SUFFIX = ".json"
BLOCK = 8192  # frames turned into text at once
NUMPY = orjson.OPT_SERIALIZE_NUMPY


@cache
def schema() -> Any:
    """Return the validator of trajectory.schema.json."""
    import jsonschema  # only what reads a trajectory file needs it

    return jsonschema.Draft202012Validator(orjson.loads(_schema_file().read_bytes()))


def _schema_file() -> Path:
    """Return the schema of the messages' package, of an installed wheel, or of the source tree."""
    for package, inside in (("mrlab_msgs", ""), ("mrlab_ros", "msg_schemas")):
        try:
            file = Path(get_package_share_directory(package), inside, "trajectory.schema.json")
        except PackageNotFoundError:
            continue
        if file.is_file():
            return file
    return Path(__file__).resolve().parents[3] / "msg_schemas" / "trajectory.schema.json"


def chunks(trajectory: Trajectory) -> Iterator[bytes | memoryview]:
    """Yield the trajectory file piece by piece, so that no whole copy of it is in memory."""
    yield orjson.dumps(trajectory_document.metadata(trajectory))[:-1] + b',"frames":{'
    columns = list(trajectory_document.frames(trajectory, 0, 2))
    for number, name in enumerate(columns):
        yield (b"," if number else b"") + b'"' + name.encode() + b'":'
        for begin in range(0, trajectory.frame_count, BLOCK):
            block = trajectory_document.frames(trajectory, begin, begin + BLOCK, (name,))[name]
            text = memoryview(orjson.dumps(block, option=NUMPY))
            yield b"," if begin else b"["
            yield text[1:-1]
        yield b"]"
    yield b"}}"


def check(document: Any, name: str) -> None:
    """Pass where `document` agrees with the schema; raise BadInput otherwise.

    The schema checks the metadata and the first two frames. `document.trajectory` checks all
    frames with numpy: jsonschema would take minutes for a million of them.
    """
    from jsonschema.exceptions import best_match

    sample = document
    if isinstance(document, dict) and isinstance(document.get("frames"), dict):
        head = {k: v[:2] if isinstance(v, list) else v for k, v in document["frames"].items()}
        sample = {**document, "frames": head}
    error = best_match(schema().iter_errors(sample))
    if error is not None:
        place = "/".join(str(p) for p in error.absolute_path)
        raise BadInput(NOT_AS_SCHEMA(file=name, place=place, error=f"{error.message:.200}"))


def parse(data: bytes, name: str) -> Trajectory:
    """Return the trajectory in the bytes of a file called `name`; raise BadInput."""
    try:
        document = orjson.loads(data)
    except orjson.JSONDecodeError as error:
        raise BadInput(NOT_JSON(file=name, error=str(error))) from None
    check(document, name)
    return trajectory_document.trajectory(document)


def write(trajectory: Trajectory, path: Path) -> None:
    """Write the trajectory file `path`, replacing it as a whole; an error leaves the old one."""
    with replaced(path) as file:
        file.writelines(chunks(trajectory))


Writer = Callable[[Trajectory, Path], Path]
DOWNSAMPLED = 1000  # blocks of a long line, a little more than its pixels
PNG_LEVEL = 1  # of compression: lines compress well at any, and 6 takes three times as long
ROUND_STEPS = (1, 2, 2.5, 5, 10)  # between the labels of an axis
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
    write(trajectory, path)
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
    import scipy.io  # a tenth of a second, which other formats do not need

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


# How the name of a file in each format ends.
ENDINGS = {name: ".mcap" if name == "jointtrajectory" else f".{name}" for name in WRITERS}


def path(name: str, trajectory_id: str, folder: Path) -> Path:
    """Return the file that the writer of the format `name` makes; raise BadInput as writer()."""
    writer(name)
    return folder / f"{trajectory_id}{ENDINGS[name]}"


def writer(name: str) -> Writer:
    """Return the writer of the format `name`; raise BadInput that lists the formats."""
    if name not in WRITERS:
        close = close_to(name, WRITERS)
        raise BadInput(NO_EXPORT_FORMAT(format=name, known=list(WRITERS), close=close))
    return WRITERS[name]


def plot(trajectory: Trajectory, robot: RobotModel, path: Path) -> None:
    """Draw angles and velocities against the limits, and the proxies, as PNG or SVG.

    A process reuses its figure for all plots, so this must run in one thread at a time.
    """
    t = times(trajectory)
    channels = trajectory.channels
    rows: list[tuple[str, Array, list[tuple[float, float]]]] = [
        (
            "angle, deg",
            np.degrees(_envelope(trajectory.positions)),
            [(np.degrees(j.lower), np.degrees(j.upper)) for j in robot.joints],
        ),
        (
            "velocity, deg/s",
            np.degrees(_envelope(channels.velocities)),
            [(-np.degrees(j.max_velocity), np.degrees(j.max_velocity)) for j in robot.joints],
        ),
        ("torque proxy, N*m nominal", _envelope(channels.effort_proxy), []),
    ]
    t = _envelope_places(t)
    figure, axes = _emptied(9, len(rows))
    for axis, (label, values, limits) in zip(axes, rows, strict=True):
        low, high = float(values.min()), float(values.max())
        near = 0.3 * (high - low + 1)
        for joint, name in enumerate(trajectory.joint_names):
            colour = JOINTS[joint % len(JOINTS)]
            axis.plot(t, values[:, joint], linewidth=1.2, label=name, color=colour)
            for limit in limits[joint] if limits else ():
                # a limit far from the motion would only squeeze the lines
                if low - near <= limit <= high + near:
                    axis.axhline(limit, color=colour, linestyle=":", linewidth=0.8)
        axis.set_ylabel(label)
    axes[-1].set_xlabel("time, s")
    axes[0].legend(loc="upper right", fontsize="small", ncols=3)
    named = f"{trajectory.source.variable} of {trajectory.source.file} on {robot.id}"
    figure.suptitle(visible(named))
    _save(figure, path)


def plot_refused(
    shown: Preview, findings: Sequence[Diagnostic], file: str, robot: RobotModel, path: Path
) -> None:
    """Draw the columns of a matrix that was not taken, and mark the rows that findings name.

    A process reuses its figure for all plots, so this must run in one thread at a time.
    """
    figure, (axis,) = _emptied(5, 1)
    for column in range(shown.values.shape[1]):
        axis.plot(
            shown.rows, shown.values[:, column], linewidth=1.2, label=f"column {column + 1}",
            color=JOINTS[column % len(JOINTS)],
        )  # fmt: skip
    marked = [d for d in findings if d.first_row and d.severity is Severity.ERROR]
    for found in marked[:MOST_MARKED]:
        axis.axvspan(
            found.first_row - 0.5, found.last_row + 0.5, color=SEVERITIES["error"], alpha=0.2
        )
        axis.axvline(found.first_row, color=SEVERITIES["error"], linestyle="--", linewidth=1.0)
        place = f"row {found.first_row}: {found.code}"
        axis.annotate(
            place, (found.first_row, 0.98), xycoords=("data", "axes fraction"),
            color=SEVERITIES["error"], fontsize="small", rotation=90, ha="right", va="top",
        )  # fmt: skip
    axis.set_xlabel("row")
    axis.set_ylabel("value as stored")
    axis.legend(loc="upper right", fontsize="small", ncols=3)
    named = f"{shown.variable} of {file}: not taken for {robot.id}"
    axis.set_title(visible(named), fontsize="medium")
    _save(figure, path)


def _envelope(values: Array) -> Array:
    """Return what a plot needs of columns: all rows, or least and greatest of each block.

    values: (N, J). A long series becomes (2 * blocks, J), so a peak of one frame stays visible.
    """
    if len(values) <= 2 * DOWNSAMPLED:
        return values
    starts = np.linspace(0, len(values), DOWNSAMPLED, endpoint=False, dtype=np.intp)
    least = np.minimum.reduceat(values, starts, axis=0)
    greatest = np.maximum.reduceat(values, starts, axis=0)
    return np.stack([least, greatest], axis=1).reshape(-1, values.shape[1])


def _envelope_places(t: Array) -> Array:
    """Return the times of the rows that `_envelope` returns; t: (N,)."""
    if len(t) <= 2 * DOWNSAMPLED:
        return t
    starts = np.linspace(0, len(t), DOWNSAMPLED, endpoint=False, dtype=np.intp)
    return np.repeat(t[starts], 2)


@cache
def _figure(height: float, rows: int) -> tuple[Any, tuple[Any, ...]]:
    """Return a figure 10 inches wide and its axes, one below the other.

    Making axes and ticks takes longer than drawing the lines, and computing a layout longer still:
    the figure is kept, and its margins are fixed.
    """
    from mrlab_ros.adapters.plotting import Figure, FigureCanvasAgg, MaxNLocator

    figure = Figure(figsize=(10, height))
    FigureCanvasAgg(figure)
    figure.subplots_adjust(0.08, 0.07 * 9 / height, 0.98, 1 - 0.06 * 9 / height, hspace=0.08)
    axes = tuple(figure.subplots(rows, 1, sharex=True, squeeze=False)[:, 0])
    for axis in axes:
        axis.grid(alpha=0.3)
        # the grid says where the labels belong; marks would double what is to be drawn
        axis.tick_params(length=0, bottom=False, left=False)
        axis.xaxis.set_major_locator(MaxNLocator(9, steps=ROUND_STEPS))
        axis.yaxis.set_major_locator(MaxNLocator(6, steps=ROUND_STEPS))
    return figure, axes


def _emptied(height: float, rows: int) -> tuple[Any, tuple[Any, ...]]:
    """Return the kept figure of this size with axes that fit what is drawn next."""
    figure, axes = _figure(height, rows)
    for axis in axes:
        for artist in [*axis.lines, *axis.patches, *axis.texts]:
            artist.remove()
        axis.relim()
        axis.autoscale(True)
    return figure, axes


def _save(figure: Any, path: Path) -> None:
    path.parent.mkdir(parents=True, exist_ok=True)
    options = {"pil_kwargs": {"compress_level": PNG_LEVEL}} if path.suffix == ".png" else {}
    figure.savefig(path, **options)
