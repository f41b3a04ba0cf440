"""Renders small pictures of robots, end effectors and objects: `thumbnails.py [ID ...]`.

Each is a WebP of SIZE pixels with a transparent background, under the same light, from the same
side: robots/<id>/thumbnail.webp, robots/end_effectors/<id>/thumbnail.webp and
config/objects/<id>.webp.
"""

from __future__ import annotations

import sys
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import trimesh
from picture import VIEW, surface, surfaces
from ray_tracer import Camera, Surface, cut_out

from mrlab_ros.adapters.robots import urdf
from mrlab_ros.adapters.robots.drawing import Assembly
from mrlab_ros.adapters.robots.end_effectors import END_EFFECTORS
from mrlab_ros.adapters.robots.library import RobotLibrary
from mrlab_ros.adapters.scenes.object_meshes import ObjectMeshes
from mrlab_ros.adapters.yaml_files import read_yaml
from mrlab_ros.core.base.geometry import Array
from mrlab_ros.core.physics import catalogue, drawing

ROOT = Path(__file__).resolve().parents[2]
SIZE = 320
SAMPLES = 12
OPENING_DEG = 24.0
MARGIN = 0.88
# Fingers point down, as on a robot.
TURNED = np.diag([1.0, -1.0, -1.0, 1.0])


def main() -> None:
    """Render what is named on the command line, or all."""
    library = RobotLibrary(ROOT / "robots", ROOT / "robots" / "none imported")
    wanted = sys.argv[1:]
    for name, path, parts in pictures(library):
        if not wanted or name in wanted:
            found = list(parts)
            extent = float(np.ptp(np.concatenate([p.vertices for p in found]), axis=0).max())
            image = cut_out(found, camera(found), (SIZE, SIZE), SAMPLES, extent / 3)
            image.save(path, quality=82, alpha_quality=90, method=6)
            print(f"{path.relative_to(ROOT)}: {path.stat().st_size} bytes")


def pictures(library: RobotLibrary) -> Iterator[tuple[str, Path, Iterator[Surface]]]:
    """Yield id, file and surfaces of every robot, end effector and object."""
    for robot in library.ids():
        yield robot, library.folder / robot / "thumbnail.webp", iter(surfaces(library, robot))
    for tool in library.end_effectors():
        path = library.folder / END_EFFECTORS / tool / "thumbnail.webp"
        yield tool, path, end_effector(library, tool)
    config = ROOT / "config"
    types = catalogue.parse(read_yaml(config / "objects.yaml"), ObjectMeshes(ROOT, 20_000))
    for kind in types.ids:
        yield kind, config / "objects" / f"{kind}.webp", thing(types.get(kind))


def end_effector(library: RobotLibrary, tool: str) -> Iterator[Surface]:
    """Yield an end effector, open."""
    root = library.end_effector(tool).root
    body = Assembly(root, tool, library.mesh_path)
    body.move({joint.name: 0.0 for joint in urdf.joints(root, tool) if joint.moves})
    for _, mesh, pose in body.meshes():
        yield surface(mesh.copy().apply_transform(TURNED @ pose))


def thing(kind: catalogue.ObjectType) -> Iterator[Surface]:
    """Yield an object: its mesh, else its one shape."""
    if kind.mesh:
        file = ROOT / kind.mesh.removeprefix("package://mrlab_ros/")
        for mesh in trimesh.load_scene(file, process=False).dump():
            yield surface(mesh)
    elif kind.solid is not None:
        points, normals, faces = drawing.surface(kind.solid)
        red, green, blue, _ = kind.color
        yield Surface(points, normals, faces, (red, green, blue), 0.0, 0.6)


def camera(parts: list[Surface]) -> Camera:
    """Return the camera from VIEW that just sees all surfaces."""
    points = np.concatenate([part.vertices for part in parts])
    ahead = -VIEW / np.linalg.norm(VIEW)
    right = np.cross(ahead, [0.0, 0.0, 1.0])
    right /= np.linalg.norm(right)
    up = np.cross(right, ahead)
    scale = np.tan(np.radians(OPENING_DEG) / 2) * MARGIN
    target: Array = (points.min(axis=0) + points.max(axis=0)) / 2
    for _ in range(20):
        seen = points - target
        x, y, depth = seen @ right, seen @ up, seen @ ahead
        distance = float(np.maximum(np.abs(x), np.abs(y)).max() / scale - depth.min())
        for _ in range(20):
            along = distance + depth
            reach = max(float(np.abs(x / along).max()), float(np.abs(y / along).max())) / scale
            distance *= reach
        along = distance + depth
        # Centre what is seen.
        target = target + distance / 2 * (
            right * ((x / along).max() + (x / along).min())
            + up * ((y / along).max() + (y / along).min())
        )
    eye = target - ahead * distance
    return Camera(tuple(map(float, eye)), tuple(map(float, target)), OPENING_DEG)  # type: ignore[arg-type]


if __name__ == "__main__":
    main()
