"""The world on pybullet: impulses, thin plates, grasps, and input that would end Bullet."""

from __future__ import annotations

import hashlib
import re
import sys
from dataclasses import replace
from pathlib import Path

import numpy as np
import pybullet
import pytest
from refusals import refused

from mrlab_ros.adapters.bullet.engine import BulletEngine
from mrlab_ros.adapters.robots.diagnostics import FOLDER_IN_USE
from mrlab_ros.adapters.robots.exporting import export
from mrlab_ros.adapters.robots.library import RobotLibrary
from mrlab_ros.adapters.yaml_files import read_yaml
from mrlab_ros.core.base.clock import SECOND, PlaybackClock
from mrlab_ros.core.base.errors import BadInput, Misuse
from mrlab_ros.core.base.geometry import Pose
from mrlab_ros.core.physics import catalogue
from mrlab_ros.core.physics.engine import Body, BodyState, Kind, Part, Shape
from mrlab_ros.core.physics.grasp import kinds
from mrlab_ros.core.physics.grasp.states import Grasp
from mrlab_ros.core.physics.settings import Settings
from mrlab_ros.core.physics.simulated_robot import GripperProgram, Playing
from mrlab_ros.core.physics.world import World
from mrlab_ros.core.physics.world_state import CollisionChanged, GraspChanged
from mrlab_ros.core.playback.states import State
from mrlab_ros.core.scene.surfaces import Surface

ROOT = Path(__file__).parents[4]
LIBRARY = RobotLibrary(ROOT / "robots")
TYPES = catalogue.parse(read_yaml(ROOT / "config" / "objects.yaml"))
MS = SECOND // 1000
STEP = 1 / 240


def beam(length: float = 1.0, thick: float = 0.05) -> str:
    """One joint about z at half a metre, a beam along x."""
    return f"""<robot name="beam">
      <link name="base_link"/>
      <link name="beam"><collision><origin xyz="{length / 2} 0 0"/>
        <geometry><box size="{length} {thick} {thick}"/></geometry></collision></link>
      <joint name="j" type="revolute"><parent link="base_link"/><child link="beam"/>
        <origin xyz="0 0 0.5"/><axis xyz="0 0 1"/>
        <limit lower="-6" upper="6" effort="1" velocity="5"/></joint></robot>"""


def resolve(uri: str) -> Path:
    return ROOT / uri.removeprefix("package://mrlab_ros/")


@pytest.fixture
def engine():
    engine = BulletEngine(resolve)
    yield engine
    engine.close()


@pytest.fixture
def world(engine):
    return World(engine, TYPES, Settings())


def drive(world: World, robot: str, positions, rate: float = 100.0, start_ns: int = 0):
    """Send joint states at `rate`, stepping along; return the events."""
    events = []
    positions = np.asarray(positions)
    velocities = np.gradient(positions, 1 / rate, axis=0)
    for i, (q, v) in enumerate(zip(positions, velocities, strict=True)):
        now_ns = start_ns + round(i * SECOND / rate)
        world.joint_state(robot, now_ns, q, v)
        world.advance(now_ns)
        events += world.take_events()
    return events


def collisions(events):
    return [e for e in events if isinstance(e, CollisionChanged)]


def test_what_the_arm_hits_gets_the_arms_speed_and_the_arm_keeps_its_own(engine):
    engine = BulletEngine(resolve, gravity=0.0)
    engine.add_arm("a", beam(), ("j",), Pose())
    ball = Body((Part(Shape.SPHERE, (0.05,)),), 0.2, restitution=0.0)
    engine.add_object("ball", ball, BodyState(Pose((0.8, 0.3, 0.5))))
    touches, k = [], 0
    while not touches:
        engine.move_arm("a", np.array([k * STEP]), np.array([1.0]))
        engine.step(STEP)
        touches = engine.touches("a")
        k += 1
    (touch,) = touches
    assert (touch.link, touch.kind, touch.other) == ("beam", Kind.OBJECT, "ball")
    radius = np.hypot(*touch.point[:2])
    speed = np.linalg.norm(engine.object("ball").linear)
    assert speed == pytest.approx(radius, rel=0.1)  # 1 rad/s
    assert touch.impulse == pytest.approx(0.2 * speed, rel=0.01)
    assert engine.link("a", "beam").angular[2] == pytest.approx(1.0, rel=1e-3)
    engine.close()


