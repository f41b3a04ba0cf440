"""Pictures of the library's robots, true to scale, beside a person of 1.8 m."""

from __future__ import annotations

import xml.etree.ElementTree as ET
from pathlib import Path

import numpy as np
import trimesh

from mrlab_ros.adapters.robots import urdf
from mrlab_ros.adapters.robots.library import RobotLibrary
from mrlab_ros.adapters.robots.ray_tracer import Camera, Surface, draw
from mrlab_ros.core.geometry import Array, transform_from_xyz_rpy

# Seen from the front right, a little from above.
VIEW = np.array([0.85, -1.0, 0.34])
OPENING_DEG = 26.0
PLAIN = (0.7, 0.7, 0.72)


def surfaces(
    library: RobotLibrary,
    robot_id: str,
    end_effector: str | None = None,
    positions: Array | None = None,
    *,
    collision: bool = False,
) -> list[Surface]:
    """Return the robot's meshes at the joint positions, (J,) rad; at home where None.

    collision: the convex hulls instead of what is seen.
    """
    model = library.model(robot_id)
    at = model.home if positions is None else positions
    root = urdf.parse(library.description(robot_id, end_effector), robot_id)
    poses = urdf.poses(root, dict(zip(model.joint_names, map(float, at), strict=True)), robot_id)
    found: list[Surface] = []
    for link in root.iterfind("link"):
        for shape in link.iterfind("collision" if collision else "visual"):
            pose = poses[str(link.get("name"))] @ _origin(shape)
            found += _shape(library, shape, pose)
    return found


def take(
    library: RobotLibrary,
    robot_id: str,
    path: Path,
    end_effector: str | None = None,
    *,
    positions: Array | None = None,
    size: tuple[int, int] = (900, 900),
    samples: int = 6,
    figure: bool = True,
    collision: bool = False,
) -> None:
    """Write a PNG of the robot, `size` pixels wide and high; at home where positions is None."""
    robot = surfaces(library, robot_id, end_effector, positions, collision=collision)
    if figure:
        # Left of the robot as the camera sees it, and as far away.
        right = np.array([-VIEW[1], VIEW[0], 0.0]) / np.hypot(VIEW[0], VIEW[1])
        place = np.eye(4)
        place[:3, 3] = right * (min(float((s.vertices @ right).min()) for s in robot) - 0.38)
        robot += mesh_surfaces(library.folder / "figure.glb", place)
    low, high = bounds(robot)
    draw(robot, _camera(low, high), size, samples, path)


def bounds(parts: list[Surface]) -> tuple[Array, Array]:
    """Return the corners, (3,) m each, of the box that holds the surfaces."""
    corners = np.array([[part.vertices.min(axis=0), part.vertices.max(axis=0)] for part in parts])
    return corners[:, 0].min(axis=0), corners[:, 1].max(axis=0)


def mesh_surfaces(path: Path, pose: Array, scale: Array | None = None) -> list[Surface]:
    """Return the surfaces of a mesh file; pose: T_world_mesh (4, 4)."""
    scene = trimesh.load_scene(path)
    found = []
    for name in scene.graph.nodes_geometry:
        place, geometry = scene.graph[name]
        mesh = scene.geometry[geometry]
        vertices = mesh.vertices @ place[:3, :3].T + place[:3, 3]
        vertices = vertices if scale is None else vertices * scale
        turn = pose[:3, :3] @ place[:3, :3]
        material = getattr(mesh.visual, "material", None)
        colour = getattr(material, "baseColorFactor", None)
        found.append(
            Surface(
                vertices @ pose[:3, :3].T + pose[:3, 3],
                np.asarray(mesh.vertex_normals) @ turn.T,
                np.asarray(mesh.faces),
                PLAIN if colour is None else _srgb(np.asarray(colour, dtype=np.float64)),
                float(getattr(material, "metallicFactor", None) or 0.0),
                float(getattr(material, "roughnessFactor", None) or 0.5),
            )
        )
    return found


def _srgb(colour: Array) -> tuple[float, float, float]:
    """Return sRGB, 0 to 1, of a glTF base colour, which trimesh gives as linear 0 to 255."""
    linear = colour[:3] / (255.0 if colour.max() > 1 else 1.0)
    values = np.where(linear <= 0.0031308, linear * 12.92, 1.055 * linear ** (1 / 2.4) - 0.055)
    red, green, blue = (float(value) for value in values)
    return red, green, blue


def _origin(shape: ET.Element) -> Array:
    origin = shape.find("origin")
    if origin is None:
        return np.eye(4)
    xyz = urdf.numbers(origin.get("xyz", "0 0 0"), 3, "origin xyz")
    return transform_from_xyz_rpy(xyz, urdf.numbers(origin.get("rpy", "0 0 0"), 3, "origin rpy"))


def _shape(library: RobotLibrary, shape: ET.Element, pose: Array) -> list[Surface]:
    geometry = shape.find("geometry/*")
    if geometry is None:
        return []
    if geometry.tag == "mesh":
        scale = np.array(urdf.numbers(geometry.get("scale", "1 1 1"), 3, "scale"))
        return mesh_surfaces(library.mesh_path(str(geometry.get("filename"))), pose, scale)
    if geometry.tag == "box":
        size = urdf.numbers(geometry.get("size", ""), 3, "box size")
        mesh = trimesh.creation.box(size)
    elif geometry.tag == "sphere":
        mesh = trimesh.creation.icosphere(3, float(geometry.get("radius", "0")))
    else:
        radius, length = float(geometry.get("radius", "0")), float(geometry.get("length", "0"))
        mesh = trimesh.creation.cylinder(radius, length, sections=48)
    faces = np.arange(mesh.faces.size).reshape(-1, 3)
    vertices = mesh.vertices[mesh.faces].reshape(-1, 3)
    normals = np.repeat(mesh.face_normals, 3, axis=0)
    turned = vertices @ pose[:3, :3].T + pose[:3, 3]
    colour = shape.find("material/color")
    rgb = PLAIN
    if colour is not None:
        red, green, blue, _ = urdf.numbers(colour.get("rgba", ""), 4, "color")
        rgb = (red, green, blue)
    return [Surface(turned, normals @ pose[:3, :3].T, faces, rgb, 0.8, 0.4)]


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
