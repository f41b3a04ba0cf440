"""What physics costs and how soon it halts an arm.

Four questions: what a step costs with a full scene, beside how long it may take; how much faster
than real time a small scene runs headless; what the whole node costs; how long it is from the
contact's step to the last joint state of a halted arm, through the graph. --soak runs a full,
busy scene for long and watches memory and what a step costs.
"""

from __future__ import annotations

import argparse
import json
import os
import subprocess
import sys
import time
from pathlib import Path
from typing import Any

import numpy as np
import psutil
import report

from mrlab_ros.adapters.bullet.engine import BulletEngine
from mrlab_ros.adapters.robots.library import RobotLibrary
from mrlab_ros.adapters.yaml_files import read_yaml
from mrlab_ros.core.base.clock import SECOND, PlaybackClock
from mrlab_ros.core.base.geometry import Pose
from mrlab_ros.core.physics import catalogue
from mrlab_ros.core.physics.engine import BodyState
from mrlab_ros.core.physics.grasp.states import Gripper
from mrlab_ros.core.physics.settings import Settings
from mrlab_ros.core.physics.simulated_robot import Playing
from mrlab_ros.core.physics.world import World
from mrlab_ros.core.playback.states import State
from mrlab_ros.core.scene.surfaces import Surface
from mrlab_ros.ros import share

ROOT = share.directory()
LIBRARY = RobotLibrary(ROOT / "robots")
KINDS = ("cube", "block", "cylinder", "sphere", "cup", "can", "bottle", "carton")
PERIOD_NS = SECOND // 100
# The wave that the arms follow repeats after this many joint states.
WAVE = 628
LONGEST = 1e5  # s
# Minutes that a soak takes until all that is bounded has reached its bound.
FILLING = 5


def resolve(uri: str) -> Path:
    return ROOT / uri.removeprefix("package://mrlab_ros/")


class CountedEngine(BulletEngine):
    """Adds up the time spent in the engine's calls of a step."""

    def __init__(self) -> None:
        super().__init__(resolve)
        self.spent_s = 0.0
        self._inside = False
        for name in ("step", "move_arm", "speed", "touches", "object", "link", "fingers"):
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


