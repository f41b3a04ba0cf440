"""Files as MATLAB users make them, each with the truth about it.

`build` returns the first set, `held_out` one that was designed after the code and that the code
was first measured with; docs/converter.md has the figures.
"""

from __future__ import annotations

import io
from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np
import scipy.io

from mrlab_ros.adapters.robots.library import RobotLibrary
from mrlab_ros.core.base.diagnostic import Fix
from mrlab_ros.core.base.geometry import pose_from_transform
from mrlab_ros.core.conversion.options import Options
from mrlab_ros.core.robots.model import RobotModel

ROOT = Path(__file__).parents[3]
LIBRARY = RobotLibrary(ROOT / "robots")
ROBOTS = sorted(p.parent.name for p in (ROOT / "robots").glob("*/robot.yaml"))
KUKA = "kuka_kr6_r900_sixx"

ACCEPT, WARN, REFUSE, NOT_SILENT = "accept", "warn", "refuse", "not silent"
Array = Any


@dataclass(frozen=True)
class File:
    """One file and what a right converter does with it.

    truth: accept (with or without a warning), warn (accepted with a warning, or asked about),
    refuse (not accepted), or not silent (anything but accepted without a warning). rate: Hz that
    it must be played at where it is accepted without a warning, None: any. positions: rad.
    """

    name: str
    robot: str
    data: bytes
    suffix: str
    truth: str
    rate: float | None = None
    positions: Array = None


def mat(**variables: Any) -> bytes:
    target = io.BytesIO()
    scipy.io.savemat(target, variables, long_field_names=True)
    return target.getvalue()


def csv(headings: str, table: Array, separator: str = ",", decimal: str = ".") -> bytes:
    lines = [headings] if headings else []
    for row in np.asarray(table):
        cells = [f"{x:.9g}".replace(".", decimal) for x in row]
        lines.append(separator.join(cells))
    return ("\n".join(lines) + "\n").encode()


def model(robot: str) -> RobotModel:
    return LIBRARY.model(robot)


def column(values: Array) -> Array:
    return np.asarray(values, dtype=float).reshape(-1, 1)


def law(rows: int, kind: str = "quintic") -> Array:
    u = np.linspace(0, 1, rows)
    if kind == "quintic":
        return 10 * u**3 - 15 * u**4 + 6 * u**5
    if kind == "cubic":
        return 3 * u**2 - 2 * u**3
    if kind == "trapezoid":
        v = np.clip(np.minimum(u, 1 - u) / 0.25, 0, 1)
        return np.cumsum(v) / v.sum()
    if kind == "cosine":
        return (1 - np.cos(np.pi * u)) / 2
    return u


def move(robot: str = "ur5e", rows: int = 300, kind: str = "quintic", seed: int = 0) -> Array:
    """A motion from home to a place near it and on, inside the limits of the robot."""
    m = model(robot)
    rng = np.random.default_rng(seed)
    low, high = (np.array([getattr(j, n) for j in m.joints]) for n in ("lower", "upper"))
    fast = np.array([j.max_velocity for j in m.joints])
    reach = np.minimum(0.8, 0.2 * fast * rows / 100)
    ends = [m.home]
    for _ in range(2):
        step = rng.uniform(0.4, 1.0, len(low)) * reach * rng.choice([-1, 1], len(low))
        ends.append(np.clip(ends[-1] + step / 2, low + 0.05, high - 0.05))
    half = rows // 2
    s, r = law(half, kind)[:, None], law(rows - half, kind)[:, None]
    first = ends[0] + s * (ends[1] - ends[0])
    return np.vstack([first, ends[1] + r * (ends[2] - ends[1])])


def wave(rows: int = 400, rate: float = 100.0, robot: str = "ur5e") -> Array:
    t = np.arange(rows) / rate
    w = np.linspace(0.6, 1.4, 6)
    return model(robot).home + 0.25 * np.sin(t[:, None] * w + np.arange(6))


def velocity(q: Array, rate: float = 100.0) -> Array:
    return np.gradient(q, axis=0) * rate


def poses(q: Array, robot: str = "ur5e") -> Array:
    return model(robot).chain.tool0(q)


def rpy(q: Array, robot: str = "ur5e") -> Array:
    pose = poses(q, robot)
    turn = pose[:, :3, :3]
    angles = [
        np.arctan2(turn[:, 2, 1], turn[:, 2, 2]),
        -np.arcsin(np.clip(turn[:, 2, 0], -1, 1)),
        np.arctan2(turn[:, 1, 0], turn[:, 0, 0]),
    ]
    return np.column_stack([pose[:, :3, 3], *(np.unwrap(a) for a in angles)])


def quaternions(q: Array, robot: str = "ur5e") -> Array:
    pose = poses(q, robot)
    turns = np.array([pose_from_transform(t).orientation for t in pose])
    return np.column_stack([pose[:, :3, 3], turns])


def clock(rows: int, rate: float = 100.0) -> Array:
    return np.arange(rows) / rate


