"""What the Tab key completes, as the scripts of the shells ask for it."""

from __future__ import annotations

import json
import os
import subprocess
import sys

import pytest

from mrlab_ros.commands import completion
from mrlab_ros.processes.run_file import RunFile


@pytest.mark.parametrize(
    ("environment", "words"),
    [
        ({}, None),
        ({"_MRLAB_COMPLETE": "source_bash"}, None),
        ({"COMP_WORDS": "mrlab pl", "COMP_CWORD": "1"}, []),
        ({"COMP_WORDS": "mrlab play u", "COMP_CWORD": "2"}, ["play"]),
        ({"COMP_WORDS": "mrlab play ", "COMP_CWORD": "2"}, ["play"]),
        ({"_TYPER_COMPLETE_ARGS": "mrlab pl"}, []),
        ({"_TYPER_COMPLETE_ARGS": "mrlab play "}, ["play"]),
        ({"_TYPER_COMPLETE_ARGS": "mrlab play u"}, ["play"]),
    ],
)
def test_the_command_is_known_from_the_shell(monkeypatch, environment, words):
    if environment and "_MRLAB_COMPLETE" not in environment:
        environment = {**environment, "_MRLAB_COMPLETE": "complete_any"}
    for name, value in environment.items():
        monkeypatch.setenv(name, value)
    assert completion.words() == words


def asked(line: str) -> list[str]:
    """Return what bash is told to offer for the last word of a line."""
    words = line.split(" ")
    code = """
import sys
from mrlab_ros import cli
try:
    cli.main()
finally:
    slow = {"rclpy", "numpy", "zenoh"} & set(sys.modules)
    assert not slow, slow
"""
    done = subprocess.run(
        [sys.executable, "-c", code],
        env={
            **os.environ,
            "_MRLAB_COMPLETE": "complete_bash",
            "COMP_WORDS": line,
            "COMP_CWORD": str(len(words) - 1),
        },
        capture_output=True,
        text=True,
        timeout=60,
    )
    assert not done.stderr
    return done.stdout.split()


@pytest.fixture
def lab(monkeypatch, tmp_path):
    """A lab with a robot and a system, as its files say."""
    monkeypatch.setenv("XDG_RUNTIME_DIR", str(tmp_path))
    monkeypatch.setenv("MRLAB_ROBOTS", str(tmp_path / "robots"))
    monkeypatch.setenv("ROS_DOMAIN_ID", "7")
    scene = {"robots": [{"name": "ur5e_1"}, {"name": "kr_1"}], "systems": [{"name": "cell"}]}
    (tmp_path / "scene.json").write_text(json.dumps(scene))
    run_file = RunFile(7)
    run_file.claim(state_dir=str(tmp_path))
    yield tmp_path
    run_file.release()


def test_names_are_offered_without_ros(lab):
    assert asked("mrlab re") == ["remove", "resume", "record", "replay"]
    assert asked("mrlab play u") == ["ur5e_1"]
    assert asked("mrlab system play ") == ["cell"]
    # Files are the shell's own.
    assert asked("mrlab convert q") == []


def test_models_and_tools_are_offered_with_the_imported_ones(lab):
    (lab / "robots" / "ur_mine").mkdir(parents=True)
    (lab / "robots" / "ur_mine" / "robot.yaml").touch()
    assert completion.models("ur") == ["ur5e", "ur_mine"]
    assert completion.tools("vac") == ["vacuum_cup"]
    assert completion.robots("") == ["kr_1", "ur5e_1"]


@pytest.mark.parametrize("domain", ["8", "none"])
def test_without_a_lab_nothing_is_offered(lab, monkeypatch, domain):
    monkeypatch.setenv("ROS_DOMAIN_ID", domain)
    assert completion.robots("") == []


@pytest.mark.slow
def test_what_a_shell_needs_is_installed_where_it_looks(tmp_path):
    mrlab = f"{sys.executable} -m mrlab_ros.cli"
    # Not as its last command: bash would become what it runs, and not be found above it.
    options = ("--install-completion", "--show-completion")
    script = "; ".join([*(f"{mrlab} {option}" for option in options), ". ~/.bashrc"])
    done = subprocess.run(
        ["bash", "-c", f"{script} && complete -p mrlab"],
        env={**os.environ, "HOME": str(tmp_path)},
        capture_output=True,
        text=True,
        timeout=60,
    )
    assert done.returncode == 0, done.stderr
    assert "bash completion installed in" in done.stdout
    shown, _, known = done.stdout.partition("complete -o default -F _mrlab_completion mrlab")
    assert "_MRLAB_COMPLETE=complete_bash" in shown
    assert "complete -o default -F _mrlab_completion mrlab" in known
