"""Copies are found however they are disguised; a class near one solution is no class of copies."""

from __future__ import annotations

import numpy as np
import pytest

from mrlab_ros.classroom.marks.similarity import SAMPLES, distances, signature, similar


def motion(seed, frames=400, around=None, far=1.0):
    """Return a smooth motion of six joints, rad."""
    random = np.random.default_rng(seed)
    way = random.uniform(-far, far, (5, 6))
    if around is not None:
        way = way + np.linspace(around[0], around[-1], 5)
    t = np.linspace(0, 1, frames)
    share = 10 * t**3 - 15 * t**4 + 6 * t**5
    nodes = np.linspace(0, 1, 5)
    return np.stack([np.interp(share, nodes, way[:, j]) for j in range(6)], axis=1)


def found(motions, reference=()):
    signatures = {name: signature(m) for name, m in motions.items()}
    digests = {name: name for name in motions}
    return similar(signatures, digests, reference)


NOISE = np.random.default_rng(0).normal(0, 0.001, (400, 6))


@pytest.mark.parametrize(
    "copy",
    [
        motion(1) + NOISE,
        np.vstack([np.repeat(motion(1)[:1], 150, axis=0), motion(1)]),
        motion(1, frames=1100),
        np.repeat(motion(1), 2, axis=0)[20:],
    ],
    ids=["noise", "later", "slower", "half the rate, and cut"],
)
def test_a_disguised_copy_is_found_and_nobody_else(copy):
    others = {f"o{n}": motion(10 + n) for n in range(12)}
    groups = found({"a": motion(1), "b": copy, **others}).groups
    assert [g.keys for g in groups] == [("a", "b")]
    assert not groups[0].equal


def test_a_class_near_one_solution_does_not_pair_up_and_a_copy_in_it_does():
    motions = {f"s{n:02}": motion(1) + 0.02 * motion(100 + n) for n in range(30)}
    assert found(motions).groups == ()
    motions["t"] = motions["s03"] + NOISE / 4
    assert [g.keys for g in found(motions).groups] == [("s03", "t")]


def test_who_is_as_the_reference_is_said_and_not_paired():
    motions = {f"s{n:02}": motion(50 + n) for n in range(10)}
    motions |= {"x": motion(1), "y": motion(1, frames=900)}
    common = found(motions, signature(motion(1)))
    assert common.groups == ()
    assert common.as_reference == ("x", "y")


def test_equal_files_are_told_but_not_where_much_of_the_class_has_them():
    signatures = {f"s{n}": signature(motion(n)) for n in range(20)}
    digests = {name: name for name in signatures} | {"s3": "same", "s9": "same"}
    (group,) = similar(signatures, digests).groups
    assert (group.keys, group.equal) == (("s3", "s9"), True)
    assert similar(signatures, dict.fromkeys(signatures, "handed out")).groups == ()


def test_another_order_gives_the_same_and_what_stands_still_too():
    motions = {f"s{n}": motion(n) for n in range(6)} | {"still": np.zeros((50, 6))}
    motions["copy"] = motion(2, frames=777)
    again = dict(sorted(motions.items(), reverse=True))
    assert found(motions) == found(again)
    assert signature(motions["still"]).shape == (SAMPLES, 6)


def test_each_has_a_distance_from_those_before_it_where_there_is_one():
    signatures = {"a": signature(motion(1)), "b": signature(motion(1) + np.radians(3.0))}
    signatures["short"] = signature(motion(1)[:, :5])
    rows = distances(signatures, ["a", "short", "b", "nobody"])
    assert rows == [[], [None], [pytest.approx(3.0, abs=1e-3), None], [None, None, None]]
