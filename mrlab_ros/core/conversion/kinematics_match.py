"""Compares a robot that a file holds with the robot that was chosen.

A workspace often holds the robot its motion was made for: a SerialLink of Corke's toolbox (or the
same as a struct, or an array of its links) or a rigidBodyTree. Both are read as chains of joints
and compared with the chosen robot's chain. Where the robot stands and what tool it holds do not
count: the axes of its joints are compared, and then the flange's positions at some poses.
"""

from __future__ import annotations

import re
from dataclasses import dataclass
from itertools import combinations
from typing import Any

import numpy as np

from mrlab_ros.core.base.diagnostic import Diagnostic
from mrlab_ros.core.base.geometry import Array, inverse_transform
from mrlab_ros.core.conversion.diagnostics import KINEMATICS_AGREE, KINEMATICS_DIFFER
from mrlab_ros.core.conversion.workspace import Variable, Workspace
from mrlab_ros.core.robots.model import KinematicChain, RobotModel, Segment

AGREES_M, AGREES_RAD = 0.01, np.radians(1.0)
MOST_JOINTS = 32
POSES = 24
# a chain that is longer is taken as written in mm
LONGEST_M = 30.0
LINK = re.compile(r"(?P<links>.+)[({](?P<number>\d+)[)}]\.alpha$")
BODY = re.compile(r"(?P<tree>.+)\.Bodies\{(?P<number>\d+)\}\.Joint\.Type$")
Z = np.array([0.0, 0.0, 1.0])


@dataclass(frozen=True, eq=False)
class FileRobot:
    """A robot in a file. path: of the variable; name: what the file calls it, may be empty."""

    path: str
    name: str
    chain: KinematicChain


@dataclass(frozen=True)
class Match:
    """How far two chains differ, at the worst of the poses. distance: m; angle: rad."""

    distance: float
    angle: float

    @property
    def agrees(self) -> bool:
        return self.distance <= AGREES_M and self.angle <= AGREES_RAD


def findings(workspace: Workspace, robot: RobotModel) -> list[Diagnostic]:
    """Say whether the robots in the file are the chosen one; nothing where the file has none."""
    found = robots_in(workspace)
    if not found:
        return []
    compared = [(match(one.chain, robot), one) for one in found]
    for agreement, one in compared:
        if agreement is not None and agreement.agrees:
            return [KINEMATICS_AGREE(model=robot.id, distance=agreement.distance, **_who(one))]
    fitting = [(m, one) for m, one in compared if m is not None]
    if fitting:
        best, one = min(fitting, key=lambda pair: pair[0].distance)
        away: dict[str, Any] = {"distance": best.distance, "angle": best.angle}
        return [KINEMATICS_DIFFER(model=robot.id, **away, **_who(one))]
    one = found[0]
    joints: dict[str, Any] = {"count": one.chain.joint_count, "joints": len(robot.joints)}
    return [KINEMATICS_DIFFER(model=robot.id, **joints, **_who(one))]


def _who(one: FileRobot) -> dict[str, Any]:
    return {"variable": one.path, "title": one.name}


def match(chain: KinematicChain, robot: RobotModel) -> Match | None:
    """Compare a chain with a robot; None where it has other joints.

    The base and the tool of `chain` are free. Joints behind the last one of the robot count as a
    gripper where they are prismatic.
    """
    joints = len(robot.joints)
    moving = [segment for segment in chain.segments if segment.axis is not None]
    theirs = [segment.prismatic for segment in moving]
    ours = [segment.prismatic for segment in robot.chain.segments if segment.axis is not None]
    if theirs[:joints] != ours or not all(theirs[joints:]):
        return None
    if len(moving) > joints:
        last = [i for i, s in enumerate(chain.segments) if s.axis is not None][joints]
        chain = KinematicChain(chain.base, chain.segments[:last])
    chain = _in_metres(chain)
    to_file = _aligned(axes(robot.chain), axes(chain), theirs[:joints])
    lower = np.array([joint.lower for joint in robot.joints])
    upper = np.array([joint.upper for joint in robot.joints])
    shares = np.random.default_rng(1).random((POSES, joints))
    poses = np.vstack([np.zeros(joints), robot.home, lower + shares * (upper - lower)])
    at_robot = to_file @ robot.chain.tool0(poses)
    at_file = chain.tool0(poses)
    flange = inverse_transform(at_file[0]) @ at_robot[0]
    at_file = at_file @ flange
    distances = np.linalg.norm(at_file[:, :3, 3] - at_robot[:, :3, 3], axis=1)
    turns = np.einsum("nji,njk->nik", at_file[:, :3, :3], at_robot[:, :3, :3])
    # |R - I| of a rotation by an angle is 2 sqrt(2) sin(angle / 2)
    sines = np.linalg.norm(turns - np.eye(3), axis=(1, 2)) / np.sqrt(8)
    angles = 2 * np.arcsin(np.clip(sines, 0, 1))
    return Match(float(distances.max()), float(angles.max()))


