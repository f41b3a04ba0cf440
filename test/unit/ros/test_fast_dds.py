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
    if chosen is not None:
        monkeypatch.setenv(fast_dds.PROFILES, chosen)
    fast_dds.prepare()
    assert os.environ[fast_dds.PROFILES] == found


def test_a_participant_names_no_shared_memory() -> None:
    locators = ElementTree.parse(fast_dds.profile_file()).iter(
        "{http://www.eprosima.com/XMLSchemas/fastRTPS_Profiles}locator"
    )
    kinds = [child.tag.rsplit("}", 1)[1] for locator in locators for child in locator]
    assert kinds == ["udpv4"]
