"""Objects that lie still cost nothing, and wake when what they lie on goes or something comes."""

from __future__ import annotations

import itertools
import math
from pathlib import Path

import numpy as np
import pybullet
import pytest

from mrlab_ros.adapters.bullet.engine import GRAVITY, BulletEngine
from mrlab_ros.core.base.errors import BadInput
from mrlab_ros.core.base.geometry import Pose, compose
from mrlab_ros.core.physics.engine import Body, BodyState, Kind, Part, Shape
from mrlab_ros.core.physics.inertia import mass_properties

STEP = 1 / 240
CUBE = Body((Part(Shape.BOX, (0.05, 0.05, 0.05)),), 0.1)
POST = Body((Part(Shape.BOX, (0.2, 0.2, 0.2)),), 0.0)
FLOOR = Body((Part(Shape.BOX, (10.0, 10.0, 1.0), Pose((0.0, 0.0, -0.5))),), 0.0)
ARM = """<robot name="arm"><link name="base_link"/><link name="plate"><collision>
  <origin xyz="0.5 0 0"/><geometry><box size="1 0.2 0.02"/></geometry></collision></link>
  <joint name="j" type="revolute"><parent link="base_link"/><child link="plate"/>
  <origin xyz="0 0 0.5"/><axis xyz="0 0 1"/>
  <limit lower="-6" upper="6" effort="1" velocity="5"/></joint></robot>"""


@pytest.fixture
def engine():
    engine = BulletEngine(lambda uri: Path(uri))
    engine.add_surface("floor", FLOOR, Pose())
    yield engine
    engine.close()


def pass_time(engine: BulletEngine, seconds: float) -> None:
    for _ in range(round(seconds / STEP)):
        engine.step(STEP)


def height(engine: BulletEngine, name: str) -> float:
    return engine.object(name).pose.position[2]


def pile(engine: BulletEngine) -> None:
    """Three cubes on each other, asleep."""
    for i in range(3):
        place = Pose((0.0, 0.0, 0.025 + 0.05 * i))
        engine.add_object(f"cube_{i}", CUBE, BodyState(place))
    pass_time(engine, 4.0)


def test_what_lies_still_sleeps_and_what_was_held_sleeps_again(engine):
    pile(engine)
    engine.add_arm("a", ARM, ("j",), Pose((-1.0, 0.0, 0.0)))
    engine.move_arm("a", (0.0,), (0.0,))
    engine.hold("a", "plate", "cube_2")
    engine.step(STEP)
    engine.release("cube_2")
    pass_time(engine, 4.0)
    # Behind the engine's back: only what sleeps does not notice.
    pybullet.removeBody(engine._surfaces["floor"], physicsClientId=engine._client)
    before = [engine.object(f"cube_{i}") for i in range(3)]
    pass_time(engine, 0.5)
    assert [engine.object(f"cube_{i}") for i in range(3)] == before


@pytest.mark.parametrize("edge", [0.03, 0.05, 0.1])
def test_ten_cubes_with_gaps_between_them_stand(engine, edge):
    cube = Body((Part(Shape.BOX, (edge, edge, edge)),), 0.1)
    for i in range(10):
        place = Pose((0.0, 0.0, edge / 2 + 0.0005 + i * (edge + 0.0005)))
        engine.add_object(f"cube_{i}", cube, BodyState(place))
    pass_time(engine, 6.0)
    for i in range(10):
        stands = (0.0, 0.0, edge / 2 + i * edge)
        assert engine.object(f"cube_{i}").pose.position == pytest.approx(stands, abs=0.001)


def test_a_body_tips_over_its_own_centre_of_mass(engine):
    # A handle and a head ten times as dense, on a shelf whose edge lies 4 mm beside their centre.
    parts = (
        Part(Shape.BOX, (0.2, 0.03, 0.03)),
        Part(Shape.BOX, (0.03, 0.03, 0.03), Pose((0.115, 0.0, 0.0)), density=10.0),
    )
    centre, inertia = mass_properties(parts, 0.5)
    hammer = Body(parts, 0.5, centre=centre, inertia=inertia)
    shelf = Body((Part(Shape.BOX, (1.0, 1.0, 0.2)),), 0.0)
    engine.add_surface("shelf", shelf, Pose((-0.5, 0.0, 0.1)))
    for name, beside, y in (("stays", -0.004, -0.2), ("tips", 0.004, 0.2)):
        engine.add_object(name, hammer, BodyState(Pose((beside - centre[0], y, 0.2151))))
    pass_time(engine, 2.0)
    assert height(engine, "stays") == pytest.approx(0.215, abs=0.0005)
    assert height(engine, "tips") < 0.15

    # Thrown and turning, the centre goes straight on; the frame's origin turns about it.
    engine.add_object(
        "thrown", hammer, BodyState(Pose((-2.0, 0.0, 3.0)), (1.0, 0.0, 0.0), (0.0, 0.0, 5.0))
    )
    start = compose(engine.object("thrown").pose, Pose(centre)).position
    pass_time(engine, 0.5)
    x, y, _ = compose(engine.object("thrown").pose, Pose(centre)).position
    assert (x - start[0], y - start[1]) == pytest.approx((0.5, 0.5 * 5.0 * centre[0]), abs=0.003)