class Lab:
    """A world with robots 3.5 m apart and objects on the floor between them, driven at 100 Hz."""

    def __init__(self, models: list[str], objects: int, *, counted: bool = False) -> None:
        types = catalogue.parse(read_yaml(ROOT / "config" / "objects.yaml"))
        self.engine = CountedEngine() if counted else BulletEngine(resolve)
        self.world = World(self.engine, types, Settings(attach_reach=1000.0))
        self.now_ns = 0
        self._motions = []
        for i, model_id in enumerate(models):
            model = LIBRARY.model(model_id)
            place = Pose((3.5 * (i % 4), 3.5 * (i // 4), 0.0))
            description = LIBRARY.description(model_id)
            self.world.add_robot(
                f"r{i}", description, model.joint_names, place, Gripper.NONE,
                LIBRARY.never_touch(model_id),
            )  # fmt: skip
            self.play(f"r{i}")
            phase = 2 * np.pi * np.arange(WAVE)[:, None] / WAVE + np.arange(len(model.joints))
            waves = model.home + 0.3 * np.sin(phase), 0.3 * np.cos(phase)
            self._motions.append(tuple(wave.tolist() for wave in waves))
        for i in range(objects):
            at = (3.5 * (i % 4) + 1.2 + 0.15 * (i // 8), 1.0 + 0.2 * (i // 4), 0.5)
            self.world.spawn(KINDS[i % len(KINDS)], pose=Pose(at), automatic=True)

    def play(self, robot: str) -> None:
        """Let a robot's run begin; what it passes is kept for scrubbing."""
        clock = PlaybackClock(self.now_ns, 0.0, 1.0)
        frames = round(100 * LONGEST)
        playing = Playing(State.PLAYING, "wave", clock, 0, frames, 100.0, LONGEST)
        self.world.playback(robot, playing)

    def frame(self) -> None:
        """Send every robot's next joint state and step along."""
        self.now_ns += PERIOD_NS
        k = self.now_ns // PERIOD_NS % WAVE
        for i, (positions, velocities) in enumerate(self._motions):
            self.world.joint_state(f"r{i}", self.now_ns, positions[k], velocities[k])
        self.world.advance(self.now_ns)
        self.world.take_events()
        self.world.take_contacts()

    def run(self, seconds: float, *, stirred: bool = False) -> None:
        """Run for `seconds` of the world's time; stirred: no object comes to rest."""
        for k in range(round(100 * seconds)):
            self.frame()
            if stirred and k % 100 == 0:
                self.stir()

    def stir(self) -> None:
        """Give every object a push that wakes it and leaves it about where it is."""
        for thing in self.world.objects:
            pose = self.world.motion(thing.name).pose
            self.engine.set_object(thing.name, BodyState(pose, (0.05, 0.0, 0.1)))


def measured(name: str, models: list[str], objects: int, seconds: float, stirred: bool) -> Any:
    """Run one scene as fast as it goes, once its objects have come to rest.

    CPU time beside wall time, for a machine is seldom one's own.
    """
    lab = Lab(models, objects)
    lab.run(4.0, stirred=stirred)
    before, cpu, wall = lab.world.steps, time.process_time(), time.perf_counter()
    lab.run(seconds, stirred=stirred)
    cpu, wall = time.process_time() - cpu, time.perf_counter() - wall
    steps = lab.world.steps - before
    return {
        "scene": name,
        "robots": len(models),
        "objects": objects,
        "steps": steps,
        "engine ms/step": 1e3 * engine_share(models, objects, seconds / 4, stirred) * cpu / steps,
        "CPU ms/step": 1e3 * cpu / steps,
        "wall ms/step": 1e3 * wall / steps,
        "% of a core": 100 * cpu / seconds,
        "x real time, CPU": seconds / cpu,
        "wall": seconds / wall,
    }


def engine_share(models: list[str], objects: int, seconds: float, stirred: bool) -> float:
    """Return which share of a step is spent in the engine and what it calls."""
    lab = Lab(models, objects, counted=True)
    lab.run(4.0, stirred=stirred)
    lab.engine.spent_s, begin = 0.0, time.perf_counter()
    lab.run(seconds, stirred=stirred)
    return lab.engine.spent_s / (time.perf_counter() - begin)


class Churn:
    """What a busy hour does to a world besides playing: comes, goes, is thrown and is cut off."""

    def __init__(self, lab: Lab) -> None:
        self._lab = lab
        self._count = 0
        square = np.array([[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0.0]])
        none = np.zeros((0, 3), np.int32)
        self._rooms: list[list[Surface]] = [
            [], [Surface("shelf", "shelf", Pose((50.0, 0.0, 0.5)), square, none)]
        ]  # fmt: skip

    def second(self) -> None:
        """Do what comes once a second: a new object for the oldest, a throw, at times a room."""
        self._count += 1
        n, world = self._count, self._lab.world
        at = (3.5 * (n % 4) + 1.75, 3.5 * (n // 4 % 3) + 1.75, 0.5)
        world.spawn(KINDS[n % len(KINDS)], pose=Pose(at), automatic=True)
        thrown = world.objects[n % len(world.objects)].name
        pose = world.motion(thrown).pose
        world.move(thrown, pose, (0.3, 0.0, 1.0), (0.0, 0.0, 1.0), held=False)
        robot = world.robots[n % len(world.robots)]
        if n % 5 == 0:
            held = world.objects[-1].name
            world.attach(robot, held)
            self._lab.frame()
            world.detach(robot)
        if n % 10 == 0:
            world.set_surfaces(self._rooms[n // 10 % 2])
        if n % 60 == 0:
            self._again(len(world.robots) - 1)

    def _again(self, i: int) -> None:
        """Take the robot that came last away and put it back."""
        world, name = self._lab.world, f"r{i}"
        robot = world.robot(name)
        world.remove_robot(name)
        model = next(m for m in LIBRARY.ids() if LIBRARY.model(m).joint_names == robot.joints)
        description = LIBRARY.description(model)
        apart = LIBRARY.never_touch(model)
        world.add_robot(name, description, robot.joints, robot.pose, Gripper.NONE, apart)
        self._lab.play(name)


def soak(models: list[str], minutes: float) -> list[dict[str, Any]]:
    """Run a full, busy scene for `minutes` of its own time; a row for each minute."""
    lab = Lab(models, 32)
    churn, process, rows = Churn(lab), psutil.Process(), []
    lab.run(5.0)
    while len(rows) < max(round(minutes), 1):
        cpu_ms, wall_ms = [], []
        for _ in range(60):
            churn.second()
            before, cpu, wall = lab.world.steps, time.process_time(), time.perf_counter()
            lab.run(1.0)
            steps = lab.world.steps - before
            cpu_ms.append(1e3 * (time.process_time() - cpu) / steps)
            wall_ms.append(1e3 * (time.perf_counter() - wall) / steps)
        rows.append(
            {
                "minute": len(rows) + 1,
                "CPU ms/step median": float(np.median(cpu_ms)),
                "CPU ms/step max": max(cpu_ms),
                "wall ms/step median": float(np.median(wall_ms)),
                "memory MiB": process.memory_info().rss / 2**20,
            }
        )
        sys.stderr.write(f"\rminute {len(rows)}")
    sys.stderr.write("\n")
    return rows


def drift(rows: list[dict[str, Any]]) -> list[dict[str, Any]]:
    """Return first, last and the slope of a straight line through each figure of a soak.

    Of a long one without its first minutes, in which what is kept for scrubbing fills up.
    """
    found = []
    rows = rows[FILLING:] if len(rows) > 2 * FILLING else rows
    for key in ("CPU ms/step median", "wall ms/step median", "memory MiB"):
        values = [row[key] for row in rows]
        slope = float(np.polyfit(range(len(values)), values, 1)[0]) if len(values) > 1 else 0.0
        first, last = values[0], values[-1]
        found.append({"figure": key, "first": first, "last": last, "slope per hour": 60 * slope})
    return found


def oracle() -> list[dict[str, Any]]:
    """Replay the tests' motions in this engine and in MuJoCo; return how far apart objects are."""
    sys.path.insert(0, str(Path(__file__).parents[1] / "test"))
    from physics_oracle import gaps, replays

    rows = []
    for name in replays():
        gap = 1e3 * gaps(name)
        rows.append({"replay": name, "most mm": float(gap.max()), "end mm": float(gap[-1])})
    return rows


def in_process(*arguments: str) -> Any:
    """Run a part of this benchmark in a process of its own; return what it found."""
    command = [sys.executable, __file__, *arguments]
    done = subprocess.run(command, stdout=subprocess.PIPE, check=True)
    return json.loads(done.stdout.decode().splitlines()[-1])


def answer(found: Any) -> None:
    # pybullet writes to stdout too, when it likes.
    sys.stdout.write(f"\n{json.dumps(found)}\n")
    sys.stdout.flush()
    os._exit(0)


def main() -> None:
    parser = report.options(__doc__)
    parser.add_argument("--soak", type=float, metavar="MINUTES", help="only soak, so long")
    parser.add_argument("--case", help=argparse.SUPPRESS)
    parser.add_argument("--oracle", action="store_true", help=argparse.SUPPRESS)
    parser.add_argument("--load", type=float, help=argparse.SUPPRESS)
    parser.add_argument("--halt", type=int, help=argparse.SUPPRESS)
    options = parser.parse_args()
    thirteen = (list(LIBRARY.ids()) * 13)[:13]
    kinds = (KINDS * 4)[:32]
    if options.case:
        answer(measured(*json.loads(options.case)))
    if options.oracle:
        answer(oracle())
    if options.load or options.halt:
        import physics_node

        if options.halt:
            answer(physics_node.halt_latencies(options.halt))
        answer(physics_node.node_load(thirteen, kinds, options.load))
    if options.soak:
        rows = soak(thirteen, options.soak)
        report.show("Physics soak", rows, options.json)
        report.show("Physics soak, drift", drift(rows), options.json)
        return
    seconds = report.scaled(options, 0.2, 3.0, 15.0)
    cases = (
        ("one robot, headless", ["ur5e"], 10, 3 * seconds, False),
        ("the same, no object at rest", ["ur5e"], 10, 3 * seconds, True),
        ("thirteen cobots", ["ur5e"] * 13, 32, seconds, False),
        ("thirteen models", thirteen, 32, seconds, False),
        ("the same, no object at rest", thirteen, 32, seconds, True),
    )
    rows = [in_process("--case", json.dumps(case)) for case in report.some(options, cases)]
    report.show("Physics steps", rows, options.json)
    if not options.touch:
        report.show("Physics beside MuJoCo", in_process("--oracle"), options.json)
    rows = in_process("--load", str(report.scaled(options, 0.5, 5.0, 30.0)))
    report.show("Physics node", rows, options.json)
    latencies = report.percentiles(in_process("--halt", str(report.scaled(options, 1, 6, 50))))
    row = {"what": "contact to last moving joint state, 100 Hz"}
    report.show("Physics halt", [row | {f"{k} ms": v for k, v in latencies.items()}], options.json)


if __name__ == "__main__":
    main()
