"""Files that mean what they say and files that mislead, in several languages.

Each case names what a right converter does: honest ones are accepted as the motion that they hold;
misleading ones are never accepted in silence, unless the motion is the right one.
"""

from __future__ import annotations

import io
import json
from collections.abc import Iterator
from dataclasses import dataclass, field
from typing import Any

import h5py
import numpy as np
from converter_corpus import KUKA, csv, gripper, mat, model, move, velocity

HONEST, MISLEADING = "honest", "misleading"
Array = Any


@dataclass(frozen=True)
class Case:
    """A file. q: rad, the motion that it holds, None where it holds none; rate: Hz, 0: any.

    about: words of which one is in the warnings that go with another motion or rate.
    """

    name: str
    data: bytes
    kind: str
    q: Array = None
    rate: float = 0.0
    robot: str = "ur5e"
    suffix: str = ".mat"
    about: tuple[str, ...] = field(default=())


def hdf5(attributes: dict[str, dict[str, Any]], **variables: Any) -> bytes:
    target = io.BytesIO()
    with h5py.File(target, "w", userblock_size=512) as file:
        for name, values in variables.items():
            made = file.create_dataset(name, data=np.asarray(values, dtype=float).T)
            made.attrs["MATLAB_class"] = np.bytes_("double")
            for key, value in attributes.get(name, {}).items():
                made.attrs[key] = value
        for key, value in attributes.get("", {}).items():
            file.attrs[key] = value
    data = bytearray(target.getvalue())
    head = b"MATLAB 7.3 MAT-file, Platform: GLNXA64, HDF5 schema 1.00 ."
    data[:128] = head.ljust(116) + b"\0" * 8 + b"\x00\x02IM"
    return bytes(data)


def npz(**variables: Any) -> bytes:
    target = io.BytesIO()
    np.savez(target, **variables)
    return target.getvalue()


def names_of(*texts: str) -> Array:
    found = np.empty((1, len(texts)), dtype=object)
    found[0] = texts
    return found


JOINT_NAMES = """
q Q q_traj qTraj jointAngles joint_positions JointPositions theta thetas q_des q_actual q_filtered
joint_trajectory q_log armJointAngles q_smoothed desiredJointAngles robot_joint_states
Gelenkwinkel gelenkwinkel_soll Achswinkel Achsstellungen Gelenkpositionen Winkelverlauf
angulosArticulares posiciones_articulares angulos_deseados posicion_articular
trayectoria_articular anglesArticulaires positions_articulaires trajectoire_articulaire
consigne_articulaire angles_mesures angoli_giunti posizioniGiunti traiettoria_giunti
angoli_misurati
posicoes_juntas angulosJuntas trajetoria_juntas katy_przegubow pozycje_przegubow gewrichtshoeken
hoeken_gewrichten guanjie_jiaodu
eklem_acilari kansetsu_kakudo q_sim q_ist q_soll qInterp measured_q config_traj
"""
OTHERS = """
erreur_q vitesses couples corriente dianliu iq velocidad_articular coppie_giunti velocita_giunti
Gelenkgeschwindigkeit courant_moteur sudu jiasudu predkosc snelheden hizlar correntes momentos
q_error tauJ Motorstrom Schleppfehler
"""
TWO_FACED_NAMES = (
    "traj trajectory Bahn trayectoria trajectoire traiettoria waypoints pos posicion data out A"
)
RATES = {
    "fs": 50.0, "dt": 0.02, "Ts": 0.02, "sample_time": 0.02, "Abtastzeit": 0.02,
    "sampleRate": 50.0, "frecuencia_muestreo": 50.0, "periodo_muestreo": 0.02,
    "periode_echantillonnage": 0.02,
    "frequence_echantillonnage": 50.0, "tempo_campionamento": 0.02,
    "frequenza_campionamento": 50.0, "periodo_amostragem": 0.02, "dt_ms": 20.0,
    "control_rate_hz": 50.0, "Abtastrate": 50.0,
    "sampling_period_ms": 20.0, "cycle_time": 0.02, "frame_rate": 50.0,
}  # fmt: skip


