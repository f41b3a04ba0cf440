"""A motion is written for Rerun, and what is missing is named."""

from __future__ import annotations

import sys
from pathlib import Path

import numpy as np
import pytest
import scipy.io
from fake_rerun import fake_rerun, sent
from refusals import refused
from typer.testing import CliRunner

from mrlab_ros.adapters import share
from mrlab_ros.adapters.diagnostics import RERUN_MISSING
from mrlab_ros.adapters.robots.library import RobotLibrary
from mrlab_ros.cli import make_app
from mrlab_ros.core.base.errors import Misuse

U = np.linspace(0, 1, 101)[:, None]
HOME = RobotLibrary(share.directory() / "robots").model("ur5e").home
Q = HOME + 0.3 * (10 * U**3 - 15 * U**4 + 6 * U**5)


def test_a_motion_has_a_curve_and_a_pose_for_each_joint(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    sdk = fake_rerun(monkeypatch)
    monkeypatch.chdir(tmp_path)
    scipy.io.savemat("run.mat", {"q": Q, "fs": 100.0})
    words = ("export", "run.mat", "--robot", "ur5e", "--to", "rrd")
    done = CliRunner().invoke(make_app(words), words)
    assert (done.exit_code, Path("run.rrd").read_text()) == (0, "rrd"), done.output
    found = sent(sdk)
    assert found["ur5e/joints/elbow_joint"].tolist() == Q[:, 2].tolist()
    assert len([name for name in found if name.startswith("ur5e/poses/")]) == 6
    whens = [call.kwargs["duration"] for call in sdk.TimeColumn.call_args_list]
    (when,) = [each for each in whens if len(each) > 1]
    assert when[-1] == 1.0


def test_without_the_sdk_it_is_named(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "rerun", None)
    words = ("export", "gone.mat", "--robot", "ur5e")
    done = CliRunner().invoke(make_app(words), words)
    with refused(RERUN_MISSING, Misuse):
        assert done.exception is not None
        raise done.exception
