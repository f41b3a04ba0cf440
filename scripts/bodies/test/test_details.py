"""What is written, cut and screwed on the bodies of robots: scripts/bodies."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import details
import drawings
import glb
import levels
import materials
import numpy as np
import pytest
import trimesh
import yaml
from cutting import cut
from housings import housings
from markings import marked, markings, sense
from materials import BLACK, ORANGE, STEEL
from relief import grooved, lined, outline, places, screwed
from scipy.spatial.transform import Rotation

from mrlab_ros.adapters.robots.hulls import samples
from mrlab_ros.adapters.robots.packing.atlas import RIM, Atlas, Drawing
from mrlab_ros.adapters.robots.packing.pieces import Piece
from mrlab_ros.adapters.robots.packing.surfaces import Material, Mesh
from mrlab_ros.core.base.geometry import transform_from_xyz_rpy

ROOT = Path(__file__).resolve().parents[3]
TABLES = sorted((ROOT / "scripts/bodies/details").glob("*.yaml"))
FOLDERS = sorted(path.parent for path in (ROOT / "robots").glob("*/robot.yaml"))


def flat(count: int = 4) -> Piece:
    """Return a square of 1 m on the plane z = 0, of count x count squares of two triangles."""
    x, y = np.meshgrid(np.linspace(-0.5, 0.5, count + 1), np.linspace(-0.5, 0.5, count + 1))
    vertices = np.column_stack([x.ravel(), y.ravel(), np.zeros(x.size)])
    a = np.arange(count * (count + 1)).reshape(count, count + 1)[:, :-1].ravel()
    quads = np.column_stack([a, a + 1, a + count + 2, a + count + 1])
    faces = np.concatenate([quads[:, [0, 1, 2]], quads[:, [0, 2, 3]]])
    mesh = Mesh(vertices, faces, np.tile([0.0, 0.0, 1.0], (x.size, 1)))
    return Piece(ORANGE, mesh, np.ones(x.size))


def area(vertices: Any, faces: Any) -> Any:
    a, b, c = vertices[faces].transpose(1, 0, 2)
    return np.cross(b - a, c - a)[:, 2] / 2


class Sky:
    """What sees all of the sky."""

    def light(self, points: Any, normals: Any) -> Any:
        return np.ones(len(points))


def test_a_cut_leaves_neither_gap_nor_crossing() -> None:
    mesh = flat().mesh
    rows = np.column_stack([mesh.vertices, np.ones(len(mesh.vertices))])
    height = mesh.vertices @ [0.6, 0.8, 0.0] - 0.11
    some = mesh.vertices[mesh.faces].mean(axis=1)[:, 0] > 0
    rows, faces, origin = cut(rows, mesh.faces, height, some)
    assert np.isclose(area(rows[:, :3], faces).sum(), 1)
    assert (area(rows[:, :3], faces) > 0).all()
    side = np.sign(np.round(rows[:, :3] @ [0.6, 0.8, 0.0] - 0.11, 9))[faces]
    assert not ((side.min(axis=1) < 0) & (side.max(axis=1) > 0) & some[origin]).any()
    # each inner edge has two faces, in opposite directions
    edges = np.concatenate([faces[:, [i, (i + 1) % 3]] for i in range(3)])
    inner = [
        tuple(e) for e in edges.tolist() if not (np.abs(rows[e, :2]).max(axis=0) == 0.5).any()
    ]
    assert all((b, a) in set(map(tuple, edges.tolist())) for a, b in inner)
    assert np.allclose(rows[:, 3], 1)


def test_the_atlas_keeps_drawings_apart_and_alike_ones_once() -> None:
    label = Drawing(drawings.pinch(40, ORANGE), ORANGE)
    other = Drawing(drawings.axis(3, "left", 60, BLACK), BLACK)
    atlas = Atlas([ORANGE, BLACK], [label, other, label], 128)
    assert atlas.place(0) == atlas.place(2) != atlas.place(1)
    one, two = (np.array(atlas.place(n)) * 128 for n in (0, 1))
    apart = np.maximum(one[:2] - two[2:], two[:2] - one[2:])
    assert apart.max() >= 2 * RIM
    assert atlas.finish(1) == 1
    with pytest.raises(ValueError, match="do not fit into 64 x 64"):
        Atlas([ORANGE, BLACK], [label, other], 64)


@pytest.mark.parametrize(
    ("axle", "middle", "word"),
    [
        ([0, 0, 1], [0, 0, 1], "left"),
        ([0, 0, -1], [0.2, 0, 1], "right"),
        # seen from above, a point in front of an axis to the right moves towards the viewer's top
        ([1, 0, 0], [0, 0, 1], "down"),
        ([0, 1, 0], [0, 0, 1], "back"),
        ([0, -1, 0], [0, 0, 1], "ahead"),
    ],
)
def test_a_label_shows_where_its_link_turns(axle: Any, middle: Any, word: str) -> None:
    assert sense(np.array(axle, float), np.array(middle, float), np.eye(3)) == word


def test_seams_and_screws_lie_on_the_surface() -> None:
    piece = flat(12)
    surface = details.Surface([(ORANGE, piece.mesh)])
    seam = {"from": [0, 0, 1], "centre": [0, 0, 20], "half": [200, 100]}
    (strip,) = lined([seam], surface, Sky())  # type: ignore[arg-type]
    assert strip.material is ORANGE
    assert np.abs(strip.mesh.vertices[:, :2]).max(axis=0) == pytest.approx([0.2, 0.1], abs=0.002)
    assert 0 < strip.mesh.vertices[:, 2].max() < 0.0005
    assert (area(strip.mesh.vertices, strip.mesh.faces) > 0).all()
    # of a circle that reaches over the edge those that stand on nothing are left out
    screw = {"from": [0, 0, 1], "centre": [450, 0, 0], "radius": 100, "count": 4, "size": 10}
    assert len(screwed([screw], surface, Sky())) == 3  # type: ignore[arg-type]
    far = {**screw, "centre": [0, 0, 500]}
    assert screwed([far], surface, Sky()) == []  # type: ignore[arg-type]


@pytest.mark.parametrize("axis", "xyz")
def test_a_housing_is_closed_and_has_fins_where_they_are_stated(axis: str) -> None:
    square = [[-40, -40], [40, -40], [40, 40], [-40, 40]]
    core = {"link": "a", "material": "black", "axis": axis, "ends": [0, 100], "outline": square}
    fins = {**core, "ends": [10, 16], "count": 3, "pitch": 20, "corner": 8, "edge": 1}
    table = {"housings": [core, fins]}
    own = housings(table)["a"]
    assert [len(own), len(housings(table, afar=True)["a"])] == [4, 1]
    for number, (_, mesh) in enumerate(own):
        solid = trimesh.Trimesh(mesh.vertices, mesh.faces)
        solid.merge_vertices(merge_norm=True)
        assert solid.is_watertight
        assert solid.volume > 0.9 * np.prod(solid.extents)
        corners = mesh.vertices[mesh.faces]
        outward = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
        assert ((outward[:, None] * mesh.normals[mesh.faces]).sum(axis=2) > 0).all()
        start = 0.0 if number == 0 else 0.010 + (number - 1) * 0.020
        assert solid.bounds[0]["xyz".index(axis)] == pytest.approx(start, abs=1e-4)


def test_what_a_housing_encloses_is_not_drawn() -> None:
    box = {"link": "a", "material": "black", "axis": "z", "ends": [0, 100]}
    square = np.array([[-1, -1], [1, -1], [1, 1], [-1, 1]])
    outer, inner = (
        {**box, "outline": (40 * square).tolist()},
        {**box, "ends": [20, 80], "outline": (20 * square).tolist()},
    )
    both = housings({"housings": [outer, inner]})["a"]
    assert [mesh.faces.tolist() for _, mesh in levels.outer(both)] == [both[0][1].faces.tolist()]


def test_a_groove_is_cut_where_it_is_stated() -> None:
    piece = flat(12)
    turned = Mesh(piece.mesh.vertices, piece.mesh.faces, piece.mesh.normals)
    seam = {"axis": "x", "at": 130, "width": 4, "depth": 2,
            "within": [[-600, -600, -10], [600, 600, 10]]}  # fmt: skip
    (cut_in,) = grooved([Piece(STEEL, turned, piece.light)], [seam])
    low = cut_in.mesh.vertices[:, 2] < -0.001
    assert np.allclose(cut_in.mesh.vertices[low, 0], 0.13)
    assert cut_in.light[low].max() < 0.5
    assert np.isclose(area(cut_in.mesh.vertices, cut_in.mesh.faces).sum(), 1)


@pytest.mark.parametrize("file", TABLES, ids=lambda file: file.stem)
def test_tables_name_links_and_kinds_there_are(file: Path) -> None:
    (folder,) = (ROOT / "robots").glob(f"**/{file.stem}")
    links = {path.stem for path in (folder / "meshes").glob("*.glb")}
    table = details.table(file.stem)
    assert set(table) <= {"markings", "seams", "screws", "clamps", "housings", "without"}
    assert {entry["link"] for entries in table.values() for entry in entries} <= links
    if not (folder / "robot.yaml").is_file():
        return
    figures = yaml.safe_load((folder / "robot.yaml").read_text())
    kinds = [entry["kind"] for entry in table["markings"]]
    assert {"name", "axis", "plate"} <= set(kinds) <= {"name", "axis", "plate", "pinch"}
    # what stands on a robot is how it is called
    names = [entry["text"] for entry in table["markings"] if entry["kind"] == "name"]
    assert all(figures["product"].startswith(name) for name in names)


@pytest.mark.parametrize("file", TABLES, ids=lambda file: file.stem)
def test_no_screw_stands_on_a_label(file: Path) -> None:
    table = details.table(file.stem)
    for label in table.get("markings", []):
        outwards = details.unit(label["from"])
        for screw in table.get("screws", []):
            if screw["link"] != label["link"] or details.unit(screw["from"]) @ outwards < 0.9:
                continue
            off = places(screw, outwards) / details.MM - label["at"]
            across = np.linalg.norm(off - np.outer(off @ outwards, outwards), axis=1)
            assert across.min() > (label["height"] + screw["size"]) / 2, label


@pytest.mark.parametrize("file", TABLES, ids=lambda file: file.stem)
def test_no_seam_runs_under_a_label(file: Path) -> None:
    table = details.table(file.stem)
    for label in table.get("markings", []):
        outwards = details.unit(label["from"])
        long = label["height"] * {"plate": 1.6, "name": 3.0}.get(label["kind"], 1.0)
        for seam in table.get("seams", []):
            if "at" in seam or seam["link"] != label["link"]:
                continue
            if details.unit(seam["from"]) @ outwards < 0.9:
                continue
            off = outline(seam, outwards)[0] / details.MM - label["at"]
            across = np.abs(np.delete(off, np.abs(outwards).argmax(), axis=1)).max(axis=1)
            assert across.min() > long / 2 + 1, label


@pytest.mark.parametrize("folder", FOLDERS, ids=lambda folder: folder.name)
def test_no_hose_ends_in_mid_air(folder: Path) -> None:
    figures = yaml.safe_load((folder / "robot.yaml").read_text())
    clamps = details.table(folder.name).get("clamps", [])
    root = figures["joints"][0]["parent"]
    for hose in figures.get("hoses", []):
        for end in hose["ends"]:
            at = np.array(end["xyz"])
            held = any(
                clamp["link"] == end["link"] and np.allclose(at / details.MM, clamp["at"])
                for clamp in clamps
            )
            if held or (end["link"] == root and at[2] == 0):  # in the surface it stands on
                continue
            surface = np.concatenate(
                [mesh.vertices[mesh.faces]
                 for _, mesh in glb.read(folder / "meshes" / f"{end['link']}.glb")]
            )  # fmt: skip
            away = np.linalg.norm(samples(surface, 0.005) - at, axis=1).min()
            assert away < 1.34 * hose["radius"], end


@pytest.mark.parametrize("folder", FOLDERS, ids=lambda folder: folder.name)
def test_meshes_have_the_materials_of_bodies(folder: Path) -> None:
    stated = {each.name: each for each in vars(materials).values() if isinstance(each, Material)}
    for path in (folder / "meshes").glob("*.glb"):
        for material, _ in glb.read(path):
            assert material.colour == pytest.approx(stated[material.name].colour, abs=1e-3)
            assert material.roughness == stated[material.name].roughness


def bend(start: Any, end: Any, leaves: Any, arrives: Any, length: float) -> float:
    """Return the tightest radius, m, of the curve that web/src/scene/robot/hose.ts draws."""
    t = np.linspace(0, 1, 81)[:, None]
    low, high = np.linalg.norm(end - start) * 0.1, length
    share = (1 - t) ** 2 * (1 + 2 * t)
    ahead = 3 * (1 - t) * t * ((1 - t) * leaves + t * arrives)
    for _ in range(12):
        bulge = (low + high) / 2
        points = share * start + (1 - share) * end + bulge * ahead
        if np.linalg.norm(np.diff(points, axis=0), axis=1).sum() > length:
            high = bulge
        else:
            low = bulge
    a, b, c = points[:-2], points[1:-1], points[2:]
    sides = [np.linalg.norm(one - other, axis=1) for one, other in ((a, b), (b, c), (c, a))]
    twice_area = np.linalg.norm(np.cross(b - a, c - a), axis=1)
    return float((np.prod(sides, axis=0) / np.maximum(2 * twice_area, 1e-12)).min())


@pytest.mark.parametrize("folder", FOLDERS, ids=lambda folder: folder.name)
def test_no_hose_creases_where_its_joint_turns(folder: Path) -> None:
    figures = yaml.safe_load((folder / "robot.yaml").read_text())
    for hose in figures.get("hoses", []):
        links = [end["link"] for end in hose["ends"]]
        for joint in figures["joints"]:
            if [joint["parent"], joint["child"]] != links:
                continue
            fixed = transform_from_xyz_rpy(joint["xyz"], joint["rpy"])
            for angle in np.linspace(joint["lower"], joint["upper"], 15):
                turn = Rotation.from_rotvec(angle * np.array(joint["axis"])).as_matrix()
                points, ways = (
                    [np.array(end[key], float) for end in hose["ends"]]
                    for key in ("xyz", "direction")
                )
                ways = [details.unit(way) for way in ways]
                points[1] = fixed[:3, :3] @ turn @ points[1] + fixed[:3, 3]
                ways[1] = fixed[:3, :3] @ turn @ ways[1]
                assert bend(*points, *ways, hose["length"]) > 0.017, (links, angle)


def test_markings_lie_on_their_links() -> None:
    folder = ROOT / "robots" / "ur5e"
    figures = yaml.safe_load((folder / "robot.yaml").read_text())
    figures["id"] = "ur5e"
    pieces = {path.stem: glb.read(path) for path in (folder / "meshes").glob("*.glb")}
    found = markings(figures, {link: details.Surface(own) for link, own in pieces.items()})
    assert len(found) == len(details.table("ur5e")["markings"])
    for link, own in pieces.items():
        here = [(n, each) for n, each in enumerate(found) if each.link == link]
        bare = [Piece(material, mesh, np.ones(len(mesh.vertices))) for material, mesh in own]
        drawn = [piece for piece in marked(bare, here) if piece.drawing is not None]
        assert {piece.drawing for piece in drawn} == {n for n, _ in here}
        for piece in drawn:
            assert piece.places is not None
            assert 0 <= piece.places.min() <= piece.places.max() <= 1
        if here:
            wrong = found[here[0][0]]
            far = type(wrong)(
                wrong.kind, wrong.link, wrong.middle + 0.6 * wrong.frame[0], wrong.frame,
                wrong.width, wrong.height, wrong.material, wrong.drawing,
            )  # fmt: skip
            with pytest.raises(ValueError, match="of it lies on"):
                marked(bare, [(0, far)])
