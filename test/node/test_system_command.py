"""`mrlab system create` refuses a system before it converts anything."""

from __future__ import annotations

from types import SimpleNamespace

import pytest
from refusals import refused

from mrlab_ros.commands.lab import system
from mrlab_ros.core.base.diagnostics import NAME_TAKEN, NO_ROBOT_IN_SCENE
from mrlab_ros.core.base.errors import BadInput, Misuse
from mrlab_ros.core.playback.diagnostics import MEMBER_OF_SYSTEM
from mrlab_ros.core.systems.cell_file import MemberEntry, SystemEntry


class Graph:
    """A graph with one robot, ur5e_1, that answers no service."""

    def robots(self):
        return [SimpleNamespace(name="ur5e_1")]

    def robot(self, name):
        if name != "ur5e_1":
            raise Misuse(NO_ROBOT_IN_SCENE(robot=name, known=["ur5e_1"]))

    def __enter__(self):
        return self

    def __exit__(self, *_):
        pass


@pytest.fixture
def systems(monkeypatch):
    found = []
    monkeypatch.setattr(system, "_systems", lambda graph, name="": found)
    return found


def entry(name, *robots):
    return SystemEntry(name, tuple(MemberEntry(robot, "a.mat") for robot in robots))


def test_robots_and_names_are_checked_first(systems):
    system._check_entry(Graph(), entry("", "ur5e_1"))
    system._check_entry(Graph(), entry("cell", "ur5e_1"))
    with refused(NO_ROBOT_IN_SCENE, Misuse, robot="kuka_1"):
        system._check_entry(Graph(), entry("cell", "ur5e_1", "kuka_1"))
    with refused(NAME_TAKEN, BadInput, name="ur5e_1"):
        system._check_entry(Graph(), entry("ur5e_1", "ur5e_1"))
    systems.append(SimpleNamespace(name="cell", members=[SimpleNamespace(robot="ur5e_1")]))
    with refused(MEMBER_OF_SYSTEM, Misuse, robot="ur5e_1", system="cell"):
        system._check_entry(Graph(), entry("other", "ur5e_1"))


def test_a_refused_file_converts_nothing(systems, monkeypatch, tmp_path):
    converted = []
    monkeypatch.setattr("mrlab_ros.client.connect.open_graph", Graph)
    monkeypatch.setattr(system, "_trajectory", lambda *given: converted.append(given))
    file = tmp_path / "cell.yaml"
    file.write_text(
        "name: cell\nmembers:\n"
        "  - {robot: ur5e_1, trajectory: a.mat}\n  - {robot: kuka_1, trajectory: b.mat}\n"
    )
    with refused(NO_ROBOT_IN_SCENE, Misuse, robot="kuka_1"):
        system.create(file)
    assert not converted


def test_a_member_without_a_trajectory_keeps_what_its_robot_has_loaded(tmp_path):
    assert system._trajectory(None, tmp_path, MemberEntry("ur5e_1")) == ""
