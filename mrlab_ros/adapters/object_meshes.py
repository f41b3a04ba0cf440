"""The meshes of the catalogue's objects, read from files with trimesh and checked."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import trimesh

from mrlab_ros.core.errors import BadInput
from mrlab_ros.core.physics.catalogue import Mesh

PREFIX = "package://mrlab_ros/"
FORMATS = (".glb", ".obj", ".stl")
SIZE_RANGE = (0.002, 5.0)  # m, of the largest edge of the bounding box


def reader(root: Path, max_triangles: int) -> Callable[[str], Mesh]:
    """Return a function that reads the mesh of a package:// URI below `root`.

    It raises BadInput where there is no such mesh, or where it has more triangles than
    `max_triangles`, names the number, or is no size that an object has.
    """

    def read(uri: str) -> Mesh:
        path = (root / uri.removeprefix(PREFIX)).resolve()
        if not uri.startswith(PREFIX) or path.suffix.lower() not in FORMATS:
            raise BadInput(
                f"the mesh is '{uri}'; expected a URI that begins with {PREFIX} and ends with "
                f"{', '.join(FORMATS)}"
            )
        try:
            mesh: Any = trimesh.load(path, force="mesh", process=False)
        except Exception as error:  # trimesh raises what its parsers happen to raise
            raise BadInput(f"the mesh {uri} cannot be read: {error}; export it again") from None
        vertices = np.array(mesh.vertices, dtype=np.float64)
        triangles = np.array(mesh.faces, dtype=np.int32)
        if len(triangles) > max_triangles:
            raise BadInput(
                f"the mesh {uri} has {len(triangles)} triangles; expected {max_triangles} at "
                "most: simplify it, in Blender with the modifier Decimate"
            )
        if not len(triangles) or not np.isfinite(vertices).all():
            raise BadInput(f"the mesh {uri} has no triangles, or a vertex that is not finite")
        size = float(np.ptp(vertices, axis=0).max())
        if not SIZE_RANGE[0] <= size <= SIZE_RANGE[1]:
            raise BadInput(
                f"the mesh {uri} measures {size:g} m; expected {SIZE_RANGE[0]:g} to "
                f"{SIZE_RANGE[1]:g} m: export it in metres"
            )
        return Mesh(vertices, triangles)

    return read