@pytest.mark.parametrize("speed", [3.0, 6.0])
def test_a_fast_thin_tool_does_not_pass_a_thin_plate(world, speed):
    world.add_robot("a", beam(1.0, 0.004), ("j",), Pose(), kinds.NONE)
    # Upright, 5 mm thick, across the way of the tip.
    world.spawn("plate", pose=Pose((0.9, 0.5, 0.5), (0.7071068, 0, 0, 0.7071068)))
    held = Pose((0.85, 0.5, 0.5), (0.7071068, 0, 0, 0.7071068))
    world.move("plate_1", held, (0, 0, 0), (0, 0, 0), held=True)
    events = drive(world, "a", np.arange(60)[:, None] * (speed / 100))
    (hit,) = [e for e in collisions(events) if e.colliding]
    assert hit.contact.touch.other == "plate_1"


def run(seconds: float = 3.0, stall: tuple[float, float] = (0.0, 0.0)):
    """A pick that knocks something over on the way: return a digest of all that happened.

    stall: from when to when, s, nothing comes in and no time passes for the world.
    """
    engine = BulletEngine(resolve)
    world = World(engine, TYPES, Settings())
    model = LIBRARY.model("ur5e")
    description = LIBRARY.description("ur5e", "parallel_gripper")
    world.add_robot("a", description, model.joint_names, Pose(), kinds.FINGERS)
    tool = model.chain.tool0(model.home)
    center = tool[:3, 3] + 0.162 * tool[:3, 2]
    world.spawn("pedestal", pose=Pose(tuple(float(v) for v in center - [0, 0, 0.2251])))
    world.spawn("cube", pose=Pose(tuple(float(v) for v in center)))
    away = model.chain.tool0(model.home + np.array([0.6, 0, 0, 0, 0, 0]))[:3, 3] - [0, 0, 0.1]
    world.spawn("can", pose=Pose(tuple(float(v) for v in away)))
    world.set_program("a", GripperProgram((0.3, 2.5), (True, False)))
    t = np.arange(round(seconds * 100)) / 100
    pan = 0.6 * np.clip((t - 1.2) / 1.2, 0, 1) ** 2
    positions = model.home + pan[:, None] * np.array([1, 0, 0, 0, 0, 0])
    playing = Playing(State.PLAYING, "t", PlaybackClock(0, 0.0, 1.0), 0, len(t), 100.0, t[-1])
    rested = PlaybackClock(2700 * MS, 2.7, 0.0)
    paused = Playing(State.PAUSED, "t", rested, 270, len(t), 100.0, t[-1], 2700 * MS)
    events, contacts, places, waiting = [], [], [], []
    velocities = np.gradient(positions, 0.01, axis=0)
    for i in range(len(t)):
        now_ns = i * 10 * MS
        waiting.append(i)
        if stall[0] <= now_ns / SECOND < stall[1]:
            continue
        # What comes after a stall comes in any order but its own topic's.
        if 2 in waiting:
            world.playback("a", playing)
        if 270 in waiting:
            world.playback("a", paused)
        for k in waiting:
            world.joint_state("a", k * 10 * MS, positions[k], velocities[k])
            if k % 16 == 15 or k == i:
                world.advance(now_ns)
        waiting.clear()
        events += world.take_events()
        contacts += world.take_contacts()
        places.append(world.motion("cube_1"))
    engine.close()
    contacts = contacts if stall == (0.0, 0.0) else []
    digest = hashlib.sha256(repr((events, contacts, places)).encode()).hexdigest()
    return digest, events, places


