"""What messages import and a process may never use, each in a fresh interpreter."""

from __future__ import annotations

import subprocess
import sys

import pytest

LOADED = "'numpy._core' in sys.modules"


@pytest.mark.parametrize(
    "code",
    [
        pytest.param(
            "import numpy as np; from sensor_msgs.msg import CameraInfo, JointState\n"
            "import inspect; inspect.getmodule(inspect.currentframe())\n"
            f"JointState(position=[0.5]); assert not {LOADED}\n"
            "assert CameraInfo().k.shape == (9,) and np.pi > 3\n"
            f"import numpy; assert {LOADED} and numpy.zeros(2).sum() == 0\n"
            "assert isinstance(numpy.zeros(2), np.ndarray)",
            id="until-it-is-used",
        ),
        pytest.param(
            "from numpy.typing import NDArray; from numpy.linalg import norm\n"
            f"assert norm([3, 4]) == 5 and {LOADED}",
            id="modules-of-it",
        ),
        pytest.param(
            "import mrlab_ros.nodes.bridge.node, mrlab_ros.processes.node_runner\n"
            f"from mrlab_msgs.srv import SpawnRobot; assert not {LOADED}",
            id="not-for-the-bridge",
        ),
    ],
)
def test_numpy_is_postponed(code):
    start = (
        "import sys; from mrlab_ros.ros.type_supports import postpone_numpy, skip_generator\n"
        "skip_generator(); postpone_numpy()\n"
    )
    done = subprocess.run(
        [sys.executable, "-c", start + code], capture_output=True, text=True, timeout=60
    )
    assert done.returncode == 0, done.stderr
