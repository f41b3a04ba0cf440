"""Which services are carried out however late, as the shipped allow-list declares."""

from __future__ import annotations

import pytest
from mrlab_msgs import srv

from mrlab_ros.core.bridge.access import Policy
from mrlab_ros.ros.moves import _rules, moves


@pytest.mark.parametrize(
    ("service", "kind", "moving"),
    [
        ("/ur5e_1/pause", srv.Trigger, False),
        ("/cell/stop", srv.Trigger, False),
        ("/converter/get", srv.GetTrajectory, False),
        ("/converter/get_any", srv.GetTrajectory, False),
        ("/converter/list", srv.ListTrajectories, False),
        ("/recorder/list_bags", srv.ListBags, False),
        ("/ur5e_1/play", srv.Trigger, True),
        ("/ur5e_1/clear_halt", srv.Trigger, True),
        ("/recorder/resume", srv.Trigger, True),
        ("/playback_host/command_members", srv.CommandMembers, True),
        ("/ur5e_1/stop", srv.Seek, True),
    ],
)
def test_what_stops_or_changes_nothing_is_declared(service: str, kind: type, moving: bool) -> None:
    assert moves(service, kind) is moving


def test_a_key_of_the_web_has_the_same_rule() -> None:
    policy = Policy(_rules())
    assert not policy.moves("ur5e_1/pause")
    assert policy.moves("ur5e_1/play")
    assert policy.moves("nobody/knows")
