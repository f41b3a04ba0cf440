"""The physics engine port on pybullet.

Bullet ends the process on bad input, so everything is checked before it is called. An arm is a
multibody whose prescribed links weigh so much that no contact moves them; its joints are put in
place before every step, with their velocities, so that what it hits gets the right impulse.
Gravity acts on the objects alone: it would pull the arms' velocities off between two steps. What
a hand holds is led with it in the same way.
"""

from __future__ import annotations

import contextlib
import math
import os
import sys
import tempfile
import xml.etree.ElementTree as ET
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np
import pybullet

from mrlab_ros.adapters import urdf
from mrlab_ros.core.errors import BadInput, Misuse
from mrlab_ros.core.kinematics import Array
from mrlab_ros.core.physics.engine import (
    Arm,
    Body,
    Finger,
    FingerState,
    Kind,
    Motion,
    Part,
    Shape,
    Touch,
)
from mrlab_ros.core.physics.poses import Vector, add, compose, cross, relative, subtract
from mrlab_ros.core.scene import Pose

GRAVITY = 9.80665  # m/s^2, the standard value
PRESCRIBED_MASS = 1e6  # kg, and kg*m^2, of every link that joint states lead
LINK_SIZE = 0.15  # m, what a link reaches beyond its frame
LEAST_MASS = 0.05  # kg, of a finger without an <inertial>
# Bullet multiplies the coefficients of both bodies, so 1 leaves it to the object.
NEUTRAL = 1.0
FINGER_FRICTION = 1.5
MESH_FORMATS = (".obj", ".stl")
FINGER_VELOCITY = 0.1  # m/s or rad/s, where the description has none
FINGER_FORCE = 50.0  # N or N*m, where the description has none
ALL_GROUPS = 0xFFFF
STATIC_GROUP = 2  # Bullet's own collision group of what never moves
# Fingers press no harder, N or N*m: what they hold is fixed to the hand, and a light thing
# between hard fingers would jitter.
PRESS = 15.0
RAY = 100.0  # m, how far down support is looked for
SOLVER_ITERATIONS = 30


@dataclass
class _Arm:
    body: int
    facts: Arm
    joints: list[int]
    fingers: list[int]
    links: dict[int, str]
    index: dict[str, int]
    moving: list[int]
    ignored: set[tuple[int, int]]
    positions: list[float]
    coupled: bool
    driven: bool = False
    last: Array = field(default_factory=lambda: np.zeros((0, 3)))


