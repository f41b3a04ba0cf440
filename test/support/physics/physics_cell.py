"""A cell for tests of the physics: gantries whose tool is driven to places, without a graph."""

from __future__ import annotations

import hashlib
import random
from pathlib import Path

from mrlab_ros.adapters.bullet.engine import BulletEngine
from mrlab_ros.adapters.robots.library import RobotLibrary
from mrlab_ros.adapters.yaml_files import read_yaml
from mrlab_ros.core.base.clock import SECOND, PlaybackClock
from mrlab_ros.core.base.diagnostic import Diagnostic
from mrlab_ros.core.base.geometry import Pose, quaternion_from_rpy
from mrlab_ros.core.physics import catalogue
from mrlab_ros.core.physics.grasp import kinds
from mrlab_ros.core.physics.grasp.kinds import Gripper
from mrlab_ros.core.physics.grasp.load import Tool
from mrlab_ros.core.physics.grasp.states import Grasp
from mrlab_ros.core.physics.settings import Settings
from mrlab_ros.core.physics.simulated_robot import GripperProgram, Playing
from mrlab_ros.core.physics.world import World
from mrlab_ros.core.physics.world_state import CollisionChanged, GraspChanged, LoadChanged
from mrlab_ros.core.playback.states import State

ROOT = Path(__file__).parents[3]
LIBRARY = RobotLibrary(ROOT / "robots")
OWN = {
    "bar": {"shape": "box", "size": [0.6, 0.04, 0.04], "mass": 0.5},
    "wide": {"shape": "box", "size": [0.06, 0.09, 0.06], "mass": 0.2},
    "fits": {"shape": "box", "size": [0.06, 0.084, 0.06], "mass": 0.2},
    "heavy": {"shape": "box", "size": [0.06, 0.06, 0.06], "mass": 20.0},
    "lead": {"shape": "box", "size": [0.06, 0.06, 0.06], "mass": 7.0},
    "nut": {"shape": "box", "size": [0.02, 0.02, 0.02], "mass": 0.02},
    "die": {"shape": "box", "size": [0.03, 0.03, 0.03], "mass": 0.05},
    "thin": {"shape": "box", "size": [0.1, 0.003, 0.06], "mass": 0.05},
    "slick": {"shape": "box", "size": [0.06, 0.06, 0.06], "mass": 4.0, "friction": 0.15},
    "slab": {"shape": "box", "size": [0.3, 0.3, 0.02], "mass": 1.0},
    "anvil": {"shape": "box", "size": [0.3, 0.3, 0.05], "mass": 9.0},
    "round": {"shape": "cylinder", "size": [0.02, 0.08], "mass": 0.2},
    "belt": {"shape": "box", "size": [3.0, 0.3, 0.02], "fixed": True},
    # It glides: what drives a belt need not press.
    "parcel": {"shape": "box", "size": [0.05, 0.05, 0.05], "mass": 0.01, "friction": 0.004},
    "tray": {
        "mass": 0.5,
        "parts": [
            {"shape": "box", "size": [0.3, 0.2, 0.01]},
            {"shape": "box", "size": [0.3, 0.01, 0.05], "at": [0, 0.095, 0.02]},
            {"shape": "box", "size": [0.3, 0.01, 0.05], "at": [0, -0.095, 0.02]},
        ],
    },
}
TYPES = catalogue.parse({"objects": read_yaml(ROOT / "config" / "objects.yaml")["objects"] | OWN})
JOINTS = ("x", "y", "z", "yaw", "tilt")
PERIOD_NS = SECOND // 100
# From tool0 to the middle of the pads of the parallel gripper, and to where the hull of the cup
# touches, m.
PADS, LIP = 0.012 + 0.0995 + 0.043, 0.012 + 0.133
# How often a joint state, or the world, is late where the machine stalls.
STALLED = 0.7
CUP = Tool(5.0, 45.0, 0.026)


def _link(name: str, mass: float, collision: str = "") -> str:
    return f"""<link name="{name}"><inertial><mass value="{mass}"/><inertia ixx="1" ixy="0"
      ixz="0" iyy="1" iyz="0" izz="1"/></inertial>{collision}</link>"""


