"""Finds and copies the files that a mesh file names: material libraries, textures, buffers."""

from __future__ import annotations

import re
import shutil
from collections.abc import Callable, Iterator
from pathlib import Path
from urllib.parse import unquote

import numpy as np

from mrlab_ros.core.geometry import Array

# Of a mesh that collides: Bullet takes a minute for a million triangles, and halts wait for it.
MOST_TRIANGLES, MOST_BYTES = 20_000, 1_000_000
CORNERS = 500  # of the hull of a larger one, at most
IMAGES = (".png", ".jpg", ".jpeg", ".bmp", ".tga", ".tif", ".tiff", ".gif", ".webp", ".dds")
TAKEN = (*IMAGES, ".mtl", ".bin")

# Patterns of references in each text format; group 2 is the name of the file. In an .mtl,
# options such as `-s 1 1 1` stand before the name.
_OPTION = r"(?:-(?:[ost](?:\s+[-+.\deE]+){1,3}|mm(?:\s+[-+.\deE]+){2}|\w+\s+\S+)\s+)*"
REFERENCES = {
    ".obj": re.compile(r"(?m)^(\s*mtllib\s+)(.+?)(\s*)$"),
    ".mtl": re.compile(
        rf"(?mi)^(\s*(?:map_\w+|bump|norm|disp|decal|refl)\s+{_OPTION})(.+?)(\s*)$"
    ),
    ".dae": re.compile(r"(<init_from>\s*(?:<ref>\s*)?)([^<>]+?)(\s*<)"),
    ".gltf": re.compile(r'("uri"\s*:\s*")(?!data:)([^"]+)(")'),
}


def companions(path: Path) -> dict[str, Path]:
    """Return the files that a mesh file names, and those that these name, by the names written.

    A file may be missing. Only materials, images and buffers count; GLB and STL hold all they
    need.
    """
    found: dict[str, Path] = {}
    for written, file in _named(path):
        found[written] = file
        if file.suffix.lower() in REFERENCES and file.is_file():
            found |= companions(file)
    return found


def copy(path: Path, folder: Path, prefix: str) -> str:
    """Copy a mesh file and all that it names into `folder`; return the copy's name.

    The names of the copies begin with `prefix`, and what names them is rewritten: two meshes with
    textures of one name keep their own, and no name leads out of the folder.
    """
    name = f"{prefix}_{path.name}"
    pattern = REFERENCES.get(path.suffix.lower())
    if pattern is None:
        shutil.copyfile(path, folder / name)
        return name
    names = {
        written: copy(file, folder, f"{prefix}_{number}")
        for number, (written, file) in enumerate(_named(path))
        if file.is_file()
    }
    # latin-1 carries any bytes through unchanged.
    text = path.read_text(encoding="latin-1")
    (folder / name).write_text(pattern.sub(_renamed(names), text), encoding="latin-1")
    return name


def readable_by_physics(path: Path) -> bool:
    """Return whether pybullet reads the file soon: a small OBJ, or an STL that is not text."""
    if path.stat().st_size > MOST_BYTES:
        return False
    suffix = path.suffix.lower()
    if suffix != ".stl":
        return suffix == ".obj"
    with path.open("rb") as file:
        head = file.read(84)
    # A binary STL has an 80-byte head, the number of triangles, and 50 bytes for each.
    return len(head) == 84 and path.stat().st_size >= 84 + 50 * int.from_bytes(head[80:], "little")


def as_stl(path: Path, folder: Path, prefix: str) -> str:
    """Write a mesh file's triangles as a binary STL into `folder`; return its name.

    Of more than MOST_TRIANGLES their convex hull, which is what physics takes of each mesh.
    """
    import trimesh

    name = f"{prefix}_{path.stem}.stl"
    mesh = trimesh.load_scene(path).to_mesh()
    if len(mesh.faces) > MOST_TRIANGLES:
        mesh = trimesh.Trimesh(_extreme(np.asarray(mesh.vertices))).convex_hull
    mesh.export(folder / name)
    return name


def _extreme(vertices: Array) -> Array:
    """Return the vertices that reach furthest in one of CORNERS even directions."""
    k = np.arange(CORNERS) + 0.5
    z = 1 - 2 * k / CORNERS
    turn = np.pi * (1 + np.sqrt(5)) * k
    across = np.sqrt(1 - z * z)
    directions = np.stack([across * np.cos(turn), across * np.sin(turn), z])
    # In parts: every vertex times every direction would be gigabytes of a large mesh.
    best = [int((vertices @ way).argmax()) for way in directions.T]
    kept: Array = vertices[np.unique(best)]
    return kept


def _renamed(names: dict[str, str]) -> Callable[[re.Match[str]], str]:
    def replace(match: re.Match[str]) -> str:
        before, written, after = match.groups()
        return f"{before}{names.get(written, written)}{after}"

    return replace


def _named(path: Path) -> Iterator[tuple[str, Path]]:
    pattern = REFERENCES.get(path.suffix.lower())
    if pattern is None:
        return
    seen = set()
    for match in pattern.finditer(path.read_text(encoding="latin-1")):
        written = match.group(2)
        place = unquote(written.removeprefix("file://")).replace("\\", "/")
        file = path.parent / place
        if written not in seen and file.suffix.lower() in TAKEN:
            seen.add(written)
            yield written, file