def axes(chain: KinematicChain) -> list[tuple[Array, Array]]:
    """Return the axis of each joint at position 0 in the base's frame: direction, point on it."""
    found = []
    pose = np.eye(4)
    for segment in chain.segments:
        pose = pose @ segment.T_parent_joint
        if segment.axis is not None:
            found.append((pose[:3, :3] @ segment.axis, pose[:3, 3]))
    return found


def _aligned(
    ours: list[tuple[Array, Array]], theirs: list[tuple[Array, Array]], prismatic: list[bool]
) -> Array:
    """Return the transform that lays our axes onto theirs best, in the sense of least squares.

    The rotation is that of Kabsch (1976) for the directions of the axes and for their common
    normals, which decide where all axes are parallel. The translation brings the axes of the
    revolute joints together; an axis of a prismatic joint has no place.
    """
    turning = [i for i, slides in enumerate(prismatic) if not slides]
    pairs = [(ours[i][0], theirs[i][0]) for i in range(len(ours))]
    for i, j in combinations(turning, 2):
        pairs.append((_normal(ours[i], ours[j]), _normal(theirs[i], theirs[j])))
    covariance = sum((np.outer(b, a) for a, b in pairs), np.zeros((3, 3)))
    left, _, right = np.linalg.svd(covariance)
    turn = left @ np.diag([1.0, 1.0, np.linalg.det(left @ right)]) @ right
    rows, targets = [], []
    for i in turning:
        direction, point = theirs[i]
        across = np.eye(3) - np.outer(direction, direction)
        rows.append(across)
        targets.append(across @ (point - turn @ ours[i][1]))
    laid = np.eye(4)
    laid[:3, :3] = turn
    if rows:
        laid[:3, 3] = np.linalg.lstsq(np.vstack(rows), np.concatenate(targets))[0]
    return laid


def _normal(first: tuple[Array, Array], second: tuple[Array, Array]) -> Array:
    """Return the shortest way from one line to another, (3,) m."""
    (u, p), (v, q) = first, second
    cross = np.cross(u, v)
    square = float(cross @ cross)
    if square < 1e-12:
        return np.asarray((q - p) - u * float(u @ (q - p)))
    return np.asarray(cross * float(cross @ (q - p)) / square)


def _in_metres(chain: KinematicChain) -> KinematicChain:
    """Return the chain, with its lengths divided by 1000 where they are too long for an arm."""
    length = sum(float(np.linalg.norm(s.T_parent_joint[:3, 3])) for s in chain.segments)
    if not length > LONGEST_M:
        return chain
    segments = []
    for segment in chain.segments:
        pose = segment.T_parent_joint.copy()
        pose[:3, 3] /= 1e3
        segments.append(Segment(segment.link, pose, segment.axis, segment.prismatic))
    return KinematicChain(chain.base, tuple(segments))


# reading chains from variables


def robots_in(workspace: Workspace) -> list[FileRobot]:
    """Return the robots of a file: those with two joints or more whose parts are all there."""
    parts = {v.path: v for v in workspace.variables}
    links: dict[str, list[int]] = {}
    bodies: dict[str, list[int]] = {}
    for path in parts:
        if found := LINK.match(path):
            links.setdefault(found["links"], []).append(int(found["number"]))
        elif found := BODY.match(path):
            bodies.setdefault(found["tree"], []).append(int(found["number"]))
    robots = []
    for place, numbers in links.items():
        chain = _serial_link(parts, place, sorted(numbers))
        if chain is not None:
            path = re.sub(r"\.links?$", "", place)
            robots.append(FileRobot(path, _text(parts, f"{path}.name"), chain))
    for path, numbers in bodies.items():
        chain = _rigid_body_tree(parts, path, sorted(numbers))
        if chain is not None:
            robots.append(FileRobot(path, "", chain))
    return [one for one in robots if 2 <= one.chain.joint_count <= MOST_JOINTS]