def _joint(name: str, kind: str, parent: str, child: str, axis: str, rpy: str = "0 0 0") -> str:
    return f"""<joint name="{name}" type="{kind}"><parent link="{parent}"/><child link="{child}"/>
      <origin xyz="0 0 0" rpy="{rpy}"/><axis xyz="{axis}"/>
      <limit lower="-9" upper="9" effort="1" velocity="9"/></joint>"""


MAST = """<collision><origin xyz="0 0 0.25"/><geometry><cylinder radius="0.03" length="0.44"/>
  </geometry></collision>"""
GANTRY = "\n".join([
    '<robot name="gantry">', _link("base", 1), _link("cx", 5), _link("cy", 5),
    _link("mast", 20, MAST), _link("wrist", 1), _link("tilted", 1), _link("tool0", 0.1),
    _joint("x", "prismatic", "base", "cx", "1 0 0"),
    _joint("y", "prismatic", "cx", "cy", "0 1 0"),
    _joint("z", "prismatic", "cy", "mast", "0 0 1"),
    _joint("yaw", "revolute", "mast", "wrist", "0 0 1"),
    _joint("tilt", "revolute", "wrist", "tilted", "1 0 0"),
    _joint("flange", "fixed", "tilted", "tool0", "0 0 1", "3.141592653589793 0 0"), "</robot>",
])  # fmt: skip


def _box(size: str, at: str) -> str:
    return f"""<collision><origin xyz="{at}"/><geometry><box size="{size}"/></geometry>
      </collision>"""


# A gantry with a hand of one jaw: it closes on what is fixed to the palm.
JAWED = GANTRY.replace("</robot>", "".join([
    _link("palm", 0.2, _box("0.02 0.09 0.03", "0 0 0.035")),
    _link("fixed_jaw", 0.1, _box("0.02 0.01 0.06", "0 -0.035 0.08")),
    _link("jaw", 0.1, _box("0.02 0.01 0.06", "0 0 0.03")),
    _joint("hand", "fixed", "tool0", "palm", "0 0 1"),
    _joint("beside", "fixed", "palm", "fixed_jaw", "0 0 1"),
    '<joint name="jaw" type="revolute"><parent link="palm"/><child link="jaw"/>'
    '<origin xyz="0 0.035 0.05"/><axis xyz="1 0 0"/>'
    '<limit lower="-0.6" upper="0.9" velocity="1.5" effort="3"/></joint></robot>',
]))  # fmt: skip


def gantry(folder: Path) -> RobotLibrary:
    """Return a library with a gantry, made below `folder`."""
    place = folder / "gantry"
    place.mkdir(parents=True, exist_ok=True)
    (place / "robot.urdf").write_text(GANTRY)
    (place / "robot.yaml").write_text("id: gantry\nflange_diameter: 0.06\n")
    return RobotLibrary(ROOT / "robots", folder)


