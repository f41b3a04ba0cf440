"""The lab's participants are reached by sockets, unless the user has chosen otherwise."""

import os
import xml.etree.ElementTree as ElementTree

import pytest

from mrlab_ros.ros import fast_dds


@pytest.mark.parametrize(
    ("chosen", "found"),
    [(None, str(fast_dds.profile_file())), ("/my/profiles.xml", "/my/profiles.xml")],
)
def test_the_profiles_are_the_lab_s_unless_there_are_others(monkeypatch, chosen, found) -> None:
    monkeypatch.delenv(fast_dds.PROFILES, raising=False)
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
