"""Takes the meshes of a description from outside: each is read once and written anew.

A mesh file may name others: material libraries, pictures, buffers. They are read in a process
in the sandbox, which reaches the description's folders only, and what it read becomes a file of
ours: a GLB with its pictures inside, an STL, or an OBJ of vertices and faces. No file is copied.

Apart from `mesh_files.py`: trimesh and what it imports would be half of the memory that a process
of the lab has for Python's modules, and none of them reads a mesh.
"""

from __future__ import annotations

import contextlib
import re
import xml.etree.ElementTree as ET
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import asdict
from pathlib import Path
from typing import Any
from urllib.parse import unquote

import numpy as np
import trimesh

from mrlab_ros.adapters.robots.diagnostics import MESH_VERTEX_NOWHERE, MESH_WITHOUT_TRIANGLES
from mrlab_ros.adapters.robots.mesh_files import COLLISION, Look
from mrlab_ros.adapters.sandbox import calls
from mrlab_ros.core.base.diagnostic import of_text, plain
from mrlab_ros.core.base.errors import BadInput
from mrlab_ros.core.base.geometry import Array

# Of a mesh that collides: Bullet takes a minute for a million triangles, and halts wait for it.
MOST_TRIANGLES, MOST_BYTES = 20_000, 1_000_000
CORNERS = 500  # of the hull of a larger one, at most
# what a mesh may name: pictures, which are decoded, material libraries and buffers of numbers
IMAGES = (".png", ".jpg", ".jpeg", ".bmp", ".tga", ".tif", ".tiff", ".gif", ".webp", ".dds")
TAKEN = (*IMAGES, ".mtl", ".bin")
MOST_TIME = 600.0  # s, for all meshes of a robot
# In an .mtl, options such as `-s 1 1 1` stand before the name of a picture.
OPTIONS = re.compile(r"(?:-(?:[ost](?:\s+[-+.\deE]+){1,3}|mm(?:\s+[-+.\deE]+){2}|\w+\s+\S+)\s+)*")
# The lines of an OBJ that physics needs: vertices, faces, and which of them are a body.
SOLID = re.compile(rb"^(?:v(?:\s+[-+.\deE]+){3,}|f(?:\s+-?\d+(?:/-?\d*){0,2}){3,}|[og]\b.*)\s*$")


def take(
    root: ET.Element,
    files: Mapping[str, Path],
    folders: Iterable[Path],
    target: Path,
    prefix: str = "",
) -> dict[str, Look]:
    """Write copies of the mesh files, by URI, of what is seen and what collides below `root`.

    folders: those in which a mesh, and what it names, may lie. target: a folder of ours.
    """
    uses = {
        (shape.tag == COLLISION, str(mesh.get("filename")))
        for shape in root.iterfind("link/*")
        for mesh in shape.iterfind("geometry/mesh")
    }
    wanted = {
        uri: (str(path), f"{prefix}{number:02d}", (False, uri) in uses, (True, uri) in uses)
        for number, (uri, path) in enumerate(files.items())
    }
    if not wanted:
        return {}
    inside = [folder.resolve() for folder in folders]
    found = calls.call(
        copies, wanted, [str(folder) for folder in inside], str(target), name="the meshes",
        read=inside, write=[target], seconds=MOST_TIME, memory=4096 * calls.MiB,
    )  # fmt: skip
    return {uri: Look(**look) for uri, look in found.items()}


def name_copies(root: ET.Element, looks: Mapping[str, Look], place: str) -> None:
    """Let the shapes of the links below `root` name the copies, which lie at `place`."""
    for shape in root.iterfind("link/*"):
        for mesh in shape.iterfind("geometry/mesh"):
            found = looks[str(mesh.get("filename"))]
            name = found.solid if shape.tag == COLLISION else found.visual
            mesh.set("filename", f"{place}/{name}")


def copies(
    wanted: Mapping[str, tuple[str, str, bool, bool]], folders: Sequence[str], target: str
) -> dict[str, Any]:
    """Write the copies that `take` wants, in the sandbox; return a Look for each, as JSON."""
    return {
        uri: asdict(_copied(Path(path), prefix, uses, [Path(f) for f in folders], Path(target)))
        for uri, (path, prefix, *uses) in wanted.items()
    }


def look(path: Path) -> Look:
    """Return what a mesh file of the lab's own holds."""
    return _copied(path, "", (False, False), [path.parent], path.parent)


