"""Write the packed levels of detail that pages draw: `levels.py [--out DIR] [ID ...]`.

<id>/lod/near.glb has baked light and is drawn nearby; far.glb has few triangles. Both are made of
the meshes of the links, which other programs read, and change when those do.
"""

from __future__ import annotations

import argparse
import hashlib
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import glb
import numpy as np
import packed
import trimesh
import yaml
from body import Material
from mesher import Mesh, creased, decimated
from occlusion import Around, lit
from scipy.spatial.transform import Rotation
from solids import Array

from mrlab_ros.core.geometry import inverse_transform, transform_from_xyz_rpy

ROBOTS = Path(__file__).resolve().parents[2] / "robots"
NEAR, FAR = 26_000, 3_600  # triangles of a model
LARGE = 1.4  # m of reach, from which a robot is a large one
NEAR_LARGE = 36_000
# Neighbours stand at home and turned by this much to both sides: what is always hidden is dark.
TURNS = (-0.9, 0.0, 0.9)
FLOOR = 4.0  # m, half of its side


def write(folder: Path, figures: dict[str, Any]) -> None:
    """Write both levels of a model into its folder from its meshes."""
    pieces = {file.stem: glb.read(file) for file in sorted((folder / "meshes").glob("*.glb"))}
    size = float(
        np.linalg.norm(
            np.ptp(
                np.concatenate([mesh.vertices for own in pieces.values() for _, mesh in own]),
                axis=0,
            )
        )
    )
    reach = float(figures.get("reach", size))
    near, far = _budgets(pieces, NEAR_LARGE if reach > LARGE else NEAR)
    surroundings = {
        link: Around(_surroundings(link, pieces, figures), float(np.clip(reach / 9, 0.04, 0.25)))
        for link in pieces
    }
    levels: dict[str, dict[str, list[packed.Piece]]] = {"near": {}, "far": {}}
    shortest = float(np.clip(reach / 120, 0.004, 0.02))
    for link, own in pieces.items():
        around = surroundings[link]
        for material, mesh in own:
            share = len(mesh.faces) / sum(len(other.faces) for _, other in own)
            fine, light = lit(mesh, around, shortest, int(near[link] * share))
            levels["near"].setdefault(link, []).append(packed.Piece(material, fine, light))
            plain = _plain(mesh, int(far[link] * share))
            light = around.light(plain.vertices, plain.normals)
            levels["far"].setdefault(link, []).append(packed.Piece(material, plain, light))
    place = folder / "lod"
    place.mkdir(exist_ok=True)
    for name, links in levels.items():
        packed.write(place / f"{name}.glb", links, digest(folder))
    counts = {
        name: sum(len(piece.mesh.faces) for own in links.values() for piece in own)
        for name, links in levels.items()
    }
    sizes = {name: (place / f"{name}.glb").stat().st_size / 1e3 for name in levels}
    off = max(
        _off(one.mesh, other.mesh)
        for link in pieces
        for one, other in zip(levels["near"][link], levels["far"][link], strict=True)
    )
    print(
        f"{figures['id']}: near {counts['near']} triangles {sizes['near']:.0f} kB, "
        f"far {counts['far']} triangles {sizes['far']:.0f} kB, off by {off * 1e3:.1f} mm"
    )


def digest(folder: Path) -> str:
    """Return the sha256 of a model's visual meshes, by name and content."""
    found = hashlib.sha256()
    for file in sorted((folder / "meshes").glob("*.glb")):
        found.update(file.name.encode() + file.read_bytes())
    return found.hexdigest()


def is_current(folder: Path) -> bool:
    """Return whether a model's levels are made of its meshes as they are."""
    made_of = digest(folder).encode()
    files = [folder / "lod" / f"{name}.glb" for name in ("near", "far")]
    return all(file.is_file() and made_of in file.read_bytes() for file in files)


