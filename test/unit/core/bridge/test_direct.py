"""Grants and reports of streams that their publisher puts on zenoh itself."""

from __future__ import annotations

import pytest

from mrlab_ros.core.bridge.direct import (
    GRANTS,
    Carried,
    grant,
    grantable,
    granted,
    report,
    reported,
)
from mrlab_ros.core.bridge.rules import Congestion, Reliability, TopicRule

DROPPED = Congestion.DROP


@pytest.mark.parametrize(
    "rule",
    [
        TopicRule("/a/joint_states", priority=2, congestion=DROPPED),
        TopicRule(
            "/a/b/c",
            priority=7,
            congestion=DROPPED,
            express=True,
            reliability=Reliability.BEST_EFFORT,
        ),
    ],
)
def test_a_grant_says_how_zenoh_treats_a_topic(rule: TopicRule) -> None:
    token = grant(rule.name, rule)
    assert token.startswith(f"{GRANTS}/")
    assert granted(token) == rule


def test_only_a_stream_without_a_cap_is_granted() -> None:
    assert grantable(TopicRule("/*/joint_states", congestion=DROPPED))
    assert not grantable(TopicRule("/*/joint_states", congestion=DROPPED, max_rate=20.0))
    assert not grantable(TopicRule("/*/joint_states"))


def test_a_report_is_read_as_it_was_written() -> None:
    carried = Carried("/a/joint_states", 576, [12_000, 9_000])
    assert reported(report(carried)) == carried
    for foreign in (b"", b"[]", b"7", b"\xff", b'["/a"]'):
        with pytest.raises((TypeError, ValueError)):
            reported(foreign)