def _copied(
    path: Path, prefix: str, uses: Sequence[bool], folders: Sequence[Path], target: Path
) -> Look:
    """Look at a mesh file, and write its copies: of what is seen, of what collides."""
    beside = Beside(path, folders)
    suffix, seen, solid = path.suffix.lower(), "", ""
    try:
        size = _size(load(path, beside, process=False))
        name = f"{prefix}_{re.sub('[^A-Za-z0-9_]+', '_', path.stem)[:40]}"
        scene = load(path, beside) if any(uses) else None
        if scene is not None and uses[0]:
            seen = f"{name}.stl" if suffix == ".stl" else f"{name}.glb"
            (scene.to_mesh() if suffix == ".stl" else scene).export(target / seen)
        if scene is not None and uses[1]:
            solid = f"{name}_solid.obj" if suffix == ".obj" else f"{name}_solid.stl"
            if suffix == ".obj" and readable_by_physics(path):
                (target / solid).write_bytes(_bodies(path.read_bytes()))
            else:
                solid = f"{name}_solid.stl"
                as_stl(scene.to_mesh(), target / solid)
    except MemoryError:
        raise
    except Exception as error:  # every mesh reader has errors of its own
        said = of_text(str(error) or type(error).__name__)
        return Look(problem=plain(getattr(error, "diagnostic", said)))
    return Look(size, None, beside.missing, seen, solid)


def _size(scene: trimesh.Scene) -> float:
    """Return the longest side of a mesh in its file's unit; raise BadInput where it is none.

    Unprocessed: trimesh leaves a vertex that is nowhere out, and Bullet ends the process on it.
    """
    if scene.bounds is None:
        raise BadInput(MESH_WITHOUT_TRIANGLES())
    if not all(np.isfinite(mesh.vertices).all() for mesh in scene.geometry.values()):
        raise BadInput(MESH_VERTEX_NOWHERE())
    return float(np.ptp(scene.bounds, axis=0).max())


def _bodies(text: bytes) -> bytes:
    """Return an OBJ's vertices and faces, and the bodies that they make: Bullet takes hulls."""
    kept = [line for line in text.splitlines() if SOLID.match(line)]
    for number, line in enumerate(kept):
        if line[:1] in b"og":
            kept[number] = b"%c body_%d" % (line[0], number)
        elif line[:1] == b"f":
            kept[number] = re.sub(rb"/[-\d/]*", b"", line)
    return b"\n".join(kept) + b"\n"


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


def as_stl(mesh: trimesh.Trimesh, file: Path) -> None:
    """Write triangles as a binary STL.

    Of more than MOST_TRIANGLES their convex hull, which is what physics takes of each mesh.
    """
    if len(mesh.faces) > MOST_TRIANGLES:
        mesh = trimesh.Trimesh(_extreme(np.asarray(mesh.vertices))).convex_hull
    mesh.export(file)


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


class Beside(trimesh.resolvers.Resolver):
    """Reads what a mesh file names, for trimesh: of TAKEN kinds, below some folders, else nothing.

    A name is of a file beside the mesh, or beside the material library that was read last.
    """

    def __init__(self, path: Path, folders: Sequence[Path]) -> None:
        self._places, self._folders = [path.parent], folders
        self.missing: list[str] = []

    def get(self, name: str) -> bytes:
        """Return a file's bytes; raise FileNotFoundError where it is none to be taken."""
        options = OPTIONS.match(name)
        written = name[options.end() :] if options else name
        written = unquote(written.removeprefix("file://")).replace("\\", "/")
        for place in self._places:
            with contextlib.suppress(OSError, ValueError, RuntimeError):
                file = (place / written).resolve()
                if file.suffix.lower() in TAKEN and any(map(file.is_relative_to, self._folders)):
                    found = file.read_bytes()
                    self._places.append(file.parent)
                    return found
        if written not in self.missing:
            self.missing.append(written)
        raise FileNotFoundError(f"{written} is not beside the mesh")

    def keys(self) -> list[str]:
        return []

    def namespaced(self, namespace: str) -> Beside:
        return self

    def write(self, name: str, data: Any) -> None:
        raise OSError("a mesh is read only")


def load(path: Path, beside: Beside, *, process: bool = True) -> trimesh.Scene:
    """Return a mesh file's scene; raises what trimesh's readers raise."""
    with path.open("rb") as file:
        suffix = path.suffix.lower().removeprefix(".")
        return trimesh.load_scene(file, file_type=suffix, resolver=beside, process=process)