class BulletEngine:
    """Implements mrlab_ros.core.physics.engine.Engine.

    resolve: turns a package:// URI into a path. One engine is one world of its own.
    """

    def __init__(self, resolve: Callable[[str], Path], gravity: float = GRAVITY) -> None:
        self._resolve = resolve
        self._gravity = gravity
        self._client = pybullet.connect(pybullet.DIRECT)
        if self._client < 0:
            raise Misuse("pybullet has no room for another world; close one first")
        self._duration = math.nan
        self._call("setGravity", 0.0, 0.0, 0.0)
        self._call(
            "setPhysicsEngineParameter",
            numSolverIterations=SOLVER_ITERATIONS,
            deterministicOverlappingPairs=1,
        )
        self._arms: dict[str, _Arm] = {}
        self._objects: dict[str, int] = {}
        self._weights: dict[int, float] = {}
        self._surfaces: dict[str, int] = {}
        self._names: dict[int, tuple[Kind, str]] = {}
        self._held: dict[str, tuple[str, str, Pose]] = {}

    def _call(self, function: str, *arguments: Any, **named: Any) -> Any:
        return getattr(pybullet, function)(*arguments, physicsClientId=self._client, **named)

    def close(self) -> None:
        if self._client >= 0:
            pybullet.disconnect(self._client)
            self._client = -1

    # arms -----------------------------------------------------------------------------------

    def add_arm(self, name: str, description: str, joints: tuple[str, ...], pose: Pose) -> Arm:
        """Load an arm; raise BadInput where a joint or a mesh of its URDF is missing."""
        if name in self._arms:
            raise Misuse(f"arm '{name}' is in the world already; remove it first")
        origin = f"the description of {name}"
        root = urdf.parse(description, origin)
        tree = _Tree(root, joints, origin)
        self._prepare(root, tree)
        with tempfile.NamedTemporaryFile("w", suffix=".urdf") as file, _silent():
            file.write(ET.tostring(root, encoding="unicode"))
            file.flush()
            body = self._call(
                "loadURDF",
                file.name,
                pose.position,
                pose.orientation,
                useFixedBase=True,
                flags=pybullet.URDF_USE_SELF_COLLISION | pybullet.URDF_USE_INERTIA_FROM_FILE,
            )
        names = {-1: tree.base}
        joint_index: dict[str, int] = {}
        for i in range(self._call("getNumJoints", body)):
            info = self._call("getJointInfo", body, i)
            names[i] = info[12].decode()
            joint_index[info[1].decode()] = i
        index = {link: i for i, link in names.items()}
        arm = _Arm(
            body=body,
            facts=tree.facts(),
            joints=[joint_index[j] for j in joints],
            fingers=[joint_index[f.joint] for f in tree.fingers],
            links=names,
            index=index,
            moving=[i for i in names if names[i] not in tree.fixed_links],
            ignored=set(),
            positions=[0.0] * len(joints),
            coupled=tree.coupled,
        )
        driven = arm.joints + arm.fingers
        self._call(
            "setJointMotorControlArray",
            body,
            driven,
            pybullet.VELOCITY_CONTROL,
            forces=[0.0] * len(driven),
        )
        for i in names:
            friction = FINGER_FRICTION if i in arm.fingers else NEUTRAL
            self._call(
                "changeDynamics",
                body,
                i,
                lateralFriction=friction,
                restitution=NEUTRAL,
                linearDamping=0.0,
                angularDamping=0.0,
                jointDamping=0.0,
                maxJointVelocity=1000.0,
            )
        self._arms[name] = arm
        self._names[body] = (Kind.ROBOT, name)
        for link in tree.fixed_links:
            # As Bullet does with everything static: the base stands on the floor for good.
            others = ALL_GROUPS & ~STATIC_GROUP
            self._call("setCollisionFilterGroupMask", body, index[link], STATIC_GROUP, others)
        for pair in tree.neighbours():
            self._ignore(arm, index[pair[0]], index[pair[1]])
        self._ignore_permanent(arm)
        return arm.facts

    def _prepare(self, root: ET.Element, tree: _Tree) -> None:
        """Leave what the engine needs: masses, collision shapes with paths, no visuals."""
        for joint in root.iterfind("joint"):
            for mimic in joint.findall("mimic"):
                joint.remove(mimic)
        for link in root.iterfind("link"):
            for element in link.findall("visual"):
                link.remove(element)
            _weigh(link, link.get("name") not in tree.finger_links)
            for mesh in link.iter("mesh"):
                uri = mesh.get("filename", "")
                path = self._resolve(uri)
                if path.suffix.lower() not in MESH_FORMATS or not path.is_file():
                    raise BadInput(
                        f"the collision mesh {uri} of link '{link.get('name')}' is missing or of "
                        f"no format that physics reads ({', '.join(MESH_FORMATS)}); generate the "
                        "robot's meshes again"
                    )
                mesh.set("filename", os.fspath(path))

    def _ignore(self, arm: _Arm, a: int, b: int) -> None:
        arm.ignored |= {(a, b), (b, a)}
        self._call("setCollisionFilterPair", arm.body, arm.body, a, b, 0)

    def _ignore_permanent(self, arm: _Arm) -> None:
        """Ignore pairs of links whose hulls overlap however the wrist and elbow are turned.

        Hulls are fatter than what they cover; a pair that overlaps in each of several poses far
        apart says nothing of a collision.
        """
        always: set[tuple[int, int]] | None = None
        for angle in (0.0, 0.35, -0.5, 0.8):
            self._pose(arm, [angle * (1 + 0.1 * k) for k in range(len(arm.joints))])
            found = {
                (p[3], p[4])
                for p in self._call("getClosestPoints", arm.body, arm.body, 0.0)
                if p[3] < p[4]
            }
            always = found if always is None else always & found
        self._pose(arm, [0.0] * len(arm.joints))
        for a, b in always or ():
            self._ignore(arm, a, b)

    def _pose(self, arm: _Arm, positions: list[float]) -> None:
        for joint, position in zip(arm.joints, positions, strict=True):
            self._call("resetJointState", arm.body, joint, position)

    def place_arm(self, name: str, pose: Pose) -> None:
        arm = self._arm(name)
        self._call("resetBasePositionAndOrientation", arm.body, pose.position, pose.orientation)
        # Bullet moves the links' shapes with the joints only.
        self._pose(arm, arm.positions)
        arm.last = self._points(arm)

    def remove_arm(self, name: str) -> None:
        arm = self._arm(name)
        for held, (holder, _, _) in list(self._held.items()):
            if holder == name:
                self.release(held)
        del self._arms[name], self._names[arm.body]
        self._call("removeBody", arm.body)

    def _arm(self, name: str) -> _Arm:
        try:
            return self._arms[name]
        except KeyError:
            raise Misuse(f"physics has no arm '{name}'; add it first") from None

    def move_arm(self, name: str, positions: Array, velocities: Array) -> None:
        arm = self._arm(name)
        q, v = positions.tolist(), velocities.tolist()
        if len(q) != len(arm.joints) or len(v) != len(arm.joints):
            raise BadInput(f"{len(q)} joint positions for {name}; expected {len(arm.joints)}")
        if not all(map(math.isfinite, q + v)):
            raise BadInput(f"the joint state of {name} is not finite: {q}, {v}")
        arm.positions = q
        self._call(
            "resetJointStatesMultiDof",
            arm.body,
            arm.joints,
            [(x,) for x in q],
            [(x,) for x in v],
        )

    def _points(self, arm: _Arm) -> Array:
        states = self._call("getLinkStates", arm.body, arm.moving, 0, 1)
        return np.array([s[4] for s in states])

    def travel(self, name: str) -> float:
        arm = self._arm(name)
        points = self._points(arm)
        if arm.last.shape != points.shape:
            arm.last = points
            return 0.0
        moved = (
            float(np.sqrt(((points - arm.last) ** 2).sum(axis=1).max())) if len(points) else 0.0
        )
        arm.last = points
        return moved

    def drive_fingers(self, name: str, velocities: Sequence[float]) -> None:
        arm = self._arm(name)
        if len(velocities) != len(arm.fingers) or not all(map(math.isfinite, velocities)):
            raise BadInput(
                f"finger velocities {list(velocities)} for {name}; expected {len(arm.fingers)}"
            )
        arm.driven = any(velocities)
        if arm.fingers:
            self._call(
                "setJointMotorControlArray",
                arm.body,
                arm.fingers,
                pybullet.VELOCITY_CONTROL,
                targetVelocities=list(velocities),
                forces=[min(f.max_force, PRESS) for f in arm.facts.fingers],
            )

    def set_fingers(self, name: str, positions: Sequence[float]) -> None:
        arm = self._arm(name)
        for joint, finger, position in zip(arm.fingers, arm.facts.fingers, positions, strict=True):
            if not finger.lower - 1e-3 <= position <= finger.upper + 1e-3:
                raise BadInput(
                    f"finger {finger.joint} at {position}; expected {finger.lower} to "
                    f"{finger.upper}"
                )
            self._call("resetJointState", arm.body, joint, position, 0.0)

    def fingers(self, name: str) -> tuple[FingerState, ...]:
        arm = self._arm(name)
        if not arm.fingers:
            return ()
        states = self._call("getJointStates", arm.body, arm.fingers)
        return tuple(FingerState(s[0], s[3]) for s in states)

    def link(self, arm: str, link: str) -> Motion:
        robot = self._arm(arm)
        if link not in robot.index:
            raise Misuse(f"{arm} has no link '{link}'; its links: {', '.join(robot.index)}")
        if robot.index[link] < 0:
            return Motion(Pose(*self._call("getBasePositionAndOrientation", robot.body)))
        state = self._call("getLinkState", robot.body, robot.index[link], 1, 1)
        return Motion(Pose(state[0], state[1]), state[6], state[7])

    def touches(self, name: str) -> list[Touch]:
        arm = self._arm(name)
        found = []
        # Bullet turns every contact so that the body asked for comes first.
        for p in self._call("getContactPoints", arm.body):
            # Bodies that press on each other may be a hair apart.
            if p[8] > 0.0 and p[9] <= 0.0:
                continue
            kind, other = self._names[p[2]]
            other_link = ""
            if kind is Kind.ROBOT:
                other_link = self._arms[other].links[p[4]]
                kind = Kind.SELF if p[2] == arm.body else Kind.ROBOT
            impulse = p[9] * self._duration
            found.append(
                Touch(
                    arm.links[p[3]], kind, other, other_link, p[5], p[7], max(-p[8], 0.0), impulse
                )
            )
        return found

    def distance(self, arm: str, kind: Kind, other: str, look: float) -> float:
        robot = self._arm(arm)
        known: dict[str, int] = {
            Kind.OBJECT: self._objects,
            Kind.SURFACE: self._surfaces,
            Kind.ROBOT: {n: a.body for n, a in self._arms.items()},
            Kind.SELF: {arm: robot.body},
        }[kind]
        if other not in known:
            return look
        nearest = look
        for p in self._call("getClosestPoints", robot.body, known[other], look):
            own = kind is Kind.SELF
            if own and (p[3] == p[4] or (p[3], p[4]) in robot.ignored):
                continue
            if own or p[3] in robot.moving:
                nearest = min(nearest, p[8])
        return nearest

    # objects and surfaces -------------------------------------------------------------------

    def add_object(self, name: str, body: Body, motion: Motion) -> None:
        if name in self._objects:
            raise Misuse(f"object '{name}' is in the world already; remove it first")
        self._objects[name] = self._make(body, motion.pose)
        self._names[self._objects[name]] = (Kind.OBJECT, name)
        if body.mass:
            self._weights[self._objects[name]] = body.mass * self._gravity
            self.set_object(name, motion)

    def remove_object(self, name: str) -> None:
        body = self._object(name)
        if name in self._held:
            self.release(name)
        del self._objects[name], self._names[body]
        self._weights.pop(body, None)
        self._call("removeBody", body)

    def _object(self, name: str) -> int:
        try:
            return self._objects[name]
        except KeyError:
            raise Misuse(f"physics has no object '{name}'; spawn it first") from None

    def object(self, name: str) -> Motion:
        body = self._object(name)
        pose = self._call("getBasePositionAndOrientation", body)
        return Motion(Pose(*pose), *self._call("getBaseVelocity", body))

    def set_object(self, name: str, motion: Motion) -> None:
        body = self._object(name)
        velocities = motion.linear + motion.angular
        if not all(abs(v) <= 1000 for v in velocities):
            raise BadInput(f"the velocity {velocities} of {name} is no speed; expected m/s, rad/s")
        pose = motion.pose
        self._call("resetBasePositionAndOrientation", body, pose.position, pose.orientation)
        self._call("resetBaseVelocity", body, motion.linear, motion.angular)

    def add_surface(self, name: str, body: Body, pose: Pose) -> None:
        if name in self._surfaces:
            raise Misuse(f"surface '{name}' is in the world already; remove it first")
        self._surfaces[name] = self._make(body, pose)
        self._names[self._surfaces[name]] = (Kind.SURFACE, name)

    def remove_surface(self, name: str) -> None:
        body = self._surfaces.pop(name)
        del self._names[body]
        self._call("removeBody", body)

    def _make(self, body: Body, pose: Pose) -> int:
        if not (math.isfinite(body.mass) and body.mass >= 0 and body.parts):
            raise BadInput(f"a body of {body.mass} kg with {len(body.parts)} parts; expected one")
        static = body.mass == 0
        shapes = [_shape(part, static) for part in body.parts]
        if len(shapes) == 1 and shapes[0].pop("collisionFramePosition") == (0.0, 0.0, 0.0):
            shapes[0].pop("collisionFrameOrientation")
            shape = self._call("createCollisionShape", **shapes[0])
        else:
            parts = [_shape(part, static) for part in body.parts]
            shape = self._compound(parts)
        if shape < 0:
            raise BadInput("pybullet made no shape of a body; check the sizes of its parts")
        made: int = self._call(
            "createMultiBody",
            body.mass,
            shape,
            -1,
            pose.position,
            pose.orientation,
            useMaximalCoordinates=True,
        )
        self._call(
            "changeDynamics",
            made,
            -1,
            lateralFriction=body.friction if body.mass else NEUTRAL,
            restitution=body.restitution if body.mass else NEUTRAL,
            rollingFriction=0.0005,
            spinningFriction=0.0005,
        )
        return made

    def _compound(self, parts: list[dict[str, Any]]) -> int:
        def column(key: str, default: Any) -> list[Any]:
            return [part.get(key, default) for part in parts]

        made: int = self._call(
            "createCollisionShapeArray",
            shapeTypes=column("shapeType", 0),
            halfExtents=column("halfExtents", [0.0, 0.0, 0.0]),
            radii=column("radius", 0.0),
            lengths=column("height", 0.0),
            collisionFramePositions=column("collisionFramePosition", (0.0, 0.0, 0.0)),
            collisionFrameOrientations=column("collisionFrameOrientation", (0.0, 0.0, 0.0, 1.0)),
        )
        return made

    # holding --------------------------------------------------------------------------------

    def hold(self, arm: str, link: str, name: str) -> None:
        robot, body = self._arm(arm), self._object(name)
        if name in self._held:
            self.release(name)
        hand, pose = self.link(arm, link).pose, self.object(name).pose
        self._held[name] = (arm, link, relative(hand, pose))
        self._let_touch(robot, body, False)

    def release(self, name: str) -> None:
        arm, _, _ = self._held.pop(name)
        self._let_touch(self._arm(arm), self._object(name), True)

    def _carry(self) -> None:
        """Put what is held where its hand is, moving with it: a constraint without any give."""
        for name, (arm, link, offset) in self._held.items():
            hand = self.link(arm, link)
            pose = compose(hand.pose, offset)
            way = subtract(pose.position, hand.pose.position)
            linear = add(hand.linear, cross(hand.angular, way))
            self.set_object(name, Motion(pose, linear, hand.angular))

    def _let_touch(self, arm: _Arm, body: int, touch: bool) -> None:
        for link in arm.links:
            self._call("setCollisionFilterPair", arm.body, body, link, -1, int(touch))

    # space and time -------------------------------------------------------------------------

    def below(self, point: Vector) -> float | None:
        x, y, z = point
        start, end = [(x, y, z)], [(x, y, z - RAY)]
        hits = self._call("rayTestBatch", start, end, collisionFilterMask=STATIC_GROUP)
        body, _, _, hit, _ = hits[0]
        return None if body < 0 else float(hit[2])

    def overlapping(self, low: Vector, high: Vector) -> set[str]:
        found = self._call("getOverlappingObjects", low, high) or ()
        names = (self._names[body] for body, _ in found if body in self._names)
        return {name for kind, name in names if kind is not Kind.SURFACE}

    def step(self, duration: float) -> None:
        if duration != self._duration:
            if not 1e-5 <= duration <= 0.1:
                raise BadInput(f"a step of {duration} s; expected 1e-5 to 0.1 s")
            self._duration = duration
            self._call("setTimeStep", duration)
        self._carry()
        client = self._client
        led = {self._objects[name] for name in self._held}
        for body, weight in self._weights.items():
            if body in led:
                continue
            at = pybullet.getBasePositionAndOrientation(body, client)[0]
            pybullet.applyExternalForce(
                body, -1, (0.0, 0.0, -weight), at, pybullet.WORLD_FRAME, client
            )
        pybullet.stepSimulation(client)
        for arm in self._arms.values():
            if arm.coupled and arm.driven:
                self._couple(arm)

    def _couple(self, arm: _Arm) -> None:
        """Keep fingers that one drive moves equally far closed."""
        states = self._call("getJointStates", arm.body, arm.fingers)
        position = sum(state[0] for state in states) / len(states)
        velocity = sum(state[1] for state in states) / len(states)
        for joint in arm.fingers:
            self._call("resetJointState", arm.body, joint, position, velocity)


