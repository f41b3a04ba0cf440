"""Where the bridge may listen, and how links are set."""

from __future__ import annotations

import pytest
from refusals import refused

from mrlab_ros.core.base.errors import BadInput
from mrlab_ros.core.bridge import diagnostics as say
from mrlab_ros.core.bridge import links
from mrlab_ros.core.bridge.links import REST_S, SETTLE_S, Pace


@pytest.mark.parametrize(
    "endpoint", ["tcp/127.0.0.1:7447", "tcp/[::1]:0", "unixsock-stream//tmp/lab.sock"]
)
def test_endpoints_of_this_machine_need_no_flag(endpoint):
    links.check_endpoints((endpoint,), insecure=False)


@pytest.mark.parametrize("endpoint", ["tcp/0.0.0.0:7447", "udp/10.0.0.2:1", "tcp/[::]:7447"])
def test_an_open_endpoint_needs_the_flag(endpoint):
    with refused(say.OPEN_ENDPOINT, BadInput, endpoint=endpoint):
        links.check_endpoints((endpoint,), insecure=False)
    links.check_endpoints((endpoint,), insecure=True)


@pytest.mark.parametrize("keys", [True, False])
def test_links_that_cannot_be_bounded_are_refused(keys):
    with refused(say.QUIC_UNBOUNDED, BadInput, better="tls/[::]:7447"):
        links.check_endpoints(("quic/[::]:7447",), insecure=True, keys=keys)


@pytest.mark.parametrize("endpoint", ["tls/0.0.0.0:7447", "tls/[::]:7447"])
def test_encryption_and_keys_go_together(endpoint):
    links.check_endpoints((endpoint,), insecure=False, keys=True)
    with refused(say.TLS_NEEDS_KEYS, BadInput, protocol="tls"):
        links.check_endpoints((endpoint,), insecure=True)
    with refused(say.KEYS_NEED_TLS, BadInput, better="tls/127.0.0.1:7447"):
        links.check_endpoints(("tcp/127.0.0.1:7447",), insecure=True, keys=True)


@pytest.mark.parametrize(
    ("endpoint", "local"),
    [
        ("tcp/127.0.0.1:7447", True),
        ("tls/127.0.1.1:7447", True),
        ("tcp/[::1]:7447", True),
        ("tcp/localhost:7447", True),
        ("unixsock-stream//tmp/lab.sock", True),
        ("tcp/0.0.0.0:7447", False),
        ("tls/lab.example.org:7447", False),
        ("tcp/[::]:7447", False),
        ("tcp/127.lab.example.org:7447", False),
    ],
)
def test_an_endpoint_is_within_this_machine_or_beyond(endpoint, local):
    assert links.is_local(endpoint) is local


def test_settings_by_path_lie_in_one_another():
    assert links.nested({"a/b/c": 1, "a/b/d": [2], "e": 3}) == {
        "a": {"b": {"c": 1, "d": [2]}},
        "e": 3,
    }


PERIOD = 0.25


def checks(pace, start, end, step=0.125):
    """Return (time, thorough) of each check from `start` to `end`, with a turn every `step`."""
    made = []
    for i in range(round((end - start) / step) + 1):
        now = start + i * step
        if pace.wait(now) == 0.0:
            made.append((now, pace.check(now)))
    return made


def test_the_first_check_is_due_at_once():
    pace = Pace(PERIOD)
    assert pace.wait(1234.5) == 0.0
    assert pace.check(1234.5) is True


def test_a_graph_at_rest_is_checked_seldom_and_thoroughly():
    made = checks(Pace(PERIOD), 0.0, 2 * REST_S)
    assert made == [(0.0, True), (REST_S, True), (2 * REST_S, True)]


def test_after_a_change_checks_go_on_until_it_has_settled_and_the_last_is_thorough():
    pace = Pace(PERIOD)
    pace.check(0.0)
    pace.changed(2.0)
    assert pace.wait(2.0) == 0.0
    made = checks(pace, 2.0, 2.0 + SETTLE_S + REST_S - PERIOD)
    assert [now for now, _ in made] == [2.0, 2.25, 2.5, 2.75, 3.0]
    assert [thorough for _, thorough in made] == [False, False, False, False, True]


def test_changes_without_end_make_no_more_checks_than_one_a_period():
    pace = Pace(PERIOD)
    made = 0
    for i in range(400):
        now = i * 0.01
        pace.changed(now)
        if pace.wait(now) == 0.0:
            pace.check(now)
            made += 1
    assert made == pytest.approx(4.0 / PERIOD, abs=1)


def test_a_new_period_counts_at_once():
    pace = Pace(60.0)
    pace.check(0.0)
    pace.changed(1.0)
    assert pace.wait(1.0) == 59.0
    pace.period = 0.5
    assert pace.wait(1.0) == 0.0
