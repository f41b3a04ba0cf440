"""Puts the links and meshes of a robot together at joint positions; yourdfpy reads the URDF."""

from __future__ import annotations

import copy
import io
import xml.etree.ElementTree as ET
from collections.abc import Callable, Iterator, Mapping
from pathlib import Path

import numpy as np
import trimesh
import yourdfpy

from mrlab_ros.adapters.robots import diagnostics, urdf
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
