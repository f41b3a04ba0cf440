"""Bakes ambient occlusion into vertices: how much of what is around it a point of a link sees."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.spatial.transform import Rotation

from mrlab_ros.adapters.robots.packing.surfaces import Material, Mesh
from mrlab_ros.core.base.geometry import Array, inverse_transform, transform_from_xyz_rpy

RAYS = 64
LIFT = 0.0012  # m, of a ray's start above the surface
DARKEST = 0.12  # of the light that a point in a narrow corner keeps
CONTRAST = 1.5  # exponent: what sees half of the sky is drawn with about a third of its light
CHUNK = 400_000
UNEVEN = 0.07  # between the light in the middle of an edge and the mean of its ends: it is cut
ROUNDS = 3
# Neighbours stand at home and turned by this much to both sides: what is always hidden is dark.
TURNS = (-0.9, 0.0, 0.9)
FLOOR = 4.0  # m, half of its side

Pieces = dict[str, list[tuple[Material, Mesh]]]


class Around:
    """What stands around a link, in the link's frame: one list of triangles (T, 3, 3) a pose.

    reach: m; what is further away keeps off no light.
    """

    def __init__(self, poses: Sequence[Array], reach: float) -> None:
        # Who packs no meshes does without its package.
        from embreex.mesh_construction import TriangleMesh
        from embreex.rtcore_scene import EmbreeScene

        self._reach = reach
        self._scenes = []
        for triangles in poses:
            scene = EmbreeScene()
            TriangleMesh(scene, triangles.astype(np.float32))
            self._scenes.append(scene)

    def light(self, points: Array, normals: Array) -> Array:
        """Return the light that points with unit normals, (N, 3), see: (N,), 1 where all."""
        found = [self._in(scene, points, normals) for scene in self._scenes]
        seen: Array = np.mean(found, axis=0)
        return DARKEST + (1 - DARKEST) * seen**CONTRAST

    def _in(self, scene: Any, points: Array, normals: Array) -> Array:
        seen = np.empty(len(points))
        step = CHUNK // RAYS
        for start in range(0, len(points), step):
            part = slice(start, start + step)
            ways = _hemisphere(normals[part])
            origins = np.repeat(points[part] + LIFT * normals[part], RAYS, axis=0)
            answer = scene.run(
                origins.astype(np.float32), ways.reshape(-1, 3).astype(np.float32), output=True
            )
            far = np.clip(answer["tfar"] / self._reach, 0, 1)
            open_way = np.where(answer["primID"] < 0, 1.0, far)
            seen[part] = open_way.reshape(-1, RAYS).mean(axis=1)
        return seen


def _hemisphere(normals: Array) -> Array:
    """Return RAYS directions a normal, (N, RAYS, 3), evenly by the cosine to it."""
    number = np.arange(RAYS) + 0.5
    across, turn = np.sqrt(number / RAYS), number * np.pi * (3 - np.sqrt(5))
    local = np.column_stack([across * np.cos(turn), across * np.sin(turn), np.sqrt(1 - across**2)])
    helper = np.where(np.abs(normals[:, :1]) < 0.8, [[1.0, 0, 0]], [[0.0, 1, 0]])
    first = np.cross(normals, helper)
    first /= np.maximum(np.linalg.norm(first, axis=1, keepdims=True), 1e-12)
    frame = np.stack([first, np.cross(normals, first), normals], axis=1)
    ways: Array = np.einsum("rk,nkc->nrc", local, frame)
    return ways


def lit(mesh: Mesh, around: Around, shortest: float, most: int) -> tuple[Mesh, Array]:
    """Return the mesh, finer where its light is uneven, and the light at its vertices, (V,).

    shortest: m, of edges that are cut; most: triangles.
    """
    light = around.light(mesh.vertices, mesh.normals)
    for _ in range(ROUNDS):
        # Corners at one place are cut alike, or a gap would open.
        _, place = np.unique(np.round(mesh.vertices, 6), axis=0, return_inverse=True)
        place = place.ravel().astype(np.int64)
        edges = np.concatenate([mesh.faces[:, [i, (i + 1) % 3]] for i in range(3)])
        length = np.linalg.norm(mesh.vertices[edges[:, 0]] - mesh.vertices[edges[:, 1]], axis=1)
        long = edges[length > 2 * shortest]
        if not len(long):
            break
        middle, normal = _between(mesh, long)
        off = np.abs(around.light(middle, normal) - light[long].mean(axis=1))
        key = np.sort(place[long], axis=1)
        pairs, owner = np.unique(key, axis=0, return_inverse=True)
        worst = np.zeros(len(pairs))
        np.maximum.at(worst, owner.ravel(), off)
        room = (most - len(mesh.faces)) // 2
        order = np.argsort(-worst)[: max(room, 0)]
        cut = pairs[order[worst[order] > UNEVEN]]
        if not len(cut):
            break
        finer = _cut(mesh, place, {(int(a), int(b)) for a, b in cut})
        fresh = slice(len(light), None)
        light = np.concatenate([light, around.light(finer.vertices[fresh], finer.normals[fresh])])
        mesh = finer
    return mesh, light


def _between(mesh: Mesh, edges: Array) -> tuple[Array, Array]:
    middle = mesh.vertices[edges].mean(axis=1)
    normal = mesh.normals[edges].sum(axis=1)
    return middle, normal / np.maximum(np.linalg.norm(normal, axis=1, keepdims=True), 1e-12)


def _cut(mesh: Mesh, place: NDArray[np.int64], cut: set[tuple[int, int]]) -> Mesh:
    """Return the mesh with the edges between places cut in half."""
    made: dict[tuple[int, int], int] = {}
    count = len(mesh.vertices)
    faces: list[list[int]] = []
    for face, where in zip(mesh.faces.tolist(), place[mesh.faces].tolist(), strict=True):
        ring: list[int] = []
        fresh: list[int] = []
        for n in range(3):
            ring.append(face[n])
            a, b = where[n], where[(n + 1) % 3]
            if (min(a, b), max(a, b)) in cut:
                one, two = face[n], face[(n + 1) % 3]
                edge = (min(one, two), max(one, two))
                fresh.append(len(ring))
                ring.append(made.setdefault(edge, count + len(made)))
        if len(fresh) == 3:
            a, ab, b, bc, c, ca = ring
            faces += [[a, ab, ca], [ab, b, bc], [ca, bc, c], [ab, bc, ca]]
        elif fresh:
            ring = ring[fresh[0] :] + ring[: fresh[0]]
            faces += [[ring[0], ring[n], ring[n + 1]] for n in range(1, len(ring) - 1)]
        else:
            faces.append(face)
    if not made:
        return mesh
    middle, normal = _between(mesh, np.array(list(made)))
    return Mesh(
        np.concatenate([mesh.vertices, middle]),
        np.array(faces, dtype=np.int64),
        np.concatenate([mesh.normals, normal]),
    )


def surroundings(pieces: Pieces, figures: dict[str, Any], reach: float) -> dict[str, Around]:
    """Return what darkens each link: itself and its neighbours, as they are drawn."""
    radius = float(np.clip(reach / 9, 0.04, 0.25))
    return {link: Around(_surroundings(link, pieces, figures), radius) for link in pieces}


def _surroundings(link: str, pieces: Pieces, figures: dict[str, Any]) -> list[Array]:
    own = triangles_of(pieces[link])
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
                around.append(_moved(triangles_of(pieces[joint["child"]]), pose))
            elif joint["child"] == link and joint["parent"] in pieces:
                around.append(
                    _moved(triangles_of(pieces[joint["parent"]]), inverse_transform(pose))
                )
        poses.append(np.concatenate(around))
    return poses


def triangles_of(pieces: Sequence[tuple[Material, Mesh]]) -> Array:
    """Return the triangles of the pieces of a link, (T, 3, 3) m."""
    return np.concatenate([mesh.vertices[mesh.faces] for _, mesh in pieces])


def _moved(triangles: Array, pose: Array) -> Array:
    result: Array = triangles @ pose[:3, :3].T + pose[:3, 3]
    return result
