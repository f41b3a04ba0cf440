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


# Labs and graphs wait more than they compute: they come first, and the others fill their waits.
ORDER = ("browser", "system", "node", "fuzz", "unit", "bodies")
# More labs at once than this take each other's time, and their deadlines pass.
PROCESSES_WITH_LABS = 2
LABS = ("test/browser/", "test/system/")
# One lab serves it whole.
ONE_LAB = "test/browser/"
# Each test starts processes of its own.
APART = ("test/system/test_bench.py", "test/system/test_examples.py")


def pytest_configure(config: pytest.Config) -> None:
    """Let the processes with labs run before those without."""
    worker = os.environ.get("PYTEST_XDIST_WORKER", "gw0")
    if int(worker.removeprefix("gw")) >= PROCESSES_WITH_LABS:
        os.nice(5)


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
    """Hands whole files to the processes that share the work, and labs to the first two alone."""

    def _split_scope(self, nodeid: str) -> str:
        if nodeid.startswith(ONE_LAB):
            return ONE_LAB
        return nodeid if nodeid.startswith(APART) else str(super()._split_scope(nodeid))

    def _first_for(self, node: Any) -> str | None:
        if self.nodes.index(node) < PROCESSES_WITH_LABS:
            return next(iter(self.workqueue), None)
        for others in ((*LABS, "test/node/"), LABS):
            first = next((s for s in self.workqueue if not s.startswith(others)), None)
            if first is not None:
                return first
        return None

    def _reschedule(self, node: Any) -> None:
        if self.workqueue and self._first_for(node) is None:
            node.shutdown()
        else:
            super()._reschedule(node)

    def _assign_work_unit(self, node: Any) -> None:
        first = self._first_for(node)
        if first is not None:
            self.workqueue.move_to_end(first, last=False)
            super()._assign_work_unit(node)


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
