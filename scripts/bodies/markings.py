"""Lettering, labels of axes, type plates and warnings, cut out of the surface of a link.

A marking's faces are those of its casting within its rectangle: it lies on it exactly. They name
its drawing in the atlas.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import drawings
import numpy as np
from cutting import cut
from details import MM, SEARCH, Surface, frame_of, table, unit
from scipy.spatial.transform import Rotation
from solids import Array

from mrlab_ros.adapters.robots.packing.atlas import Drawing
from mrlab_ros.adapters.robots.packing.pieces import Piece, piece_of, rows_of
from mrlab_ros.adapters.robots.packing.surfaces import Faces, Material
from mrlab_ros.core.base.geometry import transform_from_xyz_rpy

GRID = 7  # rays across a marking, each way, that find its plane
TURNED = 0.35  # cosine; faces turned further away carry no marking
PIXELS = {"name": 52, "axis": 88, "plate": 136, "pinch": 48}  # heights in the atlas
WHOLE = 0.9  # of a marking that must lie on its link
AFAR = ("name",)  # kinds that are drawn far off, too


@dataclass(frozen=True, eq=False)
class Marking:
    """A drawing on a link: its middle, right, up and outwards (rows), width and height, m."""

    kind: str
    link: str
    middle: Array
    frame: Array
    width: float
    height: float
    material: str
    drawing: Drawing


def markings(figures: dict[str, Any], links: dict[str, Surface]) -> list[Marking]:
    """Return the markings of a robot's table, on the surfaces of its links.

    Raises ValueError for one that does not lie on one surface of its link.
    """
    home = home_poses(figures)
    result = []
    for entry in table(figures["id"]).get("markings", []):
        link, kind = entry["link"], entry["kind"]
        outwards = unit(entry["from"])
        up = unit(entry["up"]) if "up" in entry else home[link][:3, :3].T @ [0.0, 0.0, 1.0]
        frame = frame_of(outwards, up)
        middle = np.array(entry["at"], float) * MM
        height = entry["height"] * MM
        wide = height * {"plate": 1.6, "name": 3.0}.get(kind, 1.0)
        steps = np.linspace(-0.5, 0.5, GRID)
        across, upward = np.meshgrid(steps * wide, steps * height)
        grid = middle + np.stack([across.ravel(), upward.ravel()], axis=1) @ frame[:2]
        away, normals, owner = links[link].seen(grid, outwards)
        here = np.isfinite(away)
        if here.mean() < 0.5:
            raise ValueError(
                f"{figures['id']}, {kind} on {link} at {entry['at']}: no surface there; state a "
                f"point within {SEARCH / MM:.0f} mm of it"
            )
        middle = middle + np.nanmedian(away) * outwards
        frame = frame_of(unit(normals[here].mean(axis=0)), up)
        material = links[link].materials[int(np.bincount(owner[here]).argmax())]
        picture = _drawn(kind, entry, figures, material, frame, middle)
        finish = drawings.PLATE_FINISH if kind == "plate" else material
        tall, long = picture.shape[:2]
        result.append(
            Marking(
                kind, link, middle, frame, height * long / tall, height, material.name,
                Drawing(picture, finish),
            )
        )  # fmt: skip
    return result


def _drawn(
    kind: str,
    entry: dict[str, Any],
    figures: dict[str, Any],
    ground: Material,
    frame: Array,
    middle: Array,
) -> Array:
    pixels = PIXELS[kind]
    if kind == "name":
        return drawings.name(entry["text"], pixels, ground)
    if kind == "plate":
        return drawings.plate(figures, pixels)
    if kind == "pinch":
        return drawings.pinch(pixels, ground)
    moving = [joint for joint in figures["joints"] if joint["type"] != "fixed"]
    number = entry.get("axis", 1 + [joint["child"] for joint in moving].index(entry["link"]))
    joint = moving[number - 1]
    axle = np.array(joint["axis"], float)
    if joint["parent"] == entry["link"]:
        # a label beside what turns: where that moves to
        pose = transform_from_xyz_rpy(joint["xyz"], joint["rpy"])
        axle, middle = pose[:3, :3] @ axle, middle - pose[:3, 3]
    return drawings.axis(number, sense(axle, middle, frame), pixels, ground)


def sense(axle: Array, middle: Array, frame: Array) -> str:
    """Return the word for the positive sense of an axis through the origin as a label shows it.

    middle: of the label; frame: its right, up and outwards, rows.
    """
    right, up, outwards = frame
    if abs(axle @ outwards) > 0.7:
        return "left" if axle @ outwards > 0 else "right"
    course = np.cross(axle, middle)
    along, upward = course @ right, course @ up
    if abs(along) > abs(upward):
        return "back" if along > 0 else "ahead"
    return "up" if upward > 0 else "down"


def home_poses(figures: dict[str, Any]) -> dict[str, Array]:
    """Return T_base_link of every link at home."""
    joints = figures["joints"]
    poses = {joints[0]["parent"]: np.eye(4)} if joints else {}
    angles = iter(figures.get("home_deg", []))
    for joint in joints:
        pose = transform_from_xyz_rpy(joint["xyz"], joint["rpy"])
        if joint["type"] != "fixed":
            turn = np.radians(next(angles, 0.0)) * np.array(joint["axis"], float)
            pose[:3, :3] = pose[:3, :3] @ Rotation.from_rotvec(turn).as_matrix()
        poses[joint["child"]] = poses[joint["parent"]] @ pose
    return poses


def marked(pieces: Sequence[Piece], own: Sequence[tuple[int, Marking]]) -> list[Piece]:
    """Return the pieces of a link with its markings cut out of them, as pieces of their own.

    own: markings with their numbers in the atlas. Raises ValueError for a marking of which a part
    does not lie on the link.
    """
    result: list[Piece] = []
    for piece in pieces:
        rows, faces = rows_of(piece), piece.mesh.faces
        number = np.full(len(faces), -1)
        for index, marking in own:
            if marking.material == piece.material.name:
                rows, faces, number = _inlaid(rows, faces, number, index, marking)
        result += [
            piece_of(piece.material, rows, faces[number == n], n if n >= 0 else None)
            for n in np.unique(number)
        ]
    places = dict(own)
    for index, marking in own:
        share = _covered([piece for piece in result if piece.drawing == index], marking)
        if share < WHOLE:
            at = ", ".join(f"{value / MM:.0f}" for value in marking.middle)
            raise ValueError(
                f"{marking.kind} on {marking.link} at [{at}]: {share:.0%} of it lies on "
                f"{marking.material}; move it, or draw it smaller"
            )
    return [
        piece if piece.drawing is None else _textured(piece, places[piece.drawing])
        for piece in result
    ]


def _covered(pieces: Sequence[Piece], marking: Marking) -> float:
    """Return the share of a marking's rectangle that pieces fill, seen from the front."""
    area = 0.0
    for piece in pieces:
        corners = ((piece.mesh.vertices - marking.middle) @ marking.frame.T)[piece.mesh.faces, :2]
        a, b, c = corners.transpose(1, 0, 2)
        area += float(np.abs(np.linalg.det(np.stack([b - a, c - a], axis=1))).sum()) / 2
    return area / (marking.width * marking.height)