def _budgets(
    pieces: dict[str, list[tuple[Material, Mesh]]], most: int
) -> tuple[dict[str, float], dict[str, float]]:
    """Return the triangles of each link of both levels."""
    counts = {link: sum(len(mesh.faces) for _, mesh in own) for link, own in pieces.items()}
    total = sum(counts.values())
    return (
        {link: count * max(most / total, 1) for link, count in counts.items()},
        {link: count * min(FAR / total, 1) for link, count in counts.items()},
    )


def _plain(mesh: Mesh, triangles: int) -> Mesh:
    """Return the mesh with few triangles; corners that only normals part are joined first."""
    places, index = np.unique(np.round(mesh.vertices, 6), axis=0, return_inverse=True)
    faces = index.ravel()[mesh.faces]
    faces = faces[(faces != np.roll(faces, 1, axis=1)).all(axis=1)]
    return creased(decimated(Mesh(places, faces, np.empty((0, 3))), max(triangles, 12)))


def _off(near: Mesh, far: Mesh) -> float:
    """Return the distance, m, within which 99 of 100 points of a far mesh lie of the near one."""
    points = far.vertices[far.faces].mean(axis=1)[:: max(len(far.faces) // 300, 1)]
    surface = trimesh.Trimesh(near.vertices, near.faces, process=False)
    return float(np.quantile(trimesh.proximity.closest_point(surface, points)[1], 0.99))


def _surroundings(
    link: str, pieces: dict[str, list[tuple[Material, Mesh]]], figures: dict[str, Any]
) -> list[Array]:
    own = _triangles(pieces[link])
    joints: Sequence[dict[str, Any]] = figures["joints"]
    root = joints[0]["parent"] if joints else link
    fixed = [own]
    if link == root or (joints and joints[0]["type"] == "fixed" and joints[0]["child"] == link):
        low = float(own[:, :, 2].min()) - 2e-4
        a, b, c, d = ([x * FLOOR, y * FLOOR, low] for x, y in ((-1, -1), (1, -1), (1, 1), (-1, 1)))
        fixed.append(np.array([[a, b, c], [a, c, d]]))
    poses = []
    for turn in TURNS:
        around = list(fixed)
        for joint in joints:
            moves = joint["type"] in ("revolute", "continuous")
            pose = transform_from_xyz_rpy(joint["xyz"], joint["rpy"])
            if moves:
                turned = Rotation.from_rotvec(turn * np.array(joint["axis"], float))
                pose[:3, :3] = pose[:3, :3] @ turned.as_matrix()
            if joint["parent"] == link and joint["child"] in pieces:
                around.append(_moved(_triangles(pieces[joint["child"]]), pose))
            elif joint["child"] == link and joint["parent"] in pieces:
                around.append(_moved(_triangles(pieces[joint["parent"]]), inverse_transform(pose)))
        poses.append(np.concatenate(around))
    return poses


def _triangles(pieces: Sequence[tuple[Material, Mesh]]) -> Array:
    return np.concatenate([mesh.vertices[mesh.faces] for _, mesh in pieces])


def _moved(triangles: Array, pose: Array) -> Array:
    result: Array = triangles @ pose[:3, :3].T + pose[:3, 3]
    return result


def models(ids: Sequence[str], library: Path) -> list[tuple[Path, Path]]:
    """Return the folders of models and the files of their figures; all where no id is given."""
    found = [
        (source.parent, source)
        for pattern in ("*/robot.yaml", "end_effectors/*/end_effector.yaml")
        for source in sorted(library.glob(pattern))
    ]
    return [(folder, source) for folder, source in found if not ids or folder.name in ids]


def main() -> None:
    """Write the levels of the models named on the command line, or of all."""
    parser = argparse.ArgumentParser(description="Write the packed levels of detail.")
    parser.add_argument("ids", nargs="*", metavar="ID", help="models; none: all")
    parser.add_argument("--out", type=Path, default=ROBOTS, help="the library, meshes included")
    parser.add_argument("--stale", action="store_true", help="only where the meshes have changed")
    chosen = parser.parse_args()
    for folder, source in models(chosen.ids, chosen.out):
        if not (chosen.stale and is_current(folder)):
            write(folder, yaml.safe_load(source.read_text()))


if __name__ == "__main__":
    main()
