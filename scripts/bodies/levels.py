"""Write the packed levels of detail that pages draw: `levels.py [--out DIR] [ID ...]`.

<id>/lod/near.glb has baked light and is drawn nearby; far.glb has few triangles. Both are made of
the meshes of the links, which other programs read, and change when those do; those of a large
robot are made of its castings, measured more densely than for these meshes (castings.py).
"""

from __future__ import annotations

import argparse
import hashlib
from collections.abc import Callable, Sequence
from functools import partial
from pathlib import Path
from typing import Any

import details
import glb
import kuka
import numpy as np
import trimesh
import yaml
from castings import Castings
from details import Surface
from housings import housings
from markings import AFAR, Marking, marked, markings
from relief import clamped, grooved, lined, screwed
from rings import collars

from mrlab_ros.adapters.robots.packing import packed
from mrlab_ros.adapters.robots.packing.atlas import Drawing
from mrlab_ros.adapters.robots.packing.occlusion import (
    DARKEST,
    Around,
    Pieces,
    lit,
    surroundings,
    triangles_of,
)
from mrlab_ros.adapters.robots.packing.pieces import Piece
from mrlab_ros.adapters.robots.packing.surfaces import Material, Mesh, creased, decimated

ROBOTS = Path(__file__).resolve().parents[2] / "robots"
LARGE = 1.4  # m of reach, from which a robot is a large one
NEAR, NEAR_LARGE = 15_000, 36_000  # triangles of a model at most, drawings and screws included
FAR, MOST_FAR = 3_600, 4_000  # of the bodies alone at first; with their drawings
PLAIN = 0.75  # of the triangles of near are there before it is made finer where light is uneven
PLAIN_FINE = 0.86  # the same where the castings are thinned
FAR_ATLAS = 256  # pixels

Level = dict[str, list[Piece]]


class Dress:
    """What is drawn beside the bodies of a model: lettering, seams, screws, clamps."""

    def __init__(self, figures: dict[str, Any], pieces: Pieces, reach: float) -> None:
        """pieces: the bodies as they are drawn; on their surfaces all of it lies."""
        self.around = surroundings(pieces, figures, reach)
        self._surfaces = {link: Surface(own) for link, own in pieces.items()}
        self._entries = details.table(figures["id"])
        self._marks = markings(figures, self._surfaces)
        self._collars = collars(figures, pieces, self.around)

    def drawings(self, afar: bool = False) -> list[Drawing]:
        """Return what the atlas has beside colours; afar: for the far level."""
        return [mark.drawing for mark in self._marks if not afar or mark.kind in AFAR]

    def near(self, link: str, body: list[Piece]) -> list[Piece]:
        """Return the dressed body of a link."""
        surface, around = self._surfaces[link], self.around[link]
        seams = self._own("seams", link)
        return [
            *marked(grooved(body, seams), self._numbered(link, self._marks)),
            *lined(seams, surface, around),
            *screwed(self._own("screws", link), surface, around),
            *clamped(self._own("clamps", link), surface, around),
            *self._collars[link],
        ]

    def far(self, link: str, body: list[Piece]) -> list[Piece]:
        """Return the body of a link with what is seen from afar."""
        large = [mark for mark in self._marks if mark.kind in AFAR]
        clamps = clamped(self._own("clamps", link), self._surfaces[link], self.around[link])
        return [*marked(body, self._numbered(link, large)), *clamps]

    def _own(self, kind: str, link: str) -> list[dict[str, Any]]:
        return [entry for entry in self._entries.get(kind, []) if entry["link"] == link]

    @staticmethod
    def _numbered(link: str, marks: Sequence[Marking]) -> list[tuple[int, Marking]]:
        return [(number, mark) for number, mark in enumerate(marks) if mark.link == link]


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
    most = NEAR_LARGE if reach > LARGE else NEAR
    share = PLAIN
    table = details.table(figures["id"])
    thinned: Callable[[float], Pieces] = partial(_thinned, pieces)
    if reach > LARGE and figures["id"] in kuka.ROBOTS:
        share, thinned = PLAIN_FINE, Castings(figures, pieces).thinned
    bodies = most
    while True:
        plain = _housed(thinned, share * bodies, housings(table))
        dress = Dress(figures, plain, reach)
        body = _fine(plain, dress.around, float(np.clip(reach / 120, 0.004, 0.02)), bodies)
        near = {link: dress.near(link, found) for link, found in body.items()}
        over = _count(near) - most
        if over <= 0:
            break
        bodies -= over + 50
    bodies = FAR
    while True:
        thin = _housed(thinned, bodies, housings(table, afar=True))
        few = _plainly(thin, surroundings(thin, figures, reach))
        far = {link: dress.far(link, found) for link, found in few.items()}
        over = _count(far) - MOST_FAR
        if over <= 0:
            break
        bodies -= over + 50
    off = max(_off(body[link], few[link]) for link in pieces)
    place = folder / "lod"
    place.mkdir(exist_ok=True)
    made_of = {"made_of": digest(folder), "details": details.digest(figures["id"])}
    packed.write(place / "near.glb", near, made_of, dress.drawings())
    packed.write(place / "far.glb", far, made_of, dress.drawings(True), FAR_ATLAS)
    near_kb, far_kb = ((place / f"{name}.glb").stat().st_size / 1e3 for name in ("near", "far"))
    print(
        f"{figures['id']}: near {_count(near)} triangles {near_kb:.0f} kB, "
        f"far {_count(far)} triangles {far_kb:.0f} kB, off by {off * 1e3:.1f} mm"
    )


