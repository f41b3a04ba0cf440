"""The last pose of a robot survives whatever ends the process that writes it."""

from __future__ import annotations

import math
import os
import signal
import struct
import subprocess
import sys
from pathlib import Path

import pytest

from mrlab_ros.adapters.pose_file import PoseFile

WRITER = """
import sys
from pathlib import Path
from mrlab_ros.adapters.pose_file import PoseFile
file = PoseFile(Path(sys.argv[1]), 3)
number = 0
while True:
    number += 1
    file.put(number / 100, [number, 2 * number, 3 * number])
    if number in (1, 2000):
        print(number, flush=True)
"""


def test_a_new_file_holds_nothing_and_an_old_one_what_was_put_last(tmp_path: Path) -> None:
    path = tmp_path / "state" / "ur5e_1.pose"
    file = PoseFile(path, 2)
    assert file.get() is None
    file.put(1.5, [0.1, -0.2])
    file.put(1.51, [0.11, -0.21])
    file.close()
    assert path.stat().st_mode & 0o777 == 0o600
    assert PoseFile(path, 2).get() == (1.51, [0.11, -0.21])


@pytest.mark.parametrize("count", [1, 7])
def test_what_was_written_by_half_is_not_taken(tmp_path: Path, count: int) -> None:
    path = tmp_path / "ur5e_1.pose"
    PoseFile(path, 2).put(1.5, [0.1, -0.2])
    with path.open("r+b") as file:
        file.write(struct.pack("@Q", count))
    torn = PoseFile(path, 2)
    assert torn.get() is None
    torn.put(1.5, [0.1, -0.2])
    assert torn.get() == (1.5, [0.1, -0.2])


def test_a_file_of_more_joints_that_were_never_written_is_no_pose(tmp_path: Path) -> None:
    path = tmp_path / "ur5e_1.pose"
    PoseFile(path, 1).put(1.5, [math.nan])
    assert PoseFile(path, 1).get() is None


def test_a_killed_process_leaves_its_last_pose_whole(tmp_path: Path) -> None:
    path = tmp_path / "ur5e_1.pose"
    command = (sys.executable, "-c", WRITER, str(path))
    with subprocess.Popen(command, stdout=subprocess.PIPE) as writer:
        assert writer.stdout is not None
        assert [int(writer.stdout.readline()) for _ in range(2)] == [1, 2000]
        os.kill(writer.pid, signal.SIGKILL)
    found = PoseFile(path, 3).get()
    # It may have been killed in the middle of a write.
    if found is not None:
        position, joints = found
        number = round(position * 100)
        assert number >= 2000
        assert joints == [number, 2 * number, 3 * number]