def _serial_link(
    parts: dict[str, Variable], place: str, numbers: list[int]
) -> KinematicChain | None:
    """Return the chain of links with Denavit-Hartenberg parameters, None where one is missing.

    Standard: Rz(theta) Tz(d) Tx(a) Rx(alpha). Modified (mdh): Rx(alpha) Tx(a) Rz(theta) Tz(d),
    as in Craig's book. Corke: the joint's position, negated where `flip`, and `offset` are added
    to theta, or to d where prismatic.
    """
    if numbers != list(range(1, len(numbers) + 1)):
        return None
    segments = []
    robot = re.sub(r"\.links?$", "", place)
    before = _matrix(parts, f"{robot}.base")
    for number in numbers:
        link = f"{place}({number})"
        if f"{link}.alpha" not in parts:
            link = f"{place}{{{number}}}"
        alpha = _number(parts, f"{link}.alpha")
        a = _number(parts, f"{link}.a", f"{link}.A")
        d = _number(parts, f"{link}.d", f"{link}.D")
        theta = _number(parts, f"{link}.theta") or 0.0
        offset = _number(parts, f"{link}.offset") or 0.0
        kind = _text(parts, f"{link}.jointtype")
        sigma = _number(parts, f"{link}.sigma")
        slides = kind == "P" if kind else bool(sigma)
        if slides:
            d = d or 0.0
        if alpha is None or a is None or d is None or not (kind or sigma is not None):
            return None
        modified = bool(_number(parts, f"{link}.mdh", f"{robot}.mdh"))
        flipped = _text(parts, f"{link}.flip") == "true"
        twist = _turned(0, alpha) @ _moved(a, 0, 0)
        if slides:
            joint = _turned(2, theta) @ _moved(0, 0, offset)
            behind = np.eye(4)
        else:
            joint = _turned(2, offset)
            behind = _moved(0, 0, d)
        if modified:
            joint = twist @ joint
        else:
            behind = behind @ twist
        axis = -Z if flipped else Z
        segments.append(Segment(f"link{number}", before @ joint, axis, slides))
        before = behind
    tool = _matrix(parts, f"{robot}.tool")
    return KinematicChain("base", (*segments, Segment("tool", before @ tool)))


def _rigid_body_tree(
    parts: dict[str, Variable], path: str, numbers: list[int]
) -> KinematicChain | None:
    """Return the branch of a rigidBodyTree with the most moving joints."""
    parents = {n: int(_number(parts, f"{path}.Bodies{{{n}}}.ParentIndex") or 0) for n in numbers}
    kinds = {n: _text(parts, f"{path}.Bodies{{{n}}}.Joint.Type") for n in numbers}
    if any(parent >= n or (parent and parent not in parents) for n, parent in parents.items()):
        return None
    branches: dict[int, list[int]] = {0: []}
    for n in numbers:
        branches[n] = [*branches[parents[n]], n]
    branch = max(branches.values(), key=lambda b: (sum(kinds[n] != "fixed" for n in b), -len(b)))
    segments = []
    before = np.eye(4)
    for n in branch:
        joint = f"{path}.Bodies{{{n}}}.Joint"
        before = before @ _matrix(parts, f"{joint}.JointToParentTransform")
        behind = _matrix(parts, f"{joint}.ChildToJointTransform")
        if kinds[n] == "fixed":
            before = before @ behind
            continue
        axis = parts.get(f"{joint}.JointAxis")
        if kinds[n] not in ("revolute", "prismatic") or axis is None or axis.values is None:
            return None
        direction = np.asarray(axis.values, np.float64).reshape(-1)
        length = float(np.linalg.norm(direction))
        if direction.shape != (3,) or not 0.5 < length < 2:
            return None
        slides = kinds[n] == "prismatic"
        segments.append(Segment(f"body{n}", before, direction / length, slides))
        before = behind
    return KinematicChain("base", (*segments, Segment("tip", before)))


def _number(parts: dict[str, Variable], *paths: str) -> float | None:
    """Return the first of these that is one finite number, None where none is."""
    for path in paths:
        found = parts.get(path)
        if found is not None and found.values is not None and found.values.size == 1:
            value = float(np.asarray(found.values).reshape(-1)[0])
            if np.isfinite(value):
                return value
    return None


def _text(parts: dict[str, Variable], path: str) -> str:
    found = parts.get(path)
    return found.text if found is not None else ""


def _matrix(parts: dict[str, Variable], path: str) -> Array:
    """Return a transform, (4, 4); the identity where it is not given or is none."""
    found = parts.get(path)
    if found is None or found.values is None or found.values.shape != (4, 4):
        return np.eye(4)
    pose = np.array(found.values, np.float64)
    turn = pose[:3, :3]
    rigid = np.isfinite(pose).all() and np.allclose(turn @ turn.T, np.eye(3), atol=1e-4)
    return pose if rigid and np.linalg.det(turn) > 0 else np.eye(4)


def _turned(axis: int, angle: float) -> Array:
    """Return a rotation about x (0) or z (2) by `angle` rad."""
    pose = np.eye(4)
    i, j = {0: (1, 2), 2: (0, 1)}[axis]
    cos, sin = np.cos(angle), np.sin(angle)
    pose[i, i], pose[i, j], pose[j, i], pose[j, j] = cos, -sin, sin, cos
    return pose


def _moved(x: float, y: float, z: float) -> Array:
    pose = np.eye(4)
    pose[:3, 3] = x, y, z
    return pose
