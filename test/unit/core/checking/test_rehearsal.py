"""A rehearsal on an engine that is only geometry: contacts, distances, waits, the report."""

from __future__ import annotations

import dataclasses

import numpy as np
import pytest
from fake_engine import FakeEngine

from mrlab_ros.core.base.geometry import Pose
from mrlab_ros.core.checking import evidence
from mrlab_ros.core.checking.rehearsal import FARTHEST, Actor, Rehearsal
from mrlab_ros.core.checking.report import CheckReport, digest, in_order
from mrlab_ros.core.physics import catalogue
from mrlab_ros.core.physics.engine import Kind
from mrlab_ros.core.physics.grasp import kinds
from mrlab_ros.core.physics.settings import Settings
from mrlab_ros.core.physics.world import World
from mrlab_ros.core.scene.surfaces import Surface
from mrlab_ros.core.systems.waits import parse
from mrlab_ros.core.trajectory.trajectory import Channels, Source, Trajectory

TYPES = catalogue.parse({"objects": {"post": {"shape": "sphere", "size": [0.05], "fixed": True}}})
REST = np.zeros(2)


def motion(x, seconds=1.0, rate=100.0):
    """From 0 to x, m, and back."""
    s = np.linspace(0, 1, int(seconds * rate) + 1)
    q = np.stack([x * (1 - np.cos(2 * np.pi * s)) / 2, 0 * s], axis=1)
    v = np.gradient(q, 1 / rate, axis=0)
    return Trajectory(
        "t", "m", None, ("j1", "j2"), rate, q, None, Channels(v, 0 * v), Source("f", "q", "")
    )


def rehearsed(*actors, wall=None, post=None):
    engine = FakeEngine(fingers=False)
    world = World(engine, TYPES, Settings())
    if wall is not None:
        none = np.zeros((0, 3), np.int32)
        square = np.array([[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0.0]])
        world.set_surfaces([Surface("wall", "wall", Pose((wall, 0.0, 0.0)), square, none)])
    for actor in actors:
        world.add_robot(actor.name, "<robot/>", ("j1", "j2"), Pose(), kinds.NONE)
    if post is not None:
        world.spawn("post", "post", Pose(post))
    rehearsal = Rehearsal(world, engine, actors)
    rehearsal.place()
    return rehearsal.run()


def test_a_collision_has_its_time_its_end_and_its_link_and_the_motion_goes_on():
    found = rehearsed(Actor("a", REST, motion(0.4)), wall=0.3)
    (hit,) = found.collisions
    # x = 0.2 (1 - cos 2 pi t) reaches 0.3 at 1/3 s and leaves it at 2/3 s.
    assert hit.time == pytest.approx(1 / 3, abs=0.01)
    assert hit.end == pytest.approx(2 / 3 + 0.2, abs=0.1)  # clear for 0.2 s, the settings say
    assert (hit.kind, hit.other, hit.link) == (Kind.SURFACE, "wall", "tip")
    assert found.ends["a"] == pytest.approx(1.0)
    (finding,) = evidence.of_collisions(found)
    assert finding.refuses
    assert finding.value == pytest.approx(0.1, abs=0.005)


def test_without_contact_the_least_distance_is_at_its_instant():
    found = rehearsed(Actor("a", REST, motion(0.4)), post=(0.6, 0.0, 0.5))
    assert found.collisions == []
    least = next(c for c in evidence.clearances(found) if c.other == "post")
    assert least.time == pytest.approx(0.5, abs=0.011)
    assert least.distance == pytest.approx(0.2 - FakeEngine.RADIUS, abs=0.005)
    assert evidence.of_distances(found, 0.01) == []
    assert [f.code for f in evidence.of_distances(found, 0.3)] == ["too_close"]


def test_what_is_far_counts_as_far():
    found = rehearsed(Actor("a", REST, motion(0.1)), post=(5.0, 0.0, 0.5))
    (least,) = (c for c in evidence.clearances(found) if c.other == "post")
    assert least.far
    assert least.distance == FARTHEST


def test_a_member_waits_for_a_frame_of_another_and_one_behind_another():
    wait = parse("frame 50: after b.frame 80")
    found = rehearsed(
        Actor("a", REST, motion(0.1), waits=(wait,)),
        Actor("b", REST, motion(0.1), start=0.5),
        Actor("c", REST, motion(0.1), after="b", dwell=0.25),
    )
    # b is at frame 80 at 1.3 s; a has half a second left then.
    assert found.ends["a"] == pytest.approx(1.8, abs=0.03)
    assert found.waited["a"] == pytest.approx(0.8, abs=0.03)
    assert found.ends["b"] == pytest.approx(1.5, abs=0.02)
    assert found.ends["c"] == pytest.approx(2.75, abs=0.03)


def test_a_wait_that_never_comes_true_ends_the_rehearsal_and_is_said():
    wait = parse("frame 0: object cube_1 held by b")
    found = rehearsed(Actor("a", REST, motion(0.1), waits=(wait,)), Actor("b", REST))
    assert found.stuck == {"a": wait.text}
    assert [f.code for f in evidence.of_collisions(found)] == ["waits_forever"]


def test_the_same_inputs_give_the_same_recording():
    one, two = (
        rehearsed(Actor("a", REST, motion(0.4)), wall=0.3, post=(0.6, 0.0, 0.5)) for _ in range(2)
    )
    assert one == two


def test_the_verdict_names_the_first_finding_and_the_hash_is_of_all():
    found = rehearsed(Actor("a", REST, motion(0.4)), wall=0.3)
    findings = in_order(evidence.of_collisions(found))
    report = CheckReport("t.mat", {"robot": "m"}, (), findings, 1.0)
    document = report.document()
    summary = report.summary
    assert (summary.code, summary.values["first"]) == ("check_not_ready", findings[0])
    assert summary.values["count"] == len(findings)
    assert document["verdict"] == "not_ready"
    whole = {k: v for k, v in document.items() if k != "hash"}
    assert document["hash"] == digest(dict(reversed(whole.items())))
    other = dataclasses.replace(report, inputs={"robot": "n"})
    assert other.document()["hash"] != document["hash"]
    assert CheckReport("t.mat", {}, (), ()).summary.code == "check_ready"
