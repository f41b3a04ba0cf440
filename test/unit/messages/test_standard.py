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
    # Computed when these fields were compared with those of the branches for Jazzy.
    "control_msgs/msg/JointTrajectoryControllerState": (
        "51d8dd89cc624cbe9daaeeb4d80d6de9b86168ffdc3be41fefc0953e3c26e480"
    ),
    "control_msgs/srv/QueryTrajectoryState": (
        "4a0935dffef18bc5b9e101c9d03d84e681ecd4cebd724b8f11fde008751a325a"
    ),
    "controller_manager_msgs/msg/ChainConnection": (
        "2daecd1da4b171f48b291c79747657a651eb1ab8821b68e38b1c88c736bba91c"
    ),
    "controller_manager_msgs/msg/ControllerState": (
        "9a8780ab9814b6032978a07c6c7033cf1a7894ac8d948a6fb72afea07b04cc83"
    ),
    "controller_manager_msgs/srv/ListControllers": (
        "4f8e36bb1fa5afdeba45c2d56ae6a2097b1493a253f961dd6290c085033bd189"
    ),
    "controller_manager_msgs/srv/ListControllerTypes": (
        "873e8d2bb81b8b5903ca736d299ba959f929efec4b4a18d17354b8b322822e05"
    ),
    "controller_manager_msgs/srv/LoadController": (
        "e37f7596c50c88cf8cb7a10cd376ff7579850cc63b5e787e9c8f11981f9ab4d2"
    ),
    "controller_manager_msgs/srv/UnloadController": (
        "4055728e84c041348648d7f808c6681562000e3a9ce9fbb42c3350df25773f16"
    ),
    "controller_manager_msgs/srv/ReloadControllerLibraries": (
        "485cd0040f8a343a9596155b967363e1bc715f034bbb111f795c73d9d8056a9b"
    ),
    "controller_manager_msgs/srv/SwitchController": (
        "d4ad10aa5da7808bc522d55d4123d8ef79de73d049d165639d7663ac37cc9895"
    ),
}


@pytest.mark.parametrize("name", HASHES)
def test_the_hash_is_the_distribution_s(name: str) -> None:
    package, folder, kind = name.split("/")
    file = kind.split("_")[0]
    path = Path(get_package_share_directory(package)) / folder / f"{file}.json"
    found = {t["type_name"]: t["hash_string"] for t in json.loads(path.read_text())["type_hashes"]}
    assert found[name] == f"RIHS01_{HASHES[name]}"
