"""Counts self-collisions over random poses: `self_collision.py [--poses N] [ID ...]`.

Prints one row per robot and pair of links: in how many poses their hulls touch, and in how many of
a sample of these poses the visual bodies touch as well.
"""

from __future__ import annotations

import argparse
import tempfile
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pybullet
from numpy.typing import NDArray
from scipy.spatial import cKDTree

from mrlab_ros.adapters.robots import urdf
from mrlab_ros.adapters.robots.drawing import Assembly
from mrlab_ros.adapters.robots.hulls import inside, samples
from mrlab_ros.adapters.robots.library import RobotLibrary

ROOT = Path(__file__).resolve().parents[2]
SAMPLED_POSES = 6  # of a pair, in which the bodies are compared
MOST_POINTS = 150  # of a body that are tested against another
Pair = tuple[str, str]
Array = NDArray[np.float64]


def touching_poses(
    library: RobotLibrary, robot: str, poses: Array
) -> Iterator[tuple[int, frozenset[Pair]]]:
    """Yield the number of each pose in which links that are not neighbours touch, and the pairs.

    poses: (N, J) rad.
    """
    allowed = library.touching_links(robot)
    engine = pybullet.connect(pybullet.DIRECT)
    folder = tempfile.TemporaryDirectory()
    path = Path(folder.name) / f"{robot}.urdf"
    try:
        path.write_text(library.collision_description(robot))
        flags = pybullet.URDF_USE_SELF_COLLISION | pybullet.URDF_USE_INERTIA_FROM_FILE
        body = pybullet.loadURDF(str(path), useFixedBase=True, flags=flags, physicsClientId=engine)
        count = pybullet.getNumJoints(body, physicsClientId=engine)
        infos = [pybullet.getJointInfo(body, n, physicsClientId=engine) for n in range(count)]
        names = [pybullet.getBodyInfo(body, physicsClientId=engine)[0].decode()]
        names += [info[12].decode() for info in infos]
        joints = {info[1].decode(): info[0] for info in infos}
        for a in range(count + 1):
            for b in range(a):
                if frozenset((names[a], names[b])) in allowed:
                    pybullet.setCollisionFilterPair(
                        body, body, a - 1, b - 1, 0, physicsClientId=engine
                    )
        moving = [joints[name] for name in library.model(robot).joint_names]
        for number, pose in enumerate(poses):
            for joint, position in zip(moving, pose, strict=True):
                pybullet.resetJointState(body, joint, position, physicsClientId=engine)
            pybullet.performCollisionDetection(physicsClientId=engine)
            contacts = pybullet.getContactPoints(body, body, physicsClientId=engine)
            pairs = {
                tuple(sorted((names[contact[3] + 1], names[contact[4] + 1])))
                for contact in contacts
                if contact[8] < 0
            }
            if pairs:
                yield number, frozenset(pairs)
    finally:
        pybullet.disconnect(engine)
        folder.cleanup()


def random_poses(library: RobotLibrary, robot: str, count: int) -> Array:
    """Return poses, (count, J) rad, spread evenly over the ranges of all joints."""
    joints = library.model(robot).joints
    low, high = [joint.lower for joint in joints], [joint.upper for joint in joints]
    return np.random.default_rng(5).uniform(low, high, (count, len(joints)))


class Bodies:
    """The visual bodies of a robot."""

    def __init__(self, library: RobotLibrary, robot: str) -> None:
        self.names = library.model(robot).joint_names
        root = urdf.parse(library.description(robot), robot)
        self.robot = Assembly(root, robot, library.mesh_path)

    def distance(self, pair: Pair, pose: Array) -> float:
        """Return the distance between the bodies of two links, m; 0 where they touch."""
        if self.touch(pair, pose):
            return 0.0
        one, other = (samples(faces, 0.01) for faces in self._placed(pair, pose))
        # No point is nearer to the other body than to the box around that.
        few = one[:: len(one) // MOST_POINTS + 1]
        most = float(cKDTree(few).query(other[:: len(other) // MOST_POINTS + 1])[0].min())
        one = one[_near_box(one, other, most)]
        other = other[_near_box(other, one, most)]
        return float(cKDTree(one).query(other)[0].min())

    def _placed(self, pair: Pair, pose: Array) -> list[Array]:
        self.robot.move(dict(zip(self.names, pose, strict=True)))
        faces: dict[str, list[Array]] = {name: [] for name in pair}
        for link, mesh, at in self.robot.meshes():
            if link in faces:
                faces[link].append(np.asarray(mesh.triangles) @ at[:3, :3].T + at[:3, 3])
        return [np.concatenate(faces[name]) for name in pair]

    def touch(self, pair: Pair, pose: Array) -> bool:
        """Return whether the bodies of two links overlap at a pose, (J,) rad."""
        one, other = self._placed(pair, pose)
        for a, b in ((one, other), (other, one)):
            points = a.mean(axis=1)
            low, high = b.min(axis=(0, 1)), b.max(axis=(0, 1))
            points = points[((points > low) & (points < high)).all(axis=1)]
            points = points[:: len(points) // MOST_POINTS + 1]
            if len(points) and inside(b, points).any():
                return True
        return False


def _near_box(points: Array, others: Array, most: float) -> NDArray[np.bool_]:
    """Return which points lie within `most`, m, of the box around the others."""
    low, high = others.min(axis=0) - most, others.max(axis=0) + most
    return np.asarray(((points >= low) & (points <= high)).all(axis=1))


def main() -> None:
    """Count for the robots named on the command line, or for all."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("robots", nargs="*")
    parser.add_argument("--poses", type=int, default=10_000)
    arguments = parser.parse_args()
    library = RobotLibrary(ROOT / "robots", ROOT / "robots" / "none imported")
    for robot in arguments.robots or library.ids():
        poses = random_poses(library, robot, arguments.poses)
        found: dict[Pair, list[int]] = {}
        bad = 0
        for number, pairs in touching_poses(library, robot, poses):
            bad += 1
            for pair in pairs:
                found.setdefault(pair, []).append(number)
        print(f"{robot}: {bad} of {len(poses)} poses", flush=True)
        bodies = Bodies(library, robot)
        for pair, numbers in sorted(found.items(), key=lambda item: -len(item[1])):
            sampled = numbers[:: len(numbers) // SAMPLED_POSES + 1]
            real = sum(bodies.touch(pair, poses[number]) for number in sampled)
            print(
                f"  {pair[0]} {pair[1]}: {len(numbers)}; bodies in {real} of {len(sampled)}",
                flush=True,
            )


if __name__ == "__main__":
    main()
