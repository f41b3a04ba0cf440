"""Bodies built from outlines: shoulders, drums, regions of materials, and their measure."""

from __future__ import annotations

import json
import sys
from pathlib import Path
from typing import Any

import numpy as np
import pytest

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "scripts" / "robots"))

import casting  # noqa: E402
import convex  # noqa: E402
import cuts  # noqa: E402
import figure  # noqa: E402
import kuka  # noqa: E402
import measure  # noqa: E402
import measured  # noqa: E402
import mesher  # noqa: E402
from body import BLACK, ORANGE  # noqa: E402

from mrlab_ros.adapters.robots import hulls as fits  # noqa: E402


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
    turned = casting.turned_true(body, np.eye(4))
    angle = np.linspace(-0.7, 0.7, 50)
    rim = np.column_stack([0.06 * np.cos(angle), 0.06 * np.sin(angle), np.full(50, 0.05)])
    assert np.abs(turned.distance(rim)).mean() < 0.0016
    assert np.std(turned.distance(rim)) < 0.7 * np.std(body.distance(rim))


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
    shred = mesher.Mesh(
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