class _Tree:
    """The links and joints of a description, sorted into prescribed, finger and fixed ones."""

    def __init__(self, root: ET.Element, joints: tuple[str, ...], origin: str) -> None:
        everything = urdf.joints(root, origin)
        named = {joint.name: joint for joint in everything}
        missing = [name for name in joints if name not in named or not named[name].moves]
        if missing:
            raise BadInput(
                f"{origin} has no moving joint {', '.join(missing)}; its joints: "
                f"{', '.join(named)}"
            )
        children = {joint.child for joint in everything}
        links = [str(link.get("name")) for link in root.iterfind("link")]
        roots = [link for link in links if link not in children]
        if len(roots) != 1:
            raise BadInput(f"{origin} has the root links {', '.join(roots)}; expected one")
        self.base = roots[0]
        self._by_name, self._prescribed = named, joints
        self.links = links
        self._parent = {joint.child: joint for joint in everything}
        fingers = [j for j in everything if j.moves and j.name not in joints]
        self.fingers = tuple(_finger(joint) for joint in fingers)
        self.coupled = len(fingers) > 1 and all(joint.mimic for joint in fingers[1:])
        self.finger_links = {joint.child for joint in fingers}
        self.fixed_links = {link for link in links if self._group(link) == self.base}
        tip = "tool0" if "tool0" in links else links[-1]
        self.tool_links = {link for link in links if tip in self._above(link)}
        shaped = {
            str(link.get("name"))
            for link in root.iterfind("link")
            if link.find("collision") is not None
        }
        if fingers:
            self.hand = fingers[0].parent
        else:
            self.hand = next((x for x in reversed(links) if x in self.tool_links & shaped), tip)

    def _above(self, link: str) -> list[str]:
        above = []
        while link in self._parent:
            link = self._parent[link].parent
            above.append(link)
        return above

    def _group(self, link: str) -> str:
        """Return the topmost link that `link` is rigidly fixed to."""
        while link in self._parent and not self._parent[link].moves:
            link = self._parent[link].parent
        return link

    def neighbours(self) -> Iterator[tuple[str, str]]:
        """Yield each pair of links that may overlap: one rigid group, or joined by one joint."""
        for i, a in enumerate(self.links):
            for b in self.links[i + 1 :]:
                ga, gb = self._group(a), self._group(b)
                joined = any(
                    x in self._parent and self._group(self._parent[x].parent) == y
                    for x, y in ((ga, gb), (gb, ga))
                )
                if ga == gb or joined or {ga, gb} <= self.finger_links:
                    yield a, b

    def _below(self, link: str) -> float:
        """Return the longest way down from `link`, m; a link itself counts a little."""
        ways = [
            math.hypot(*joint.xyz) + self._below(joint.child)
            for joint in self._parent.values()
            if joint.parent == link
        ]
        return max(ways, default=LINK_SIZE)

    def facts(self) -> Arm:
        return Arm(
            self.fingers,
            self.hand,
            frozenset(self.tool_links),
            frozenset(self.fixed_links),
            np.array([self._below(self._by_name[name].child) for name in self._prescribed]),
        )


