"""A shipped scene in a world of its own, whose robots play shipped motions; no graph."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from scipy.io import loadmat
from scipy.spatial.transform import Rotation

from mrlab_ros.adapters.bullet.engine import BulletEngine
from mrlab_ros.adapters.robots.library import RobotLibrary
from mrlab_ros.adapters.scenes.files import SceneFiles
from mrlab_ros.adapters.yaml_files import read_yaml
from mrlab_ros.core.base.clock import SECOND, PlaybackClock
from mrlab_ros.core.base.geometry import Pose
from mrlab_ros.core.physics import catalogue
from mrlab_ros.core.physics.grasp import kinds
from mrlab_ros.core.physics.grasp.states import Grasp
from mrlab_ros.core.physics.settings import Settings
from mrlab_ros.core.physics.simulated_robot import GripperProgram, Playing
from mrlab_ros.core.physics.world import World
from mrlab_ros.core.physics.world_state import CollisionChanged, GraspChanged
from mrlab_ros.core.playback.states import State

ROOT = Path(__file__).parents[3]
LIBRARY = RobotLibrary(ROOT / "robots")
TYPES = catalogue.parse(read_yaml(ROOT / "config" / "objects.yaml"))
SCENES = SceneFiles(ROOT / "config" / "scenes", ROOT / "no saved ones")
RATE = 100
FRAME_NS = SECOND // RATE
HANDOVER = {
    "ur5e_1": "two_robot_handover_ur5e",
    "kuka_kr6_r900_sixx_1": "two_robot_handover_kr6",
}


def _place(transform: np.ndarray) -> Pose:
    x, y, z, w = Rotation.from_matrix(transform[:3, :3]).as_quat()
    return Pose(tuple(map(float, transform[:3, 3])), (float(x), float(y), float(z), float(w)))


class Stage:
    """A shipped scene whose robots play the columns of the shipped workspace files."""

    def __init__(self, scene: str, files: dict[str, str] | None = None) -> None:
        self.engine = BulletEngine(LIBRARY.mesh_path)
        self.world = World(self.engine, TYPES, Settings())
        document = SCENES.load(scene)
        self.motions = {}
        for robot in document.robots:
            model = LIBRARY.model(robot.model)
            self.world.add_robot(
                robot.name,
                LIBRARY.description(robot.model, robot.end_effector),
                model.joint_names,
                robot.pose,
                kinds.FINGERS,
                LIBRARY.never_touch(robot.model),
            )
            if not files:
                self.motions[robot.name] = model.home[None, :]
                continue
            q = loadmat(ROOT / "examples" / f"{files[robot.name]}.mat")["q"]
            closed = q[:, 6] > 0.5
            frames = [0, *(np.flatnonzero(np.diff(q[:, 6])) + 1)]
            program = GripperProgram(
                tuple(f / RATE for f in frames),
                tuple(bool(closed[f]) for f in frames),
                tuple(map(_place, model.chain.tool0(q[frames, :6]))),
            )
            self.world.set_program(robot.name, program)
            self.motions[robot.name] = q[:, :6]
        for thing in document.objects:
            self.world.spawn(thing.type, thing.name, thing.pose, automatic=thing.automatic)
        self.frame = 0
        self.now_ns = 0
        self.events = []

    def _tell(self, state: State, frame: int) -> None:
        for name, q in self.motions.items():
            clock = PlaybackClock(self.now_ns, frame / RATE, float(state is State.PLAYING))
            count = len(q)
            duration = (count - 1) / RATE
            playing = Playing(state, "t", clock, frame, count, RATE, duration, self.now_ns)
            self.world.playback(name, playing)

    def _send(self, frame: int, *, moving: bool, frozen: bool = False) -> None:
        for name, q in self.motions.items():
            last = len(q) - 1
            v = (q[min(frame + 1, last)] - q[min(max(frame - 1, 0), last)]) * RATE / 2 * moving
            self.world.joint_state(name, self.now_ns, q[min(frame, last)], v)
        if frozen:
            return
        self.world.advance(self.now_ns)
        self.events += self.world.take_events()

    def play(self, until: float) -> None:
        """Play on to a place on the timeline, s."""
        self._tell(State.PLAYING, self.frame)
        while self.frame < round(until * RATE):
            self.frame += 1
            self.now_ns += FRAME_NS
            self._send(self.frame, moving=True)

    def freeze(self, until: float) -> None:
        """Let the arms play on to a place on the timeline, s, and to their end where it lies
        behind that, while the world is not stepped; then go on with it."""
        while self.frame < round(until * RATE):
            self.frame += 1
            self.now_ns += FRAME_NS
            last = max(map(len, self.motions.values())) - 1
            if self.frame == last:
                self._tell(State.READY, 0)
            self._send(self.frame, moving=self.frame < last, frozen=True)
        self.world.advance(self.now_ns)
        self.events += self.world.take_events()

    def stand(self, seconds: float = 0.3) -> None:
        self._tell(State.PAUSED, self.frame)
        for _ in range(round(seconds * RATE)):
            self.now_ns += FRAME_NS
            self._send(self.frame, moving=False)

    def seek(self, position: float) -> None:
        self.frame = round(position * RATE)
        self.now_ns += FRAME_NS
        self.stand()

    def place(self, name: str) -> np.ndarray:
        return np.array(self.world.motion(name).pose.position)

    def grasps(self, robot: str) -> list[Grasp]:
        return [e.state for e in self.events if isinstance(e, GraspChanged) and e.robot == robot]

    def hits(self) -> list[CollisionChanged]:
        return [e for e in self.events if isinstance(e, CollisionChanged)]
