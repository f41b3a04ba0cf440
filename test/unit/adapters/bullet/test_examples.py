"""The shipped examples in their scenes, in a world of their own: what they promise happens."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from scipy.io import loadmat

from mrlab_ros.adapters.bullet.engine import BulletEngine
from mrlab_ros.adapters.robots.library import RobotLibrary
from mrlab_ros.adapters.scenes.files import SceneFiles
from mrlab_ros.adapters.yaml_files import read_yaml
from mrlab_ros.core.clock import SECOND, PlaybackClock
from mrlab_ros.core.physics import catalogue
from mrlab_ros.core.physics.events import CollisionChanged, GraspChanged
from mrlab_ros.core.physics.grasp import Grasp, Gripper
from mrlab_ros.core.physics.settings import Settings
from mrlab_ros.core.physics.simulated_robot import GripperProgram, Playing
from mrlab_ros.core.physics.world import World
from mrlab_ros.core.playback.states import State

ROOT = Path(__file__).parents[4]
LIBRARY = RobotLibrary(ROOT / "robots")
TYPES = catalogue.parse(read_yaml(ROOT / "config" / "objects.yaml"))
SCENES = SceneFiles(ROOT / "config" / "scenes", ROOT / "no saved ones")
RATE = 100
FRAME_NS = SECOND // RATE


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
                Gripper.FINGERS,
                LIBRARY.never_touch(robot.model),
            )
            if files is None:
                self.motions[robot.name] = model.home[None, :]
                continue
            q = loadmat(ROOT / "examples" / f"{files[robot.name]}.mat")["q"]
            closed = q[:, 6] > 0.5
            frames = [0, *(np.flatnonzero(np.diff(q[:, 6])) + 1)]
            program = GripperProgram(
                tuple(f / RATE for f in frames), tuple(bool(closed[f]) for f in frames)
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
            playing = Playing(state, "t", clock, frame, count, RATE, (count - 1) / RATE)
            self.world.playback(name, playing)

    def _send(self, frame: int, *, moving: bool) -> None:
        for name, q in self.motions.items():
            last = len(q) - 1
            v = (q[min(frame + 1, last)] - q[max(frame - 1, 0)]) * RATE / 2 * moving
            self.world.joint_state(name, self.now_ns, q[min(frame, last)], v)
        self.world.advance(self.now_ns)
        self.events += self.world.take_events()

    def play(self, until: float) -> None:
        """Play on to a place on the timeline, s."""
        self._tell(State.PLAYING, self.frame)
        while self.frame < round(until * RATE):
            self.frame += 1
            self.now_ns += FRAME_NS
            self._send(self.frame, moving=True)

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


@pytest.fixture
def stages():
    made: list[Stage] = []

    def make(*args) -> Stage:
        made.append(Stage(*args))
        return made[-1]

    yield make
    for stage in made:
        stage.engine.close()


@pytest.mark.parametrize("scene", SCENES.names())
def test_in_every_shipped_scene_the_robots_stand_free_and_the_objects_rest(stages, scene):
    stage = stages(scene)
    before = {thing.name: stage.place(thing.name) for thing in stage.world.objects}
    stage.stand(1.0)
    assert not stage.hits()
    for name, place in before.items():
        assert np.abs(stage.place(name) - place).max() < 0.003, name


@pytest.mark.slow
def test_a_cube_is_picked_carried_and_put_down_as_the_script_says(stages):
    stage = stages("pick_and_place", {"ur5e_1": "pick_and_place_ur5e"})
    start = stage.place("cube_1")
    stage.play(1.8)
    assert np.abs(stage.place("cube_1") - start).max() < 0.001
    stage.play(4.6)
    assert stage.world.object("cube_1").held_by == "ur5e_1"
    assert stage.place("cube_1")[2] > 0.1
    stage.play(7.6)
    stage.stand()
    assert stage.grasps("ur5e_1") == [Grasp.OPEN, Grasp.CLOSING, Grasp.HOLDING, Grasp.OPEN]
    assert not stage.hits()
    turn = np.radians(60)
    assert stage.place("cube_1") == pytest.approx(
        [0.46 * np.cos(turn), 0.46 * np.sin(turn), 0.025], abs=0.005
    )


@pytest.mark.slow
def test_scrubbing_a_run_puts_the_cube_back_where_it_was(stages):
    stage = stages("pick_and_place", {"ur5e_1": "pick_and_place_ur5e"})
    start = stage.place("cube_1")
    stage.play(7.6)
    stage.stand()
    end = stage.place("cube_1")
    stage.seek(3.5)
    assert stage.world.object("cube_1").held_by == "ur5e_1"
    hand = stage.world.hand("ur5e_1").pose.position
    # The gripper's tool centre point is 154 mm from its base.
    assert np.linalg.norm(stage.place("cube_1") - hand) == pytest.approx(0.154, abs=0.01)
    carried = stage.place("cube_1")
    stage.seek(1.0)
    assert stage.world.object("cube_1").held_by == ""
    assert np.abs(stage.place("cube_1") - start).max() < 0.002
    stage.seek(7.0)
    assert np.abs(stage.place("cube_1") - end).max() < 0.002
    stage.seek(3.5)
    assert np.abs(stage.place("cube_1") - carried).max() < 0.002
    # From there the run goes on, and puts the cube down again.
    stage.play(7.6)
    assert stage.world.object("cube_1").held_by == ""
    assert np.abs(stage.place("cube_1") - end).max() < 0.005
    assert not stage.hits()


HANDOVER = {
    "ur5e_1": "two_robot_handover_ur5e",
    "kuka_kr6_r900_sixx_1": "two_robot_handover_kr6",
}


@pytest.mark.slow
def test_a_rod_is_handed_from_one_gripper_to_the_other(stages):
    giver, taker = HANDOVER
    stage = stages("handover", HANDOVER)
    start = stage.place("rod_1")
    stage.play(4.1)
    assert stage.world.object("rod_1").held_by == giver
    before = stage.place("rod_1")
    assert before[2] == pytest.approx(0.7, abs=0.005)
    stage.play(4.6)
    assert stage.world.object("rod_1").held_by == taker
    assert np.abs(stage.place("rod_1") - before).max() < 0.002, "no jump at the change of hands"
    stage.play(5.2)
    assert stage.place("rod_1")[0] > before[0] + 0.05
    stage.play(8.0)
    stage.stand()
    open_, closing, holding, empty = Grasp.OPEN, Grasp.CLOSING, Grasp.HOLDING, Grasp.EMPTY
    assert stage.grasps(giver) == [open_, closing, holding, empty, open_]
    assert stage.grasps(taker) == [open_, closing, holding, open_]
    assert not stage.hits()
    end = stage.place("rod_1")
    assert end == pytest.approx([1.2 - 0.5 * np.cos(np.radians(40)), -0.3214, 0.08], abs=0.01)
    # Scrubbed together, each robot has again what it had then.
    for position, holder, place in ((6.0, taker, None), (3.0, giver, None), (1.0, "", start)):
        stage.seek(position)
        assert stage.world.object("rod_1").held_by == holder
        if place is not None:
            assert np.abs(stage.place("rod_1") - place).max() < 0.002
