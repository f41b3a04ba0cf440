"""What a lab says about physics where pybullet is not installed."""

from __future__ import annotations

import importlib.machinery
import importlib.util
import subprocess
import sys

import pytest
from refusals import refused

from mrlab_ros.adapters.bullet import support
from mrlab_ros.core.base.errors import BadInput
from mrlab_ros.processes import physics_support
from mrlab_ros.processes.child_process import WRONG_CONFIGURATION
from mrlab_ros.processes.diagnostics import NO_PHYSICS

# An interpreter that finds everything but pybullet.
WITHOUT = """
import importlib.machinery as machinery
found = machinery.PathFinder.find_spec
machinery.PathFinder.find_spec = lambda name, *rest: None if name == "pybullet" else found(
    name, *rest
)
"""


def test_physics_is_what_was_chosen_where_it_is_installed():
    assert support.missing() is None
    assert physics_support.wanted(True) == (True, None)
    assert physics_support.wanted(False) == (False, None)
    assert physics_support.wanted(None) == (True, None)


def test_without_pybullet_physics_is_refused_or_left_out_in_words(monkeypatch):
    monkeypatch.setattr(importlib.util, "find_spec", lambda name: None)
    with refused(NO_PHYSICS, BadInput):
        physics_support.wanted(True)
    assert physics_support.wanted(False) == (False, None)
    on, why = physics_support.wanted(None)
    assert not on
    assert why.code == "runs_without_physics"


@pytest.mark.slow
def test_the_node_and_the_command_end_with_the_same_sentence():
    node = "from mrlab_ros.processes import host\nhost.main(['physics'])"
    command = (
        "import sys\nfrom mrlab_ros import cli\n"
        "sys.argv[1:] = ['up', '--physics', '--no-web']\ncli.main()"
    )
    for code, status in ((node, WRONG_CONFIGURATION), (command, 1)):
        done = subprocess.run(
            [sys.executable, "-c", WITHOUT + code],
            capture_output=True,
            text=True,
            timeout=60,
            check=False,
        )
        assert done.returncode == status
        assert "pybullet is not installed for this Python" in done.stderr
        assert "Traceback" not in done.stderr
