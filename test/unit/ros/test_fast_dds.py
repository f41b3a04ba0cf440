"""The lab's participants are reached by sockets, unless the user has chosen otherwise."""

import os
import subprocess
import sys
import xml.etree.ElementTree as ElementTree

import pytest
from own_domain import own_domain

from mrlab_ros.ros import fast_dds

# Prints the addresses on which a participant listens: sockets in the ports of its domain.
# Ports of the tests' domains are below those that the kernel draws for sockets that only send.
LISTENS = """
import os, rclpy, socket
from mrlab_ros.ros import fast_dds
fast_dds.prepare()
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
    [(None, str(fast_dds.profile_file())), ("/my/profiles.xml", "/my/profiles.xml")],
)
def test_the_profiles_are_the_lab_s_unless_there_are_others(monkeypatch, chosen, found) -> None:
    monkeypatch.delenv(fast_dds.PROFILES, raising=False)
    monkeypatch.setenv(fast_dds.RANGE, "SUBNET")
    monkeypatch.setenv(fast_dds.PROFILES_OF_ENDS, "")  # so that it is restored
    monkeypatch.delenv(fast_dds.PROFILES_OF_ENDS)
    if chosen is not None:
        monkeypatch.setenv(fast_dds.PROFILES, chosen)
    fast_dds.prepare()
    assert os.environ[fast_dds.PROFILES] == found
    # Profiles of the user's own say nothing of writers and readers unless the user wants that.
    assert os.environ.get(fast_dds.PROFILES_OF_ENDS) == (None if chosen else "1")


def test_profiles_of_the_source_tree_are_the_lab_s_as_well(monkeypatch, tmp_path) -> None:
    copy = tmp_path / "fastdds.xml"
    copy.write_bytes(fast_dds.profile_file().read_bytes())
    monkeypatch.setenv(fast_dds.PROFILES, str(copy))
    monkeypatch.setenv(fast_dds.PROFILES_OF_ENDS, "")  # so that it is restored
    monkeypatch.delenv(fast_dds.PROFILES_OF_ENDS)
    fast_dds.prepare()
    assert os.environ[fast_dds.PROFILES_OF_ENDS] == "1"


@pytest.mark.parametrize(
    ("environment", "loopback"),
    [
        ({fast_dds.RANGE: "LOCALHOST"}, True),
        ({fast_dds.RANGE: "localhost"}, True),
        ({"ROS_LOCALHOST_ONLY": "1"}, True),
        ({fast_dds.RANGE: "LOCALHOST", "ROS_STATIC_PEERS": "10.0.0.2"}, False),
        ({fast_dds.RANGE: "SUBNET"}, False),
        ({}, False),
    ],
)
@pytest.mark.parametrize("before", [False, True, None])
def test_a_graph_that_stays_on_this_machine_has_profiles_of_its_own(
    environment, loopback, before
) -> None:
    if before is not None:  # a shell, or the process that started this one, has set them
        before = {fast_dds.PROFILES: str(fast_dds.profile_file(loopback=before))}
    found = fast_dds.settings({**environment, **(before or {})})
    assert found[fast_dds.PROFILES] == str(fast_dds.profile_file(loopback=loopback))


def test_the_profiles_of_both_graphs_differ_in_their_interfaces_alone() -> None:
    def lines(loopback: bool) -> set[str]:
        text = fast_dds.profile_file(loopback=loopback).read_text().partition("-->")[2]
        return {line.strip() for line in text.splitlines()}

    assert lines(False) - lines(True) == {"<address>0.0.0.0</address>"}
    more = " ".join(lines(True) - lines(False)).lower()
    assert "<qos>" not in more
    assert "policy" not in more


def test_a_graph_that_stays_here_listens_on_the_loopback_interface_alone() -> None:
    """ROS's range alone leaves sockets on all interfaces, which answer a foreign static peer."""
    with own_domain() as domain:
        environment = {**os.environ, fast_dds.RANGE: "LOCALHOST", "ROS_DOMAIN_ID": str(domain)}
        environment.pop("ROS_STATIC_PEERS", None)
        done = subprocess.run(
            [sys.executable, "-c", LISTENS],
            env=environment,
            capture_output=True,
            text=True,
            check=True,
        )
    assert set(done.stdout.split()) == {"127.0.0.1"}


def test_a_participant_announces_itself_while_a_tool_of_ros_looks() -> None:
    """`ros2 node list --no-daemon` looks for half a second."""
    where = "rtps/builtin/discovery_config/leaseAnnouncement"
    names = "/".join(f"{{*}}{name}" for name in ("profiles", "participant", *where.split("/")))
    period = ElementTree.parse(fast_dds.profile_file()).getroot().find(names)
    assert period is not None
    sec, nanosec = (int(child.text or "") for child in period)
    assert 0.1 <= sec + nanosec * 1e-9 <= 0.25


def test_a_participant_names_no_shared_memory() -> None:
    locators = ElementTree.parse(fast_dds.profile_file()).iter(
        "{http://www.eprosima.com/XMLSchemas/fastRTPS_Profiles}locator"
    )
    kinds = [child.tag.rsplit("}", 1)[1] for locator in locators for child in locator]
    assert kinds == ["udpv4"]
