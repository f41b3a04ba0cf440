"""Where the bridge may listen, and how links are set."""

from __future__ import annotations

import pytest
from refusals import refused

from mrlab_ros.core.base.errors import BadInput
from mrlab_ros.core.bridge import diagnostics as say
from mrlab_ros.core.bridge import links


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
