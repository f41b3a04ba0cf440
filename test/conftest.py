"""Isolation: every run has a ROS domain of its own and stays on this machine."""

from __future__ import annotations

import os
from collections.abc import Iterator

import domain_coordinator
import pytest


@pytest.fixture(scope="session", autouse=True)
def ros_domain() -> Iterator[int]:
    """Hold a free ROS domain for this run; child processes inherit it."""
    with domain_coordinator.domain_id() as domain:
        os.environ["ROS_DOMAIN_ID"] = str(domain)
        os.environ["ROS_AUTOMATIC_DISCOVERY_RANGE"] = "LOCALHOST"
        yield domain