def _inlaid(
    rows: Array, faces: Faces, number: Array, index: int, marking: Marking
) -> tuple[Array, Faces, Array]:
    outwards = marking.frame[2]

    def local() -> Array:
        result: Array = (rows[:, :3] - marking.middle) @ marking.frame.T
        return result

    def near() -> Array:
        corners = local()[faces]
        half = np.array([marking.width, marking.height]) / 2
        over = (corners[..., :2].max(axis=1) > -half) & (corners[..., :2].min(axis=1) < half)
        deep = np.abs(corners[..., 2].mean(axis=1)) < 0.4 * half.max() + 0.01
        a, b, c = rows[faces, :3].transpose(1, 0, 2)
        normal = np.cross(b - a, c - a)
        turned = normal @ outwards > TURNED * np.linalg.norm(normal, axis=1)
        result: Array = over.all(axis=1) & deep & turned
        return result

    for axis, sign in ((0, 1), (0, -1), (1, 1), (1, -1)):
        edge = (marking.width, marking.height)[axis] / 2
        rows, faces, origin = cut(rows, faces, sign * local()[:, axis] - edge, near())
        number = number[origin]
    middle = local()[faces].mean(axis=1)
    inside = (np.abs(middle[:, :2]) < [marking.width / 2, marking.height / 2]).all(axis=1)
    number = np.where(inside & near(), index, number)
    return rows, faces, number


def _textured(piece: Piece, marking: Marking) -> Piece:
    """Return the piece with the place of each vertex in its drawing, 0 to 1 from the left top."""
    local = (piece.mesh.vertices - marking.middle) @ marking.frame.T
    u = 0.5 + local[:, 0] / marking.width
    v = 0.5 - local[:, 1] / marking.height
    places = np.clip(np.stack([u, v], axis=1), 0, 1)
    return Piece(piece.material, piece.mesh, piece.light, piece.drawing, places)
