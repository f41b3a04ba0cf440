"""What physics costs and how soon it halts an arm.

Three questions: how long a step takes with a full scene, beside how long it may take; how much
faster than real time a small scene runs headless; how long it is from the contact's step to the
last joint state of a halted arm, through the graph. --soak runs a full scene for long and
watches memory and step time.
"""

from __future__ import annotations

import argparse
import json
import os
import signal
import subprocess
import sys
import time
from typing import Any

import numpy as np
import report

from mrlab_ros import share
from mrlab_ros.adapters.bullet import BulletEngine
from mrlab_ros.adapters.robot_library import RobotLibrary, read_yaml
from mrlab_ros.core.clock import SECOND
from mrlab_ros.core.physics import catalogue
from mrlab_ros.core.physics.grasp import Gripper
from mrlab_ros.core.physics.settings import Settings
from mrlab_ros.core.physics.world import World
from mrlab_ros.core.scene import Pose

ROOT = share.directory()
LIBRARY = RobotLibrary(ROOT / "robots")
KINDS = ("cube", "block", "cylinder", "sphere", "cup", "can", "bottle", "carton")


def make_world(models: list[str], objects: int) -> World:
    """Return a world with robots 3.5 m apart and objects on pedestals' tops and the floor."""
    types = catalogue.parse(read_yaml(ROOT / "config" / "objects.yaml"))
    engine = BulletEngine(lambda uri: ROOT / uri.removeprefix("package://mrlab_ros/"))
    world = World(engine, types, Settings())
    for i, model_id in enumerate(models):
        model = LIBRARY.model(model_id)
        place = Pose((3.5 * (i % 4), 3.5 * (i // 4), 0.0))
        world.add_robot(
            f"r{i}", LIBRARY.description(model_id), model.joint_names, place, Gripper.NONE
        )
    for i in range(objects):
        at = (3.5 * (i % 4) + 1.2 + 0.15 * (i // 8), 1.0 + 0.2 * (i // 4), 0.5)
        world.spawn(KINDS[i % len(KINDS)], pose=Pose(at), automatic=True)
    return world


def drive(world: World, models: list[str], seconds: float, start_ns: int = 0) -> int:
    """Send 100 Hz joint states of a slow wave and step along; return the end, ns."""
    homes = [LIBRARY.model(m).home for m in models]
    period_ns = SECOND // 100
    now_ns = start_ns
    for k in range(round(seconds * 100)):
        now_ns = start_ns + (k + 1) * period_ns
        t = now_ns / SECOND
        for i, home in enumerate(homes):
            wave = 0.3 * np.sin(t + np.arange(len(home)))
            speed = 0.3 * np.cos(t + np.arange(len(home)))
            world.joint_state(f"r{i}", now_ns, home + wave, speed)
        world.advance(now_ns)
        world.take_events()
        world.take_contacts()
    return now_ns


def measured(name: str, models: list[str], objects: int, seconds: float) -> dict[str, Any]:
    """Run one scene as fast as it goes."""
    world = make_world(models, objects)
    end_ns = drive(world, models, 1.0)
    engine_s = [0.0]
    step = world._engine.step

    def timed(duration: float) -> None:
        begin = time.perf_counter()
        step(duration)
        engine_s[0] += time.perf_counter() - begin

    world._engine.step = timed  # type: ignore[method-assign]
    before, cpu, begin = world.steps, time.process_time(), time.perf_counter()
    drive(world, models, seconds, end_ns)
    wall, cpu = time.perf_counter() - begin, time.process_time() - cpu
    steps = world.steps - before
    return {
        "scene": name,
        "robots": len(models),
        "objects": objects,
        "steps": steps,
        "engine ms/step": 1e3 * engine_s[0] / steps,
        "world ms/step": 1e3 * wall / steps,
        "engine % of a core": 100 * engine_s[0] / seconds,
        "world % of a core": 100 * cpu / seconds,
        "x real time": seconds / wall,
    }


def halt_latencies(runs: int) -> list[float]:
    """Halt an arm again and again; return contact to last moving joint state, ms."""
    physics = subprocess.Popen([sys.executable, __file__, "--node"])
    try:
        return halted(runs)
    finally:
        physics.terminate()
        physics.wait(20)


def halted(runs: int) -> list[float]:
    """Do the work of halt_latencies() with a physics node that runs elsewhere."""
    import rclpy
    from geometry_msgs.msg import Point
    from geometry_msgs.msg import Pose as PoseMessage
    from mrlab_msgs import msg, srv
    from rclpy.node import Node
    from sensor_msgs.msg import JointState
    from std_srvs.srv import Trigger

    from mrlab_ros import conversions, qos
    from mrlab_ros.core.trajectory import Channels, Source, Trajectory
    from mrlab_ros.nodes.calls import call
    from mrlab_ros.nodes.lab import LabNode
    from mrlab_ros.nodes.playback import PlaybackHostNode
    from mrlab_ros.spinning import SpunNode

    rclpy.init()
    model = LIBRARY.model("ur5e")
    t = np.arange(301) / 100
    pan = 0.5 * t
    positions = model.home + pan[:, None] * np.array([1, 0, 0, 0, 0, 0])
    zeros = np.zeros_like(positions)
    motion = Trajectory(
        "sweep", "ur5e", None, model.joint_names, 100.0, positions, None,
        Channels(np.gradient(positions, 0.01, axis=0), zeros, zeros.copy()),
        Source("q.mat", "q", "0" * 64),
    )  # fmt: skip

    class Catalogue(Node):
        def __init__(self) -> None:
            super().__init__("converter")
            self.create_service(srv.GetTrajectory, "~/get", self._get)

        def _get(self, request: Any, response: Any) -> Any:
            response.success = True
            response.trajectory = conversions.trajectory_to_message(motion)
            return response

    host, client = PlaybackHostNode(), Node("bench")
    spun = [SpunNode(node) for node in (Catalogue(), LabNode(), host, client)]

    def ask(kind: Any, name: str, /, **fields: Any) -> Any:
        answer = call(client.create_client(kind, name), kind.Request(**fields), 20.0)
        if not answer.success:
            raise SystemExit(f"{name}: {answer.message}")
        return answer

    robot = ask(srv.SpawnRobot, "/lab/spawn_robot", model="ur5e").robot.name
    states: list[Any] = []
    joints: list[Any] = []
    collisions: list[Any] = []
    client.create_subscription(
        msg.PlaybackState, f"/{robot}/playback_state", states.append, qos.EVENTS
    )
    client.create_subscription(JointState, f"/{robot}/joint_states", joints.append, qos.STREAM)
    client.create_subscription(msg.Collision, f"/{robot}/collision", collisions.append, qos.EVENTS)
    ask(srv.LoadTrajectory, f"/{robot}/load", id="sweep")
    place = model.chain.tool0(positions[120])[:3, 3]
    x, y, z = (float(v) for v in place)
    box = ask(
        srv.SpawnObject, "/physics/spawn_object", type="cube_large",
        pose=PoseMessage(position=Point(x=x, y=y, z=3.0)),
    ).object.name  # fmt: skip

    def put(height: float) -> None:
        ask(
            srv.MoveObject, "/physics/move_object", name=box, held=True,
            pose=PoseMessage(position=Point(x=x, y=y, z=height)),
        )  # fmt: skip

    def wait(condition: Any) -> None:
        deadline = time.monotonic() + 20
        while not condition():
            if time.monotonic() > deadline:
                raise SystemExit(f"waited in vain; the playback is {states[-1].label}")
            time.sleep(0.01)

    def once() -> float:
        put(3.0)
        wait(lambda: states[-1].label in ("READY", "PAUSED"))
        ask(srv.Seek, f"/{robot}/seek", position=0.6)
        put(z)
        collisions.clear()
        ask(Trigger, f"/{robot}/play")
        wait(lambda: states[-1].label == "COLLISION_HALT" and collisions)
        contact_ns = conversions.to_ns(collisions[0].header.stamp)
        time.sleep(0.1)
        last = next(j for j in reversed(joints) if np.any(j.velocity))
        return (conversions.to_ns(last.header.stamp) - contact_ns) * 1e-6

    found = [once() for _ in range(runs)]
    for each in spun:
        each.close()
    return found


def run_node() -> None:
    """Run the physics node until it is asked to stop."""
    import rclpy

    from mrlab_ros.nodes.physics import PhysicsNode
    from mrlab_ros.spinning import SpunNode

    rclpy.init()
    spun = SpunNode(PhysicsNode())
    signal.sigwait({signal.SIGTERM, signal.SIGINT})
    spun.close()
    os._exit(0)


def memory_mib() -> float:
    with open("/proc/self/statm") as file:
        return int(file.read().split()[1]) * os.sysconf("SC_PAGE_SIZE") / 2**20


def soak(models: list[str], minutes: float) -> list[dict[str, Any]]:
    """Run a full scene for `minutes` of its own time; a row for each tenth."""
    world = make_world(models, 32)
    now_ns, rows = drive(world, models, 5.0), []
    for part in range(10):
        begin, before = time.perf_counter(), world.steps
        now_ns = drive(world, models, 6 * minutes, now_ns)
        rows.append(
            {
                "tenth": part + 1,
                "simulated min": (now_ns / SECOND) / 60,
                "world ms/step": 1e3 * (time.perf_counter() - begin) / (world.steps - before),
                "memory MiB": memory_mib(),
            }
        )
    return rows


def main() -> None:
    parser = report.options(__doc__)
    parser.add_argument("--soak", type=float, metavar="MINUTES", help="only soak, so long")
    parser.add_argument("--node", action="store_true", help=argparse.SUPPRESS)
    parser.add_argument("--case", help=argparse.SUPPRESS)
    options = parser.parse_args()
    if options.node:
        run_node()
    thirteen = (list(LIBRARY.ids()) * 13)[:13]
    if options.case:
        sys.stdout.write(json.dumps(measured(*json.loads(options.case))))
        sys.stdout.flush()
        os._exit(0)
    if options.soak:
        report.show("Physics soak", soak(thirteen, options.soak), options.json)
        return
    seconds = 3.0 if options.quick else 15.0
    rows = []
    for case in (
        ("one robot, headless", ["ur5e"], 10, 3 * seconds),
        ("thirteen cobots", ["ur5e"] * 13, 32, seconds),
        ("thirteen models", thirteen, 32, seconds),
    ):
        done = subprocess.run(
            [sys.executable, __file__, "--case", json.dumps(case)],
            stdout=subprocess.PIPE,
            check=True,
        )
        text = done.stdout.decode()
        rows.append(json.loads(text[text.index("{") :]))
    report.show("Physics steps", rows, options.json)
    latencies = report.percentiles(halt_latencies(6 if options.quick else 50))
    row = {"what": "contact to last moving joint state, 100 Hz"}
    report.show("Physics halt", [row | {f"{k} ms": v for k, v in latencies.items()}], options.json)
    sys.stdout.flush()
    os._exit(0)


if __name__ == "__main__":
    main()
