"""A ROS domain for one lab of the tests, which no other test of this machine takes meanwhile."""

from __future__ import annotations

import random
from collections.abc import Iterator
from contextlib import contextmanager

import domain_coordinator

from mrlab_ros.commands.demo.lab import domain_is_free

# As domain_coordinator has them.
DOMAINS = range(1, 101)


@contextmanager
def own_domain() -> Iterator[int]:
    """Hold a domain that is held by no other test and in which no participant is left.

    It is drawn: in the one that was let go of last somebody may be about to end.
    """
    drawn = filter(domain_is_free, random.sample(DOMAINS, len(DOMAINS)))
    held = domain_coordinator.domain_id(lambda: next(drawn))
    domain: int = held.__enter__()
    try:
        yield domain
    finally:
        # Without the error of the test, if any: it would take an OSError for a domain in use.
        held.__exit__(None, None, None)
