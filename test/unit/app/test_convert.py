"""Which JSON is a trajectory file of the lab, and which one a student's data."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from mrlab_ros.adapters import share
from mrlab_ros.adapters.robots.library import RobotLibrary
from mrlab_ros.adapters.trajectories import formats
from mrlab_ros.app.convert import converted, held_to_robot, is_trajectory_file
from mrlab_ros.core.conversion.options import Options


@pytest.mark.parametrize(
    ("name", "content", "lab"),
    [
        ("a.json", '{"schema_version": "1.0"}', True),
        ("a.json", '{"q": [[0]], "schema_version": "1.0"}', True),
        ("a.json", '{"q": [[0]]}', False),
        ("a.json", "", True),
        ("a.csv", '{"schema_version": "1.0"}', False),
    ],
)
def test_a_trajectory_file_names_its_schema(
    tmp_path: Path, name: str, content: str, lab: bool
) -> None:
    file = tmp_path / name
    file.write_text(content)
    assert is_trajectory_file(file) is lab


def test_a_students_json_is_converted_as_any_other_file(tmp_path: Path) -> None:
    file = tmp_path / "mine.json"
    rows = [[i / 100, -1.5, 1.5, -1.5, -1.5, 0] for i in range(60)]
    file.write_text(json.dumps({"q": rows, "fs": 100}))
    library = RobotLibrary(share.directory() / "robots")
    found = converted(file, "ur5e", "", Options(), library)
    assert found.trajectory is not None, found.message
    assert found.trajectory.positions.tolist() == rows


def test_a_written_trajectory_is_read_with_its_warnings_and_says_each_once(tmp_path: Path) -> None:
    file, written = tmp_path / "mine.json", tmp_path / "fast.json"
    rows = [[i * 0.04, -1.5, 1.5, -1.5, -1.5, 0] for i in range(60)]
    file.write_text(json.dumps({"q": rows, "fs": 100}))
    library = RobotLibrary(share.directory() / "robots")
    first = converted(file, "ur5e", "", Options(), library)
    assert first.trajectory is not None
    formats.write(first.trajectory, written)
    again = held_to_robot(converted(written, "", "", Options(), library), library)
    codes = [one.code for one in again.diagnostics]
    assert sorted(set(codes)) == sorted(codes)
    assert "velocity_limit" in codes
