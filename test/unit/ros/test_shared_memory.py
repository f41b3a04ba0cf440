"""What a killed process left of Fast DDS's shared memory goes, and nothing else."""

import os
import time

import pytest

from mrlab_ros.ros.shared_memory import LONGEST_S, remove_abandoned

FINISHED, BEGUN = b"\2\0\0\0" + bytes(60), b"\1\0\0\0" + bytes(60)


def segment(folder, name, content, age):
    path = folder / name
    path.write_bytes(content)
    made = time.time() - age
    os.utime(path, (made, made))
    return path


@pytest.mark.parametrize("content", [b"", BEGUN, bytes(64)])
def test_a_segment_that_nobody_finishes_goes(tmp_path, content):
    segment(tmp_path, "fastrtps_port7001", content, LONGEST_S + 1)
    assert remove_abandoned(tmp_path) == ["fastrtps_port7001"]
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize(
    ("name", "content", "age"),
    [
        ("fastrtps_port7411", FINISHED, 1000),
        ("fastrtps_port7411", b"", 0),  # being made
        ("fastrtps_port7411_el", b"", 1000),  # a lock is always empty
        ("sem.fastrtps_port7411_mutex", b"", 1000),
        ("fastrtps_0123456789abcdef", b"", 1000),
        ("41267.zenoh", b"", 1000),
    ],
)
def test_what_others_use_stays(tmp_path, name, content, age):
    path = segment(tmp_path, name, content, age)
    assert remove_abandoned(tmp_path) == []
    assert path.read_bytes() == content


def test_a_folder_that_is_not_there_is_no_error(tmp_path):
    assert remove_abandoned(tmp_path / "none") == []
