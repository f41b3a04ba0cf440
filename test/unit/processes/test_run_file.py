"""The folder of run files: on a machine with other users it is this user's, or another one."""

from __future__ import annotations

import os
import stat
from pathlib import Path

import pytest

from mrlab_ros.core.base.errors import Unavailable
from mrlab_ros.processes.run_file import RunFile, domains, folder

NAME = f"mrlab-{os.getuid()}"
VICTIM = "what the victim has"


@pytest.fixture
def shared(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Return a folder that all users write into, as /tmp, where no run folder is given."""
    shared = tmp_path / "tmp"
    shared.mkdir()
    shared.chmod(0o1777)
    monkeypatch.delenv("XDG_RUNTIME_DIR", raising=False)
    monkeypatch.setenv("XDG_STATE_HOME", str(tmp_path / "state"))
    monkeypatch.setattr("tempfile.gettempdir", lambda: str(shared))
    (tmp_path / "victim").write_text(VICTIM)
    return shared


def mode(path: Path) -> int:
    return stat.S_IMODE(path.lstat().st_mode)


def claimed(domain: int = 7) -> RunFile:
    run_file = RunFile(domain)
    run_file.claim(state_dir="")
    return run_file


def test_all_is_of_the_user_alone(shared: Path) -> None:
    run_file = claimed()
    assert (run_file.folder, run_file.not_usual) == (shared / NAME, "")
    assert mode(shared / NAME) == 0o700
    assert {mode(path) for path in (shared / NAME).iterdir()} == {0o600}
    assert domains() == [7]
    run_file.release()


def plant_link(shared: Path) -> None:
    (shared / "theirs").mkdir()
    (shared / NAME).symlink_to(shared / "theirs")


def plant_file(shared: Path) -> None:
    (shared / NAME).write_text("")


def plant_open(shared: Path) -> None:
    (shared / NAME).mkdir()
    (shared / NAME).chmod(0o777)


def open_parent(shared: Path) -> None:
    shared.chmod(0o777)


@pytest.mark.parametrize("plant", [plant_link, plant_file, plant_open, open_parent])
def test_what_others_could_have_made_is_not_used(shared: Path, plant) -> None:
    plant(shared)
    for name in ("domain-7.new", "domain-7.json", "domain-7.lock"):
        for planted in (shared / "theirs", shared / NAME):
            if planted.is_dir() and not (planted / name).is_symlink():
                (planted / name).symlink_to(shared.parent / "victim")
    run_file = claimed()
    assert run_file.folder == shared.parent / "state" / NAME
    assert str(shared) in run_file.not_usual
    assert RunFile(7).socket == str(shared.parent / "state" / NAME / "domain-7.sock")
    assert (shared.parent / "victim").read_text() == VICTIM
    run_file.release()


def test_the_folder_of_another_user_is_not_used(
    shared: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (shared / NAME).mkdir(mode=0o700)
    lstat = Path.lstat

    def of_another(path: Path) -> os.stat_result:
        found = [*lstat(path)]
        if path == shared / NAME:
            found[stat.ST_UID] += 1
        return os.stat_result(found)

    monkeypatch.setattr(Path, "lstat", of_another)
    found, why = folder()
    assert found == shared.parent / "state" / NAME
    assert "another user" in why


def test_links_within_are_not_followed(shared: Path) -> None:
    (shared / NAME).mkdir(mode=0o700)
    (shared / NAME / "domain-7.lock").symlink_to(shared.parent / "victim")
    with pytest.raises(OSError, match="domain-7"):
        claimed()
    (shared / NAME / "domain-7.lock").unlink()
    (shared / NAME / "domain-7.json").symlink_to(shared.parent / "victim")
    run_file = claimed()
    assert (shared.parent / "victim").read_text() == VICTIM
    run_file.release()


def test_without_any_folder_it_says_what_to_set(
    shared: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    plant_file(shared)
    (shared.parent / "state").write_text("no folder")
    with pytest.raises(Unavailable, match="XDG_RUNTIME_DIR"):
        folder()