def honest(robot: str) -> Iterator[Case]:
    short = robot[:6]
    rows = 400
    q = move(robot, rows, seed=3)
    t = np.arange(rows) / 50.0

    def case(name: str, data: bytes, rate: float = 50.0, **more: Any) -> Case:
        return Case(f"{short}_{name}", data, HONEST, q, rate, robot, **more)

    for name in JOINT_NAMES.split():
        yield case(name, mat(**{name: q, "fs": 50.0}))
    for name in TWO_FACED_NAMES.split():
        yield case(name, mat(**{name: q, "fs": 50.0}))
    for name, value in RATES.items():
        yield case(f"rate_{name}", mat(q=q, **{name: value}))
    for name in (
        "t",
        "time",
        "Zeit",
        "tiempo",
        "temps",
        "tempo",
        "tijd",
        "czas",
        "shijian",
        "tout",
    ):
        yield case(f"time_{name}", mat(q=q, **{name: t.reshape(-1, 1)}))
    degrees = np.degrees(q)
    for key, word in {
        "unit": "deg", "units": "degrees", "Einheit": "Grad", "unidad": "grados",
        "unite": "degres", "unita": "gradi", "unita_misura": "gradi",
        "unidade": "graus", "angleUnit": "deg",
    }.items():  # fmt: skip
        yield case(f"unit_{key}", mat(q=degrees, fs=50.0, **{key: word}))
        yield case(f"meta_{key}", mat(q=degrees, fs=50.0, meta={key: word}))
    yield case("flag_degrees", mat(q=degrees, fs=50.0, degrees=True))
    yield case("flag_radians", mat(q=q, fs=50.0, isRadians=True))
    yield case("meta_rad", mat(q=q, meta={"unit": "rad", "fs": 50.0, "author": "M. Muster"}))
    yield case("meta_robot", mat(q=q, fs=50.0, robot=model(robot).product))
    yield case("order_same", mat(q=q, fs=50.0, joint_order=np.arange(1.0, 7.0)))
    yield case("described", mat(q=q, fs=50.0, description="pick and place of the robot arm"))
    yield case("names_same", mat(q=q, fs=50.0, joint_names=names_of(*model(robot).joint_names)))
    yield case(
        "names_numbered", mat(q=q, fs=50.0, labels=names_of(*(f"q{i}" for i in range(1, 7))))
    )
    yield case("struct", mat(log={"q": q, "t": t.reshape(-1, 1)}))
    yield case("struct_deep", mat(exp={"arm": {"q": q}, "fs": 50.0}))
    yield case("with_velocity", mat(q=q, qd=velocity(q, 50.0), t=t.reshape(-1, 1)))
    yield case("with_tau", mat(q=q, tau=velocity(q), t=t.reshape(-1, 1)))
    yield case("gripper", mat(q=np.column_stack([q, gripper(rows)]), fs=50.0))
    yield case("home", mat(q=q, fs=50.0, q_home=model(robot).home))
    yield case("date", mat(q=q, fs=50.0, created="2024-05-01", author="Eva"))
    commented = b"# joint angles [deg], 50 Hz\n" + csv("q1,q2,q3,q4,q5,q6", degrees)
    yield case("comment", commented, 0.0, suffix=".csv")
    timed = np.column_stack([t, q])
    yield case("csv_time", csv("t,q1,q2,q3,q4,q5,q6", timed), suffix=".csv")
    yield case("csv_zeit", csv("Zeit;A1;A2;A3;A4;A5;A6", timed, ";", ","), suffix=".csv")
    yield case("csv_deg", csv(",".join(f"A{i} [deg]" for i in range(1, 7)), degrees), 0.0,
               suffix=".csv")  # fmt: skip
    yield case("npz", npz(q=q, fs=50.0), suffix=".npz")
    yield case("npz_unit", npz(q=degrees, fs=50.0, unit=np.array("deg")), suffix=".npz")
    yield case("hdf5", hdf5({}, q=q, fs=[[50.0]]))
    yield case("hdf5_unit", hdf5({"q": {"unit": "deg"}}, q=degrees, fs=[[50.0]]))
    yield case("hdf5_rate", hdf5({"q": {"sample_rate": 50.0}}, q=q))