def test_what_leans_on_something_that_goes_falls(engine):
    pile(engine)
    engine.remove_object("cube_0")
    pass_time(engine, 1.0)
    assert height(engine, "cube_1") == pytest.approx(0.025, abs=0.001)
    assert height(engine, "cube_2") == pytest.approx(0.075, abs=0.001)


def test_what_leans_on_something_pulled_away_at_once_falls(engine):
    pile(engine)
    engine.set_object("cube_0", BodyState(Pose((1.0, 0.0, 1.0))))
    pass_time(engine, 1.0)
    assert height(engine, "cube_2") == pytest.approx(0.075, abs=0.001)
    assert height(engine, "cube_0") == pytest.approx(0.025, abs=0.001)


@pytest.mark.parametrize("parts", [1, 10])
def test_what_lost_its_floor_falls_freely_however_short_the_steps(engine, parts):
    pile(engine)
    engine.remove_surface("floor")
    for _ in range(60 * parts):
        engine.step(STEP / parts)
    fallen = 0.5 * GRAVITY * 0.25**2
    assert height(engine, "cube_2") == pytest.approx(0.125 - fallen, abs=0.01)


def test_a_fixed_thing_moved_by_hand_wakes_what_it_held_up_and_what_it_runs_into(engine):
    engine.add_object("post", POST, BodyState(Pose((0.0, 0.0, 0.1))))
    engine.add_object("on", CUBE, BodyState(Pose((0.0, 0.0, 0.225))))
    engine.add_object("beside", CUBE, BodyState(Pose((1.0, 0.0, 0.025))))
    pass_time(engine, 4.0)
    engine.set_object("post", BodyState(Pose((0.89, 0.0, 0.1))))
    pass_time(engine, 1.0)
    assert height(engine, "on") == pytest.approx(0.025, abs=0.001)
    assert engine.object("beside").pose.position[0] > 1.01


def test_what_an_arm_comes_to_touch_is_awake_and_what_stood_on_it_falls_when_it_goes(engine):
    pile(engine)
    engine.add_arm("a", ARM, ("j",), Pose((-1.0, 0.0, -0.45)))
    engine.add_object("on", CUBE, BodyState(Pose((-0.5, -0.5, 0.085))))
    engine.move_arm("a", (-0.8,), (0.0,))
    pass_time(engine, 4.0)
    for k in range(240):
        engine.move_arm("a", (-0.8 + k * STEP,), (1.0,))
        engine.step(STEP)
    assert math.hypot(*engine.object("cube_0").pose.position[:2]) > 0.02
    assert height(engine, "on") > 0.08
    for go in (
        lambda: engine.move_arm("a", (-2.0,), (0.0,), jumped=True),
        lambda: engine.place_arm("a", Pose((3.0, 0.0, -0.45))),
        lambda: engine.remove_arm("a"),
    ):
        engine.place_arm("a", Pose((-1.0, 0.0, -0.45)))
        engine.move_arm("a", (0.2,), (0.0,), jumped=True)
        engine.set_object("on", BodyState(Pose((-0.5, 0.1, 0.085))))
        pass_time(engine, 4.0)
        assert height(engine, "on") > 0.08
        go()
        pass_time(engine, 0.5)
        assert height(engine, "on") == pytest.approx(0.025, abs=0.002)


def test_held_things_give_way_to_nothing_and_weigh_again_what_they_weighed(engine):
    engine.add_arm("a", ARM, ("j",), Pose())
    engine.move_arm("a", (0.0,), (0.0,))
    engine.add_object("cube", CUBE, BodyState(Pose((0.9, 0.0, 0.6))))
    engine.hold("a", "plate", "cube")
    # What is added while something is held changes nothing about that.
    engine.add_object(
        "ball", Body((Part(Shape.SPHERE, (0.03,)),), 5.0), BodyState(Pose((0.9, 0, 1)))
    )
    for _ in range(240):
        engine.move_arm("a", (0.0,), (0.0,))
        engine.step(STEP)
        assert math.dist(engine.object("cube").pose.position, (0.9, 0.0, 0.6)) < 1e-4
    engine.remove_object("ball")
    engine.release("cube")
    engine.set_object("cube", BodyState(Pose((3.0, 0.0, 3.0))))
    pass_time(engine, 0.5)
    fallen = 0.5 * GRAVITY * 0.5**2
    assert height(engine, "cube") == pytest.approx(3.0 - fallen, abs=0.02)
    engine.add_object("other", CUBE, BodyState(Pose((3.04, 0.0, height(engine, "cube")))))
    engine.set_object("cube", BodyState(Pose((2.9, 0.0, 1.0)), (1.0, 0.0, 0.0)))
    engine.set_object("other", BodyState(Pose((3.0, 0.0, 1.0))))
    pass_time(engine, 0.2)
    # Of two equal masses the one gives the other half its speed at least.
    assert engine.object("other").linear[0] == pytest.approx(0.5, abs=0.1)


