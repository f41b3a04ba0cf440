"""Buckets of attempts."""

from __future__ import annotations

from refusals import refused

from mrlab_ros.gateway.diagnostics import TOO_MANY_REQUESTS
from mrlab_ros.gateway.errors import TooMany
from mrlab_ros.gateway.people.person import Limit, RateLimit

LIMIT = Limit("tries", 3, 10.0)


def passed(limit: RateLimit, subject: str, now: float) -> bool:
    try:
        limit.check(subject, now)
    except TooMany:
        return False
    return True


def test_a_burst_passes_then_one_a_period() -> None:
    limit = RateLimit(LIMIT)
    assert [passed(limit, "a", 0.0) for _ in range(5)] == [True] * 3 + [False] * 2
    assert [passed(limit, "a", t) for t in (9.9, 10.0, 10.1, 20.0)] == [False, True, False, True]
    assert [passed(limit, "a", 1000.0) for _ in range(4)] == [True] * 3 + [False]


def test_subjects_do_not_share() -> None:
    limit = RateLimit(LIMIT)
    assert [passed(limit, name, 0.0) for name in "aaaab"] == [True] * 3 + [False, True]


def test_it_says_when_to_try_again() -> None:
    limit = RateLimit(LIMIT)
    for _ in range(3):
        limit.check("a", 0.0)
    with refused(TOO_MANY_REQUESTS, TooMany, what="tries", wait=6.0) as caught:
        limit.check("a", 4.0)
    assert caught.value.headers == {"Retry-After": "6"}


def test_it_remembers_a_bounded_number_of_subjects() -> None:
    limit = RateLimit(LIMIT, subjects=2)
    for _ in range(3):
        limit.check("a", 0.0)
    for name in "bc":
        limit.check(name, 0.0)
    assert passed(limit, "a", 0.0)
