"""A third set, designed after the code by other habits: what of it taught something.

Of the 264 files of the whole set the converter, as it was, accepted one wrong one in silence
(`q_rev`, turns) and refused three good ones; the classes behind these and behind what was
accepted with a warning too lightly are kept here.
"""

from __future__ import annotations

import io
from collections.abc import Iterator
from datetime import datetime, timedelta
from typing import Any

import matlab_objects as matlab
import numpy as np
from converter_corpus import (
    ACCEPT,
    KUKA,
    NOT_SILENT,
    REFUSE,
    File,
    mat,
    model,
    poses,
    rpy,
    velocity,
)
from numpy.typing import NDArray
from scipy.interpolate import CubicSpline

Array = NDArray[Any]
ROWS, RATE = 300, 125.0
T = np.arange(ROWS) / RATE
WRISTS = tuple(f"wrist_{i}_joint" for i in (1, 2, 3))
ROS_JOINTS = ("elbow_joint", "shoulder_lift_joint", "shoulder_pan_joint", *WRISTS)
ROS_ORDER = [2, 1, 0, 3, 4, 5]


def spline(seed: int, robot: str = "ur5e") -> Array:
    """Return a clamped cubic spline through six configurations near home."""
    chosen = np.random.default_rng(seed)
    joints = model(robot).joints
    low = np.array([max(j.lower, -2.0) + 0.05 for j in joints])
    high = np.array([min(j.upper, 2.0) - 0.05 for j in joints])
    points = np.clip(model(robot).home + chosen.uniform(-0.5, 0.5, (6, 6)), low, high)
    return CubicSpline(np.linspace(0, T[-1], 6), points, bc_type="clamped")(T)


Q = spline(11)
DQ = velocity(Q, RATE)
GRIPPER = (np.arange(ROWS) > 100) & (np.arange(ROWS) < 220)


def table(
    headings: list[str],
    rows: Any,
    *,
    separator: str = ",",
    decimal: str = ".",
    above: str = "",
    encoding: str = "utf-8",
) -> bytes:
    lines = [separator.join(headings)] if headings else []
    for row in rows:
        cells = [x if isinstance(x, str) else f"{x:.9f}".replace(".", decimal) for x in row]
        lines.append(separator.join(cells))
    return (above + "\n".join(lines) + "\n").encode(encoding)


def npz(**variables: Any) -> bytes:
    target = io.BytesIO()
    np.savez(target, **variables)
    return target.getvalue()


def good(name: str, data: bytes, suffix: str = ".mat", rate: float | None = None) -> File:
    return File(f"t_{name}", "ur5e", data, suffix, ACCEPT, rate, Q)


def wrong(name: str, data: bytes, suffix: str = ".mat", robot: str = "ur5e") -> File:
    return File(f"t_{name}", robot, data, suffix, REFUSE)


def asked(name: str, data: bytes, suffix: str = ".mat") -> File:
    return File(f"t_{name}", "ur5e", data, suffix, NOT_SILENT)


