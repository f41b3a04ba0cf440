"""Packs the meshes that a robot wears into the two levels of detail that pages draw.

Paints are those of the lab's own body: of the colour that a vendor's part has, or of the part of
the own body that lies nearest where it has none. So a maker's orange is the same on all robots.
"""

from __future__ import annotations

import colorsys
from pathlib import Path
from typing import Any

import numpy as np
import trimesh
from numpy.typing import NDArray
from scipy.spatial import cKDTree

from mrlab_ros.adapters.robots import urdf
from mrlab_ros.adapters.robots.drawing import Assembly, colour
from mrlab_ros.adapters.robots.library import RobotLibrary, vendor_levels
from mrlab_ros.adapters.robots.packing import packed
from mrlab_ros.adapters.robots.packing.occlusion import Pieces, surroundings
from mrlab_ros.adapters.robots.packing.pieces import Piece
from mrlab_ros.adapters.robots.packing.surfaces import Material, Mesh, creased, together
from mrlab_ros.core.base.geometry import Array, inverse_transform

TRIANGLES = {"near": 60_000, "far": 6_000}  # of a robot, at most
BYTES = {"near": 1_200_000, "far": 150_000}
FEWER = 0.95  # of the triangles are tried next where there are too many
FIRST_GRID = 0.001  # m, on which corners are joined where thinning alone is not enough
WELDED = 1e-5  # m; corners as near are one
VIVID, DIM = 0.4, 0.2  # saturation and value above which a paint is no black, grey or white
TURNED = 0.04  # of the circle of hues; one paint in two files differs by less
SAMPLES = 4_000  # points of a link's own body, by which a bare part finds its paint
SIDE = 480  # pixels of a silhouette


def write(library: RobotLibrary, robot_id: str, made_of: dict[str, str]) -> dict[str, int]:
    """Write near and far of a robot that wears a vendor's meshes; return their triangles."""
    own = _by_link(library, library.own_description(robot_id), robot_id)
    worn = _by_link(library, library.description(robot_id), robot_id)
    pieces = {link: _painted(meshes, own.get(link, meshes)) for link, meshes in worn.items()}
    facts = library.facts(robot_id)
    counts = {}
    for level, file in vendor_levels(library.imported / robot_id).items():
        file.parent.mkdir(exist_ok=True)
        most = TRIANGLES[level]
        grid = WELDED
        while True:
            thin = _thinned(pieces, most, grid)
            around = surroundings(thin, facts, float(facts["reach"]))
            links = {
                link: [
                    Piece(material, mesh, around[link].light(mesh.vertices, mesh.normals))
                    for material, mesh in one
                ]
                for link, one in thin.items()
            }
            packed.write(file, links, made_of)
            counts[level] = sum(len(mesh.faces) for one in thin.values() for _, mesh in one)
            if counts[level] <= TRIANGLES[level] and file.stat().st_size <= BYTES[level]:
                break
            # Slivers cannot be thinned; on a coarser grid they are gone.
            most, grid = int(most * FEWER), max(2 * grid, FIRST_GRID)
    return counts


def sizes(folder: Path) -> dict[str, int]:
    """Return the bytes of the packed levels in a robot's folder."""
    return {level: file.stat().st_size for level, file in vendor_levels(folder).items()}


def overlap(library: RobotLibrary, robot_id: str) -> float:
    """Return how far the silhouettes of the worn and the own body agree, 0 to 1.

    Intersection over union, the least of the three views along the axes, all joints at zero.
    """
    texts = library.own_description(robot_id), library.description(robot_id)
    both = [_placed(library, text, robot_id) for text in texts]
    low = np.min([points.min(axis=(0, 1)) for points in both], axis=0)
    size = float(np.max([points.max(axis=(0, 1)) - low for points in both]))
    shares = []
    for axis in range(3):
        views = [_silhouette(np.delete((p - low) / size, axis, axis=2)) for p in both]
        shares.append((views[0] & views[1]).sum() / max((views[0] | views[1]).sum(), 1))
    return float(min(shares))


def _silhouette(triangles: Array) -> NDArray[np.bool_]:
    from PIL import Image, ImageDraw

    image = Image.new("1", (SIDE, SIDE))
    draw = ImageDraw.Draw(image)
    for triangle in (triangles * (SIDE - 1)).reshape(-1, 6).tolist():
        draw.polygon(triangle, fill=1)
    return np.asarray(image)


def _placed(library: RobotLibrary, text: str, robot_id: str) -> Array:
    robot = Assembly(urdf.parse(text, robot_id), robot_id, library.mesh_path)
    return np.concatenate(
        [mesh.triangles @ pose[:3, :3].T + pose[:3, 3] for _, mesh, pose in robot.meshes()]
    )


def _by_link(library: RobotLibrary, text: str, robot_id: str) -> dict[str, list[trimesh.Trimesh]]:
    """Return the meshes of each link in the link's frame."""
    robot = Assembly(urdf.parse(text, robot_id), robot_id, library.mesh_path)
    back = {link: inverse_transform(pose) for link, pose in robot.poses().items()}
    found: dict[str, list[trimesh.Trimesh]] = {}
    for link, mesh, pose in robot.meshes():
        found.setdefault(link, []).append(mesh.copy().apply_transform(back[link] @ pose))
    return found


