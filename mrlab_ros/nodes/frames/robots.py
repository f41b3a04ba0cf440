"""The robots whose frames are published, and their newest joint positions."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from mrlab_ros.adapters.robots import urdf
from mrlab_ros.core.base.clock import SECOND
from mrlab_ros.core.base.geometry import Array, Pose
from mrlab_ros.core.robots.frames import WORLD, LinkFrames
from mrlab_ros.messages import joint_states
from mrlab_ros.messages.poses import TransformsEncoder


@dataclass(eq=False)
class ShownRobot:
    """A robot whose frames are published.

    base: T_world_base. description: its published URDF, empty until it arrived. positions: rad or
    m by joint. placed: whether a joint state of its arm has come. stamp_ns: of the newest joint
    state; sent_ns: of the one that was published last. subscriptions: what is destroyed with it.
    """

    name: str
    joint_names: tuple[str, ...]
    base: Pose
    description: str = ""
    frames: LinkFrames | None = None
    positions: dict[str, float] = field(default_factory=dict)
    placed: bool = False
    stamp_ns: int = 0
    sent_ns: int = 0
    subscriptions: list[Any] = field(default_factory=list)

    def describe(self, text: str) -> None:
        """Take the robot's URDF; raise BadInput where it is none."""
        self.frames = urdf.frames(urdf.parse(text, self.name), self.name)
        self.description = text
        self.sent_ns = 0

    def take_arm(self, data: bytes) -> None:
        """Take a joint state of the arm, CDR; raise BadInput where it is none."""
        stamp_ns, positions, _ = joint_states.read(data, self.joint_names)
        self.stamp_ns, self.placed = stamp_ns, True
        self.positions.update(zip(self.joint_names, positions, strict=True))

    def take_fingers(self, stamp_ns: int, positions: Mapping[str, float]) -> None:
        self.stamp_ns = max(self.stamp_ns, stamp_ns)
        self.positions.update(positions)

    @property
    def moved(self) -> bool:
        """Whether there is something new to publish. tf2 warns of a stamp that comes twice."""
        # A stamp from before the last one: the lab's clock was set back, or went back in a loop.
        return self.stamp_ns > self.sent_ns or self.sent_ns - self.stamp_ns > SECOND

    def fixed(self) -> list[tuple[str, str, Pose]]:
        """Return what never moves while the robot stands where it does: (parent, child, pose)."""
        if self.frames is None:
            return []
        return [
            (WORLD, self.frames.root, self.base),
            *((frame.parent, frame.child, frame.pose) for frame in self.frames.fixed),
        ]


class Batch:
    """One message with the frames of all robots that moved."""

    def __init__(self) -> None:
        self._encoders: dict[tuple[tuple[str, str], ...], TransformsEncoder] = {}

    def message(self, robots: Mapping[str, ShownRobot]) -> bytes | None:
        """Return the frames of the robots with a new joint state, as CDR; None: there are none.

        Each robot's frames have the stamp of its joint state.
        """
        pairs: list[tuple[str, str]] = []
        stamps: list[Array] = []
        values: list[Array] = []
        for robot in robots.values():
            frames = robot.frames
            if frames is None or not (robot.placed and robot.moved and frames.moving):
                continue
            robot.sent_ns = robot.stamp_ns
            pairs.extend(frames.moving)
            stamps.append(np.full(len(frames.moving), robot.stamp_ns, dtype=np.int64))
            values.append(frames.at(robot.positions))
        if not pairs:
            return None
        key = tuple(pairs)
        encoder = self._encoders.get(key)
        if encoder is None:
            # Another set of robots moves now; the last few sets are remembered.
            if len(self._encoders) >= 8:
                self._encoders.clear()
            encoder = self._encoders[key] = TransformsEncoder(pairs)
        return encoder.encode(np.concatenate(stamps), np.concatenate(values))