def tables() -> Iterator[File]:
    joints = [f"q{i}" for i in range(1, 7)]
    timed = np.column_stack([T, Q])
    german = {"separator": ";", "decimal": ","}
    degrees = [f"Gelenk {i} [°]" for i in range(1, 7)]
    in_degrees = np.column_stack([T, np.degrees(Q)])
    yield good("degrees_in_headings", table(["Zeit [s]", *degrees], in_degrees, **german), ".csv")
    above = "Versuch 7;;;;;;\n;;;;;;\n"
    headed = table(["t", *joints], timed, above=above, separator=";")
    yield good("title_in_first_cell", headed, ".csv", RATE)
    start = datetime(2024, 5, 3, 23, 59, 59)
    moments = [start + timedelta(seconds=float(t)) for t in T]
    split = [
        [m.strftime("%d.%m.%Y"), m.strftime("%H:%M:%S,%f")[:-3], *row]
        for m, row in zip(moments, Q, strict=True)
    ]
    yield good("day_and_time", table(["Datum", "Uhrzeit", *joints], split, **german), ".csv", RATE)
    iso = [
        [m.isoformat(timespec="milliseconds") + "Z", *r] for m, r in zip(moments, Q, strict=True)
    ]
    yield good("iso_dates", table(["time", *joints], iso), ".csv", RATE)
    yield good("stated_rate", table(joints, Q, above="# my log\n# fs: 125\n"), ".csv", RATE)
    utf16 = table(["t", *joints], timed, separator="\t", encoding="utf-16")
    yield good("utf16_tabs", utf16, ".csv", RATE)
    units = [["s", *["rad"] * 6], *timed]
    yield good("row_of_units", table(["t", *joints], units, separator=";"), ".csv", RATE)
    speeds = [["s", *["rad/s"] * 6], *np.column_stack([T, DQ])]
    yield wrong("row_of_units_of_speed", table(["t", *joints], speeds), ".csv")
    yield wrong("unit_of_speed_at_the_end", table([f"{j}_rad_s" for j in joints], DQ), ".csv")
    speed = [f"Gelenk {i} [°/s]" for i in range(1, 7)]
    yield wrong("speed_in_headings", table(speed, np.degrees(DQ), **german), ".csv")
    yield wrong("commas_twice", table(["t", *joints], timed, decimal=","), ".csv")
    ordered = Q[:, ROS_ORDER]
    named = [f"position.{j}" for j in ROS_JOINTS]
    stamps = [[f"{int(1.6e18 + t * 1e9)}", *r] for t, r in zip(T, ordered, strict=True)]
    yield good("ros_positions", table(["time", *named], stamps), ".csv", RATE)
    for quantity in ("velocity", "effort"):
        other = [f"{quantity}.{j}" for j in ROS_JOINTS]
        moved = [[row[0], *r] for row, r in zip(stamps, DQ[:, ROS_ORDER], strict=True)]
        yield wrong(f"ros_{quantity}", table(["time", *other], moved), ".csv")
    halves = [
        [f"{1_600_000_000 + i // 125}", f"{i % 125 * 8_000_000}", *row]
        for i, row in enumerate(ordered)
    ]
    yield good("ros_secs_nsecs", table(["secs", "nsecs", *ROS_JOINTS], halves), ".csv", RATE)
    currents = [f"actual_current_{i}" for i in range(6)]
    yield wrong("rtde_current", table(currents, 1.3 * Q), ".csv")
    points = np.column_stack([poses(Q)[:, :3, 3], rpy(Q)])
    pose = [f"actual_TCP_pose_{i}" for i in range(6)]
    yield wrong("rtde_pose", table(pose, points), ".csv")
    kuka = spline(12, KUKA)
    frame = np.column_stack(
        [poses(kuka, KUKA)[:, :3, 3] * 1000, np.degrees(rpy(kuka, KUKA)[:, 3:])]
    )
    yield wrong("kuka_frames", table(list("XYZABC"), frame, **german), ".csv", KUKA)


def workspaces() -> Iterator[File]:
    for name in (
        "vels",
        "qdot_meas",
        "velocidad",
        "Drehrate",
        "jointSpeed",
        "joint_velocity_rad_s",
    ):
        yield wrong(f"named_{name}", mat(**{name: DQ}))
    for name in ("z", "yout", "data"):
        yield asked(f"velocities_as_{name}", mat(**{name: DQ}))
    yield asked("velocities_as_actions", npz(actions=DQ / 3), ".npz")
    yield wrong("turns", mat(q_turns=Q / (2 * np.pi)))
    yield asked("turns_or_reversed", mat(q_rev=Q / (2 * np.pi)))
    yield asked("struct_of_velocities", mat(vel={"joint": DQ}))
    yield asked("tool_path_as_traj", mat(traj=np.column_stack([poses(Q)[:, :3, 3], rpy(Q)])))
    yield good("equal_copy", mat(q=Q, q_copy=Q.copy(), t=T), rate=RATE)
    yield good("other_rate", mat(q=Q, emg={"fs": 2000.0, "data": np.ones((900, 4))}), rate=100.0)
    yield good("times_rounded", mat(q=Q, t=np.round(T, 2)), rate=RATE)
    dates = np.column_stack([np.tile([2024, 2, 29, 23.0, 59], (ROWS, 1)), T])
    yield good("datevec", mat(q=Q, stamp=dates), rate=RATE)
    yield good("begin_and_end", mat(q=Q, tspan=np.array([0, T[-1]])), rate=RATE)
    yield good("minutes", mat(q=Q, t_min=T / 60), rate=RATE)
    # jtraj without times gives the velocity from row to row
    yield good("velocity_per_row", mat(q=Q, qd=np.gradient(Q, axis=0)), rate=100.0)
    yield good("velocity_per_row_and_time", mat(q=Q, qd=np.gradient(Q, axis=0), t=T), rate=RATE)
    degrees = {f"J{i + 1}": np.degrees(Q[:, [i]]) for i in range(6)}
    yield good("table_called_T", matlab.saved(T=matlab.table(degrees, ["deg"] * 6)))
    yield good("logical_gripper", mat(q=Q, closed=GRIPPER))
    yield wrong("states", mat(x=np.column_stack([Q, DQ]), t=T))
    yield wrong("time_among_states", mat(X=np.column_stack([T, Q, DQ])))
    yield asked("shuffled", mat(q=Q[np.random.default_rng(3).permutation(ROWS)]))


def build() -> list[File]:
    """Return the files of the third set; their names are unique."""
    files = [*tables(), *workspaces()]
    assert len({f.name for f in files}) == len(files)
    return files
