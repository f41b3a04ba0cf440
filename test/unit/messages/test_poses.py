"""Transforms written past rclpy are what rclpy writes, but for the bytes between the fields."""

from __future__ import annotations

import numpy as np
import pytest
from rclpy.serialization import deserialize_message, serialize_message
from tf2_msgs.msg import TFMessage

from mrlab_ros.core.base.geometry import Pose
from mrlab_ros.messages.poses import TransformsEncoder, transforms_to_message

FRAMES = [("world", "a/base_link"), ("a/base_link", "a/link_1"), ("b", "bcd/l")]


@pytest.mark.parametrize("count", [1, 2, 3])
def test_the_encoder_writes_what_rclpy_writes(count: int) -> None:
    frames = FRAMES[:count]
    encoder = TransformsEncoder(frames)
    for stamp in (0, 1_700_000_000_123_456_789):
        values = np.arange(count * 7, dtype=np.float64).reshape(count, 7)
        values[:, 3:] = (0.5, -0.5, 0.5, 0.5)
        data = encoder.encode(np.full(count, stamp, dtype=np.int64), values)
        poses = [Pose(tuple(row[:3]), tuple(row[3:])) for row in values.tolist()]
        expected = transforms_to_message(
            stamp, [(*pair, pose) for pair, pose in zip(frames, poses, strict=True)]
        )
        assert len(data) == len(serialize_message(expected))
        assert deserialize_message(data, TFMessage) == expected


def test_each_transform_has_its_own_stamp() -> None:
    encoder = TransformsEncoder(FRAMES)
    data = encoder.encode(np.array([1, 2, 3_000_000_004]), np.zeros((3, 7)))
    stamps = [t.header.stamp for t in deserialize_message(data, TFMessage).transforms]
    assert [(s.sec, s.nanosec) for s in stamps] == [(0, 1), (0, 2), (3, 4)]
