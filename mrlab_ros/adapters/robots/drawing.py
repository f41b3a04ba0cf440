"""Draws a robot: as a picture, as a page in which it can be turned, or as a glTF file."""

from __future__ import annotations

import math
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np
import trimesh

from mrlab_ros.adapters.robots import urdf
from mrlab_ros.adapters.robots.assembly import Assembly
from mrlab_ros.adapters.robots.diagnostics import SHEET_FORMAT
from mrlab_ros.adapters.robots.library import RobotLibrary
from mrlab_ros.core.base.errors import BadInput
from mrlab_ros.core.base.geometry import Array

FORMATS = (".png", ".html", ".glb")
# Unit vectors: the picture is taken from the front right, a little from above; the light comes
# from the left of that.
VIEW = np.array([0.85, -1.0, 0.34]) / np.linalg.norm([0.85, -1.0, 0.34])
LIGHT = np.array([0.35, -0.75, 0.95]) / np.linalg.norm([0.35, -0.75, 0.95])
SHADE = 0.4  # of the colour, where no light falls
# matplotlib draws whole triangles, the furthest first: the longest side of one is at most the
# robot's size divided by this, so that none hides what is in front of it.
PIECES = 70


def bodies(
    library: RobotLibrary,
    robot_id: str,
    end_effector: str | None = None,
    positions: Mapping[str, float] | None = None,
    *,
    collision: bool = False,
) -> list[trimesh.Trimesh]:
    """Return the robot's meshes at the joint positions, m, in the frame of its root link.

    positions: rad or m by the names of the joints; None: home. collision: the convex hulls
    instead of what is seen. Raises BadInput for an unknown id or a missing mesh.
    """
    model = library.model(robot_id)
    root = urdf.parse(library.description(robot_id, end_effector), robot_id)
    robot = Assembly(root, robot_id, library.mesh_path, collision=collision)
    home = dict(zip(model.joint_names, model.home, strict=True))
    robot.move(home if positions is None else positions)
    return [mesh.copy().apply_transform(pose) for _, mesh, pose in robot.meshes()]


def write(parts: list[trimesh.Trimesh], path: Path) -> None:
    """Write the meshes, z up, to a file; raise BadInput for a suffix other than FORMATS."""
    suffix = path.suffix.lower()
    if suffix not in FORMATS:
        raise BadInput(SHEET_FORMAT(file=path.name, formats=[*FORMATS]))
    path.parent.mkdir(parents=True, exist_ok=True)
    if suffix == ".png":
        _picture(parts, path)
        return
    # y points up in glTF, and in the page, which holds a glTF file.
    turn = trimesh.transformations.rotation_matrix(-math.pi / 2, [1, 0, 0])
    scene = trimesh.Scene(parts).apply_transform(turn)
    if suffix == ".glb":
        scene.export(path)
    else:
        from trimesh.viewer.notebook import scene_to_html

        path.write_text(scene_to_html(scene), encoding="utf-8")


def colour(mesh: trimesh.Trimesh) -> Array:
    """Return the mean colour of a mesh, sRGB 0 to 1."""
    material: Any = getattr(mesh.visual, "material", None)
    if getattr(material, "baseColorFactor", None) is not None:  # glTF's factors are linear
        linear = np.asarray(material.main_color, dtype=np.float64)[:3] / 255
        low, high = linear * 12.92, 1.055 * linear ** (1 / 2.4) - 0.055
        return np.where(linear <= 0.0031308, low, high)
    plain: Any = mesh.visual
    if material is not None:
        plain = plain.to_color()
    return np.asarray(plain.main_color, dtype=np.float64)[:3] / 255


def _picture(parts: list[trimesh.Trimesh], path: Path) -> None:
    from mrlab_ros.adapters.plotting import Figure

    figure = Figure(figsize=(9, 9))
    axes: Any = figure.add_axes(
        (-0.03, 0, 1, 1), projection="3d", proj_type="persp", focal_length=2
    )
    paint(axes, parts)
    figure.savefig(path)


def paint(axes: Any, parts: list[trimesh.Trimesh]) -> float:
    """Draw meshes into matplotlib's 3D axes; return half of the drawn cube's side, m."""
    from mpl_toolkits.mplot3d.art3d import Poly3DCollection

    low, high = np.array([[part.bounds[0], part.bounds[1]] for part in parts]).transpose(1, 0, 2)
    low, high = np.append(low, [[0, 0, 0]], axis=0).min(axis=0), high.max(axis=0)
    half = float((high - low).max()) / 2
    triangles, colours = [], []
    for part in parts:
        vertices, faces, owner = trimesh.remesh.subdivide_to_size(
            part.vertices, part.faces, 2 * half / PIECES, max_iter=20, return_index=True
        )
        normal = np.array(part.face_normals)
        if hasattr(part.visual, "material"):  # other files have no normals of their own
            normal = part.vertex_normals[part.faces].mean(axis=1)
        normal /= np.maximum(np.linalg.norm(normal, axis=1, keepdims=True), 1e-9)
        # Towards the viewer, whichever way round a mesh of somebody else's is.
        lit = np.clip((normal @ LIGHT) * np.where(normal @ VIEW < 0, -1, 1), 0, 1)
        shaded = colour(part) * (SHADE + (1 - SHADE) * lit)[:, None]
        triangles.append(vertices[faces])
        colours.append(shaded[owner])
    paints = np.concatenate(colours)
    axes.add_collection3d(
        Poly3DCollection(
            np.concatenate(triangles), facecolors=paints, edgecolors=paints, linewidths=0.25
        )
    )
    for name, middle in zip("xyz", (low + high) / 2, strict=True):
        axes.set(**{f"{name}lim": (middle - half, middle + half), f"{name}label": f"{name}, m"})
    axes.set_box_aspect((1, 1, 1))
    axes.view_init(math.degrees(math.asin(VIEW[2])), math.degrees(math.atan2(VIEW[1], VIEW[0])))
    return half