class Cell:
    """Gantries in one world; time moves with their motions, 10 ms at a time.

    stalls: on a loaded machine, whose: joint states arrive late and together, and the world is
    stepped late. None: all comes in time.
    """

    def __init__(
        self,
        library: RobotLibrary,
        settings: Settings | None = None,
        stalls: random.Random | None = None,
    ) -> None:
        self.library = library
        self.engine = BulletEngine(library.mesh_path)
        self.world = World(self.engine, TYPES, settings or Settings())
        self._stalls = stalls
        self.now_ns = 0
        self.at: dict[str, tuple[float, ...]] = {}
        self.program: dict[str, list[tuple[float, bool]]] = {}
        self.events: list = []

    def add(
        self, name: str, hand: str = "parallel_gripper", at=(0.0, 0.0, 0.5), payload: float = 5.0
    ) -> None:
        """Add a gantry with its tool0 at `at`: x, y, z m and optionally yaw, tilt rad."""
        vacuum = hand == "vacuum_cup"
        kind = kinds.CUP if vacuum else kinds.FINGERS
        tool = CUP if vacuum else Tool(payload)
        text = self.library.description("gantry", hand)
        self.join(name, text, JOINTS, (*at, *(0.0,) * (5 - len(at))), kind, tool)

    def join(self, name: str, text: str, joints, at, kind: Gripper, tool: Tool) -> None:
        """Add any robot; at: its joint positions."""
        self.world.add_robot(name, text, tuple(joints), Pose(), kind, frozenset(), tool)
        self.at[name] = tuple(at)
        self.program[name] = [(0.0, False)]
        self.world.set_program(name, GripperProgram((0.0,), (False,)))
        clock = PlaybackClock(self.now_ns, self.now_ns / SECOND, 1.0)
        playing = Playing(State.PLAYING, "t", clock, 0, 100_000, 100.0, 1000.0, self.now_ns)
        self.world.playback(name, playing)
        self.go(name, at, 0.03)

    def put(self, kind: str, at, rpy=(0.0, 0.0, 0.0), name: str = "") -> str:
        """Spawn an object; its centre at `at`, m."""
        return self.world.spawn(kind, name, Pose(tuple(at), quaternion_from_rpy(*rpy))).name

    def go(self, name: str, to, seconds: float, *, even: bool = False) -> None:
        """Drive one gantry to `to`; without `even` it begins and ends at rest."""
        start = self.at[name]
        goal = (*to, *start[len(to) :])
        count = max(round(seconds * 100), 1)
        waiting = []
        for k in range(1, count + 1):
            s = k / count
            share, rate = (s, 1.0) if even else (s * s * (3 - 2 * s), 6 * s * (1 - s))
            self.now_ns += PERIOD_NS
            for other, at in self.at.items():
                if other == name:
                    q = tuple(a + share * (b - a) for a, b in zip(start, goal, strict=True))
                    v = tuple(rate * (b - a) / seconds for a, b in zip(start, goal, strict=True))
                else:
                    q, v = at, (0.0,) * len(at)
                waiting.append((other, self.now_ns, q, v))
            if k == count or not self._stalled():
                for state in waiting:
                    self.world.joint_state(*state)
                waiting.clear()
            if k == count or not self._stalled():
                self.world.advance(self.now_ns)
                self.events += self.world.take_events()
        self.at[name] = goal

    def accelerate(self, name: str, axis: int, acceleration: float, seconds: float) -> None:
        """Drive one axis of a gantry from rest at a constant acceleration, m/s^2, to its speed."""
        start = self.at[name]
        for k in range(1, round(seconds * 100) + 1):
            to = list(start)
            to[axis] += acceleration * (k / 100) ** 2 / 2
            self.go(name, to, 0.01, even=True)

    def _stalled(self) -> bool:
        return self._stalls is not None and self._stalls.random() < STALLED

    def infinite(self) -> None:
        """Begin anew, with grasps that nothing slips out of."""
        self.engine.close()
        self.__init__(self.library, Settings(hold="infinite"), self._stalls)

    def wait(self, seconds: float) -> None:
        if self.at:
            name = next(iter(self.at))
            self.go(name, self.at[name], seconds)
            return
        for _ in range(round(seconds * 100)):
            self.now_ns += PERIOD_NS
            self.world.advance(self.now_ns)
            self.events += self.world.take_events()

    def close(self, name: str, seconds: float = 0.8) -> None:
        self._command(name, True, seconds)

    def open(self, name: str, seconds: float = 0.6) -> None:
        self._command(name, False, seconds)

    def _command(self, name: str, closed: bool, seconds: float) -> None:
        self.program[name].append((self.now_ns / SECOND, closed))
        times, closes = zip(*self.program[name], strict=True)
        self.world.set_program(name, GripperProgram(times, closes))
        if seconds:
            self.wait(seconds)

    def hits(self, name: str = "") -> list:
        """Return (robot, link, held, other) of each collision that began."""
        return [
            (e.robot, e.contact.touch.link, e.contact.touch.held, e.contact.touch.other)
            for e in self.events
            if isinstance(e, CollisionChanged) and e.colliding and name in ("", e.robot)
        ]

    def grasps(self, name: str) -> list[Grasp]:
        return [e.state for e in self.events if isinstance(e, GraspChanged) and e.robot == name]

    def reasons(self, name: str) -> dict[str, Diagnostic]:
        """Return what was said of a robot's gripper, by code."""
        found = [e.grasp if isinstance(e, LoadChanged) else e for e in self.events]
        of_robot = [e.reason for e in found if isinstance(e, GraspChanged) and e.robot == name]
        return {reason.code: reason for reason in of_robot if reason is not None}

    def place(self, name: str) -> tuple[float, float, float]:
        return self.world.motion(name).pose.position

    def digest(self) -> str:
        """Return a hash of all that happened and of where everything is."""
        places = [self.world.motion(thing.name) for thing in self.world.objects]
        return hashlib.sha256(repr((self.events, places)).encode()).hexdigest()