def small(robot: str) -> Array:
    """A motion whose degrees stay small enough to be radians of the robot."""
    m = model(robot)
    low = np.array([j.lower for j in m.joints])
    high = np.array([j.upper for j in m.joints])
    middle = np.clip(np.zeros(6), low + 0.4, high - 0.4)
    u = np.sin(np.linspace(0, 6, 300))[:, None] * np.linspace(0.3, 0.9, 6)
    return np.clip(middle + 0.5 * u, low + 0.05, high - 0.05)


def misleading(robot: str) -> Iterator[Case]:
    short, rows = robot[:6], 400
    q = move(robot, rows, seed=4)
    s = small(robot)
    v = velocity(q, 50.0)

    def case(name: str, data: bytes, about: str, truth: Array = None, rate: float = 0.0,
             suffix: str = ".mat") -> Case:  # fmt: skip
        words = tuple(about.split())
        return Case(f"{short}_{name}", data, MISLEADING, truth, rate, robot, suffix, words)

    for name, values in {
        "sin_q": np.sin(q), "q_norm": (q - q.min(0)) / np.ptp(q, axis=0), "q_pi": q / np.pi,
        "q_scaled": q * 0.5, "theta_norm_pi": q / np.pi, "q_tours": q / (2 * np.pi),
        "q_leg": q * 0.7, "q_mirrored": -s, "cos_theta": np.cos(q), "q_offset": q * 0.1,
        "tan_half_q": np.tan(q / 8), "joint_angles_inverse": -s, "q_abs": np.abs(s),
        "q_rel": q - q[0], "hip_angles": s, "q_cumsum": 0.3 * s, "eye_angles": s, "q_fft": s,
    }.items():  # fmt: skip
        word = [w for w in name.lower().split("_") if w not in ("q", "theta", "joint", "angles")]
        truth = q if name in ("q_pi", "q_tours") else None
        yield case(name, mat(**{name: values, "fs": 50.0}), " ".join([*word, "unit"]), truth)
    for name in OTHERS.split():
        yield case(f"other_{name}", mat(**{name: 0.3 * v, "fs": 50.0}), "name speed current")
    labelled = {"values": s, "label": "q (deg)"}
    states = {
        "meta_unit": mat(q=s, fs=50.0, meta={"unit": "deg"}),
        "angleUnit": mat(q=s, fs=50.0, angleUnit="deg"),
        "degrees_true": mat(q=s, fs=50.0, degrees=True),
        "radians_false": mat(q=s, fs=50.0, use_radians=False),
        "Einheit": mat(q=s, fs=50.0, Einheit="Grad"),
        "label": mat(simout={"time": np.arange(300.0) / 50, "signals": labelled}),
        "note": mat(q=s, fs=50.0, note="all joint angles in degrees"),
        "info": mat(q=s, fs=50.0, info={"description": "Gelenkwinkel in Grad"}),
    }  # fmt: skip
    degrees = np.radians(s)
    for name, data in states.items():
        yield case(f"deg_{name}", data, "degree", degrees)
    yield case("deg_comment", b"# Winkel [\xc2\xb0]\n" + csv("q1,q2,q3,q4,q5,q6", s), "degree",
               degrees, suffix=".csv")  # fmt: skip
    yield case("deg_attribute", hdf5({"q": {"unit": "deg"}}, q=s, fs=[[50.0]]), "degree", degrees)
    yield case("deg_attribute_file", hdf5({"": {"angle_unit": "deg"}}, q=s, fs=[[50.0]]), "degree",
               degrees)  # fmt: skip
    for unit, factor in {"gon": np.pi / 200, "mrad": 1e-3, "turns": 2 * np.pi, "half turns": np.pi,
                         "percent": 0.0, "foo": 0.0}.items():  # fmt: skip
        held = q / factor if factor else 100 * s
        truth = q if factor else None
        yield case(f"unit_{unit}", mat(q=held, fs=50.0, unit=unit), "unit rad turn percent", truth)
    for unit in ("Nm", "V", "rad/s"):
        yield case(f"unit_{unit[:3]}", mat(q=s, fs=50.0, unit=unit), "unit")
    yield case("unit_two", mat(q_deg=s, fs=50.0, unit="rad"), "radians degrees")
    back = np.arange(6)[::-1]
    yield case("order_back", mat(q=q[:, ::-1], fs=50.0, joint_order=back + 1.0), "order", q)
    yield case("order_labels", mat(q=q[:, ::-1], fs=50.0,
               labels=names_of(*(f"q{6 - i}" for i in range(6)))), "order joints", q)  # fmt: skip
    joined = "\n".join(model(robot).joint_names[::-1])
    yield case("order_text", mat(q=q[:, ::-1], fs=50.0, joint_names=joined), "order joints", q)
    cycle = [1, 2, 0, 3, 4, 5]
    yield case("order_cycle", mat(q=q[:, cycle], fs=50.0, order=np.array(cycle) + 1.0), "order", q)
    other = "KUKA LBR iiwa 7" if robot == "ur5e" else "UR5e"
    yield case("robot_text", mat(q=q, fs=50.0, robot=other), "robot")
    yield case("robot_meta", mat(q=q, fs=50.0, meta={"robot": other, "date": "2024"}), "robot")
    human = names_of("shoulder_flex", "shoulder_abd", "elbow_flex", "wrist_dev", "hip", "knee")
    yield case("names_human", mat(armAngles=s, fs=50.0, names=human), "names joints")
    yield case("motor_q", mat(q_motor=s, fs=50.0), "motor")
    yield case("motor_gear", mat(q=s, fs=50.0, gear_ratio=np.array([100.0] * 6)), "gear motor")
    for name, number in {"scale": 0.001, "q_factor": 57.3, "scaling": 2.0}.items():
        yield case(f"factor_{name}", mat(q=s, fs=50.0, **{name: number}), "factor")
    for name, number in {"units_per_rad": 100.0, "q_gain": 0.5, "conv": 57.3}.items():
        yield case(f"beside_{name}", mat(q=s, fs=50.0, **{name: number}), "factor")
    for key, words in {
        "note": "mirrored arm, left is right", "remarks": "raw encoder counts",
        "readme": "axes inverted", "comment": "scaled by 0.5", "info": "values relative to home",
    }.items():  # fmt: skip
        yield case(f"text_{key}", mat(q=s, fs=50.0, **{key: words}), words)
    for unit in ("steps", "%", "a.u."):
        headings = ",".join(f"q{i} [{unit}]" for i in range(1, 7))
        yield case(f"heading_{unit}", csv(headings, s), "unit percent", suffix=".csv")
    for key, words in {
        "order": "reversed", "long_name": "joint velocity", "rotation_unit": "rev",
        "unit_angle": "milli rad", "coordinate": "relative", "source": "human demonstration",
    }.items():  # fmt: skip
        yield case(f"said_{key}", mat(q=s, fs=50.0, **{key: words}), words)
    for key, value in {"rad": "no", "is_deg": "yes", "deg_mode": True}.items():
        yield case(f"deg_{key}", mat(q=s, fs=50.0, **{key: value}), "degree", degrees)
    for key, number in {"enc_res": 8192.0, "lsb": 0.001, "gain_joint": 0.5}.items():
        yield case(f"beside_{key}", mat(q=s, fs=50.0, **{key: number}), "factor")
    yield case("comment_mirrored", b"# mirrored left arm\n" + csv("q1,q2,q3,q4,q5,q6", s),
               "mirrored", suffix=".csv")  # fmt: skip
    backwards = {"joint_names": model(robot).joint_names[::-1]}
    yield case("order_json", json.dumps({"q": q[:, ::-1].tolist(), "meta": backwards}).encode(),
               "order", q, suffix=".json")  # fmt: skip
    for name in ("jointLabels", "q_from_home"):
        yield case(name, mat(**{name: s, "fs": 50.0}), "understood")
    for name in ("log_q", "exp_q", "q_current", "q_unit"):
        yield case(name, mat(**{name: s, "fs": 50.0}), "understood current")
    yield case("robot_series", mat(q=q, fs=50.0, model="iiwa14"), "robot")
    rng = np.random.default_rng(5)
    low = np.array([j.lower for j in model(robot).joints])
    high = np.array([j.upper for j in model(robot).joints])
    yield case("random", mat(q=rng.uniform(low, high, (300, 6))), "motion")
    yield case("shuffled", mat(q=rng.permutation(q)), "motion")
    for name, value in {
        "Te": 0.02, "Fe": 50.0, "Ta": 0.02, "period_ms": 20.0, "cycle_ms": 20.0,
        "control_freq": 50.0, "Tm": 0.02, "fm": 50.0, "okres": 0.02, "pas": 0.02, "loop": 20.0,
        "abc": 0.02, "vv": 50.0,
        "T_samp": 0.02, "freq_control": 50.0,
        "Ttotal": 7.98, "tick": 20.0 * np.arange(400.0),
        "temps": np.arange(400.0) / 50, "zz": np.arange(400.0) / 50, "marcas": np.cumsum(
            rng.uniform(0.01, 0.03, 400)), "info": "recorded at 50 Hz", "note": "dt = 20 ms",
        "tvec": np.arange(200.0) / 50, "stamp": np.arange(401.0) / 50,
        "n_per_s": 50.0, "tau_s": 0.02, "speed_hz": 50.0, "logging_rate": 50.0,
        "timing": np.array([0.02, 0, 0]), "moments": np.arange(400.0) / 50,
        "x_axis": np.arange(400.0) / 50, "remarque": "une mesure toutes les 20 ms",
        "force": np.column_stack([np.arange(400.0) / 50, v[:, :3]]),
        "hz": 50.0, "freqEch": 50.0, "seconds": 7.98, "duree_totale": 7.98, "meta": {"Te": 0.02},
    }.items():  # fmt: skip
        word = name.lower() if name != "meta" else "te"
        value = value.reshape(len(value), -1) if isinstance(value, np.ndarray) else value
        yield case(f"rate_{name}", mat(q=q, **{name: value}), word, q, 50.0)
    base = np.column_stack([np.linspace(0, 0.4, rows), 0.2 * q[:, :2], q])[
        :, [0, 1, 2, 3, 4, 5, 6, 7]
    ]
    yield case("mobile_base", mat(q=base, fs=50.0), "columns")
    for name, stated in {
        "units_q": {"units": {"q": "deg"}}, "units_joint": {"units": {"joint": "deg"}},
        "meta_q_unit": {"meta": {"q": {"unit": "deg"}}},
    }.items():  # fmt: skip
        yield case(f"deg_{name}", mat(q=np.degrees(s), fs=50.0, **stated), "unit", s)
    first = np.column_stack([gripper(rows), q])
    yield case("gripper_first", mat(q=first, fs=50.0), "column gripper", q)
    ramp = np.column_stack([q, np.linspace(0, 1, rows)])
    yield case("gripper_ramp", mat(q=ramp, fs=100.0), "column gripper", q, 100.0)
    yield case("gripper_ramp_alone", mat(q=ramp), "100", q)
    yield case("milliradians", mat(q=np.round(1000 * q), fs=50.0), "unit", q)
    yield case("lerobot", mat(action=q + 0.002, observation={"state": q}, fs=50.0), "action", q)


def build() -> Iterator[Case]:
    for robot in ("ur5e", KUKA, "kuka_lbr_iisy15_r930"):
        yield from honest(robot)
        yield from misleading(robot)
