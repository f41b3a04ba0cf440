"""A motion and a session for Rerun: what is written, and what is said where its SDK is missing."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import Any
from unittest.mock import MagicMock

import numpy as np
import pytest
import scipy.io
from refusals import refused
from typer.testing import CliRunner

from mrlab_ros.adapters import rerun_file, share
from mrlab_ros.adapters.diagnostics import NOTHING_TO_SHOW, RERUN_MISSING
from mrlab_ros.adapters.robots.library import RobotLibrary
from mrlab_ros.cli import make_app
from mrlab_ros.core.base.errors import BadInput, Misuse
from mrlab_ros.core.recording.recorded_motion import RecordedMotion, RecordedObject, Track

LIBRARY = RobotLibrary(share.directory() / "robots")
U = np.linspace(0, 1, 101)[:, None]
Q = LIBRARY.model("ur5e").home + 0.3 * (10 * U**3 - 15 * U**4 + 6 * U**5)


@pytest.fixture
def sdk(monkeypatch: pytest.MonkeyPatch) -> MagicMock:
    """Stands for Rerun's SDK: keeps what is sent, and writes a file."""
    made = MagicMock()
    made.RecordingStream.return_value.save.side_effect = lambda path: Path(path).write_text("rrd")
    made.Scalars.columns.side_effect = lambda scalars: scalars
    body = made.urdf.UrdfTree.from_file_path.return_value
    body.name, body.root_link.return_value.name = "ur5e", "base_link"
    for name in ("rerun", "rerun.blueprint", "rerun.urdf"):
        monkeypatch.setitem(sys.modules, name, getattr(made, name.rpartition(".")[2], made))
    monkeypatch.setitem(sys.modules, "rerun", made)
    return made


def sent(sdk: MagicMock) -> dict[str, Any]:
    return {call.args[0]: call.args[2] for call in sdk.send_columns.call_args_list}


def test_a_motion_has_a_curve_and_a_pose_for_each_joint(
    sdk: MagicMock, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
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


def test_a_session_has_its_objects_and_comes_whole_out_of_the_sandbox(
    sdk: MagicMock, tmp_path: Path
) -> None:
    motion = rerun_file.motion_of(
        MagicMock(
            frame_count=101, frame_rate=100.0, robot_model="ur5e", end_effector=None,
            joint_names=LIBRARY.model("ur5e").joint_names, positions=Q,
        )
    )  # fmt: skip
    shape = {
        "size": {"x": 1, "y": 2, "z": 3},
        "color": dict.fromkeys("rgba", 1.0),
        "primitive": {"type": rerun_file.SPHERE, "dimensions": [0.1]},
    }
    motion.objects["ball"] = RecordedObject(shape, 0.0, 1.0, Track([0.0], [rerun_file.STANDING]))
    whole = rerun_file.of_plain(rerun_file.plain(motion))
    assert whole == motion
    rerun_file.write(whole, LIBRARY, tmp_path / "s.rrd")
    assert "objects/ball/pose" in sent(sdk)
    sdk.Ellipsoids3D.assert_called_once()
    with refused(NOTHING_TO_SHOW, BadInput):
        rerun_file.write(RecordedMotion(), LIBRARY, tmp_path / "none.rrd")


def test_without_the_sdk_it_is_named(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "rerun", None)
    words = ("export", "gone.mat", "--robot", "ur5e")
    done = CliRunner().invoke(make_app(words), words)
    with refused(RERUN_MISSING, Misuse):
        assert done.exception is not None
        raise done.exception
