"""`mrlab compare` says what it found, and what it did not compare."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import scipy.io
from typer.testing import CliRunner

from mrlab_ros.cli import make_app

S = 10 * (T := np.linspace(0, 1, 401)) ** 3 - 15 * T**4 + 6 * T**5
Q = np.array([0.0, -1.5, 1.5, -1.5, -1.5, 0.0]) + np.outer(S, [0.5, -0.4, 0.6, 0.2, -0.3, 0.4])


@pytest.mark.parametrize(
    ("rows", "rate", "expected"),
    [
        (Q, 100.0, {"side": "same", "alike": "yes"}),
        (Q[::2], 50.0, {"side": "same"}),
        (Q[:201], 100.0, {"side": "same", "alike": "yes", "compared": 2.0, "whole": 4.0}),
        (Q + 0.01 * S[:, None] * np.eye(6)[2], 100.0, {"joint": "elbow_joint"}),
    ],
)
def test_what_is_said_of_two_motions(
    tmp_path: Path, rows: np.ndarray, rate: float, expected: dict[str, Any]
) -> None:
    for name, motion, fs in (("a.mat", Q, 100.0), ("b.mat", rows, rate)):
        scipy.io.savemat(tmp_path / name, {"q": motion, "fs": fs})
    arguments = ["compare", str(tmp_path / "a.mat"), str(tmp_path / "b.mat"), "--robot", "ur5e"]
    done = CliRunner().invoke(make_app(), [*arguments, "--json"])
    values = json.loads(done.stdout)["comparison"]["said"]["values"]
    assert {key: values.get(key) for key in expected} == expected
    assert ("compared" in values) == ("compared" in expected)
    assert ("joint" in values) != ("alike" in values)
