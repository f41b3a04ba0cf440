"""Where ROS logs on a machine whose home cannot be written."""

from __future__ import annotations

import os
from pathlib import Path

import pytest

from mrlab_ros.ros import log_folder


@pytest.fixture(autouse=True)
def surroundings(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.delenv("ROS_LOG_DIR", raising=False)
    monkeypatch.delenv("ROS_HOME", raising=False)
    monkeypatch.setattr("tempfile.gettempdir", lambda: str(tmp_path / "temporary"))


def test_a_home_that_can_be_written_is_kept(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setenv("HOME", str(tmp_path))
    log_folder.prepare()
    assert "ROS_LOG_DIR" not in os.environ
    assert (tmp_path / ".ros" / "log").is_dir()
    assert capsys.readouterr().err == ""


@pytest.mark.parametrize("variable", ["HOME", "ROS_HOME", "ROS_LOG_DIR"])
def test_a_folder_that_cannot_be_made_is_named_with_what_takes_its_place(
    variable: str,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    (tmp_path / "file").touch()
    monkeypatch.setenv("ROS_LOG_DIR", "")  # so that what prepare() sets is taken back
    monkeypatch.setenv(variable, str(tmp_path / "file" / "home"))
    log_folder.prepare()
    instead = tmp_path / "temporary" / f"mrlab-{os.getuid()}" / "log"
    assert os.environ["ROS_LOG_DIR"] == str(instead)
    assert instead.is_dir()
    assert f"not into {tmp_path / 'file' / 'home'}" in capsys.readouterr().err
    log_folder.prepare()
    assert capsys.readouterr().err == ""


def test_without_the_variable_of_the_home_it_is_that_of_the_user(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setenv("ROS_LOG_DIR", "")
    monkeypatch.delenv("HOME")
    monkeypatch.setattr(Path, "home", lambda: tmp_path / "anna")
    log_folder.prepare()
    assert os.environ["ROS_LOG_DIR"] == str(tmp_path / "anna" / ".ros" / "log")
    assert capsys.readouterr().err == ""


def test_a_user_without_a_home_has_the_temporary_folder(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    def nobody() -> Path:
        raise RuntimeError("Could not determine home directory.")

    monkeypatch.setenv("ROS_LOG_DIR", "")
    monkeypatch.delenv("HOME")
    monkeypatch.setattr(Path, "home", nobody)
    log_folder.prepare()
    assert os.environ["ROS_LOG_DIR"].startswith(str(tmp_path / "temporary"))
    assert "this user has no home" in capsys.readouterr().err
