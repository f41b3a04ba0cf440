"""Frames that arrive over zenoh in a demo, compared with the file."""

from __future__ import annotations

from typing import Any

from mrlab_ros.messages.time import time_from_message


class Arrivals:
    """Payloads that arrive over zenoh on one robot's joint_states, in order."""

    def __init__(self, session: Any, robot: str) -> None:
        self.key = f"{robot}/joint_states"
        self.payloads: list[bytes] = []
        self.bytes = 0
        self._subscriber = session.declare_subscriber(self.key, self._take)

    def _take(self, sample: Any) -> None:
        payload = sample.payload.to_bytes()
        self.payloads.append(payload)
        self.bytes += len(payload)


def frames_in_order(
    payloads: list[bytes], trajectory: Any, start_ns: int
) -> tuple[int, list[str]]:
    """Count the source frames among `payloads`; say what is wrong with their order or values.

    A frame counts once, when its stamp is its deadline and its positions are the trajectory's
    own, bit for bit. `start_ns` is the deadline of frame 0.
    """
    import numpy as np
    from rclpy.serialization import deserialize_message
    from sensor_msgs.msg import JointState

    from mrlab_ros.messages import trajectories

    source = trajectories.trajectory_from_message(trajectory)
    expected, found, wrong = 0, 0, []
    for payload in payloads:
        message = deserialize_message(payload, JointState)
        share = (time_from_message(message.header.stamp) - start_ns) * 1e-9 * source.frame_rate
        frame = round(share)
        if not 0 <= frame < source.frame_count or abs(share - frame) > 1e-3:
            continue
        if frame != expected:
            wrong.append(f"frame {frame} came where frame {expected} was due")
        positions = np.array(message.position[: len(source.joint_names)])
        if not np.array_equal(positions, source.positions[frame]):
            wrong.append(f"frame {frame} has other positions than the file")
        elif frame >= expected:
            found += 1
        expected = max(expected, frame + 1)
    return found, wrong
