"""Isolation: every run has a ROS domain of its own and stays on this machine."""

from __future__ import annotations

import os
from collections.abc import Iterator
from pathlib import Path

import domain_coordinator
import pytest
from hypothesis import settings

# How long an example takes is the machine's affair: a timing is a benchmark, never a test.
settings.register_profile("lab", deadline=None)
settings.load_profile("lab")


# Folders whose tests need no graph and no launched process of the lab.
FAST_FOLDERS = ("unit", "fuzz")


# What runs in one process when several share the work: a folder with a lab for all of its files,
# else a file. The labs come last, so that none runs beside tests that do not need it.
ORDER = ("node", "fuzz", "unit", "browser", "system")


@pytest.hookimpl(tryfirst=True)  # before pytest-xdist reads the marks
def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    """Mark the `fast` tests, put the folders in ORDER, and say what runs in one process."""
    root = Path(__file__).parent

    def folder(item: pytest.Item) -> str:
        return item.path.relative_to(root).parts[0]

    items.sort(key=lambda item: ORDER.index(folder(item)))
    for item in items:
        if folder(item) in FAST_FOLDERS and item.get_closest_marker("slow") is None:
            item.add_marker(pytest.mark.fast)
        together = "browser" if folder(item) == "browser" else item.path.relative_to(root)
        item.add_marker(pytest.mark.xdist_group(str(together)))


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