def _paint(mesh: trimesh.Trimesh) -> Material:
    material: Any = getattr(mesh.visual, "material", None)
    red, green, blue = map(float, colour(mesh))
    finish = [getattr(material, name, None) for name in ("metallicFactor", "roughnessFactor")]
    metalness, roughness = (
        float(stated) if stated is not None else usual
        for stated, usual in zip(finish, (0.0, 0.5), strict=True)
    )
    return Material(str(material.name), (red, green, blue), metalness, roughness)


def _painted(
    worn: list[trimesh.Trimesh], own: list[trimesh.Trimesh]
) -> list[tuple[Material, Mesh]]:
    """Return a link's meshes by paint, corners welded."""
    paints = [_paint(mesh) for mesh in own]
    points, owner = [], []
    for number, mesh in enumerate(own):
        count = max(int(SAMPLES * mesh.area / sum(one.area for one in own)), 20)
        points.append(trimesh.sample.sample_surface(mesh, count, seed=1)[0])
        owner += [number] * count
    near = cKDTree(np.concatenate(points))
    groups: dict[str, tuple[Material, list[Array]]] = {}
    for mesh in worn:
        if getattr(mesh.visual, "material", None) is not None:
            chosen = np.full(len(mesh.faces), _alike(_paint(mesh), paints))
        else:
            chosen = np.array(owner, dtype=np.int64)[near.query(mesh.triangles_center)[1]]
            chosen = _by_part(mesh, chosen)
        for number in np.unique(chosen):
            group = groups.setdefault(paints[number].name, (paints[number], []))
            group[1].append(mesh.triangles[chosen == number])
    return [(paint, _welded(np.concatenate(parts))) for paint, parts in groups.values()]


def _alike(wanted: Material, paints: list[Material]) -> int:
    """Return the number of the paint that a vendor's means: of its hue, or as bright.

    A vivid one that no paint of the link is like, such as of a lettering, is added to them.
    """
    hue, saturation, value = colorsys.rgb_to_hsv(*wanted.colour)
    known = [colorsys.rgb_to_hsv(*paint.colour) for paint in paints]
    vivid = saturation > VIVID and value > DIM
    alike = [n for n, one in enumerate(known) if (one[1] > VIVID and one[2] > DIM) == vivid]

    def off(n: int) -> float:
        turn = abs(known[n][0] - hue) % 1.0
        return min(turn, 1 - turn) if vivid else abs(known[n][2] - value)

    best = min(alike or range(len(paints)), key=off)
    if vivid and off(best) > TURNED:
        paints.append(wanted)
        return len(paints) - 1
    return best


def _by_part(mesh: trimesh.Trimesh, chosen: NDArray[np.int64]) -> NDArray[np.int64]:
    """Return one paint for each part of a mesh that is apart: that of most of its surface."""
    joined = _parts(_welded(mesh.triangles, keep=True))
    votes = np.zeros((joined.max() + 1, int(chosen.max()) + 1))
    np.add.at(votes, (joined, chosen), mesh.area_faces)
    return np.asarray(votes.argmax(axis=1)[joined])


def _parts(mesh: Mesh) -> NDArray[np.int64]:
    """Return the number of the part that each triangle belongs to."""
    adjacent = trimesh.graph.face_adjacency(mesh.faces)
    found = trimesh.graph.connected_component_labels(adjacent, node_count=len(mesh.faces))
    return np.asarray(found, dtype=np.int64)


def _welded(triangles: Array, grid: float = WELDED, keep: bool = False) -> Mesh:
    """Return triangles as a mesh whose corners are shared; keep: those without area, too.

    grid: m, on which they lie.
    """
    places, index = np.unique(
        np.round(triangles.reshape(-1, 3) / grid), axis=0, return_inverse=True
    )
    faces = index.reshape(-1, 3)
    if not keep:
        faces = faces[(faces != np.roll(faces, 1, axis=1)).all(axis=1)]
    return Mesh(places * grid, faces, np.empty((0, 3)))


def _thinned(pieces: Pieces, triangles: int, grid: float) -> Pieces:
    """Return bodies of so many triangles in all: the smallest error goes first in any."""
    flat = [(link, material, mesh) for link, own in pieces.items() for material, mesh in own]
    meshes = [mesh for _, _, mesh in flat]
    if grid > WELDED:
        meshes = [_welded(mesh.vertices[mesh.faces], grid) for mesh in meshes]
    thin = together(meshes, triangles)
    result: Pieces = {}
    for (link, material, _), mesh in zip(flat, thin, strict=True):
        if len(mesh.faces):
            result.setdefault(link, []).append((material, creased(mesh)))
    return result


def picture(
    library: RobotLibrary, robot_id: str, before: list[trimesh.Trimesh], path: Path
) -> None:
    """Write a PNG of the robot at home, `before` on the left and as it is now on the right."""
    from mrlab_ros.adapters.plotting import Figure
    from mrlab_ros.adapters.robots.drawing import bodies, paint

    figure = Figure(figsize=(16, 8))
    for number, parts in enumerate((before, bodies(library, robot_id))):
        axes = figure.add_axes((number / 2, 0, 0.5, 1), projection="3d", proj_type="persp")
        paint(axes, parts)
    path.parent.mkdir(parents=True, exist_ok=True)
    figure.savefig(path)