def digest(folder: Path) -> str:
    """Return the sha256 of a model's visual meshes, by name and content."""
    found = hashlib.sha256()
    for file in sorted((folder / "meshes").glob("*.glb")):
        found.update(file.name.encode() + file.read_bytes())
    return found.hexdigest()


def is_current(folder: Path) -> bool:
    """Return whether a model's levels are made of its meshes and its table as they are."""
    made_of = [found.encode() for found in (digest(folder), details.digest(folder.name))]
    files = [folder / "lod" / f"{name}.glb" for name in ("near", "far")]
    return all(
        file.is_file() and all(each in file.read_bytes() for each in made_of) for file in files
    )


def _count(level: Level) -> int:
    return sum(len(piece.mesh.faces) for own in level.values() for piece in own)


def _total(pieces: Pieces) -> int:
    return sum(len(mesh.faces) for own in pieces.values() for _, mesh in own)


def _housed(thinned: Callable[[float], Pieces], triangles: float, own: Pieces) -> Pieces:
    """Return the bodies of so many triangles, their housings included."""
    found = thinned(triangles - _total(own))
    return {
        link: outer([*pieces, *own[link]]) if link in own else pieces
        for link, pieces in found.items()
    }


def outer(pieces: list[tuple[Material, Mesh]]) -> list[tuple[Material, Mesh]]:
    """Return the pieces of a link without the triangles of which no ray gets out of it."""
    link = Around([triangles_of(pieces)], 1e6)
    kept = []
    for material, mesh in pieces:
        corners = mesh.vertices[mesh.faces]
        normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
        normals /= np.maximum(np.linalg.norm(normals, axis=1, keepdims=True), 1e-12)
        middle = corners.mean(axis=1)
        lights = [link.light(middle, normals)]
        lights += [link.light(0.85 * corners[:, n] + 0.15 * middle, normals) for n in range(3)]
        faces = mesh.faces[np.max(lights, axis=0) > DARKEST + 1e-3]
        if len(faces):
            used, index = np.unique(faces, return_inverse=True)
            own = Mesh(mesh.vertices[used], index.reshape(-1, 3), mesh.normals[used])
            kept.append((material, own))
    return kept


def _thinned(pieces: Pieces, triangles: float) -> Pieces:
    """Return bodies of so many triangles at most."""
    share = triangles / _total(pieces)
    if share >= 1:
        return pieces
    return {
        link: [(material, _plain(mesh, int(len(mesh.faces) * share))) for material, mesh in own]
        for link, own in pieces.items()
    }


def _fine(pieces: Pieces, around: dict[str, Around], shortest: float, triangles: int) -> Level:
    """Return the bodies of `near`, of so many triangles at most, with their light."""
    share = triangles / _total(pieces)
    return {
        link: [
            Piece(material, *lit(mesh, around[link], shortest, int(len(mesh.faces) * share)))
            for material, mesh in own
        ]
        for link, own in pieces.items()
    }


def _plainly(pieces: Pieces, around: dict[str, Around]) -> Level:
    """Return bodies with the light at their corners."""
    return {
        link: [
            Piece(material, mesh, around[link].light(mesh.vertices, mesh.normals))
            for material, mesh in own
        ]
        for link, own in pieces.items()
    }


def _plain(mesh: Mesh, triangles: int) -> Mesh:
    """Return the mesh with few triangles; corners that only normals part are joined first."""
    places, index = np.unique(np.round(mesh.vertices, 6), axis=0, return_inverse=True)
    faces = index.ravel()[mesh.faces]
    faces = faces[(faces != np.roll(faces, 1, axis=1)).all(axis=1)]
    return creased(decimated(Mesh(places, faces, np.empty((0, 3))), max(triangles, 12)))


def _off(near: list[Piece], far: list[Piece]) -> float:
    """Return the distance, m, within which 99 of 100 points of a far body lie of the near one."""
    one, other = (
        triangles_of([(each.material, each.mesh) for each in own]) for own in (near, far)
    )
    points = other.mean(axis=1)[:: max(len(other) // 600, 1)]
    surface = trimesh.Trimesh(**trimesh.triangles.to_kwargs(one))
    return float(np.quantile(trimesh.proximity.closest_point(surface, points)[1], 0.99))


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
