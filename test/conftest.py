"""Isolation: every run has a ROS domain of its own and stays on this machine."""

from __future__ import annotations

import os
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import domain_coordinator
import pytest
from hypothesis import settings
from xdist.scheduler import LoadFileScheduling

# How long an example takes is the machine's affair: a timing is a benchmark, never a test.
settings.register_profile("lab", deadline=None)
settings.load_profile("lab")


# Folders whose tests need no graph and no launched process of the lab.
FAST_FOLDERS = ("unit", "fuzz", "bodies")


# The labs come last, so that none runs beside tests that do not need it.
ORDER = ("node", "fuzz", "unit", "bodies", "browser", "system")
# What one lab serves whole.
ONE_LAB = "test/browser/"


def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    """Mark the `fast` tests and put the folders in ORDER."""
    root = Path(__file__).parents[1]

    def folder(item: pytest.Item) -> str:
        return item.path.relative_to(root).parts[1]

    items.sort(key=lambda item: ORDER.index(folder(item)))
    for item in items:
        if folder(item) in FAST_FOLDERS and item.get_closest_marker("slow") is None:
            item.add_marker(pytest.mark.fast)


class _Files(LoadFileScheduling):
    """Hands whole files to the processes that share the work, and a folder that shares a lab."""

    def _split_scope(self, nodeid: str) -> str:
        return ONE_LAB if nodeid.startswith(ONE_LAB) else str(super()._split_scope(nodeid))


def pytest_xdist_make_scheduler(config: pytest.Config, log: Any) -> _Files | None:
    """Keep what shares a lab in one process; its mark for that does nothing since pytest 9.1."""
    return _Files(config, log) if config.getvalue("dist") == "loadfile" else None


@pytest.fixture(scope="session", autouse=True)
def no_imported_robots(tmp_path_factory: pytest.TempPathFactory) -> None:
    """Keep the robots that the user imported out of every test and its child processes."""
    os.environ["MRLAB_ROBOTS"] = str(tmp_path_factory.mktemp("robots"))


@pytest.fixture(scope="session", autouse=True)
def ros_domain() -> Iterator[int]:
    """Hold a free ROS domain for this run; child processes inherit it."""
    with domain_coordinator.domain_id() as domain:
        os.environ["ROS_DOMAIN_ID"] = str(domain)
        os.environ["ROS_AUTOMATIC_DISCOVERY_RANGE"] = "LOCALHOST"
        yield domain
