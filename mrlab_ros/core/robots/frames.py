"""The frames of a robot's links, as tf2 has them: each link in its parent's frame.

A frame is named by robot and link, `ur5e_1/tool0`, so that robots of one model stay apart. The
robot's published URDF has the same names, for links only: its joints are told apart by the
namespace in which their states are published. Where joints of all robots meet, they are named by
robot, too.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from mrlab_ros.core.base.geometry import Array, Pose

WORLD = "world"


def frame_name(robot: str, link: str) -> str:
    """Return the name of the frame of a robot's link."""
    return f"{robot}/{link}"


def joint_name(robot: str, joint: str) -> str:
    """Return the name of a robot's joint among those of all robots.

    Not as frames are: ros2_control and MoveIt take what follows a `/` for an interface.
    """
    return f"{robot}_{joint}"


def without_frames(urdf: str, robot: str) -> str:
    """Return a published URDF with the plain names of its links, as contacts name them."""
    return urdf.replace(f'="{robot}/', '="')


@dataclass(frozen=True)
class FixedFrame:
    """A link that never moves in its parent's frame."""

    parent: str
    child: str
    pose: Pose


@dataclass(frozen=True)
class MovingFrame:
    """A link behind a moving joint.

    origin: the joint's frame in the parent's at position 0. axis: unit vector in the joint's
    frame. joint: whose position moves it, as position * multiplier + offset.
    """

    parent: str
    child: str
    origin: Pose
    axis: tuple[float, float, float]
    prismatic: bool
    joint: str
    multiplier: float = 1.0
    offset: float = 0.0


class LinkFrames:
    """The frames of one robot's links.

    root: the frame of its first link; fixed: those that never move; moving: (parent, child) of
    the others, in the order of at(). joints: those that move, but for what follows another.
    """

    def __init__(
        self, root: str, fixed: Sequence[FixedFrame], moving: Sequence[MovingFrame]
    ) -> None:
        self.root = root
        self.fixed = tuple(fixed)
        self.moving = tuple((frame.parent, frame.child) for frame in moving)
        self._joints = [frame.joint for frame in moving]
        self.joints = tuple(dict.fromkeys(self._joints))
        self._multipliers = np.array([frame.multiplier for frame in moving])
        self._offsets = np.array([frame.offset for frame in moving])
        self._prismatic = np.array([frame.prismatic for frame in moving], dtype=bool)
        self._axes = np.array([frame.axis for frame in moving]).reshape(-1, 3)
        self._places = np.array([frame.origin.position for frame in moving]).reshape(-1, 3)
        turns = np.array([frame.origin.orientation for frame in moving]).reshape(-1, 4)
        self._turns = turns
        # Each joint's axis as its parent sees it, along which a prismatic one moves.
        self._ways = _rotated(turns, self._axes)

    def at(self, positions: Mapping[str, float]) -> Array:
        """Return x y z (m) and the quaternion x y z w of each moving frame in its parent, (M, 7).

        positions: rad or m by joint; a joint without one stands at 0.
        """
        given = np.array([positions.get(joint, 0.0) for joint in self._joints])
        values = given * self._multipliers + self._offsets
        half = np.where(self._prismatic, 0.0, values / 2)
        turned = np.empty((len(values), 4))
        turned[:, :3] = self._axes * np.sin(half)[:, None]
        turned[:, 3] = np.cos(half)
        ways = np.where(self._prismatic, values, 0.0)
        found = np.empty((len(values), 7))
        found[:, :3] = self._places + self._ways * ways[:, None]
        found[:, 3:] = _product(self._turns, turned)
        return found


def _product(a: Array, b: Array) -> Array:
    """Return the products of quaternions (M, 4), x y z w."""
    (ax, ay, az, aw), (bx, by, bz, bw) = a.T, b.T
    return np.stack(
        [
            aw * bx + ax * bw + ay * bz - az * by,
            aw * by - ax * bz + ay * bw + az * bx,
            aw * bz + ax * by - ay * bx + az * bw,
            aw * bw - ax * bx - ay * by - az * bz,
        ],
        axis=1,
    )


def _rotated(turns: Array, vectors: Array) -> Array:
    """Return vectors (M, 3) turned by unit quaternions (M, 4)."""
    pure = np.hstack([vectors, np.zeros((len(vectors), 1))])
    back = turns * np.array([-1.0, -1.0, -1.0, 1.0])
    return _product(_product(turns, pure), back)[:, :3]
