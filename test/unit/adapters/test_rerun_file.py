"""A session for Rerun: robots, objects, and what the sandbox hands out."""

from __future__ import annotations

from pathlib import Path
from unittest.mock import MagicMock

import numpy as np
import pytest
from fake_rerun import fake_rerun, sent
from refusals import refused

from mrlab_ros.adapters import rerun_file, share
from mrlab_ros.adapters.diagnostics import NOTHING_TO_SHOW
from mrlab_ros.adapters.robots.library import RobotLibrary
from mrlab_ros.core.base.errors import BadInput
from mrlab_ros.core.recording.recorded_motion import RecordedMotion, RecordedObject, Track

LIBRARY = RobotLibrary(share.directory() / "robots")
Q = np.tile(LIBRARY.model("ur5e").home, (101, 1))


def test_a_session_has_its_objects_and_comes_whole_out_of_the_sandbox(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    sdk = fake_rerun(monkeypatch)
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