def test_the_same_inputs_give_the_same_events_and_a_grasp_without_a_jump():
    first, events, places = run()
    second, _, _ = run()
    assert first == second
    grasps = [e for e in events if isinstance(e, GraspChanged)]
    assert [g.state for g in grasps] == [Grasp.OPEN, Grasp.CLOSING, Grasp.HOLDING, Grasp.OPEN]
    held = grasps[2].stamp_ns // (10 * MS)
    before, after = (np.array(places[held + i].pose.position) for i in (-1, 2))
    assert np.abs(after - before).max() < 0.002


@pytest.mark.parametrize("stall", [(0.1, 1.6), (0.5, 0.9), (2.3, 2.9)])
def test_a_stall_changes_nothing_of_what_happens(stall):
    """Neither the fingers' time to close nor where they open is lost with it."""
    _, expected, places = run()
    _, events, late = run(stall=stall)
    assert events == expected
    assert late[-1] == places[-1]


def test_attaching_moves_nothing_and_the_held_object_follows_the_hand(world):
    world.add_robot("a", beam(), ("j",), Pose(), kinds.NONE)
    drive(world, "a", np.zeros((3, 1)))
    world.spawn("cube", pose=Pose((0.9, 0.06, 0.55)))
    before = world.motion("cube_1").pose
    world.attach("a", "cube_1", reach=2.0)
    drive(world, "a", np.zeros((4, 1)), start_ns=30 * MS)
    after = world.motion("cube_1").pose
    assert np.abs(np.subtract(after.position, before.position)).max() < 1e-4
    assert np.abs(np.subtract(after.orientation, before.orientation)).max() < 1e-4
    t = np.arange(1, 200) / 100
    q = 0.5 - 0.5 * np.cos(2 * t)
    drive(world, "a", q[:, None], start_ns=70 * MS)
    x, y, z = world.motion("cube_1").pose.position
    shown = world.robot("a").placed[0]
    expected = [
        0.9 * np.cos(shown) - 0.06 * np.sin(shown),
        0.9 * np.sin(shown) + 0.06 * np.cos(shown),
        0.55,
    ]
    assert [x, y, z] == pytest.approx(expected, abs=0.006)  # one step ahead at most
    world.detach("a")
    v = world.motion("cube_1").linear
    assert np.hypot(v[0], v[1]) == pytest.approx(abs(np.sin(2 * t[-1])) * 0.902, abs=0.05)


def test_what_sleeps_on_something_held_falls_when_a_seek_takes_that_away(world):
    world.add_robot("a", beam(), ("j",), Pose((-1.0, 0.0, 0.3)), kinds.NONE)
    for i in range(2):
        world.spawn("cube", pose=Pose((0.0, 0.0, 0.0255 + 0.05 * i)))
    drive(world, "a", np.full((20, 1), 0.5))
    world.attach("a", "cube_1", reach=2.0)
    drive(world, "a", np.full((400, 1), 0.5), start_ns=SECOND)
    assert world.motion("cube_2").pose.position[2] == pytest.approx(0.075, abs=0.002)
    drive(world, "a", np.full((80, 1), 2.5), start_ns=6 * SECOND)
    assert world.motion("cube_2").pose.position[2] == pytest.approx(0.025, abs=0.002)


def test_a_vacuum_cup_holds_what_it_touches_and_another_robot_takes_it_over(world):
    model = LIBRARY.model("ur5e")
    description = LIBRARY.description("ur5e", "vacuum_cup")
    world.add_robot("a", description, model.joint_names, Pose(), kinds.CUP)
    tool = model.chain.tool0(model.home)
    below = tool[:3, 3] + (0.012 + 0.13) * tool[:3, 2]
    world.spawn("pedestal", pose=Pose(tuple(float(v) for v in below - [0, 0, 0.249])))
    world.spawn("cube", pose=Pose(tuple(float(v) for v in below - [0, 0, 0.0235])))
    world.set_program("a", GripperProgram((0.1,), (True,)))
    playing = Playing(State.PLAYING, "t", PlaybackClock(0, 0.0, 1.0), 0, 100, 100.0, 1.0)
    world.playback("a", playing)
    events = drive(world, "a", np.tile(model.home, (60, 1)))
    assert world.robot("a").held == "cube_1"
    assert not collisions(events)
    world.playback("a", replace(playing, state=State.PAUSED))
    world.add_robot("b", beam(), ("j",), Pose((1.0, 1.0, 0.0)), kinds.NONE)
    drive(world, "b", np.zeros((3, 1)), start_ns=610 * MS)
    world.attach("b", "cube_1", reach=2.0)
    assert world.robot("a").grasp is Grasp.EMPTY
    world.remove_robot("b")
    world.advance(SECOND)
    assert world.object("cube_1").held_by == ""


