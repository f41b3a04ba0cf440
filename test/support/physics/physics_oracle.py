"""The shipped motions in both engines: where objects are in ours and in MuJoCo."""

from __future__ import annotations

import numpy as np
from mujoco_cell import Oracle, Replayed, pad_friction
from physics_stage import FRAME_NS, HANDOVER, LIBRARY, RATE, ROOT, Stage
from scipy.io import loadmat

from mrlab_ros.core.physics.simulated_robot import GripperProgram
from mrlab_ros.core.playback.states import State

FINGERS = ("gripper_left_finger_joint", "gripper_right_finger_joint")


def compare(scene: str, motions: dict[str, np.ndarray], name: str):
    """Replay columns in both engines; return the places (N, 3) of an object in each."""
    stage = Stage(scene, {})
    document_robots = {robot: stage.world.robot(robot) for robot in stage.world.robots}
    start = {t.name: stage.world.motion(t.name).pose for t in stage.world.objects}
    bodies = {t.name: t.type.body for t in stage.world.objects}
    robots = []
    for robot, q in motions.items():
        closed = q[:, 6] > 0.5
        frames = [0, *(np.flatnonzero(np.diff(q[:, 6])) + 1)]
        program = GripperProgram(
            tuple(f / RATE for f in frames), tuple(bool(closed[f]) for f in frames)
        )
        stage.world.set_program(robot, program)
        stage.motions[robot] = q[:, :6]
        model = "ur5e" if robot.startswith("ur5e") else robot.rsplit("_", 1)[0]
        robots.append(
            Replayed(
                robot,
                LIBRARY.collision_description(model, "parallel_gripper"),
                document_robots[robot].pose,
                LIBRARY.model(model).joint_names,
                q[:, :6],
                closed,
                FINGERS,
                pad_friction(bodies[name]),
                RATE,
            )
        )
    oracle = Oracle(robots, [(n, bodies[n], start[n]) for n in start])
    theirs = oracle.run([name])[name]
    count, ours = len(theirs), []
    stage._tell(State.PLAYING, 0)
    for k in range(count):
        stage.now_ns = k * FRAME_NS
        stage._send(k, moving=True)
        ours.append(stage.place(name))
    stage.engine.close()
    return np.array(ours), theirs


def columns(example: str) -> np.ndarray:
    return loadmat(ROOT / "examples" / f"{example}.mat")["q"]


def swung(release: int | None, speed: float) -> np.ndarray:
    """Return the pick of the example up to where it lifts, then a swing about the base."""
    q = columns("pick_and_place_ur5e")[: round(3.4 * RATE)]
    t = np.arange(round(1.2 * RATE)) / RATE
    swing = np.repeat(q[-1:], len(t), axis=0)
    turn = speed * np.where(t < 0.6, t**2 / 1.2, t - 0.3)
    swing[:, 0] += turn
    whole = np.concatenate([q, swing])
    if release is not None:
        whole[len(q) + release :, 6] = 0
    return whole


def replays():
    """Return name, scene, motions and object of each replay."""
    pick = {"ur5e_1": columns("pick_and_place_ur5e")}
    return {
        "pick": ("pick_and_place", pick, "cube_1"),
        "swing": ("pick_and_place", {"ur5e_1": swung(None, 2.0)}, "cube_1"),
        "throw": ("pick_and_place", {"ur5e_1": swung(80, 2.0)}, "cube_1"),
        "hand-over": (
            "handover",
            {robot: columns(example) for robot, example in HANDOVER.items()},
            "rod_1",
        ),
    }


def gaps(name: str) -> np.ndarray:
    """Return how far apart, m, an object is in the two engines at each frame."""
    ours, theirs = compare(*replays()[name])
    gap: np.ndarray = np.linalg.norm(ours - theirs, axis=1)
    return gap
