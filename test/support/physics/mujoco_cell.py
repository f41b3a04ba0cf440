"""The same robots, objects and motions in MuJoCo: servos drive the joints, friction holds."""

from __future__ import annotations

from dataclasses import dataclass

import mujoco
import numpy as np

from mrlab_ros.core.base.geometry import Pose
from mrlab_ros.core.physics.engine import Body, Part, Shape
from mrlab_ros.core.physics.grasp.kinds import PAD_FRICTION

STEP = 0.001  # s
# Servos of arm joints: N*m/rad, N*m*s/rad, and the inertia of their rotors, kg*m^2.
STIFF, DAMPED, ROTOR = 1e5, 900.0, 1.0
ARM, OBJECT, FLOOR = 2, 1, 4
COMPILER = (
    '<mujoco><compiler discardvisual="true" strippath="false" fusestatic="false" '
    'balanceinertia="true" boundmass="1e-5" boundinertia="1e-8"/></mujoco>'
)


@dataclass(frozen=True, eq=False)
class Replayed:
    """A robot and its motion. urdf: with paths of meshes; positions: (N, J) rad at `rate` Hz, in
    order of `joints`; closed: (N,) bool; fingers: the joint, and those that follow it 1:1."""

    name: str
    urdf: str
    pose: Pose
    joints: tuple[str, ...]
    positions: np.ndarray
    closed: np.ndarray
    fingers: tuple[str, ...]
    friction: float
    rate: float = 100.0


class Oracle:
    """A world in MuJoCo. objects: name, body and pose of each."""

    def __init__(self, robots: list[Replayed], objects: list[tuple[str, Body, Pose]]) -> None:
        spec = mujoco.MjSpec()
        spec.option.timestep = STEP
        spec.option.cone = mujoco.mjtCone.mjCONE_ELLIPTIC
        spec.option.impratio = 20
        # Without it what friction holds creeps.
        spec.option.noslip_iterations = 6
        spec.option.integrator = mujoco.mjtIntegrator.mjINT_IMPLICITFAST
        spec.worldbody.add_geom(
            name="floor", type=mujoco.mjtGeom.mjGEOM_PLANE, size=[9, 9, 1],
            contype=FLOOR, conaffinity=OBJECT,
        )  # fmt: skip
        for robot in robots:
            self._add(spec, robot)
        for name, body, pose in objects:
            self._put(spec, name, body, pose)
        self.robots = robots
        self.model = spec.compile()
        self.data = mujoco.MjData(self.model)
        for robot in robots:
            for joint, q in zip(robot.joints, robot.positions[0], strict=True):
                self.data.joint(f"{robot.name}_{joint}").qpos[0] = q
        mujoco.mj_forward(self.model, self.data)

    def _add(self, spec, robot: Replayed) -> None:
        head = robot.urdf.index(">", robot.urdf.index("<robot")) + 1
        child = mujoco.MjSpec.from_string(robot.urdf[:head] + COMPILER + robot.urdf[head:])
        for body in child.bodies:
            body.gravcomp = 1.0
        for geom in child.geoms:
            geom.contype, geom.conaffinity = ARM, OBJECT
            if "finger" in geom.parent.name:
                geom.priority = 1
                geom.friction = [robot.friction, 0.005, 0.0001]
                geom.condim = 4
                # The defaults let a pad sink a centimetre into what is light.
                geom.solref, geom.solimp = [2 * STEP, 1.0], [0.99, 0.999, 1e-4, 0.5, 2.0]
        for joint in child.joints:
            if joint.name in robot.joints:
                joint.armature = ROTOR
        x, y, z, w = robot.pose.orientation
        frame = spec.worldbody.add_frame(pos=list(robot.pose.position), quat=[w, x, y, z])
        spec.attach(child, prefix=f"{robot.name}_", frame=frame)
        for joint in robot.joints:
            servo = spec.add_actuator(name=f"{robot.name}_{joint}", target=f"{robot.name}_{joint}")
            servo.trntype = mujoco.mjtTrn.mjTRN_JOINT
            servo.set_to_position(kp=STIFF, kv=DAMPED)
        for joint in robot.fingers:
            servo = spec.add_actuator(name=f"{robot.name}_{joint}", target=f"{robot.name}_{joint}")
            servo.trntype = mujoco.mjtTrn.mjTRN_JOINT
            servo.set_to_position(kp=4000.0, kv=200.0)
            servo.forcelimited, servo.forcerange = True, [-62.5, 62.5]
        for joint in robot.fingers[1:]:
            spec.add_equality(
                type=mujoco.mjtEq.mjEQ_JOINT,
                objtype=mujoco.mjtObj.mjOBJ_JOINT,
                name1=f"{robot.name}_{joint}",
                name2=f"{robot.name}_{robot.fingers[0]}",
                data=[0, 1, *[0] * (mujoco.mjNEQDATA - 2)],
            )

    def _put(self, spec, name: str, body: Body, pose: Pose) -> None:
        x, y, z, w = pose.orientation
        made = spec.worldbody.add_body(name=name, pos=list(pose.position), quat=[w, x, y, z])
        if body.mass:
            made.add_freejoint()
        for part in body.parts:
            kind, size = _size(part)
            x, y, z, w = part.pose.orientation
            made.add_geom(
                type=kind, size=size, pos=list(part.pose.position), quat=[w, x, y, z],
                mass=body.mass / len(body.parts), friction=[body.friction, 0.005, 0.0001],
                contype=OBJECT, conaffinity=ARM | OBJECT | FLOOR, condim=4,
            )  # fmt: skip

    def run(self, names: list[str]) -> dict[str, np.ndarray]:
        """Replay the motions; return the place (N, 3) m of each object at each frame."""
        count = max(len(robot.positions) for robot in self.robots)
        rate = self.robots[0].rate
        steps = round(1 / rate / STEP)
        places = {name: np.zeros((count, 3)) for name in names}
        for k in range(count):
            for name in names:
                places[name][k] = self.data.body(name).xpos
            for j in range(steps):
                self._drive(k + (j + 1) / steps)
                mujoco.mj_step(self.model, self.data)
        return places

    def _drive(self, frame: float) -> None:
        for robot in self.robots:
            last = len(robot.positions) - 1
            k = min(int(frame), last)
            start, end = robot.positions[k], robot.positions[min(k + 1, last)]
            target = start + (frame - k) * (end - start) if k < last else start
            # What the damping of a servo costs at this speed.
            target = target + DAMPED / STIFF * (end - start) * robot.rate
            for joint, q in zip(robot.joints, target, strict=True):
                self.data.actuator(f"{robot.name}_{joint}").ctrl[0] = q
            for joint in robot.fingers:
                limits = self.model.joint(f"{robot.name}_{joint}").range
                goal = limits[1] + 0.02 if robot.closed[k] else limits[0]
                self.data.actuator(f"{robot.name}_{joint}").ctrl[0] = goal


def _size(part: Part):
    if part.shape is Shape.BOX:
        return mujoco.mjtGeom.mjGEOM_BOX, [s / 2 for s in part.size]
    if part.shape is Shape.CYLINDER:
        return mujoco.mjtGeom.mjGEOM_CYLINDER, [part.size[0], part.size[1] / 2, 0]
    return mujoco.mjtGeom.mjGEOM_SPHERE, [part.size[0], 0, 0]


def pad_friction(body: Body) -> float:
    """Return the friction between a pad and an object, as this lab's engine has it."""
    return PAD_FRICTION * body.friction
