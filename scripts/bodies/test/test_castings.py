"""Bodies built from outlines: shoulders, drums, regions of materials, and their measure."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import casting
import castings
import convex
import cuts
import drums
import fairing
import figure
import kuka
import measure
import measured
import mesher
import numpy as np
import outlines
import pytest
import solids
import trimesh
from materials import BLACK, ORANGE

from mrlab_ros.adapters.robots import hulls as fits
from mrlab_ros.adapters.robots.packing import surfaces

ROOT = Path(__file__).resolve().parents[3]


def ring(radius: float) -> list[float]:
    angle = np.arange(28) * 2 * np.pi / 28
    return np.round(radius * np.column_stack([np.cos(angle), np.sin(angle)]), 2).ravel().tolist()


def stepped_drum() -> dict[str, Any]:
    """A drum about z, 120 mm high: radius 60 mm below z = 72, 30 mm above."""
    profile = [-60, 0, 60, 0, 60, 72, 30, 72, 30, 120, -30, 120, -30, 72, -60, 72]
    return {
        "box": [[-60, -60, 0], [60, 60, 120]],
        "slice_axis": "z",
        "section_axes": "xy",
        "sections": [
            {"at": at, "outlines": [ring(60 if at < 72 else 30)]} for at in range(10, 120, 20)
        ],
        "silhouettes": {
            "xy": {"outer": [ring(60)]},
            "xz": {"outer": [profile]},
            "yz": {"outer": [profile]},
        },
    }


@pytest.fixture(scope="module")
def drum() -> Any:
    return casting.casting(stepped_drum())


def test_a_shoulder_stands_where_the_silhouettes_have_it(drum: Any) -> None:
    # The sections stand at 70 and 90; a blend of them alone would put 45 mm at z = 80.
    below, above = ([[0.045, 0.0, z]] for z in (0.069, 0.075))
    assert drum.distance(np.array(below))[0] < 0
    assert drum.distance(np.array(above))[0] > 0


def test_an_outline_of_28_corners_becomes_round(drum: Any) -> None:
    angle = np.linspace(0, 2 * np.pi, 200)
    rim = np.column_stack([0.06 * np.cos(angle), 0.06 * np.sin(angle), np.full(200, 0.03)])
    away = np.abs(drum.distance(rim))
    # Where a silhouette touches the drum, the edge between both is rounded.
    assert away.max() < 0.0012
    assert away.mean() < 0.0006


def test_a_drum_cut_across_becomes_round_again() -> None:
    lying = stepped_drum()
    heights = np.linspace(-55, 55, 12)
    half = np.sqrt(60.0**2 - heights**2).round(1)
    rectangles = [[-w, 0, w, 0, w, 120, -w, 120] for w in half.tolist()]
    square = {"outer": [[-60, 0, 60, 0, 60, 120, -60, 120]]}
    lying |= {
        "slice_axis": "y",
        "section_axes": "xz",
        "sections": [
            {"at": float(at), "outlines": [outline]}
            for at, outline in zip(heights, rectangles, strict=True)
        ],
        # A foot plate hides the drum from above.
        "silhouettes": {
            "xy": {"outer": [[-60, -60, 60, -60, 60, 60, -60, 60]]},
            "xz": square,
            "yz": square,
        },
    }
    body = casting.casting(lying)
    turned = drums.turned_true(body, np.eye(4))
    angle = np.linspace(-0.7, 0.7, 50)
    rim = np.column_stack([0.06 * np.cos(angle), 0.06 * np.sin(angle), np.full(50, 0.05)])
    assert np.abs(turned.distance(rim)).mean() < 0.0016
    assert np.std(turned.distance(rim)) < 0.7 * np.std(body.distance(rim))


def leaning_rim() -> dict[str, Any]:
    """A wall that leans over by more than its thickness from one section to the next one."""
    heights = range(10, 120, 20)
    return {
        "box": [[0, -40, 0], [132, 40, 120]],
        "slice_axis": "z",
        "section_axes": "xy",
        "sections": [
            {"at": z, "outlines": [[z, -40, z + 12, -40, z + 12, 40, z, 40]]} for z in heights
        ],
        "silhouettes": {
            "xy": {"outer": [[0, -40, 132, -40, 132, 40, 0, 40]]},
            "xz": {"outer": [[0, 0, 12, 0, 132, 120, 120, 120]]},
            "yz": {"outer": [[-40, 0, 40, 0, 40, 120, -40, 120]]},
        },
    }


def test_a_thin_wall_that_leans_does_not_tear_between_sections() -> None:
    body = casting.casting(leaning_rim())
    height = np.linspace(0.012, 0.108, 60)
    middle = np.column_stack([height + 0.006, np.zeros(60), height])
    # A plain blend of two walls that lie apart is empty half-way.
    assert body.distance(middle).max() < -0.0015


def test_fairing_closes_slits_and_leaves_walls_where_they_are() -> None:
    wall = solids.block(np.array([0.3, 0.2, 0.1]), 0.0)
    slit = solids.block(np.array([0.002, 0.4, 0.2]), 0.0)
    body = fairing.faired(wall - slit, 0.002)
    faces = [[x, y, z] for x in (0.01, 0.07) for y in (0.03, -0.06) for z in (0.05, -0.05)]
    assert np.abs(body.distance(np.array(faces))).max() < 0.0004
    assert body.distance(np.array([[0.0, 0.02, 0.0]]))[0] < -0.001


def test_halves_that_are_nearly_alike_become_equal() -> None:
    skew = solids.block(np.array([0.3, 0.2, 0.1]), 0.0).moved(0.0, 0.001, 0.0)
    even = fairing.mirrored(skew, 0.004)
    sides = even.distance(np.array([[0.0, 0.1, 0.0], [0.0, -0.1, 0.0]]))
    assert sides[0] == pytest.approx(sides[1], abs=1e-9)
    lop = skew.moved(0.0, 0.02, 0.0)
    assert fairing.mirrored(lop, 0.004).distance(np.array([[0.0, 0.121, 0.0]]))[0] == (
        pytest.approx(0.0, abs=1e-9)
    )


def test_a_painted_mesh_keeps_its_surface_and_has_no_gap(drum: Any) -> None:
    mesh = mesher.smoothed(measured.whole(mesher.contour(drum, 0.006)))
    region = measured.Region(BLACK, (-100, -100, 50), (100, 13, 1000))
    pieces = {
        material.name: piece
        for material, piece in measured.painted(mesh, measured.Link(ORANGE, (region,)))
    }
    assert set(pieces) == {"orange", "black"}
    middles = pieces["black"].vertices[pieces["black"].faces].mean(axis=1)
    assert middles[:, 2].min() > 0.05
    assert middles[:, 1].max() < 0.013
    faces = np.concatenate([piece.faces for piece in pieces.values()])
    edges = np.sort(np.concatenate([faces[:, [i, (i + 1) % 3]] for i in range(3)]), axis=1)
    vertices = max(pieces.values(), key=lambda piece: len(piece.vertices)).vertices
    _, index = np.unique(np.round(vertices, 7), axis=0, return_inverse=True)
    _, uses = np.unique(index.ravel()[edges], axis=0, return_counts=True)
    assert set(uses) == {2}


def test_few_hulls_hold_a_casting_and_stay_close_to_it(drum: Any) -> None:
    mesh = mesher.smoothed(measured.whole(mesher.contour(drum, 0.004)))
    faces = mesh.vertices[mesh.faces]
    found = [convex.triangles(hull) for hull in cuts.cover_all([(drum, faces)], mesh.vertices)]
    assert len(found) <= 2
    assert fits.sticks_out(faces, found, 4000) <= fits.MOST_SMALLER
    assert fits.stands_off(faces, found, 4000) <= fits.MOST_LARGER


def test_what_lies_outside_all_hulls_becomes_a_corner_of_the_nearest() -> None:
    corners = np.array(np.meshgrid(*[[0.0, 0.1]] * 3)).reshape(3, -1).T
    hulls = [corners, corners + np.array([0.3, 0, 0])]
    inside, beside = np.full(3, 0.05), np.array([0.05, 0.05, 0.102])
    # above no face, beyond an edge: 5.7 mm away, 4 mm above each plane
    beyond = np.array([0.404, 0.104, 0.05])
    assert convex.held(hulls, np.array([inside, beside])) == hulls
    first, second = convex.held(hulls, np.array([inside, beside, beyond]))
    assert first is corners
    assert (second == beyond).all(axis=1).any()
    assert len(second) == 9


def test_a_surface_beyond_the_stated_box_is_whole() -> None:
    ball = solids.Solid(
        lambda points: np.linalg.norm(points, axis=1) - 0.05, np.full(3, -0.04), np.full(3, 0.04)
    )
    reach = np.linalg.norm(mesher.contour(ball, 0.004).vertices, axis=1)
    assert np.allclose(reach, 0.05, atol=1e-3)


def test_slits_between_the_pieces_of_a_collision_mesh_are_closed() -> None:
    slit = stepped_drum()
    for section in slit["sections"]:
        radius = max(section["outlines"][0])
        halves = [[-radius, low, radius, low, radius, low + 55, -radius, low + 55]
                  for low in (-59, 4)]  # fmt: skip
        section["outlines"] = halves
    whole = {**slit, "gap": 16}
    assert measure.solid(slit).body_count > measure.solid(whole).body_count == 1
    assert measure.solid(whole).volume > 1.05 * measure.solid(slit).volume
    assert np.ptp(measure.solid(whole).vertices, axis=0) == pytest.approx([120, 118, 120], abs=1.5)


def ball(radius: float, cell: float, middle: float = 0.0) -> surfaces.Mesh:
    return mesher.contour(solids.ball(radius).moved(middle, 0, 0), cell)


def test_what_is_thinned_together_is_as_exact_everywhere_and_stays_in_place() -> None:
    large, small = castings.together([ball(0.5, 0.03), ball(0.05, 0.004, 0.3)], 1500)
    assert len(large.faces) + len(small.faces) == pytest.approx(1500, rel=0.03)
    assert len(large.faces) > 3 * len(small.faces)
    for mesh, radius, middle in ((large, 0.5, 0.0), (small, 0.05, 0.3)):
        away = np.linalg.norm(mesh.vertices - [middle, 0, 0], axis=1)
        assert np.abs(away - radius).max() < 0.004


def test_a_thinned_ball_is_shaded_as_the_fine_one() -> None:
    fine = surfaces.creased(ball(0.5, 0.02))
    thin = surfaces.creased(surfaces.decimated(fine, 300))

    def off(mesh: surfaces.Mesh) -> float:
        true = mesh.vertices / np.linalg.norm(mesh.vertices, axis=1, keepdims=True)
        return float(
            np.degrees(np.arccos(np.clip((true * mesh.normals).sum(axis=1), -1, 1))).max()
        )

    told = castings.shaded(thin, fine)
    assert off(told) < 0.4 * off(thin)
    # a wall that looks the other way tells nothing
    turned = surfaces.Mesh(fine.vertices, fine.faces, -fine.normals)
    np.testing.assert_allclose(castings.shaded(thin, turned).normals, thin.normals, atol=1e-4)


def test_sections_are_measured_on_an_open_mesh() -> None:
    box = trimesh.creation.box((0.1, 0.06, 0.08))
    box.apply_scale(1000)
    # one end is missing
    box.update_faces(box.triangles_center[:, 0] < 49)
    link = {"slice_axis": "x", "section_axes": "yz", "box": [[-50, -30, -40], [50, 30, 40]]}
    found = outlines.sections(box, link, 4)
    assert [section["at"] for section in found] == [-37.5, -12.5, 12.5, 37.5]
    for section in found:
        (outline,) = section["outlines"]
        points = np.array(outline).reshape(-1, 2)
        np.testing.assert_allclose(
            [points.min(axis=0), points.max(axis=0)], [[-30, -40], [30, 40]]
        )
    assert outlines.overlap(box, {**link, "sections": found}) > 0.99
    moved = [{"at": -10, "outlines": [[0, 0, 60, 0, 60, 80, 0, 80]]}]
    assert outlines.overlap(box, {**link, "sections": moved}) < 0.4


def test_the_person_has_the_measures_it_names() -> None:
    person = figure.figure()
    by = figure.STATURE / figure.MEASURED
    assert person.high[2] == pytest.approx(1.8, abs=0.005)
    assert person.low[2] == pytest.approx(0.0, abs=0.005)
    across = np.linspace(0, 0.4, 801)

    def half(height: float, y: float = 0.0) -> float:
        line = np.column_stack([across, np.full(801, y), np.full(801, height * by)])
        return float(across[person.distance(line) < 0].max()) / by

    assert 2 * half(1.345, 0.014) == pytest.approx(0.510, abs=0.05)
    assert 2 * half(1.63) == pytest.approx(0.155, abs=0.01)
    # Between the legs, below the crotch, is nothing.
    assert person.distance(np.array([[0.0, 0.0, 0.75 * by]]))[0] > 0


def test_shreds_in_mid_air_are_dropped(drum: Any) -> None:
    mesh = mesher.contour(drum, 0.008)
    shred = surfaces.Mesh(
        np.concatenate([mesh.vertices, mesh.vertices[:3] * 0.01 + 1.0]),
        np.concatenate([mesh.faces, [[len(mesh.vertices) + n for n in range(3)]]]),
        mesh.normals,
    )
    assert len(measured.whole(shred).faces) == len(mesh.faces)


def test_the_measure_sees_a_body_that_is_off(drum: Any) -> None:
    truth = measure.solid(stepped_drum())
    assert truth.volume == pytest.approx(np.pi * (60**2 * 72 + 30**2 * 48), rel=0.03)
    mesh = mesher.contour(drum, 0.004)
    ours = truth.copy()
    ours.vertices, ours.faces = mesh.vertices * 1000, mesh.faces
    assert measure.distance(ours, truth) < 3.0
    ours.apply_translation([25, 0, 0])
    assert measure.distance(ours, truth) > 15.0


@pytest.mark.parametrize("robot", kuka.ROBOTS)
def test_every_casting_has_outlines_and_a_source(robot: str) -> None:
    tables = json.loads((measured.TABLES / f"{robot}.json").read_text())
    assert set(tables) == set(kuka.ROBOTS[robot])
    for link in tables:
        assert tables[link]["source"].startswith(("kroshu/", "ros-industrial/"))
        assert len(measured.table(robot, link)["sections"]) >= 20
