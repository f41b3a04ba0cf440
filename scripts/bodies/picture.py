"""Rendered pictures of the library's robots, true to scale, beside a person of 1.8 m."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import trimesh
from ray_tracer import Camera, Surface, draw

from mrlab_ros.adapters.robots import drawing
from mrlab_ros.adapters.robots.library import RobotLibrary
from mrlab_ros.core.base.geometry import Array

# Seen from the front right, a little from above.
VIEW = np.array([0.85, -1.0, 0.34])
OPENING_DEG = 26.0
# Of shapes without a material, such as the adapter plate of bare aluminium.
METALNESS, ROUGHNESS = 0.8, 0.4


def surfaces(
    library: RobotLibrary,
    robot_id: str,
    end_effector: str | None = None,
    positions: Array | None = None,
) -> list[Surface]:
    """Return the robot's meshes at the joint positions, (J,) rad; at home where None."""
    at = None
    if positions is not None:
        names = library.model(robot_id).joint_names
        at = dict(zip(names, map(float, positions), strict=True))
    return [surface(mesh) for mesh in drawing.bodies(library, robot_id, end_effector, at)]


def surface(mesh: trimesh.Trimesh) -> Surface:
    """Return a mesh with the colour and roughness of its material."""
    material = getattr(mesh.visual, "material", None)
    if material is None:
        mesh.unmerge_vertices()  # flat faces: a shape has edges
    return Surface(
        np.asarray(mesh.vertices),
        np.asarray(mesh.vertex_normals),
        np.asarray(mesh.faces),
        tuple(float(value) for value in drawing.colour(mesh)),
        METALNESS if material is None else float(material.metallicFactor or 0.0),
        ROUGHNESS if material is None else float(material.roughnessFactor or 0.5),
    )


def take(
    library: RobotLibrary,
    robot_id: str,
    path: Path,
    end_effector: str | None = None,
    *,
    size: tuple[int, int] = (900, 900),
    samples: int = 6,
    figure: bool = True,
) -> None:
    """Write a PNG of the robot at home, `size` pixels wide and high, `samples` rays a pixel."""
    robot = surfaces(library, robot_id, end_effector)
    if figure:
        # Left of the robot as the camera sees it, and as far away.
        right = np.array([-VIEW[1], VIEW[0], 0.0]) / np.hypot(VIEW[0], VIEW[1])
        person = trimesh.load_scene(library.folder / "figure.glb")
        edge = min(float((part.vertices @ right).min()) for part in robot)
        person.apply_translation(right * (edge - 0.38))
        robot += [surface(mesh) for mesh in person.dump()]
    low, high = bounds(robot)
    draw(robot, _camera(low, high), size, samples, path)


def bounds(parts: list[Surface]) -> tuple[Array, Array]:
    """Return the corners, (3,) m each, of the box that holds the surfaces."""
    corners = np.array([[part.vertices.min(axis=0), part.vertices.max(axis=0)] for part in parts])
    return corners[:, 0].min(axis=0), corners[:, 1].max(axis=0)


def _camera(low: Array, high: Array) -> Camera:
    middle, ahead = (low + high) / 2, -VIEW / np.linalg.norm(VIEW)
    right = np.cross(ahead, [0.0, 0.0, 1.0])
    right /= np.linalg.norm(right)
    up = np.cross(right, ahead)
    corners = np.array(np.meshgrid(*zip(low, high, strict=True))).reshape(3, -1).T - middle
    # Far enough that every corner of the box is inside the opening, with a margin.
    scale = np.tan(np.radians(OPENING_DEG) / 2) * 0.93
    across = np.maximum(np.abs(corners @ right), np.abs(corners @ up))
    distance = float((across / scale - corners @ ahead).max())
    eye = middle - ahead * distance
    return Camera(
        (float(eye[0]), float(eye[1]), float(eye[2])),
        (float(middle[0]), float(middle[1]), float(middle[2])),
        OPENING_DEG,
    )
