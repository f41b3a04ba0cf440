"""What physics costs, and how soon it halts an arm.

Steps: what a step costs with a full scene, and how much faster than real time a small scene runs
headless; processor time stands beside wall time, for a machine is seldom one's own. Node: what it
costs while all robots stand and play. Halt: from the contact's step to the last joint state of the
halted arm. MuJoCo is the baseline of where objects go. --soak runs a full, busy scene.
"""

from __future__ import annotations

import sys
import tempfile
import time
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np
import psutil
import report
from geometry_msgs.msg import Point
from geometry_msgs.msg import Pose as PoseMessage
from lab import LIBRARY, MODEL, ROOT, Lab, catalogue, running, trajectory
from mrlab_msgs import msg, srv
from mrlab_msgs.srv import Trigger
from partner import cpu_s, in_process, until
from sensor_msgs.msg import JointState
from size import Size

from mrlab_ros.adapters import share
from mrlab_ros.adapters.bullet.engine import BulletEngine
from mrlab_ros.adapters.yaml_files import read_yaml
from mrlab_ros.core.base.clock import SECOND, PlaybackClock
from mrlab_ros.core.base.geometry import Pose
from mrlab_ros.core.physics import catalogue as kinds
from mrlab_ros.core.physics.engine import BodyState
from mrlab_ros.core.physics.grasp.kinds import NONE
from mrlab_ros.core.physics.settings import Settings
from mrlab_ros.core.physics.simulated_robot import Playing
from mrlab_ros.core.physics.world import World
from mrlab_ros.core.playback.states import State
from mrlab_ros.core.scene.surfaces import Surface
from mrlab_ros.messages import qos
from mrlab_ros.messages.time import time_from_message

NEEDS = ()
KINDS = ("cube", "block", "cylinder", "sphere", "cup", "can", "bottle", "carton")
MODELS = tuple((LIBRARY.ids() * 13)[:13])
OBJECTS = 32
RATE, PERIOD_NS = 100.0, SECOND // 100
# The wave that the arms follow repeats after this many joint states.
WAVE = 628
LONGEST = 1e5  # s
# How long objects take to come to rest and fall asleep, s.
SETTLE_S = 5.0
# Minutes that a soak takes until all that is bounded has reached its bound.
FILLING = 5
COUNTED = ("step", "move_arm", "speed", "touches", "object", "link", "fingers")
PROCESSES = ("lab", "playback", "physics")


def resolve(uri: str) -> Path:
    return share.directory() / uri.removeprefix("package://mrlab_ros/")


class CountedEngine(BulletEngine):
    """Adds up the time spent in the engine's calls of a step."""

    def __init__(self) -> None:
        super().__init__(resolve)
        self.spent_s = 0.0
        self._inside = False
        for name in COUNTED:
            setattr(self, name, self._counted(getattr(self, name)))

    def _counted(self, function: Any) -> Any:
        def counted(*arguments: Any, **named: Any) -> Any:
            if self._inside:
                return function(*arguments, **named)
            self._inside, begin = True, time.perf_counter()
            try:
                return function(*arguments, **named)
            finally:
                self.spent_s += time.perf_counter() - begin
                self._inside = False

        return counted