def gripper(rows: int) -> Array:
    return ((np.arange(rows) > rows // 3) & (np.arange(rows) < 2 * rows // 3)).astype(float)


Maker = Callable[[], Iterator[File]]


def good_names() -> Iterator[File]:
    names = [
        "q",
        "Q",
        "qTraj",
        "q_traj",
        "theta",
        "Theta",
        "thetas",
        "jointAngles",
        "joint_angles",
        "JointPositions",
        "q_des",
        "qd_ref",
        "q_actual",
        "Gelenkwinkel",
        "gelenkwinkel",
        "Achswinkel",
        "winkel",
        "jointPos",
        "q_sol",
        "qMatrix",
        "config_q",
        "joints",
        "angles",
        "qSim",
        "q_out",
        "jointTraj",
        "q_meas",
    ]
    for i, name in enumerate(names):
        q = move(seed=i, kind=("quintic", "cubic", "trapezoid", "cosine")[i % 4])
        truth = NOT_SILENT if name == "qd_ref" else ACCEPT
        yield File(f"named_{name}", "ur5e", mat(**{name: q, "fs": 50.0}), ".mat", truth, 50.0, q)


def every_robot() -> Iterator[File]:
    for i, robot in enumerate(ROBOTS):
        q = move(robot, 400, seed=i)
        yield File(f"robot_{robot}", robot, mat(q=q, fs=100.0), ".mat", ACCEPT, 100.0, q)
        held = np.column_stack([q, gripper(400)])
        yield File(f"gripper_{robot}", robot, mat(q=held, dt=0.01), ".mat", ACCEPT, 100.0, q)
        x = rpy(q, robot)
        yield File(
            f"company_{robot}", robot, mat(q=q, tcp=x, t=clock(400)), ".mat", ACCEPT, 100.0, q
        )


def neutral_names() -> Iterator[File]:
    for i, name in enumerate(
        [
            "A",
            "data",
            "Tabelle",
            "result",
            "out1",
            "simout",
            "values",
            "mydata",
            "ergebnis",
            "daten",
            "Y",
            "matrix",
        ]
    ):
        q = move(seed=20 + i)
        yield File(f"neutral_{name}", "ur5e", mat(**{name: q}), ".mat", WARN, None, q)


def foreign_names() -> Iterator[File]:
    q = move(seed=40)
    v, x = velocity(q), rpy(q)
    for name in [
        "qp",
        "qv",
        "omega",
        "thetad",
        "joint_speeds",
        "qdot",
        "dq",
        "speeds",
        "Gelenkgeschwindigkeiten",
    ]:
        yield File(f"velocity_{name}", "ur5e", mat(**{name: v}), ".mat", REFUSE)
    for name in ["qdd", "ddq", "beschleunigung", "accelerations"]:
        yield File(f"acceleration_{name}", "ur5e", mat(**{name: velocity(v)}), ".mat", REFUSE)
    for name in ["tau", "currents", "motor_current", "torques", "Drehmomente", "effort"]:
        yield File(f"torque_{name}", "ur5e", mat(**{name: v * 3 + 1}), ".mat", REFUSE)
    for name in ["errors", "q_error", "tracking_err", "Regelfehler"]:
        yield File(f"error_{name}", "ur5e", mat(**{name: v * 1e-3}), ".mat", REFUSE)
    for name in ["xyzrpy", "tcp_pose", "X", "pose", "ee_pose", "cart_path"]:
        yield File(f"poses_{name}", "ur5e", mat(**{name: x}), ".mat", REFUSE)
    for name in ["traj", "pos", "waypoints", "path", "trajectory", "positions"]:
        yield File(f"poses_{name}", "ur5e", mat(**{name: x}), ".mat", NOT_SILENT)
        yield File(f"joints_{name}", "ur5e", mat(**{name: q, "fs": 100.0}), ".mat", WARN, None, q)


def time_columns() -> Iterator[File]:
    q = move(seed=60, rows=301)
    t = clock(301)
    rng = np.random.default_rng(5)
    jitter = t + rng.uniform(-0.002, 0.002, 301)
    jitter[0] = 0
    still = q.copy()
    still[:, 5] = 0
    shapes = {
        "first": np.column_stack([t, q]),
        "last": np.column_stack([q, t]),
        "middle": np.column_stack([q[:, :3], t, q[:, 3:]]),
        "milliseconds": np.column_stack([t * 1000, q]),
        "jitter": np.column_stack([jitter, q]),
        "epoch": np.column_stack([1.7e9 + t, q]),
        "datenum": np.column_stack([738000 + t / 86400, q]),
        "linspace": np.column_stack([np.linspace(0, 5, 301), q]),
        "counter": np.column_stack([np.arange(1, 302), q]),
        "still_last": np.column_stack([t, still]),
        "offset": np.column_stack([t + 12.5, q]),
        "five_joints": np.column_stack([t, q[:, :5], np.zeros(301)]),
        "with_gripper": np.column_stack([t, q, gripper(301)]),
        "transposed": np.column_stack([t, q]).T,
    }
    for name, table in shapes.items():
        yield File(f"time_{name}", "ur5e", mat(q=table), ".mat", ACCEPT)
    for name in ("data", "log", "traj", "Messung"):
        yield File(f"time_{name}", "ur5e", mat(**{name: shapes["first"]}), ".mat", WARN, 100.0, q)
    five = np.column_stack([t, q[:, :5]])
    yield File("time_and_five", "ur5e", mat(q=five), ".mat", NOT_SILENT)
    both = mat(q=shapes["first"], t=t)
    yield File("time_and_vector", "ur5e", both, ".mat", ACCEPT, 100.0, q)


def wide() -> Iterator[File]:
    q = move(seed=70)
    v, t = velocity(q), clock(300)
    tables = {
        "q_qd": np.column_stack([q, v]),
        "q_qd_qdd": np.column_stack([q, v, velocity(v)]),
        "t_q_qd": np.column_stack([t, q, v]),
        "t_q_qd_qdd": np.column_stack([t, q, v, velocity(v)]),
        "q_tau": np.column_stack([q, v * 5]),
        "qd_q": np.column_stack([v, q]),
        "poses16": poses(q).reshape(300, 16),
    }
    for name, table in tables.items():
        yield File(f"wide_{name}", "ur5e", mat(q=table), ".mat", REFUSE)


def companies() -> Iterator[File]:
    for i, names in enumerate(
        [
            ("q", "qd", "qdd"),
            ("theta", "dtheta", "ddtheta"),
            ("a", "b", "c"),
            ("m1", "m2", "m3"),
            ("pos", "vel", "acc"),
            ("winkel", "geschw", "beschl"),
            ("q", "qp", "qpp"),
            ("out_1", "out_2", "out_3"),
            ("z9", "y9", "x9"),
        ]
    ):
        q = move(seed=80 + i)
        v = velocity(q)
        content = dict(zip(names, (q, v, velocity(v)), strict=True))
        truth = ACCEPT if names[0] in ("q", "theta", "winkel") else WARN
        yield File(
            f"derivatives_{names[0]}_{names[1]}", "ur5e", mat(**content), ".mat", truth, None, q
        )
    q = move(seed=90)
    x = rpy(q)
    yield File(
        "jtraj",
        "ur5e",
        mat(q=q, qd=velocity(q, 1), qdd=velocity(velocity(q, 1), 1)),
        ".mat",
        ACCEPT,
        None,
        q,
    )
    yield File("pair_named", "ur5e", mat(q=q, X=x), ".mat", ACCEPT, None, q)
    yield File("pair_unnamed", "ur5e", mat(one=x, two=q), ".mat", ACCEPT, None, q)
    yield File("pair_tool", "ur5e", mat(u1=q, tool=x[:, :3] * 1000), ".mat", ACCEPT, None, q)
    other = rpy(move(seed=91))
    yield File("pair_differs", "ur5e", mat(q=q, tcp_pose=other), ".mat", WARN, None, q)
    k = move(KUKA, seed=92)
    yield File("wrong_robot", "ur5e", mat(q=k, tcp_pose=rpy(k, KUKA)), ".mat", WARN, None, k)
    yield File(
        "only_velocities", "ur5e", mat(qd=velocity(q), qdd=velocity(velocity(q))), ".mat", REFUSE
    )
    yield File("two_motions", "ur5e", mat(q1=q, q2=move(seed=93)), ".mat", REFUSE)


def cartesian() -> Iterator[File]:
    q = move(seed=100)
    x, k = rpy(q), quaternions(q)
    mm = x * [1000, 1000, 1000, 1, 1, 1]
    yield File("cart_mm_rad", "ur5e", mat(q=mm), ".mat", REFUSE)
    yield File(
        "cart_mm_deg",
        "ur5e",
        mat(q=np.column_stack([mm[:, :3], np.degrees(x[:, 3:])])),
        ".mat",
        REFUSE,
    )
    yield File("cart_quaternion", "ur5e", mat(q=k), ".mat", REFUSE)
    yield File("cart_quaternion_data", "ur5e", mat(data=k), ".mat", REFUSE)
    yield File("cart_wxyz", "ur5e", mat(traj=k[:, [0, 1, 2, 6, 3, 4, 5]]), ".mat", REFUSE)
    a = np.linspace(0, 2 * np.pi, 300)
    circle = np.column_stack(
        [0.4 + 0.1 * np.cos(a), 0.1 * np.sin(a), 0 * a + 0.3, 0 * a + np.pi, 0 * a, 0 * a]
    )
    yield File("cart_circle", "ur5e", mat(traj=circle), ".mat", REFUSE)
    yield File("cart_circle_q", "ur5e", mat(q=circle), ".mat", NOT_SILENT)
    line = np.column_stack(
        [0.3 + 0.2 * law(200), 0 * law(200) + 0.1, 0.5 - 0.3 * law(200), *[np.zeros(200)] * 3]
    )
    yield File("cart_line", "ur5e", mat(waypoints=line), ".mat", REFUSE)
    yield File("cart_4x4", "ur5e", mat(T=np.moveaxis(poses(q), 0, 2)), ".mat", REFUSE)
    yield File(
        "cart_4x4_q", "ur5e", mat(T=np.moveaxis(poses(q), 0, 2), q=q), ".mat", ACCEPT, None, q
    )
    yield File("cart_xyz", "ur5e", mat(p=x[:, :3]), ".mat", REFUSE)


def units() -> Iterator[File]:
    for i, robot in enumerate(("ur5e", KUKA, "kuka_kr300_r2700_2")):
        q = move(robot, seed=110 + i)
        degrees = np.degrees(q)
        yield File(f"degrees_{robot}", robot, mat(q=degrees), ".mat", REFUSE)
        yield File(f"degrees_named_{robot}", robot, mat(q_deg=degrees), ".mat", ACCEPT, 0, q)
        yield File(f"centidegrees_{robot}", robot, mat(q=np.round(degrees * 100)), ".mat", REFUSE)
        yield File(f"millidegrees_{robot}", robot, mat(q=np.round(degrees * 1000)), ".mat", REFUSE)
        counts = np.round(q / (2 * np.pi) * 65536)
        yield File(f"counts_{robot}", robot, mat(enc=counts, q=counts), ".mat", REFUSE)
        yield File(f"transposed_{robot}", robot, mat(q=q.T), ".mat", ACCEPT, None, q)
    small = 4 * np.sin(np.linspace(0, 6, 300))[:, None] * np.linspace(0.2, 1, 6)
    yield File(
        "degrees_small_named",
        "ur5e",
        mat(theta_deg=small),
        ".mat",
        NOT_SILENT,
        0,
        np.radians(small),
    )


def rates() -> Iterator[File]:
    q = move(seed=120)
    t = clock(300, 50.0)
    vectors = {
        "t": t, "time": t, "tSamples": t, "trajTimes": t, "timestamps": t, "tspan": t, "Zeit": t,
        "zeitvektor": t, "tout": t, "tvec": t, "t_ms": t * 1e3, "time_us": t * 1e6,
        "timestamp_ns": t * 1e9, "epoch_time": t + 1.7e9, "tDatenum": 738123.5 + t / 86400,
        "Zeitstempel": t + 1.65e9,
    }  # fmt: skip
    for name, values in vectors.items():
        truth = ACCEPT
        yield File(
            f"rate_{name}", "ur5e", mat(q=q, **{name: column(values)}), ".mat", truth, 50.0, q
        )
    yield File("rate_row", "ur5e", mat(q=q, t=t.reshape(1, -1)), ".mat", ACCEPT, 50.0, q)
    yield File("rate_unnamed", "ur5e", mat(q=q, abc=column(t)), ".mat", WARN, 50.0, q)
    yield File("rate_ms_unnamed", "ur5e", mat(q=q, t=column(t * 1e3)), ".mat", WARN, 50.0, q)
    scalars = {"fs": 50.0, "Fs": 50.0, "sampleRate": 50.0, "Abtastrate": 50.0, "dt": 0.02,
               "Ts": 0.02, "Abtastzeit": 0.02, "sampleTime": 0.02, "frame_rate": 50.0}  # fmt: skip
    for name, value in scalars.items():
        yield File(f"rate_{name}", "ur5e", mat(q=q, **{name: value}), ".mat", ACCEPT, 50.0, q)
    for name, value in {
        "f": 2.0,
        "h": 0.3,
        "n": 300.0,
        "T": 3.0,
        "f0": 0.5,
        "freq": 0.25,
        "N": 50.0,
        "A0": 20.0,
        "rate": 3.0,
    }.items():
        yield File(f"no_rate_{name}", "ur5e", mat(q=q, **{name: value}), ".mat", ACCEPT, 100.0, q)
    yield File("conflict", "ur5e", mat(q=q, t=column(t), fs=100.0), ".mat", WARN, 50.0, q)
    yield File("sine_f", "ur5e", mat(q=q, t=column(t), f=2.0, A=0.3), ".mat", ACCEPT, 50.0, q)
    yield File(
        "agreeing", "ur5e", mat(q=q, t=column(t), dt=0.02, fs=50.0), ".mat", ACCEPT, 50.0, q
    )
    rng = np.random.default_rng(3)
    uneven = np.cumsum(rng.uniform(0.01, 0.03, 300))
    yield File("uneven", "ur5e", mat(q=q, t=column(uneven)), ".mat", WARN, None, q)
    gap = t.copy()
    gap[150:] += 1
    yield File("gap", "ur5e", mat(q=q, t=column(gap)), ".mat", WARN, None, q)
    twice = t.copy()
    twice[100] = twice[99]
    yield File("repeated", "ur5e", mat(q=q, t=column(twice)), ".mat", WARN, None, q)
    back = t.copy()
    back[200:] -= 0.5
    yield File("backward", "ur5e", mat(q=q, t=column(back)), ".mat", WARN, None, q)
    yield File("velocity_says", "ur5e", mat(q=q, qd=velocity(q, 250.0)), ".mat", WARN, 250.0, q)
    s = np.linspace(0, 1, 300)
    yield File("path_parameter", "ur5e", mat(q=q, s=column(s)), ".mat", ACCEPT, 100.0, q)


def simulink() -> Iterator[File]:
    q = wave(rows=501)
    t = column(clock(501))
    for name in ("q", "q_actual", "jointAngles", "Gelenkwinkel"):
        log = {
            "time": t,
            "signals": {"values": q, "dimensions": 6.0, "label": ""},
            "blockName": "m/To",
        }
        yield File(f"structure_{name}", "ur5e", mat(**{name: log}), ".mat", ACCEPT, 100.0, q)
    log = {"time": t, "signals": {"values": velocity(q), "dimensions": 6.0, "label": ""}}
    yield File("structure_velocity", "ur5e", mat(qd_target=log), ".mat", REFUSE)
    yield File("tout_yout", "ur5e", mat(tout=t, yout=q), ".mat", WARN, 100.0, q)
    out = {"tout": t, "q": q}
    yield File("out", "ur5e", mat(out=out), ".mat", ACCEPT, 100.0, q)
    table = mat(simout=np.column_stack([t, q]))
    yield File("array_with_time", "ur5e", table, ".mat", WARN, 100.0, q)
    scope = np.zeros(6, dtype=[("values", object), ("label", object)])
    for i in range(6):
        scope[i] = (column(q[:, i]), f"q{i}")
    yield File("scope", "ur5e", mat(ScopeData={"time": t, "signals": scope}), ".mat", REFUSE)


def more_dimensions() -> Iterator[File]:
    q = wave(rows=501)
    t = column(clock(501))
    stacked = q.T.reshape(6, 1, 501)
    yield File("six_by_one", "ur5e", mat(q=stacked, t=t), ".mat", ACCEPT, 100.0, q)
    yield File("one_by_six", "ur5e", mat(q=q.T[None], t=t), ".mat", ACCEPT, 100.0, q)
    yield File("rows_first", "ur5e", mat(q=q[:, None, :], t=t), ".mat", ACCEPT, 100.0, q)
    yield File("x_six_by_one", "ur5e", mat(tau=stacked, t=t), ".mat", REFUSE)
    logged = {"time": t, "signals": {"values": stacked, "dimensions": [6.0, 1.0], "label": "q"}}
    yield File("structure_3d", "ur5e", mat(q=logged), ".mat", ACCEPT, 100.0, q)
    held = np.column_stack([q, gripper(501)])
    yield File("seven_by_one", "ur5e", mat(q=held.T[:, None], t=t), ".mat", ACCEPT, 100.0, q)
    timed = np.column_stack([t, q]).T[:, None]
    yield File("time_3d", "ur5e", mat(q=timed), ".mat", ACCEPT, 100.0, q)
    for robot in ("ur5e", KUKA):
        own = wave(rows=300, robot=robot)
        pages = np.moveaxis(poses(own, robot), 0, 2)
        yield File(f"transforms_{robot}", robot, mat(T=pages), ".mat", REFUSE)
        beside = mat(T=pages, q=own, fs=100.0)
        yield File(f"q_and_transforms_{robot}", robot, beside, ".mat", ACCEPT, 100.0, own)
        foreign = mat(T=pages[..., ::-1], q=own, fs=100.0)
        yield File(f"q_and_other_transforms_{robot}", robot, foreign, ".mat", WARN, None, own)
    trials = np.stack([q, q + 0.01, q - 0.01], axis=2)
    yield File("trials_rows", "ur5e", mat(q=trials), ".mat", REFUSE)
    yield File("trials_columns", "ur5e", mat(q=trials.transpose(1, 0, 2)), ".mat", REFUSE)
    yield File("picture", "ur5e", mat(q=q, t=t, img=np.ones((9, 8, 3))), ".mat", ACCEPT, 100.0, q)


def rtde() -> Iterator[File]:
    q = wave(rows=625, rate=125.0)
    stamp = 8123.4 + clock(625, 125.0)
    log = {
        "timestamp": column(stamp), "actual_q": q, "actual_qd": velocity(q, 125),
        "actual_TCP_pose": rpy(q), "actual_current": velocity(q, 125) * 2 + 0.3,
    }  # fmt: skip
    yield File("rtde", "ur5e", mat(**log), ".mat", ACCEPT, 125.0, q)
    yield File("rtde_struct", "ur5e", mat(rtde=log), ".mat", ACCEPT, 125.0, q)
    yield File("rtde_both", "ur5e", mat(target_q=q + 1e-3, **log), ".mat", ACCEPT)
    names = ["timestamp"] + [
        f"{n}_{i}" for n in ("actual_q", "actual_qd", "actual_TCP_pose") for i in range(6)
    ]
    table = np.column_stack([stamp, q, velocity(q, 125), rpy(q)])
    yield File("rtde_csv", "ur5e", csv(",".join(names), table), ".csv", ACCEPT, 125.0, q)
    yield File(
        "rtde_csv_blanks", "ur5e", csv(" ".join(names), table, " "), ".csv", ACCEPT, 125.0, q
    )
    only = ",".join(f"actual_qd_{i}" for i in range(6))
    yield File("rtde_csv_qd", "ur5e", csv(only, velocity(q, 125)), ".csv", REFUSE)


def tables() -> Iterator[File]:
    q = move(seed=140)
    t = clock(300, 50)
    k = move(KUKA, seed=141)
    yield File("csv_q", "ur5e", csv("q1,q2,q3,q4,q5,q6", q), ".csv", ACCEPT, None, q)
    yield File(
        "csv_t_q",
        "ur5e",
        csv("t,q1,q2,q3,q4,q5,q6", np.column_stack([t, q])),
        ".csv",
        ACCEPT,
        50.0,
        q,
    )
    yield File(
        "csv_german",
        "ur5e",
        csv("Zeit;q1;q2;q3;q4;q5;q6", np.column_stack([t, q]), ";", ","),
        ".csv",
        ACCEPT,
        50.0,
        q,
    )
    yield File("csv_A1", KUKA, csv("A1,A2,A3,A4,A5,A6", k), ".csv", ACCEPT, None, k)
    yield File(
        "csv_A1_deg",
        KUKA,
        csv("A1 [deg],A2 [deg],A3 [deg],A4 [deg],A5 [deg],A6 [deg]", np.degrees(k)),
        ".csv",
        ACCEPT,
        None,
        k,
    )
    yield File(
        "csv_joint",
        "ur5e",
        csv(
            "joint_1,joint_2,joint_3,joint_4,joint_5,joint_6,gripper",
            np.column_stack([q, gripper(300)]),
        ),
        ".csv",
        ACCEPT,
        None,
        q,
    )
    names = model("ur5e").joint_names
    yield File("csv_names", "ur5e", csv(",".join(names), q), ".csv", ACCEPT, None, q)
    yield File(
        "csv_names_swapped",
        "ur5e",
        csv(",".join(reversed(names)), q[:, ::-1]),
        ".csv",
        ACCEPT,
        None,
        q,
    )
    yield File("csv_pose", "ur5e", csv("x,y,z,roll,pitch,yaw", rpy(q)), ".csv", REFUSE)
    yield File("csv_quaternion", "ur5e", csv("x,y,z,qx,qy,qz,qw", quaternions(q)), ".csv", REFUSE)
    yield File("csv_dq", "ur5e", csv("dq1,dq2,dq3,dq4,dq5,dq6", velocity(q)), ".csv", REFUSE)
    yield File("csv_bare", "ur5e", csv("", q), ".csv", WARN, None, q)
    yield File("csv_bare_time", "ur5e", csv("", np.column_stack([t, q])), ".csv", WARN)
    yield File(
        "csv_tau", "ur5e", csv("tau1,tau2,tau3,tau4,tau5,tau6", velocity(q)), ".csv", REFUSE
    )
    ros = ["time"] + [f"{n}_{i}" for n in ("position", "velocity", "effort") for i in range(6)]
    stamps = 1.7e9 + t
    table = np.column_stack([t, q, velocity(q, 50), velocity(q, 50) * 9])
    yield File("csv_ros", "ur5e", csv(",".join(ros), table), ".csv", ACCEPT, 50.0, q)
    rostopic = ["%time"] + [f"field.{n}{i}" for n in ("position", "velocity") for i in range(6)]
    yield File(
        "csv_rostopic",
        "ur5e",
        csv(",".join(rostopic), np.column_stack([np.round(stamps * 1e9), q, velocity(q, 50)])),
        ".csv",
        ACCEPT,
        None,
        q,
    )


def pieces() -> Iterator[File]:
    q = move(seed=150)
    for name, apart in {
        "q": {f"q{i + 1}": column(q[:, i]) for i in range(6)},
        "theta": {f"theta{i + 1}": q[:, i] for i in range(6)},
        "struct": {"log": {f"j{i + 1}": column(q[:, i]) for i in range(6)}},
    }.items():
        yield File(f"split_{name}", "ur5e", mat(**apart), ".mat", ACCEPT, None, q)
    cells = np.empty(3, dtype=object)
    for i in range(3):
        cells[i] = q[100 * i : 100 * (i + 1)]
    yield File("segments", "ur5e", mat(seg=cells), ".mat", REFUSE)
    samples = np.empty(30, dtype=object)
    for i in range(30):
        samples[i] = q[10 * i].reshape(1, 6)
    yield File("samples", "ur5e", mat(c=samples), ".mat", REFUSE)


def flaws() -> Iterator[File]:
    q = move(seed=160)
    zeros = np.vstack([q, np.zeros((50, 6))])
    yield File("unfilled", "ur5e", mat(q=zeros), ".mat", REFUSE)
    yield File("all_zeros", "ur5e", mat(q=np.zeros((300, 6))), ".mat", REFUSE)
    nan = np.vstack([q, np.full((20, 6), np.nan)])
    yield File("unfilled_nan", "ur5e", mat(q=nan), ".mat", REFUSE)
    jump = q.copy()
    jump[150:] += 0.9
    yield File("jump", "ur5e", mat(q=jump), ".mat", REFUSE)
    turn = q.copy()
    turn[150:, 0] -= 2 * np.pi
    yield File("turn", "ur5e", mat(q=turn), ".mat", REFUSE)
    far = q.copy()
    far[:, 2] += 3 * law(300)
    yield File("limit", "ur5e", mat(q=far), ".mat", REFUSE)
    yield File("complex", "ur5e", mat(q=q + 1e-3j), ".mat", REFUSE)
    yield File("int16", "ur5e", mat(q=np.round(q * 10).astype(np.int16)), ".mat", REFUSE)
    yield File("one_row", "ur5e", mat(q=q[:1]), ".mat", REFUSE)
    yield File("five_columns", "ur5e", mat(q=q[:, :5]), ".mat", REFUSE)
    one = np.tile(model("ur5e").home, (300, 1))
    one[:, 0] = np.linspace(0, np.pi / 2, 300)
    yield File("one_joint", "ur5e", mat(q=one, fs=100.0), ".mat", ACCEPT, 100.0, one)
    still = q.copy()
    still[:, 3] = q[0, 3]
    yield File("one_still", "ur5e", mat(q=still), ".mat", ACCEPT, None, still)
    ramps = np.linspace(0, 1, 300)[:, None] * np.linspace(0.3, 1, 6) + model("ur5e").home
    yield File("ramps", "ur5e", mat(q=ramps), ".mat", ACCEPT, None, ramps)
    yield File("holds", "ur5e", mat(q=np.tile(q[0], (300, 1))), ".mat", NOT_SILENT)
    home = np.vstack(
        [law(150)[:, None] * q[-1], (1 - law(150))[:, None] * q[-1], np.zeros((30, 6))]
    )
    yield File("ends_at_zero", "ur5e", mat(q=home), ".mat", ACCEPT, None, home)


def grippers() -> Iterator[File]:
    q = move(seed=170)
    g = gripper(300)
    ramp = np.interp(np.arange(300), [100, 160, 200, 250], [0, 1, 1, 0])
    yield File("gripper_01", "ur5e", mat(q=np.column_stack([q, g])), ".mat", ACCEPT, None, q)
    yield File("gripper_255", "ur5e", mat(q=np.column_stack([q, 255 * g])), ".mat", WARN, None, q)
    yield File(
        "gripper_255_ramp",
        "ur5e",
        mat(q=np.column_stack([q, np.round(255 * ramp)])),
        ".mat",
        WARN,
        None,
        q,
    )
    yield File(
        "gripper_width",
        "ur5e",
        mat(q=np.column_stack([q, 0.085 * (1 - g)])),
        ".mat",
        WARN,
        None,
        q,
    )
    yield File(
        "gripper_percent", "ur5e", mat(q=np.column_stack([q, 100 * ramp])), ".mat", WARN, None, q
    )
    yield File("gripper_beside", "ur5e", mat(q=q, gripper=column(g)), ".mat", ACCEPT, None, q)
    yield File("gripper_Greifer", "ur5e", mat(q=q, Greifer=column(g)), ".mat", ACCEPT, None, q)
    seven = np.column_stack([q, 0.4 * np.sin(np.arange(300) / 40)])
    yield File("seven_axes", "ur5e", mat(q=seven), ".mat", REFUSE)


def clocks_and_rates_of_many_kinds() -> Iterator[File]:
    q, n = wave(rate=500.0), 400
    t = clock(n, 500.0)
    right = {
        "fs_int32": {"fs": np.int32(500)},
        "fs_uint16": {"fs": np.uint16(500)},
        "info_fs_uint16": {"info": {"fs": np.uint16(500)}},
        "dt_ms_int32": {"dt_ms": np.int32(2)},
        "time_us_uint64": {"time_us": np.rint(t * 1e6).astype(np.uint64)[:, None]},
        "stamp_uint64": {
            "stamp": np.rint(t * 1e9).astype(np.uint64)[:, None] + 1700000000 * 10**9
        },
        "fs_text": {"fs": "500 Hz"},
        "fs_kHz": {"fs_kHz": 0.5},
    }
    for name, more in right.items():
        yield File(f"kind_{name}", "ur5e", mat(q=q, **more), ".mat", ACCEPT, 500.0, q)
    flawed = t.copy()
    flawed[100] = np.nan
    doubtful = {
        "t_nan": {"t": column(flawed)},
        "t_descending": {"t": column(t[::-1])},
        "t_constant": {"t": column(0 * t)},
        "t_denormal": {"t": column(np.linspace(0, 1e-320, n))},
        "t_pairs": {"t": np.column_stack([t, t])},
        "dt_steps": {"dt": column(np.diff(t))},
        "tspan": {"tspan": np.array([[0, t[-1]]])},
        "fs_nan": {"fs": np.nan},
        "fs_zero": {"fs": 0.0},
        "fs_negative": {"fs": -500.0},
        "fs_complex": {"fs": 500 + 1j},
        "fs_logical": {"fs": True},
        "emg": {"emg": {"fs": 2000.0, "data": np.zeros((6000, 2))}},
        "controller": {"controller": {"Ts": 1e-4, "Kp": 3.0}},
        "cam": {"cam": {"t": column(np.linspace(0, 10, n))}},
    }
    for name, more in doubtful.items():
        yield File(f"flaw_{name}", "ur5e", mat(q=q, **more), ".mat", NOT_SILENT, None, q)
    ends = model("ur5e").home + np.array([[0], [0.6], [0.2], [0.6], [0]])
    way = mat(q=ends, t=column([0, 2, 4, 6, 8]))
    yield File("waypoints", "ur5e", way, ".mat", NOT_SILENT, None, ends)
    held = np.column_stack([q, np.ones(n)])
    yield File("gripper_one", "ur5e", mat(q=held, fs=500.0), ".mat", NOT_SILENT, None, q)


MAKERS: tuple[Maker, ...] = (
    good_names, every_robot, neutral_names, foreign_names, time_columns, wide, companies,
    cartesian, units, rates, simulink, more_dimensions, rtde, tables, pieces, flaws, grippers,
    clocks_and_rates_of_many_kinds,
)  # fmt: skip


def build() -> list[File]:
    """Return the files of the first set; their names are unique."""
    files = [f for maker in MAKERS for f in maker()]
    assert len({f.name for f in files}) == len(files)
    return files


def held_names() -> Iterator[File]:
    for i, name in enumerate(
        [
            "qm",
            "qStar",
            "joint_states_position",
            "jnt_angles",
            "q_vec",
            "Stellungen",
            "Achswerte",
            "qList",
            "armJoints",
            "joint_values",
            "robotJoints",
            "axisAngles",
            "thetaTraj",
            "qPlan",
            "q_smooth",
            "Gelenkstellungen",
        ]
    ):
        q = move(seed=300 + i, rows=240, kind=("cosine", "cubic", "quintic")[i % 3])
        known = name != "qm"
        yield File(
            f"h_good_{name}",
            "ur5e",
            mat(**{name: q, "Ts": 0.008}),
            ".mat",
            ACCEPT if known else WARN,
            125.0 if known else None,
            q,
        )
    v = velocity(move(seed=320))
    for name in [
        "qDot_log",
        "jointVel",
        "w_joints",
        "rpm",
        "Drehzahlen",
        "angularVelocity",
        "vel_q",
        "velocityProfile",
    ]:
        yield File(f"h_vel_{name}", "ur5e", mat(**{name: v}), ".mat", REFUSE)
    for name in [
        "Motorstroeme",
        "tauMeas",
        "jointTorque",
        "ext_wrench",
        "gravityTorques",
        "i_meas",
        "amps",
    ]:
        yield File(f"h_tau_{name}", "ur5e", mat(**{name: v * 4}), ".mat", REFUSE)
    x = rpy(move(seed=321))
    for name in [
        "toolPose",
        "flangePath",
        "Xd",
        "TCP",
        "x_des",
        "EE_traj",
        "cartesianPath",
        "kartPos",
    ]:
        yield File(f"h_pose_{name}", "ur5e", mat(**{name: x}), ".mat", NOT_SILENT)
    for name in ["punkte", "route", "bewegung", "refTraj", "plan", "profile", "S", "B"]:
        yield File(f"h_poses_{name}", "ur5e", mat(**{name: x}), ".mat", NOT_SILENT)
    for name in ["temps", "track_error", "residuals", "Abweichung", "delta_q"]:
        yield File(f"h_err_{name}", "ur5e", mat(**{name: v * 0.01}), ".mat", REFUSE)


def held_times() -> Iterator[File]:
    q = move(seed=330, rows=451, kind="trapezoid")
    rng = np.random.default_rng(8)
    for name, t in {
        "rate60": np.arange(451) / 60,
        "rate30_round": np.round(np.arange(451) / 30, 3),
        "ms4": np.arange(451) * 4.0,
        "us": np.arange(451) * 8000.0,
        "jitter10": np.cumsum(rng.normal(0.01, 0.001, 451)),
        "late": 3.02 + np.arange(451) * 0.02,
        "T7": np.linspace(0, 7, 451),
    }.items():
        first, last = np.column_stack([t, q]), np.column_stack([q, t])
        yield File(f"h_col_{name}", "ur5e", mat(run=first), ".mat", WARN, None, q)
        yield File(f"h_col_last_{name}", "ur5e", mat(q=last), ".mat", ACCEPT, None, q)
        yield File(f"h_row_{name}", "ur5e", mat(q=first.T), ".mat", ACCEPT, None, q)
    flat = q.copy()
    flat[:, 5] = 0.3
    yield File(
        "h_col_still",
        "ur5e",
        mat(q=np.column_stack([np.arange(451) * 0.005, flat])),
        ".mat",
        ACCEPT,
    )
    t = np.arange(451) * 0.01
    for name in ["log", "Messdaten", "recorded"]:
        yield File(
            f"h_wide_{name}",
            "ur5e",
            mat(**{name: np.column_stack([t, q, velocity(q), np.zeros((451, 3))])}),
            ".mat",
            REFUSE,
        )


def held_rates() -> Iterator[File]:
    q = move(seed=340, rows=500)
    t = np.arange(500) / 40
    for name, values in {
        "tGrid": t, "t_s": t, "time_vec": t, "Zeitpunkte": t, "tTraj": t, "sampleTimes": t,
        "zeit_ms": t * 1e3, "stamp_us": t * 1e6, "rostime": t + 1.69e9, "t_end_vec": t,
    }.items():  # fmt: skip
        yield File(
            f"h_rate_{name}", "ur5e", mat(q=q, **{name: column(values)}), ".mat", ACCEPT, 40.0, q
        )
    for name, value in {
        "samplingRate": 40.0,
        "abtastfrequenz": 40.0,
        "dT": 0.025,
        "t_s": 0.025,
        "Fsample": 40.0,
        "delta_t": 0.025,
        "dt_ms": 25.0,
        "Tsample": 0.025,
        "control_rate": 40.0,
    }.items():
        yield File(f"h_scalar_{name}", "ur5e", mat(q=q, **{name: value}), ".mat", ACCEPT, 40.0, q)
    for name, value in {
        "f": 1.0,
        "h": 0.15,
        "K": 500.0,
        "T": 4.0,
        "m": 100.0,
        "w": 2.0,
        "freq": 0.5,
        "n_samples": 500.0,
        "tau": 0.5,
        "step": 1.0,
    }.items():
        yield File(f"h_norate_{name}", "ur5e", mat(q=q, **{name: value}), ".mat", ACCEPT, 100.0, q)
    yield File("h_conflict", "ur5e", mat(q=q, time=column(t), Ts=0.001), ".mat", WARN, 40.0, q)
    drop = np.delete(t, slice(200, 230))
    yield File(
        "h_dropped",
        "ur5e",
        mat(q=np.delete(q, slice(200, 230), axis=0), t=column(drop)),
        ".mat",
        NOT_SILENT,
    )
    adaptive = np.sort(np.random.default_rng(2).uniform(0, 5, 500))
    yield File("h_adaptive", "ur5e", mat(q=q, tout=column(adaptive)), ".mat", WARN, None, q)
    yield File("h_unnamed_vector", "ur5e", mat(q=q, vv=column(t)), ".mat", WARN, 40.0, q)


def held_company() -> Iterator[File]:
    for i, (a, b) in enumerate(
        [("P", "V"), ("first", "second"), ("lage", "tempo"), ("d1", "d2"), ("ang", "angp")]
    ):
        q = wave(rows=350 + i)
        yield File(f"h_pair_{a}", "ur5e", mat(**{a: q, b: velocity(q)}), ".mat", WARN, None, q)
        yield File(
            f"h_diff_{a}",
            "ur5e",
            mat(**{a: q, b: np.diff(q, axis=0) * 100}),
            ".mat",
            WARN,
            None,
            q,
        )
    k = move("kuka_kr16_r1610_2", seed=350)
    yield File(
        "h_tool_kuka",
        "kuka_kr16_r1610_2",
        mat(winkel=k, bahn=rpy(k, "kuka_kr16_r1610_2")[:, :3]),
        ".mat",
        ACCEPT,
        None,
        k,
    )
    yield File(
        "h_wrong_kuka",
        "kuka_kr3_r540",
        mat(q=move("kuka_kr3_r540", seed=351), tcp=rpy(k, "kuka_kr16_r1610_2")),
        ".mat",
        WARN,
    )
    yield File(
        "h_q_and_quat",
        "ur5e",
        mat(traj=move(seed=352), pose=quaternions(move(seed=352))),
        ".mat",
        ACCEPT,
    )
    yield File("h_measured", "ur5e", mat(q_ist=wave(), q_soll=wave() + 0.002), ".mat", ACCEPT)


def held_tables() -> Iterator[File]:
    q = move(seed=360)
    t = clock(300, 20)
    k = move(KUKA, seed=361)
    yield File("h_csv_J", "ur5e", csv("J1,J2,J3,J4,J5,J6", q), ".csv", ACCEPT, None, q)
    yield File(
        "h_csv_zeit",
        "ur5e",
        csv(
            "Zeit [s];Achse1;Achse2;Achse3;Achse4;Achse5;Achse6", np.column_stack([t, q]), ";", ","
        ),
        ".csv",
        ACCEPT,
        20.0,
        q,
    )
    yield File("h_csv_xyzabc", KUKA, csv("X,Y,Z,A,B,C", rpy(k, KUKA)), ".csv", REFUSE)
    yield File(
        "h_csv_vel", "ur5e", csv("vel1,vel2,vel3,vel4,vel5,vel6", velocity(q)), ".csv", REFUSE
    )
    yield File(
        "h_csv_brackets",
        "ur5e",
        csv(
            "time,position[0],position[1],position[2],position[3],position[4],position[5],velocity[0],velocity[1],velocity[2],velocity[3],velocity[4],velocity[5]",
            np.column_stack([t, q, velocity(q, 20)]),
        ),
        ".csv",
        ACCEPT,
        20.0,
        q,
    )
    yield File(
        "h_csv_target",
        "ur5e",
        csv("timestamp," + ",".join(f"target_q_{i}" for i in range(6)), np.column_stack([t, q])),
        ".csv",
        ACCEPT,
        20.0,
        q,
    )
    yield File(
        "h_csv_deg",
        "ur5e",
        csv(",".join(f"theta{i} (deg)" for i in range(1, 7)), np.degrees(q)),
        ".csv",
        ACCEPT,
        None,
        q,
    )
    yield File(
        "h_csv_gripper",
        "ur5e",
        csv(
            ",".join([f"q{i}" for i in range(1, 7)] + ["gripper"]),
            np.column_stack([q, gripper(300)]),
        ),
        ".csv",
        ACCEPT,
        None,
        q,
    )
    yield File("h_csv_letters", "ur5e", csv("a,b,c,d,e,f", q), ".csv", WARN, None, q)


def held_values() -> Iterator[File]:
    for i, robot in enumerate(ROBOTS):
        q = move(robot, seed=380 + i)
        yield File(f"h_deg_{robot}", robot, mat(Winkel=np.degrees(q)), ".mat", REFUSE)
        yield File(
            f"h_prealloc_{robot}", robot, mat(q=np.vstack([q, np.zeros((120, 6))])), ".mat", REFUSE
        )
    q = move(seed=395)
    yield File("h_counts20", "ur5e", mat(q=np.round(q / (2 * np.pi) * 2**20)), ".mat", REFUSE)
    yield File("h_counts4096", "ur5e", mat(theta=np.round(q / (2 * np.pi) * 4096)), ".mat", REFUSE)
    yield File(
        "h_mm",
        KUKA,
        mat(q=rpy(move(KUKA, seed=396), KUKA) * [1e3, 1e3, 1e3, 1, 1, 1]),
        ".mat",
        REFUSE,
    )
    u = law(300)[:, None]
    corner = np.array([[0.3, -0.2, 0.4, np.pi, 0, 0], [0.5, 0.25, 0.2, np.pi, 0, 0]])
    yield File(
        "h_square", "ur5e", mat(waypoints=corner[0] + u * (corner[1] - corner[0])), ".mat", REFUSE
    )
    yield File(
        "h_rand", "ur5e", mat(A=np.random.default_rng(1).uniform(-1, 1, (200, 6))), ".mat", REFUSE
    )
    single = np.tile(model("ur5e").home, (200, 1))
    single[:, 2] += 0.01 * np.arange(200)
    single = np.clip(single, -3.1, 3.1)
    yield File("h_one_joint", "ur5e", mat(q=single), ".mat", ACCEPT, None, single)
    yield File(
        "h_split_zero",
        "ur5e",
        mat(**{f"joint{i}": column(q[:, i]) for i in range(6)}),
        ".mat",
        ACCEPT,
        None,
        q,
    )
    yield File(
        "h_gripper_width_mm",
        "ur5e",
        mat(q=np.column_stack([q, 85 * gripper(300)])),
        ".mat",
        WARN,
        None,
        q,
    )
    slow = np.interp(np.arange(300), [50, 200], [0, 0.08])
    yield File("h_gripper_slow", "ur5e", mat(q=np.column_stack([q, slow])), ".mat", WARN, None, q)


HELD_OUT: tuple[Maker, ...] = (
    held_names, held_times, held_rates, held_company, held_tables, held_values,
)  # fmt: skip


def held_out() -> list[File]:
    """Return the files of the second set; their names are unique."""
    files = [f for maker in HELD_OUT for f in maker()]
    assert len({f.name for f in files}) == len(files)
    return files


def applied(options: Options, fix: Fix) -> Options:
    """Return the options with a fix, as a button sets it from its text."""
    now = getattr(options, fix.option)
    value = fix.value == "true" if isinstance(now, bool) else type(now)(fix.value or 0)
    return replace(options, **{fix.option: fix.value if isinstance(now, str) else value})