@pytest.mark.parametrize("robot", LIBRARY.ids())
def test_every_robot_stands_at_home_without_touching_itself_or_the_floor(world, robot):
    model = LIBRARY.model(robot)
    world.add_robot("a", LIBRARY.description(robot), model.joint_names, Pose(), kinds.NONE)
    assert not collisions(drive(world, "a", np.tile(model.home, (5, 1))))


def test_every_object_of_the_catalogue_spawns_free_and_comes_to_rest_upright(world):
    for kind in TYPES.ids:
        world.spawn(kind, automatic=True)
    start = {o.name: world.motion(o.name).pose for o in world.objects}
    for i in range(1, 100):
        world.advance(i * 20 * MS)
    for name, pose in start.items():
        now = world.motion(name)
        assert np.linalg.norm(now.linear) < 0.05, name
        assert np.abs(np.subtract(now.pose.position, pose.position)).max() < 0.02, name


def test_an_object_falls_on_a_mesh_and_off_a_table_that_is_taken_away(world):
    corners = np.array([[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0.0]])
    mesh = np.array([[0, 1, 2], [0, 2, 3]], np.int32)
    none = np.zeros((0, 3), np.int32)
    world.set_surfaces([
        Surface("table", "table", Pose((0, 0, 0.7)), corners, none),
        Surface("shelf", "other", Pose((5, 0, 0.4)), corners, mesh),
    ])  # fmt: skip
    on_table = world.spawn("cube", pose=Pose((0, 0, 1.0)), automatic=True).name
    on_shelf = world.spawn("cube", pose=Pose((5, 0, 1.0)), automatic=True).name
    for i in range(50):
        world.advance(i * 20 * MS)
    assert world.motion(on_table).pose.position[2] == pytest.approx(0.725, abs=0.002)
    assert world.motion(on_shelf).pose.position[2] == pytest.approx(0.425, abs=0.002)
    world.set_surfaces([])
    for i in range(50, 120):
        world.advance(i * 20 * MS)
    assert world.motion(on_table).pose.position[2] == pytest.approx(0.025, abs=0.002)


def test_input_that_would_end_bullet_is_refused_before(engine):
    engine.add_arm("a", beam(), ("j",), Pose())
    sphere = Part(Shape.SPHERE, (0.1,))
    nan = float("nan")
    cases = [
        lambda: engine.move_arm("a", np.array([nan]), np.array([0.0])),
        lambda: engine.move_arm("a", np.zeros(3), np.zeros(3)),
        lambda: engine.move_arm("nobody", np.zeros(1), np.zeros(1)),
        lambda: engine.add_arm("a", beam(), ("j",), Pose()),
        lambda: engine.add_arm("b", "<robot", ("j",), Pose()),
        lambda: engine.add_arm("b", "<robot/>", (), Pose()),
        lambda: engine.add_arm("b", beam(), ("other",), Pose()),
        lambda: engine.add_arm("b", beam().replace('<box size="1.0 0.05 0.05"/>',
                '<mesh filename="package://mrlab_ros/no.stl"/>'), ("j",), Pose()),
        lambda: engine.add_object("x", Body((sphere,), nan), BodyState(Pose())),
        lambda: engine.add_object("x", Body((), 1.0), BodyState(Pose())),
        lambda: engine.add_object("x", Body((Part(Shape.BOX, (1, 0, 1)),), 1), BodyState(Pose())),
        lambda: engine.add_object("x", Body((Part(Shape.MESH),), 0.0), BodyState(Pose())),
        lambda: engine.add_object(
            "x", Body((Part(Shape.MESH, vertices=np.eye(3)),), 1.0), BodyState(Pose())
        ),
        lambda: engine.add_surface(
            "x",
            Body((Part(Shape.MESH, vertices=np.eye(3), triangles=np.array([[0, 1, 9]])),), 0.0),
            Pose(),
        ),
        lambda: engine.remove_object("x"),
        lambda: engine.set_object("x", BodyState(Pose())),
        lambda: engine.hold("a", "beam", "x"),
        lambda: engine.link("a", "hand"),
        lambda: engine.drive_fingers("a", [1.0]),
        lambda: engine.step(nan),
        lambda: engine.step(0.0),
    ]  # fmt: skip
    for case in cases:
        with pytest.raises((BadInput, Misuse)):
            case()
    engine.step(STEP)


