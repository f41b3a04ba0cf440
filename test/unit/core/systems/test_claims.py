"""Claims that end with their holder."""

from __future__ import annotations

from mrlab_ros.core.systems.claims import Leases


def test_a_claim_lasts_while_its_system_is_named():
    leases = Leases(4.0)
    for now in range(10):
        leases.renew(["cell"], now)
        assert leases.expired(["cell"], now + 0.5) == []
    assert leases.expired(["cell"], 12.9) == []
    assert leases.expired(["cell"], 13.0) == ["cell"]


def test_a_claim_that_was_just_made_gets_its_time():
    leases = Leases(4.0)
    leases.renew(["cell"], 0.0)
    assert leases.expired([], 1.0) == []
    assert leases.expired(["cell"], 100.0) == []
    assert leases.expired(["cell"], 104.0) == ["cell"]


def test_systems_expire_one_by_one():
    leases = Leases(4.0)
    leases.renew(["a", "b"], 0.0)
    leases.expired(["a", "b"], 0.0)
    leases.renew(["a"], 3.0)
    assert leases.expired(["a", "b"], 4.0) == ["b"]
