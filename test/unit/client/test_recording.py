"""What robots did, as a table: read from the bag that the recorder wrote."""

from __future__ import annotations

import sys
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import pytest
from builtin_interfaces.msg import Time
from rclpy.serialization import serialize_message
from refusals import refused
from sensor_msgs.msg import JointState
from std_msgs.msg import Header

from mrlab_ros.adapters.bags.diagnostics import NO_BAG
from mrlab_ros.adapters.bags.writer import BagWriter
from mrlab_ros.client.recording import Recording
from mrlab_ros.core.recording.metadata import Topic
from mrlab_ros.messages.definitions import definition

START_NS = 10**18


def test_a_table_has_a_column_a_joint_and_a_row_a_state(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    writer = BagWriter(tmp_path / "class", definition)
    robots = {"ur5e_1": ["pan", "lift"], "kr6_1": ["a1"]}
    for robot in robots:
        writer.add_topic(Topic(f"/{robot}/joint_states", "sensor_msgs/msg/JointState", ""))
    for step in range(3):
        for late, (robot, joints) in enumerate(robots.items()):
            now = START_NS + step * 10**7 + late * 10**6
            stamp = Time(sec=now // 10**9, nanosec=now % 10**9)
            state = JointState(
                header=Header(stamp=stamp), name=joints, position=[step + late] * len(joints)
            )
            writer.write(f"/{robot}/joint_states", now, serialize_message(state), now)
    writer.close()
    graph: Any = None
    made = SimpleNamespace(
        DataFrame=lambda rows, index, columns: (rows, index), Index=lambda values, name: values
    )
    monkeypatch.setitem(sys.modules, "pandas", made)
    rows, times = Recording(graph, str(tmp_path / "class")).to_dataframe()
    assert rows[:3] == [
        {"ur5e_1/pan": 0, "ur5e_1/lift": 0},
        {"kr6_1/a1": 1},
        {"ur5e_1/pan": 1, "ur5e_1/lift": 1},
    ]
    assert times == pytest.approx([1e9 + 0.01 * k + 0.001 * n for k in range(3) for n in (0, 1)])
    with refused(NO_BAG):
        Recording(graph, str(tmp_path / "gone")).to_dataframe()