def test_things_that_come_do_not_stop_what_flies(engine):
    engine.add_object("thrown", CUBE, BodyState(Pose((0.0, 0.0, 1.0)), (0.0, 0.0, 2.0)))
    for k in range(24):
        engine.step(STEP)
        if k % 4 == 0:
            place = Pose((2.0 + k, 0.0, 0.025))
            engine.add_object(f"cube_{k}", CUBE, BodyState(place))
    assert engine.object("thrown").linear[2] == pytest.approx(2.0 - 0.1 * GRAVITY, rel=1e-3)


def test_an_arm_knows_no_gravity_and_no_limit_that_its_joint_states_do_not_keep(engine):
    engine.add_arm("a", ARM.replace("0 0 1", "0 1 0"), ("j",), Pose((0, 0, 1)))
    engine.add_object("cube", CUBE, BodyState(Pose((3.0, 0.0, 1.0))))
    for position, speed in ((0.0, 0.0), (8.0, 2.0)):
        engine.move_arm("a", (position,), (speed,))
        engine.step(STEP)
        assert engine.link("a", "plate").angular[1] == pytest.approx(speed, abs=1e-6)


def test_one_world_is_as_another(engine):
    """Waking and falling asleep come at the same steps in every run."""

    def run() -> list[BodyState]:
        engine = BulletEngine(lambda uri: Path(uri))
        engine.add_surface("floor", FLOOR, Pose())
        rng = np.random.default_rng(1)
        for i in range(12):
            x, y = (float(v) for v in rng.uniform(-0.1, 0.1, 2))
            engine.add_object(f"cube_{i}", CUBE, BodyState(Pose((x, y, 0.03 + 0.06 * i))))
        pass_time(engine, 3.0)
        engine.remove_object("cube_0")
        engine.set_object("cube_5", BodyState(Pose((0.0, 0.0, 1.0))))
        pass_time(engine, 1.0)
        motions = [engine.object(f"cube_{i}") for i in range(1, 12)]
        engine.close()
        return motions

    assert run() == run()


def test_names_and_numbers_are_checked_wherever_they_come_in(engine):
    nan = float("nan")
    engine.add_arm("a", ARM, ("j",), Pose())
    engine.add_object("cube", CUBE, BodyState(Pose((2.0, 0.0, 0.025))))
    cases = (
        lambda: engine.add_object("x", CUBE, BodyState(Pose(), (nan, 0.0, 0.0))),
        lambda: engine.set_object("cube", BodyState(Pose(), (0.0, 1e9, 0.0))),
        lambda: engine.move_arm("a", (0.0,), (math.inf,)),
        lambda: engine.place_arm("a", Pose((nan, 0.0, 0.0))),
    )
    for case, _ in itertools.product(cases, range(2)):
        with pytest.raises(BadInput):
            case()
    assert engine.distance("a", Kind.OBJECT, "x", 0.5) == 0.5
    pass_time(engine, 0.1)
    assert height(engine, "cube") == pytest.approx(0.025, abs=0.001)


SQUARE = np.array([[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]], float)
CORNERS = np.array(list(itertools.product((-0.025, 0.025), repeat=3)))
FLAT = {
    "box": FLOOR,
    "outline": Body((Part(Shape.HULL, vertices=np.vstack([SQUARE, SQUARE - [0, 0, 0.02]])),), 0.0),
    "triangles": Body(
        (Part(Shape.MESH, vertices=SQUARE, triangles=np.array([[0, 1, 2], [0, 2, 3]])),), 0.0
    ),
}


@pytest.mark.parametrize("surface", FLAT)
def test_what_stands_on_a_surface_of_any_shape_stands_at_its_height(surface):
    engine = BulletEngine(lambda uri: Path(uri))
    engine.add_surface("table", FLAT[surface], Pose((0.0, 0.0, 0.7)))
    shapes = {
        "cube": Part(Shape.BOX, (0.05, 0.05, 0.05)),
        "hull": Part(Shape.HULL, vertices=CORNERS),
        "can": Part(Shape.CYLINDER, (0.025, 0.05)),
    }
    for i, (name, part) in enumerate(shapes.items()):
        place = Pose((0.3 * i - 0.3, 0.1, 0.73))
        engine.add_object(name, Body((part,), 0.1), BodyState(place))
    pass_time(engine, 2.0)
    for name in shapes:
        assert height(engine, name) == pytest.approx(0.725, abs=5e-5)
    engine.close()
