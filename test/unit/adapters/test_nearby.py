"""The file that was meant by a name that is not there."""

from __future__ import annotations

from pathlib import Path

from mrlab_ros.adapters.nearby import close_file


def test_the_closest_entry_of_the_folder_is_named(tmp_path: Path) -> None:
    for name in ("quintic_ur5e.mat", "notes.txt", ".quintic_ur5.mat.swp"):
        (tmp_path / name).touch()
    assert close_file(tmp_path / "quintic_ur5.mat") == "quintic_ur5e.mat"
    assert close_file(tmp_path / "other.csv") is None
    assert close_file(tmp_path / "nowhere" / "notes.txt") is None