def _finger(joint: urdf.UrdfJoint) -> Finger:
    limit = joint.limit or {}
    return Finger(
        joint.name,
        joint.child,
        limit.get("lower", 0.0),
        limit.get("upper", 0.0),
        limit.get("velocity", 0.0) or FINGER_VELOCITY,
        limit.get("effort", 0.0) or FINGER_FORCE,
    )


def _weigh(link: ET.Element, prescribed: bool) -> None:
    """Give a prescribed link a mass that nothing moves, a finger without a mass a small one."""
    inertial = link.find("inertial")
    if inertial is not None:
        if not prescribed:
            return
        link.remove(inertial)
    mass = PRESCRIBED_MASS if prescribed else LEAST_MASS
    moment = mass if prescribed else mass * 0.05**2
    inertial = ET.SubElement(link, "inertial")
    ET.SubElement(inertial, "mass", value=repr(mass))
    moments = dict.fromkeys(("ixx", "iyy", "izz"), repr(moment))
    ET.SubElement(inertial, "inertia", moments | dict.fromkeys(("ixy", "ixz", "iyz"), "0"))


def _shape(part: Part, static: bool) -> dict[str, Any]:
    """Return the arguments of createCollisionShape; raise BadInput where the part is no shape."""
    size = part.size
    counts = {Shape.BOX: 3, Shape.CYLINDER: 2, Shape.SPHERE: 1, Shape.HULL: 0, Shape.MESH: 0}
    if len(size) != counts[part.shape] or not all(1e-4 <= s <= 1000 for s in size):
        raise BadInput(
            f"a {part.shape.value} of size {size} m; expected {counts[part.shape]} numbers of "
            "0.0001 to 1000"
        )
    result: dict[str, Any] = {
        "collisionFramePosition": part.pose.position,
        "collisionFrameOrientation": part.pose.orientation,
    }
    if part.shape is Shape.BOX:
        result.update(shapeType=pybullet.GEOM_BOX, halfExtents=[s / 2 for s in size])
    elif part.shape is Shape.CYLINDER:
        result.update(shapeType=pybullet.GEOM_CYLINDER, radius=size[0], height=size[1])
    elif part.shape is Shape.SPHERE:
        result.update(shapeType=pybullet.GEOM_SPHERE, radius=size[0])
    else:
        vertices = part.vertices
        if vertices is None or len(vertices) < 3 or not np.isfinite(vertices).all():
            raise BadInput("a mesh without at least three finite vertices; expected (V, 3) m")
        result.update(shapeType=pybullet.GEOM_MESH, vertices=vertices.tolist())
        if part.shape is Shape.MESH:
            triangles = part.triangles
            if not static:
                raise BadInput("a hollow mesh cannot move; make it of convex parts")
            if triangles is None or not (
                len(triangles) and triangles.min() >= 0 and triangles.max() < len(vertices)
            ):
                raise BadInput("a mesh whose triangles name vertices it does not have")
            result.update(
                indices=triangles.ravel().tolist(), flags=pybullet.GEOM_FORCE_CONCAVE_TRIMESH
            )
    return result


@contextlib.contextmanager
def _silent() -> Iterator[None]:
    """Keep what Bullet prints while it loads out of the lab's output."""
    sys.stdout.flush()
    saved, nowhere = os.dup(1), os.open(os.devnull, os.O_WRONLY)
    try:
        os.dup2(nowhere, 1)
        yield
    finally:
        os.dup2(saved, 1)
        os.close(saved)
        os.close(nowhere)