def test_a_robot_that_comes_again_is_the_body_that_was_put_aside(world, engine):
    """Bullet keeps the shapes of a removed body: 60 spawns would take 50 MB."""
    world.spawn("cube", pose=Pose((0.9, 0.3, 0.5)))
    seen = set()
    for k in range(12):
        world.add_robot("a", beam(), ("j",), Pose((0.0, 0.0, 0.1 * (k % 2))), kinds.NONE)
        seen.add(engine._arms["a"].body)
        drive(world, "a", np.zeros((3, 1)), start_ns=k * SECOND)
        world.remove_robot("a")
    assert len(seen) == 1
    world.advance(13 * SECOND)
    # What is put aside touches nothing, and what is back does.
    height = world.motion("cube_1").pose.position[2]
    assert height == pytest.approx(0.025, abs=0.002)
    world.move("cube_1", Pose((0.9, 0.1, 0.5)), (0, 0, 0), (0, 0, 0), held=True)
    world.add_robot("a", beam(), ("j",), Pose(), kinds.NONE)
    events = drive(world, "a", np.arange(30)[:, None] * 0.01, start_ns=14 * SECOND)
    assert collisions(events)[0].contact.touch.other == "cube_1"


@pytest.mark.parametrize("robot", LIBRARY.ids())
def test_plain_bullet_has_nothing_to_say_of_a_shipped_description(robot, capfd, tmp_path):
    """Frames without a body state a mass too: an engine takes 1 kg for one that states none."""
    text = LIBRARY.own_description(robot).replace("package://mrlab_ros", str(ROOT))
    path = tmp_path / "robot.urdf"
    # Bullet reads no .glb.
    path.write_text(re.sub(r"<visual>.*?</visual>", "", text, flags=re.S))
    assert said_of(path, capfd) == ""


def said_of(path, capfd) -> str:
    """Return what plain Bullet says while it loads a URDF."""
    client = pybullet.connect(pybullet.DIRECT)
    capfd.readouterr()
    body = pybullet.loadURDF(str(path), useFixedBase=True, physicsClientId=client)
    sys.stdout.flush()
    said = capfd.readouterr()
    assert pybullet.getVisualShapeData(body, physicsClientId=client) or "visual" not in str(path)
    pybullet.disconnect(client)
    return said.out + said.err


HANDED = [("ur5e", hand) for hand in LIBRARY.end_effectors()]


@pytest.mark.parametrize(("robot", "hand"), [*((r, None) for r in LIBRARY.ids()), *HANDED])
def test_plain_bullet_loads_an_exported_robot_with_what_is_seen(robot, hand, capfd, tmp_path):
    path = export(LIBRARY, robot, hand, tmp_path / "visual")
    assert said_of(path, capfd) == ""
    with refused(FOLDER_IN_USE, BadInput, folder=str(tmp_path / "visual")):
        export(LIBRARY, robot, hand, tmp_path / "visual")