def robot_place(i: int) -> tuple[float, float, float]:
    return (3.5 * (i % 4), 3.5 * (i // 4), 0.0)


def object_place(i: int) -> tuple[float, float, float]:
    return (3.5 * (i % 4) + 1.2 + 0.15 * (i // 8), 1.0 + 0.2 * (i // 4), 0.5)


class Cell:
    """A world with robots 3.5 m apart and objects on the floor between them, driven at 100 Hz."""

    def __init__(self, models: Sequence[str], objects: int, *, counted: bool = False) -> None:
        types = kinds.parse(read_yaml(share.directory() / "config" / "objects.yaml"))
        self.engine = CountedEngine() if counted else BulletEngine(resolve)
        self.world = World(self.engine, types, Settings(attach_reach=1000.0))
        self.now_ns = 0
        self._motions = []
        for i, model_id in enumerate(models):
            model = LIBRARY.model(model_id)
            self.add(f"r{i}", model_id, Pose(robot_place(i)))
            phase = 2 * np.pi * np.arange(WAVE)[:, None] / WAVE + np.arange(len(model.joints))
            waves = model.home + 0.3 * np.sin(phase), 0.3 * np.cos(phase)
            self._motions.append(tuple(wave.tolist() for wave in waves))
        for i in range(objects):
            self.world.spawn(KINDS[i % len(KINDS)], pose=Pose(object_place(i)), automatic=True)

    def add(self, name: str, model: str, place: Pose) -> None:
        """Add a robot and let its run begin; what it passes is kept for scrubbing."""
        names, apart = LIBRARY.model(model).joint_names, LIBRARY.never_touch(model)
        description = LIBRARY.description(model)
        self.world.add_robot(name, description, names, place, NONE, apart)
        clock = PlaybackClock(self.now_ns, 0.0, 1.0)
        frames = round(RATE * LONGEST)
        playing = Playing(State.PLAYING, "wave", clock, 0, frames, RATE, LONGEST)
        self.world.playback(name, playing)

    def frame(self) -> None:
        """Send every robot's next joint state and step along."""
        self.now_ns += PERIOD_NS
        k = self.now_ns // PERIOD_NS % WAVE
        for i, (positions, velocities) in enumerate(self._motions):
            self.world.joint_state(f"r{i}", self.now_ns, positions[k], velocities[k])
        self.world.advance(self.now_ns)
        self.world.take_events()
        self.world.take_contacts()

    def run(self, seconds: float, *, stirred: bool = False) -> tuple[int, float, float]:
        """Run for `seconds` of the world's time; return steps, processor and wall time, s.

        stirred: no object comes to rest.
        """
        steps, cpu, wall = self.world.steps, time.process_time(), time.perf_counter()
        for k in range(round(RATE * seconds)):
            self.frame()
            if stirred and k % 100 == 0:
                self._stir()
        cpu, wall = time.process_time() - cpu, time.perf_counter() - wall
        return self.world.steps - steps, cpu, wall

    def _stir(self) -> None:
        """Give every object a push that wakes it and leaves it about where it is."""
        for thing in self.world.objects:
            pose = self.world.motion(thing.name).pose
            self.engine.set_object(thing.name, BodyState(pose, (0.05, 0.0, 0.1)))


def stepped(
    name: str, models: Sequence[str], objects: int, seconds: float, stirred: bool
) -> dict[str, Any]:
    """Run one scene as fast as it goes, once its objects have come to rest."""
    cell = Cell(models, objects)
    cell.run(4.0, stirred=stirred)
    steps, cpu, wall = cell.run(seconds, stirred=stirred)
    counted = Cell(models, objects, counted=True)
    counted.run(4.0, stirred=stirred)
    counted.engine.spent_s = 0.0
    *_, counted_wall = counted.run(seconds / 4, stirred=stirred)
    return {
        "scene": name,
        "robots": len(models),
        "objects": objects,
        "steps": steps,
        "engine ms/step": 1e3 * counted.engine.spent_s / counted_wall * cpu / steps,
        "CPU ms/step": 1e3 * cpu / steps,
        "wall ms/step": 1e3 * wall / steps,
        "% of a core": 100 * cpu / seconds,
        "x real time, CPU": seconds / cpu,
        "x real time, wall": seconds / wall,
    }


def steps(size: Size) -> list[dict[str, Any]]:
    seconds = size.of(0.2, 3.0, 15.0)
    cases = (
        ("one robot, headless", (MODEL,), 10, 3 * seconds, False),
        ("the same, no object at rest", (MODEL,), 10, 3 * seconds, True),
        ("thirteen cobots", (MODEL,) * 13, OBJECTS, seconds, False),
        ("thirteen models", MODELS, OBJECTS, seconds, False),
        ("the same, no object at rest", MODELS, OBJECTS, seconds, True),
    )
    return [in_process(stepped, *case) for case in size.some(cases)]


def beside_mujoco(size: Size) -> list[dict[str, Any]]:
    """Replay the tests' motions in this engine and in MuJoCo; return how far apart objects are."""
    sys.path.append(str(ROOT / "test" / "support" / "physics"))
    from physics_oracle import gaps, replays

    rows = []
    for name in size.some(tuple(replays())):
        gap = 1e3 * gaps(name)
        rows.append({"replay": name, "most mm": float(gap.max()), "end mm": float(gap[-1])})
    return rows


def loads(size: Size) -> list[dict[str, Any]]:
    """Accelerate 7 kg between two pads; return the friction needed beside that of statics."""
    sys.path.append(str(ROOT / "test" / "support" / "physics"))
    from physics_cell import PADS, Cell, gantry

    rows = []
    for acceleration in size.some((1.0, 2.0, 4.0, 8.0, 12.0, 20.0)):
        with tempfile.TemporaryDirectory() as name:
            cell = Cell(gantry(Path(name)), Settings(hold="infinite"))
            cell.put("lead", (0.0, 0.0, 0.03))
            cell.add("a", at=(0.0, 0.0, 0.03 + PADS))
            cell.close("a")
            cell.go("a", (0.0, 0.0, 0.5 + PADS), 1.0)
            cell.accelerate("a", 0, acceleration, 0.4)
            load = cell.world.robot("a").holding.load
            cell.engine.close()
        statics = 7 * float(np.hypot(9.80665, acceleration)) / 125
        rows.append(
            {
                "m/s2": acceleration,
                "m/s": 0.4 * acceleration,
                "friction, statics": statics,
                "friction, lab": load.friction_needed,
                "off %": 100 * (load.friction_needed / statics - 1),
            }
        )
    return rows


def pose_at(x: float, y: float, z: float) -> PoseMessage:
    return PoseMessage(position=Point(x=x, y=y, z=z))


def spawned(lab: Lab, model: str, place: tuple[float, float, float]) -> str:
    """Put a robot at a place, m; return its name, once physics has it."""
    answer = lab.ask(srv.SpawnRobot, "/lab/spawn_robot", model=model, pose=pose_at(*place))
    name: str = answer.robot.name
    until(lambda: lab.node.count_publishers(f"/{name}/collision"), f"the hulls of {name}")
    return name


def node_load(size: Size) -> list[dict[str, Any]]:
    """Measure the node while all robots stand, and while they play."""
    models = size.some(MODELS)
    settle, seconds = size.of((1.0, 0.5), (SETTLE_S, 5.0), (SETTLE_S, 30.0))
    t = np.arange(round(RATE * (seconds + 4 * SETTLE_S))) / RATE
    with tempfile.TemporaryDirectory() as name:
        store = catalogue(Path(name))
        for model in map(LIBRARY.model, sorted(set(models))):
            wave = 0.3 * np.sin(t[:, None] + np.arange(len(model.joints)))
            # From rest: the wave comes up within a second.
            positions = model.home + np.clip(t, 0, 1)[:, None] * wave
            store.save(trajectory(model.id, positions, RATE, model=model.id))
        with running(Path(name), PROCESSES) as lab:
            robots = [spawned(lab, model, robot_place(i)) for i, model in enumerate(models)]
            for i in range(OBJECTS):
                place, kind = pose_at(*object_place(i)), KINDS[i % len(KINDS)]
                lab.ask(
                    srv.SpawnObject, "/physics/spawn_object", type=kind, pose=place, automatic=True
                )
            time.sleep(settle)
            standing = node_row(lab, "stand", len(robots), seconds / 2)
            lab.follow(robots)
            for robot, model in zip(robots, models, strict=True):
                lab.ask(srv.LoadTrajectory, f"/{robot}/load", id=model)
                lab.ask(Trigger, f"/{robot}/play")
            for robot in robots:
                lab.await_label(robot, "PLAYING")
            time.sleep(settle)
            playing = node_row(lab, "play at 100 Hz", len(robots), seconds)
            for robot in robots:
                lab.await_label(robot, "PLAYING")
    return [standing, playing]


def node_row(lab: Lab, what: str, robots: int, seconds: float) -> dict[str, Any]:
    process = lab.processes()["physics"]
    before, begin = cpu_s(process), time.perf_counter()
    time.sleep(seconds)
    return {
        "robots": what,
        "count": robots,
        "objects": OBJECTS,
        "node % of a core": 100 * (cpu_s(process) - before) / (time.perf_counter() - begin),
        "memory MiB": process.memory_info().rss / 2**20,
    }


def halts(size: Size) -> list[dict[str, Any]]:
    """Halt an arm again and again by a box that is held in its way."""
    model = LIBRARY.model(MODEL)
    pan = 0.5 * np.arange(301) / RATE
    positions = model.home + pan[:, None] * np.array([1, 0, 0, 0, 0, 0])
    x, y, z = (float(v) for v in model.chain.tool0(positions[120])[:3, 3])
    with tempfile.TemporaryDirectory() as name:
        catalogue(Path(name), [trajectory("sweep", positions, RATE)])
        with running(Path(name), PROCESSES) as lab:
            robot = spawned(lab, MODEL, (0.0, 0.0, 0.0))
            lab.follow([robot])
            joints = lab.heard(JointState, f"/{robot}/joint_states", qos.STREAM)
            collisions = lab.heard(msg.Collision, f"/{robot}/collision", qos.EVENTS)
            lab.ask(srv.LoadTrajectory, f"/{robot}/load", id="sweep")
            box = lab.ask(
                srv.SpawnObject,
                "/physics/spawn_object",
                type="cube_large",
                pose=pose_at(x, y, 3.0),
            ).object.name

            def put(height: float) -> None:
                place = pose_at(x, y, height)
                lab.ask(srv.MoveObject, "/physics/move_object", name=box, held=True, pose=place)

            def halt() -> float:
                put(3.0)
                lab.await_label(robot, "READY", "PAUSED")
                lab.ask(srv.Seek, f"/{robot}/seek", position=0.6)
                put(z)
                collisions.clear()
                lab.ask(Trigger, f"/{robot}/play")
                lab.await_label(robot, "COLLISION_HALT")
                until(lambda: collisions, "the collision")
                contact_ns = time_from_message(collisions[0].header.stamp)
                time.sleep(0.1)
                last = next(j for j in reversed(joints) if np.any(j.velocity))
                return (time_from_message(last.header.stamp) - contact_ns) * 1e-6

            taken = [halt() for _ in range(size.of(1, 6, 50))]
    return [{"halts": len(taken), **report.percentiles(taken)}]


class Churn:
    """What a busy hour does to a world besides playing: comes, goes, is thrown and is cut off."""

    def __init__(self, cell: Cell, models: Sequence[str]) -> None:
        self._cell, self._models = cell, models
        self._count = 0
        square = np.array([[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0.0]])
        none = np.zeros((0, 3), np.int32)
        shelf = Surface("shelf", "shelf", Pose((50.0, 0.0, 0.5)), square, none)
        self._rooms: list[list[Surface]] = [[], [shelf]]

    def second(self) -> None:
        """Do what comes once a second: a new object for the oldest, a throw, at times a room."""
        self._count += 1
        n, world = self._count, self._cell.world
        at = (3.5 * (n % 4) + 1.75, 3.5 * (n // 4 % 3) + 1.75, 0.5)
        world.spawn(KINDS[n % len(KINDS)], pose=Pose(at), automatic=True)
        thrown = world.objects[n % len(world.objects)].name
        pose = world.motion(thrown).pose
        world.move(thrown, pose, (0.3, 0.0, 1.0), (0.0, 0.0, 1.0), held=False)
        robot = world.robots[n % len(world.robots)]
        if n % 5 == 0:
            world.attach(robot, world.objects[-1].name)
            self._cell.frame()
            world.detach(robot)
        if n % 10 == 0:
            world.set_surfaces(self._rooms[n // 10 % 2])
        if n % 60 == 0:
            last = len(self._models) - 1
            place = world.robot(f"r{last}").pose
            world.remove_robot(f"r{last}")
            self._cell.add(f"r{last}", self._models[last], place)


def soak(size: Size) -> list[dict[str, Any]]:
    """Run a full, busy scene for `size.soak` minutes of its own time; a row for each minute."""
    cell = Cell(MODELS, OBJECTS)
    churn, process, rows = Churn(cell, MODELS), psutil.Process(), []
    cell.run(5.0)
    for minute in range(max(round(size.soak), 1)):
        cpu_ms, wall_ms = [], []
        for _ in range(60):
            churn.second()
            count, cpu, wall = cell.run(1.0)
            cpu_ms.append(1e3 * cpu / count)
            wall_ms.append(1e3 * wall / count)
        rows.append(
            {
                "minute": str(minute + 1),
                "CPU ms/step median": float(np.median(cpu_ms)),
                "CPU ms/step max": max(cpu_ms),
                "wall ms/step median": float(np.median(wall_ms)),
                "memory MiB": process.memory_info().rss / 2**20,
            }
        )
        print(f"minute {minute + 1} of {size.soak:g}", flush=True)
    return [*rows, drift(rows)]


def drift(rows: list[dict[str, Any]]) -> dict[str, Any]:
    """Return the slope of a straight line through each figure, an hour.

    Of a long soak without its first minutes, in which what is kept for scrubbing fills up.
    """
    rows = rows[FILLING:] if len(rows) > 2 * FILLING else rows
    figures = {key: [row[key] for row in rows] for key in rows[0] if key != "minute"}
    slopes = {
        key: 60 * float(np.polyfit(range(len(v)), v, 1)[0]) if len(v) > 1 else 0.0
        for key, v in figures.items()
    }
    return {"minute": "slope, an hour", **slopes}


TABLES = {
    "Physics steps": steps,
    "Physics beside MuJoCo": beside_mujoco,
    "Physics load of a grasp beside statics": loads,
    "Physics node": node_load,
    "Physics halt: contact to last moving joint state, 100 Hz": halts,
}
SOAKS = {"Physics soak": soak}
