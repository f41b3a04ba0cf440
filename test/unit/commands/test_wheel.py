"""Commands of an installed wheel, where neither ROS 2 nor the lab's messages are."""

from __future__ import annotations

import sys

import pytest
from typer.testing import CliRunner

from mrlab_ros import cli
from mrlab_ros.core.base.errors import LabError


@pytest.mark.parametrize("name", ["rclpy", "mrlab_msgs.msg", "builtin_interfaces"])
def test_a_command_that_needs_ros_says_how_to_get_it(name: str) -> None:
    found = cli.without_graph(ModuleNotFoundError(f"No module named '{name}'", name=name))
    assert (found.code, found.values["package"]) == ("needs_ros", name.partition(".")[0])


def test_another_module_that_is_missing_is_named() -> None:
    found = cli.without_graph(ModuleNotFoundError("No module named 'h5py'", name="h5py"))
    assert (found.code, found.values["error"]) == (
        "module_not_installed",
        "No module named 'h5py'",
    )


def test_help_lists_what_cannot_run_here(monkeypatch: pytest.MonkeyPatch) -> None:
    # None there makes an import fail as that of a module that is not installed.
    monkeypatch.setitem(sys.modules, "mrlab_ros.commands.status.command", None)
    monkeypatch.setattr(cli, "COMMANDS", {k: cli.COMMANDS[k] for k in ("keys", "status")})
    said = CliRunner().invoke(cli.make_app(), ["--help"])
    assert said.exit_code == 0
    assert "Needs ROS 2" in said.stdout
    with pytest.raises(ModuleNotFoundError):
        cli.make_app(["status"])


@pytest.mark.parametrize(
    ("error", "code"),
    [
        (LabError("the motion is no verdict"), 1),
        (ZeroDivisionError("a bug"), 3),
        (ModuleNotFoundError("No module named 'pybullet'", name="pybullet"), 3),
        (KeyboardInterrupt(), 130),
    ],
)
def test_an_error_of_the_program_is_no_verdict(
    error: BaseException, code: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    def broken(_: object) -> None:
        raise error

    monkeypatch.setattr(cli, "make_app", broken)
    for name in ("guard", "keep_to_installed_modules"):
        monkeypatch.setattr(cli, name, lambda: None)
    monkeypatch.setattr(cli.signal, "signal", lambda *_: None)
    monkeypatch.setattr(sys, "argv", ["mrlab", "check"])
    with pytest.raises(SystemExit) as ended:
        cli.main()
    assert ended.value.code == code
