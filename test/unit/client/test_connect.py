"""How a command finds its lab, and what it says where there is none."""

from __future__ import annotations

from pathlib import Path

import pytest
from refusals import refused

from mrlab_ros.client import connect
from mrlab_ros.commands.open import running_web
from mrlab_ros.core.base.errors import Misuse
from mrlab_ros.processes.diagnostics import LABS_ELSEWHERE
from mrlab_ros.processes.run_file import RunFile, domains
from mrlab_ros.ros.calls import NoAnswer
from mrlab_ros.ros.diagnostics import NO_LAB_ANSWERS


class Lone:
    """A graph in which the given nodes are, and nobody else ever comes."""

    domain = 7

    def __init__(self, *names: str) -> None:
        self.names = names
        self.closed = False

    def node_names(self) -> tuple[str, ...]:
        return self.names

    def close(self) -> None:
        self.closed = True


@pytest.fixture(autouse=True)
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("XDG_RUNTIME_DIR", str(tmp_path))
    monkeypatch.setenv("ROS_DOMAIN_ID", "7")
    monkeypatch.setattr(connect, "LOOK_PERIOD_S", 0.0)


@pytest.mark.parametrize("tools", [(), ("_mrlab_command", "_ros2cli_daemon_7")])
def test_a_domain_of_tools_alone_has_no_lab(
    tools: tuple[str, ...], monkeypatch: pytest.MonkeyPatch
) -> None:
    lone = Lone(*tools)
    monkeypatch.setattr(connect, "_node", lambda: lone)
    with refused(NO_LAB_ANSWERS, NoAnswer, domain=7):
        connect.open_graph()
    assert lone.closed


def test_pages_are_looked_for_on_the_domain_of_a_lab() -> None:
    elsewhere = RunFile(9)
    elsewhere.claim()
    with refused(LABS_ELSEWHERE, Misuse, domain=7, labs=[9]):
        running_web()
    elsewhere.release()


def test_any_other_node_may_be_a_lab(monkeypatch: pytest.MonkeyPatch) -> None:
    lone = Lone("_mrlab_command", "talker")
    monkeypatch.setattr(connect, "_node", lambda: lone)
    assert connect.open_graph() is lone


def test_a_lab_that_starts_is_waited_for(monkeypatch: pytest.MonkeyPatch) -> None:
    starting = RunFile(7)
    starting.claim()
    lone = Lone("_mrlab_command")
    monkeypatch.setattr(connect, "_node", lambda: lone)
    assert connect.open_graph() is lone
    starting.release()


def test_the_domain_of_the_lab_that_runs_is_named(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(connect, "_node", lambda: Lone("_mrlab_command"))
    one, other = RunFile(12), RunFile(3)
    one.claim()
    with refused(LABS_ELSEWHERE, NoAnswer, labs=[12]):
        connect.open_graph()
    other.claim()
    assert domains() == [3, 12]
    with refused(LABS_ELSEWHERE, NoAnswer, labs=[3, 12]):
        connect.open_graph()
    one.release()
    assert domains() == [3]
    other.release()
