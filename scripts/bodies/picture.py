"""Rendered pictures of the library's robots, true to scale, beside a person of 1.8 m."""

from __future__ import annotations

import json
import struct
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import trimesh
from ray_tracer import Camera, Surface, draw

from mrlab_ros.adapters.robots import drawing
from mrlab_ros.adapters.robots.library import RobotLibrary
from mrlab_ros.adapters.robots.packing import packed
from mrlab_ros.adapters.robots.packing.surfaces import srgb
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
    """Return a robot at the joint positions, (J,) rad, at home where None.

    Alone it is what pages draw, without lettering; with an end effector the meshes of its links.
    """
    model = library.model(robot_id)
    if end_effector is None:
        poses = model.chain.links(model.home if positions is None else positions)
        return list(drawn(library.folder / robot_id / "lod" / "near.glb", poses))
    at = None
    if positions is not None:
        at = dict(zip(model.joint_names, map(float, positions), strict=True))
    return [surface(mesh) for mesh in drawing.bodies(library, robot_id, end_effector, at)]


def drawn(file: Path, poses: dict[str, Array]) -> Iterator[Surface]:
    """Yield the surfaces of a packed file (packed.py), one a colour, of the links of `poses`."""
    data = file.read_bytes()
    length = struct.unpack_from("<I", data, 12)[0]
    document, packed_bytes = json.loads(data[20 : 20 + length]), data[28 + length :]
    extras = document["materials"][0]["extras"]
    palette = extras["palette"]
    rows = np.array([each[4] for each in extras.get("drawings", [])] or [0])
    for node in (each for each in document["nodes"] if each["name"] in poses):
        for part in (document["nodes"][number] for number in node.get("children", [])):
            mesh = document["meshes"][part["mesh"]]["primitives"][0]
            views = [
                document["bufferViews"][document["accessors"][number]["bufferView"]]
                for number in (mesh["attributes"]["POSITION"], mesh["indices"])
            ]
            stored, listed = (_unpacked(view, packed_bytes) for view in views)
            vertices = stored.view(packed.VERTEX).ravel()
            faces = listed.view(f"<u{views[1]['extensions'][packed.PACKING]['byteStride']}")
            faces = faces.astype(np.int64).reshape(-1, 3)
            turn, place = poses[node["name"]][:3, :3], poses[node["name"]][:3, 3]
            points = vertices["position"] * part["scale"][0] + part["translation"]
            points, normals = points @ turn.T + place, vertices["normal"] / 127 @ turn.T
            u, v = (vertices["places"] / 65535).T
            own = np.minimum((u * len(palette)).astype(int), len(palette) - 1)
            lettered = v > extras.get("band", 1)
            own[lettered] = rows[_drawing_of(u[lettered], v[lettered], extras)]
            for number in np.unique(own[faces[:, 0]]):
                used, index = np.unique(faces[own[faces[:, 0]] == number], return_inverse=True)
                red, green, blue, roughness, metalness = palette[number]
                colour = srgb(red), srgb(green), srgb(blue)
                corners = index.reshape(-1, 3)
                yield Surface(points[used], normals[used], corners, colour, metalness, roughness)


def _drawing_of(u: Array, v: Array, extras: dict[str, list[list[float]]]) -> Array:
    """Return the numbers of the drawings nearest to places in the picture."""
    left, top, right, bottom, _ = np.array(extras.get("drawings", [[0.0] * 5])).T[:, :, None]
    off = np.maximum(np.maximum(left - u, u - right), np.maximum(top - v, v - bottom))
    return np.asarray(off.argmin(axis=0))


def _unpacked(view: dict[str, Any], data: bytes) -> Array:
    import meshoptimizer  # which has to be compiled, so set-up leaves it out

    stated = view["extensions"][packed.PACKING]
    own = data[stated["byteOffset"] : stated["byteOffset"] + stated["byteLength"]]
    unpack = (
        meshoptimizer.decode_vertex_buffer
        if stated["mode"] == "ATTRIBUTES"
        else meshoptimizer.decode_index_buffer
    )
    found = np.ascontiguousarray(unpack(stated["count"], stated["byteStride"], own))
    return np.frombuffer(found.tobytes()[: stated["count"] * stated["byteStride"]], np.uint8)


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
