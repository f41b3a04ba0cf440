"""Draws a robot: as a picture, as a page in which it can be turned, or as a glTF file.

Puts the links and meshes of a robot together at joint positions; yourdfpy reads the URDF.
"""

from __future__ import annotations

import copy
import io
import math
import xml.etree.ElementTree as ET
from collections.abc import Callable, Iterator, Mapping
from pathlib import Path
from typing import Any

import numpy as np
import trimesh
import yourdfpy

from mrlab_ros.adapters.robots import diagnostics, urdf
from mrlab_ros.adapters.robots.diagnostics import SHEET_FORMAT
from mrlab_ros.adapters.robots.library import RobotLibrary
from mrlab_ros.core.base.errors import BadInput
from mrlab_ros.core.base.geometry import Array

Resolve = Callable[[str], Path]


class Assembly:
    """A URDF with its meshes, which moves.

    root: from urdf.parse; origin: names it in errors; resolve: returns the file of a mesh URI, and
    None leaves the meshes out; collision: the collision geometry instead of what is seen. Raises
    BadInput where a joint, a number, a shape or a mesh file is wrong.
    """

    def __init__(
        self,
        root: ET.Element,
        origin: str,
        resolve: Resolve | None = None,
        *,
        collision: bool = False,
    ) -> None:
        def file_of(fname: str) -> str:
            path = Path(fname) if resolve is None else resolve(fname)
            if not path.is_file():
                raise BadInput(diagnostics.ROBOT_NO_MESH(uri=fname, why=str(path)))
            return str(path)

        try:
            self._model = yourdfpy.URDF.load(
                io.BytesIO(ET.tostring(_with_unit_axes(root, origin))),
                build_scene_graph=not collision,
                build_collision_scene_graph=collision,
                load_meshes=resolve is not None,
                load_collision_meshes=resolve is not None,
                force_collision_mesh=False,
                filename_handler=file_of,
            )
        except BadInput:
            raise
        except Exception as error:  # yourdfpy and the mesh readers have errors of many kinds
            raise BadInput(
                diagnostics.NOT_ASSEMBLED(file=origin, why=f"{type(error).__name__}: {error}")
            ) from error
        model = self._model
        self.scene: trimesh.Scene = model.collision_scene if collision else model.scene
        self._moving = frozenset(model.actuated_joint_names)

    def move(self, positions: Mapping[str, float]) -> None:
        """Move joints, rad or m by name; others stand still, and mimicking ones follow theirs."""
        wanted = {name: float(at) for name, at in positions.items() if name in self._moving}
        self._model.update_cfg(wanted)

    def poses(self) -> dict[str, Array]:
        """Return T_root_link, (4, 4), of every link."""
        return {name: np.asarray(self.scene.graph.get(name)[0]) for name in self._model.link_map}

    def meshes(self) -> Iterator[tuple[str, trimesh.Trimesh, Array]]:
        """Yield the name of the link, the mesh and T_root_mesh, (4, 4), of each mesh or shape."""
        graph = self.scene.graph
        for node in graph.nodes_geometry:
            pose, geometry = graph.get(node)
            mesh = self.scene.geometry[geometry]
            if isinstance(mesh, trimesh.primitives.Primitive):
                shape, mesh = mesh, mesh.to_mesh()
                mesh.visual = shape.visual.copy()  # type: ignore[union-attr]
            if isinstance(mesh, trimesh.Trimesh) and len(mesh.faces):
                yield graph.transforms.parents[node], mesh, np.asarray(pose)


def _with_unit_axes(root: ET.Element, origin: str) -> ET.Element:
    """Return a checked copy with axes of length 1, by which yourdfpy scales sliding joints."""
    joints = urdf.joints(root, origin)
    _check_tree(root, joints, origin)
    result = copy.deepcopy(root)
    for joint, element in zip(joints, result.iterfind("joint"), strict=True):
        axis, unit = element.find("axis"), joint.segment().axis
        if axis is not None and unit is not None:
            axis.set("xyz", " ".join(map(repr, unit.tolist())))
    return result


def _check_tree(root: ET.Element, joints: tuple[urdf.UrdfJoint, ...], origin: str) -> None:
    """Raise BadInput where the joints do not make one tree of the links."""
    links = {str(element.get("name")) for element in root.iterfind("link")}
    parents: dict[str, str] = {}
    for joint in joints:
        if missing := {joint.parent, joint.child} - links:
            lacks = min(missing)
            raise BadInput(diagnostics.ROBOT_NO_LINK(joint=joint.name, link=lacks))
        if joint.child in parents:
            raise BadInput(diagnostics.TWICE_IN_URDF(file=origin, what="child", name=joint.child))
        parents[joint.child] = joint.parent
        urdf.path_to(joint.child, joints)
    roots = sorted(links - set(parents))
    if len(roots) != 1:
        raise BadInput(diagnostics.ROOT_LINKS(file=origin, links=roots))


FORMATS = (".png", ".html", ".glb")
# Unit vectors: the picture is taken from the front right, a little from above; the light comes
# from the left of that.
VIEW = np.array([0.85, -1.0, 0.34]) / np.linalg.norm([0.85, -1.0, 0.34])
LIGHT = np.array([0.35, -0.75, 0.95]) / np.linalg.norm([0.35, -0.75, 0.95])
SHADE = 0.4  # of the colour, where no light falls
# matplotlib draws whole triangles, the furthest first: the longest side of one is at most the
# robot's size divided by this, so that none hides what is in front of it.
PIECES = 70
# Bars in place of bodies: the shortest, m, their radius as a share of the longest, their sides.
LEAST_BAR, THIN, BAR_SIDES = 1e-3, 0.06, 16


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
    instead of what is seen, as of a robot that has nothing to be seen; one that has neither is
    bars from joint to joint. Raises BadInput for an unknown id or a missing mesh.
    """
    model = library.model(robot_id)
    root = urdf.parse(library.description(robot_id, end_effector), robot_id)
    home = dict(zip(model.joint_names, model.home, strict=True))
    for hulls in (True,) if collision else (False, True):
        robot = Assembly(root, robot_id, library.mesh_path, collision=hulls)
        robot.move(home if positions is None else positions)
        parts = [mesh.copy().apply_transform(pose) for _, mesh, pose in robot.meshes()]
        if parts:
            return parts
    return _bars(urdf.joints(root, robot_id), robot.poses())


def _bars(joints: tuple[urdf.UrdfJoint, ...], poses: Mapping[str, Array]) -> list[trimesh.Trimesh]:
    """Return a bar, m, from each joint to the next; one at the root where all are at one place."""
    places = [(poses[joint.parent][:3, 3], poses[joint.child][:3, 3]) for joint in joints]
    ways = [(start, end) for start, end in places if np.linalg.norm(end - start) > LEAST_BAR]
    radius = THIN * max((float(np.linalg.norm(end - start)) for start, end in ways), default=0.1)
    if not ways:
        return [trimesh.creation.icosphere(radius=radius)]
    return [
        trimesh.creation.cylinder(radius, segment=np.array(way), sections=BAR_SIDES)
        for way in ways
    ]


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
