"""The lab's participants are reached by sockets, unless the user has chosen otherwise."""

from __future__ import annotations

import os
import subprocess
import sys
import time
import xml.etree.ElementTree as ElementTree
from pathlib import Path

import pytest
from own_domain import own_domain

from mrlab_ros.core.base.errors import BadInput
from mrlab_ros.ros import environment
from mrlab_ros.ros.environment import LONGEST_S, remove_abandoned

# Prints the addresses on which a participant listens: sockets in the ports of its domain.
# Ports of the tests' domains are below those that the kernel draws for sockets that only send.
LISTENS = """
import os, rclpy, socket
from mrlab_ros.ros import environment
environment.prepare()
rclpy.init()
node = rclpy.create_node("listening")
first = 7400 + 250 * int(os.environ["ROS_DOMAIN_ID"])
for number in os.listdir("/proc/self/fd"):
    try:
        with socket.socket(fileno=os.dup(int(number))) as found:
            address, port = found.getsockname()[:2]
            if first <= port < first + 250:
                print(address)
    except (OSError, ValueError, TypeError):
        pass
"""


@pytest.mark.parametrize(
    ("chosen", "found"),
    [(None, str(environment.profile_file())), ("/my/profiles.xml", "/my/profiles.xml")],
)
def test_the_profiles_are_the_lab_s_unless_there_are_others(monkeypatch, chosen, found) -> None:
    monkeypatch.delenv(environment.PROFILES, raising=False)
    monkeypatch.setenv(environment.RANGE, "SUBNET")
    monkeypatch.setenv(environment.PROFILES_OF_ENDS, "")  # so that it is restored
    monkeypatch.delenv(environment.PROFILES_OF_ENDS)
    if chosen is not None:
        monkeypatch.setenv(environment.PROFILES, chosen)
    environment.prepare()
    assert os.environ[environment.PROFILES] == found
    # Profiles of the user's own say nothing of writers and readers unless the user wants that.
    assert os.environ.get(environment.PROFILES_OF_ENDS) == (None if chosen else "1")


def test_profiles_of_the_source_tree_are_the_lab_s_as_well(monkeypatch, tmp_path) -> None:
    copy = tmp_path / "fastdds.xml"
    copy.write_bytes(environment.profile_file().read_bytes())
    monkeypatch.setenv(environment.PROFILES, str(copy))
    monkeypatch.setenv(environment.PROFILES_OF_ENDS, "")  # so that it is restored
    monkeypatch.delenv(environment.PROFILES_OF_ENDS)
    environment.prepare()
    assert os.environ[environment.PROFILES_OF_ENDS] == "1"


@pytest.mark.parametrize(
    ("variables", "loopback"),
    [
        ({environment.RANGE: "LOCALHOST"}, True),
        ({environment.RANGE: "localhost"}, True),
        ({"ROS_LOCALHOST_ONLY": "1"}, True),
        ({environment.RANGE: "LOCALHOST", "ROS_STATIC_PEERS": "10.0.0.2"}, False),
        ({environment.RANGE: "SUBNET"}, False),
        ({}, False),
    ],
)
@pytest.mark.parametrize("before", [False, True, None])
def test_a_graph_that_stays_on_this_machine_has_profiles_of_its_own(
    variables, loopback, before
) -> None:
    if before is not None:  # a shell, or the process that started this one, has set them
        before = {environment.PROFILES: str(environment.profile_file(loopback=before))}
    found = environment.settings({**variables, **(before or {})})
    assert found[environment.PROFILES] == str(environment.profile_file(loopback=loopback))


def test_the_profiles_of_both_graphs_differ_in_their_interfaces_alone() -> None:
    def lines(loopback: bool) -> set[str]:
        text = environment.profile_file(loopback=loopback).read_text().partition("-->")[2]
        return {line.strip() for line in text.splitlines()}

    assert lines(False) - lines(True) == {"<address>0.0.0.0</address>"}
    more = " ".join(lines(True) - lines(False)).lower()
    assert "<qos>" not in more
    assert "policy" not in more


