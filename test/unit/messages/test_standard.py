"""The interfaces that are built beside the lab's are those of the distribution, by their hashes.

A type's hash (REP 2011) covers names, types and order of its fields and of all that they hold.
Publishers and subscribers whose hashes differ are different types to each other.
"""

from __future__ import annotations

import json
from pathlib import Path

import pytest
from ament_index_python.packages import get_package_share_directory

# As of 22 November 2026.
HASHES = {
    # In rosbag2 metadata and `ros2 topic info -v` of Jazzy that people published.
    "tf2_msgs/msg/TFMessage": "e369d0f05a23ae52508854b66f6aa0437f3449d652e8cbf22d5abe85d020f087",
    # In a published build of ros-controls/control_msgs: what rosidl generated from it.
    "control_msgs/action/FollowJointTrajectory": (
        "738ebcb7a2d7cfa42f9f1001cc99ce3a4383d1cfe508015d9be8485e4b1c66f6"
    ),
    "control_msgs/action/FollowJointTrajectory_Goal": (
        "8a9060704b269608f5a340934cc26e66869dd14bdac29e2e7fd9ec8b9882d205"
    ),
    "control_msgs/action/FollowJointTrajectory_Result": (
        "8002e99ed2c14c6faa522f2a93c26d744c5982f254f9e98ff9c6f19789bdb220"
    ),
    # No published value was found for these two; the goal's hash above covers both.
    "control_msgs/msg/JointTolerance": (
        "c254f9cece0f3b733017b6990fd46d1326e25242d6b8844398c97d9a88e7d648"
    ),
    "control_msgs/msg/JointComponentTolerance": (
        "739ea7566931944d33830fa10f1bf5e7a7fbdc3172bce7a7eaac642bd6e3ffa4"
    ),
}


@pytest.mark.parametrize("name", HASHES)
def test_the_hash_is_the_distribution_s(name: str) -> None:
    package, folder, kind = name.split("/")
    file = kind.split("_")[0]
    path = Path(get_package_share_directory(package)) / folder / f"{file}.json"
    found = {t["type_name"]: t["hash_string"] for t in json.loads(path.read_text())["type_hashes"]}
    assert found[name] == f"RIHS01_{HASHES[name]}"
