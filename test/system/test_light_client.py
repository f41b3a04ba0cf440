"""The client without ROS against a running lab, in a process that could not import ROS."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

from served_lab import served_lab

CLIENT = Path(__file__).parents[2] / "clients" / "python"
DEADLINE_S = 120.0
SCRIPT = """
import asyncio
import sys

import numpy as np
from mrlab_client import FileRefused, Lab, LabError

t = np.arange(101) / 100
q = np.column_stack([np.sin(t) * 0.5, *([-1.2 + 0 * t] * 2), *([t / 3] * 3)])
with Lab(sys.argv[1], token=sys.argv[2]) as lab:
    assert lab.check(q, fs=100).ok
    try:
        lab.convert(np.column_stack([8 * t, q[:, 1:]]), "ur5e", fs=100)
    except FileRefused as refused:
        print(refused.code)
    try:
        lab.check(q, fs=0)
    except LabError as refused:
        print(refused.code)
    motion = lab.convert(q, lab.robot("ur5e_1"), fs=100, id="light")
    with lab.record("ur5e_1") as recording:
        assert lab.play(motion, "ur5e_1").wait(60)

    async def awaited():
        return await lab.play(motion, "ur5e_1")

    assert asyncio.run(awaited())
    assert len(recording) > 50
    sys.modules["pandas"] = None
    for empty in (motion, recording):
        try:
            empty.to_dataframe()
        except LabError as refused:
            print(refused.code)
    rows, names = motion.positions()
    print(len(names), abs(rows - q).max() < 1e-12)
    try:
        lab.robot("ur5e_1").seek(99.0)
    except LabError as refused:
        print(refused.code)
assert not {"rclpy", "mrlab_msgs", "mrlab_ros"} & set(sys.modules)
"""


def test_it_checks_plays_and_records(tmp_path: Path) -> None:
    with served_lab(tmp_path) as lab:
        token = lab.done("users", "token").split()[-1]
        done = subprocess.run(
            (sys.executable, "-c", SCRIPT, lab.url, token),
            env=os.environ | {"PYTHONPATH": str(CLIENT), "HOME": str(tmp_path)},
            capture_output=True, text=True, timeout=DEADLINE_S, check=False,
        )  # fmt: skip
    assert done.returncode == 0, done.stderr
    assert done.stdout.split() == [
        "joint_limit",
        "array_rate",
        *["pandas_missing"] * 2,
        "6",
        "True",
        "bad_position",
    ]