def test_a_graph_that_stays_here_listens_on_the_loopback_interface_alone() -> None:
    """ROS's range alone leaves sockets on all interfaces, which answer a foreign static peer."""
    with own_domain() as domain:
        variables = {**os.environ, environment.RANGE: "LOCALHOST", "ROS_DOMAIN_ID": str(domain)}
        variables.pop("ROS_STATIC_PEERS", None)
        done = subprocess.run(
            [sys.executable, "-c", LISTENS],
            env=variables,
            capture_output=True,
            text=True,
            check=True,
        )
    assert set(done.stdout.split()) == {"127.0.0.1"}


def test_a_participant_announces_itself_while_a_tool_of_ros_looks() -> None:
    """`ros2 node list --no-daemon` looks for half a second."""
    where = "rtps/builtin/discovery_config/leaseAnnouncement"
    names = "/".join(f"{{*}}{name}" for name in ("profiles", "participant", *where.split("/")))
    period = ElementTree.parse(environment.profile_file()).getroot().find(names)
    assert period is not None
    sec, nanosec = (int(child.text or "") for child in period)
    assert 0.1 <= sec + nanosec * 1e-9 <= 0.25


def test_a_participant_names_no_shared_memory() -> None:
    locators = ElementTree.parse(environment.profile_file()).iter(
        "{http://www.eprosima.com/XMLSchemas/fastRTPS_Profiles}locator"
    )
    kinds = [child.tag.rsplit("}", 1)[1] for locator in locators for child in locator]
    assert kinds == ["udpv4"]


FINISHED, BEGUN = b"\2\0\0\0" + bytes(60), b"\1\0\0\0" + bytes(60)


def segment(folder, name, content, age):
    path = folder / name
    path.write_bytes(content)
    made = time.time() - age
    os.utime(path, (made, made))
    return path


@pytest.mark.parametrize("content", [b"", BEGUN, bytes(64)])
def test_a_segment_that_nobody_finishes_goes(tmp_path, content):
    segment(tmp_path, "fastrtps_port7001", content, LONGEST_S + 1)
    assert remove_abandoned(tmp_path) == ["fastrtps_port7001"]
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize(
    ("name", "content", "age"),
    [
        ("fastrtps_port7411", FINISHED, 1000),
        ("fastrtps_port7411", b"", 0),  # being made
        ("fastrtps_port7411_el", b"", 1000),  # a lock is always empty
        ("sem.fastrtps_port7411_mutex", b"", 1000),
        ("fastrtps_0123456789abcdef", b"", 1000),
        ("41267.zenoh", b"", 1000),
    ],
)
def test_what_others_use_stays(tmp_path, name, content, age):
    path = segment(tmp_path, name, content, age)
    assert remove_abandoned(tmp_path) == []
    assert path.read_bytes() == content


def test_a_folder_that_is_not_there_is_no_error(tmp_path):
    assert remove_abandoned(tmp_path / "none") == []


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
        "import sys; from mrlab_ros.ros.environment import postpone_numpy, skip_generator\n"
        "skip_generator(); postpone_numpy()\n"
    )
    done = subprocess.run(
        [sys.executable, "-c", start + code], capture_output=True, text=True, timeout=60
    )
    assert done.returncode == 0, done.stderr


@pytest.mark.parametrize("variable", ["ROS_LOG_DIR", "ROS_HOME", "HOME"])
def test_a_folder_without_room_for_the_log_of_ros_is_named(
    variable: str, monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    for name in ("ROS_LOG_DIR", "ROS_HOME"):
        monkeypatch.delenv(name, raising=False)
    monkeypatch.setenv(variable, str(tmp_path))
    environment.check_log_folder()
    # Nobody can write here, not even root.
    monkeypatch.setenv(variable, "/proc/nowhere")
    with pytest.raises(BadInput) as raised:
        environment.check_log_folder()
    said = raised.value.diagnostic
    assert said.code == "no_log_folder"
    assert str(said.values["folder"]).startswith("/proc/nowhere")


def test_a_client_of_the_graph_says_where_ros_cannot_write() -> None:
    code = """
from mrlab_ros.core.base.errors import BadInput
from mrlab_ros.ros.graph_node import Graph
try:
    Graph()
except BadInput as error:
    print(error.diagnostic.code)
"""
    nowhere = {**os.environ, "ROS_LOG_DIR": "/proc/nowhere"}
    done = subprocess.run(
        (sys.executable, "-c", code), env=nowhere, capture_output=True, text=True
    )
    assert done.stdout == "no_log_folder\n", done.stderr
