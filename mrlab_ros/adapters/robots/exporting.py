"""Exports a robot as a folder for other programs: a URDF with OBJ and STL files beside it."""

from __future__ import annotations

import copy
import shutil
import xml.etree.ElementTree as ET
from pathlib import Path

import trimesh

from mrlab_ros.adapters.robots import mesh_copies, urdf
from mrlab_ros.adapters.robots.diagnostics import FOLDER_IN_USE
from mrlab_ros.adapters.robots.drawing import colour
from mrlab_ros.adapters.robots.library import RobotLibrary, state_masses
from mrlab_ros.core.base.errors import BadInput


def export(library: RobotLibrary, robot_id: str, end_effector: str | None, folder: Path) -> Path:
    """Write a robot with its end effector into a new folder; return the path of its URDF.

    Visuals become one OBJ for each material, with its colour in the URDF; what collides STL or
    OBJ. Paths are relative to the URDF. Raises BadInput for an unknown id, and for a folder that
    holds something.
    """
    if folder.exists() and (not folder.is_dir() or any(folder.iterdir())):
        raise BadInput(FOLDER_IN_USE(folder=str(folder)))
    root = urdf.parse(library.description(robot_id, end_effector), robot_id)
    state_masses(root)
    meshes = folder / "meshes"
    meshes.mkdir(parents=True, exist_ok=True)
    names: dict[str, str] = {}
    for link in root.iterfind("link"):
        for shape in list(link):
            mesh = shape.find("geometry/mesh")
            if mesh is None:
                continue
            path = library.mesh_path(str(mesh.get("filename")))
            if shape.tag == "collision":
                mesh.set("filename", f"meshes/{_solid(path, meshes, names)}")
            elif shape.tag == "visual":
                at = list(link).index(shape)
                link.remove(shape)
                for k, part in enumerate(_coloured(shape, path, meshes)):
                    link.insert(at + k, part)
    ET.indent(root)
    written = folder / f"{robot_id}.urdf"
    text = ET.tostring(root, encoding="unicode")
    written.write_text(f'<?xml version="1.0"?>\n{text}\n', encoding="utf-8")
    return written


def _solid(path: Path, folder: Path, names: dict[str, str]) -> str:
    """Copy what collides once; return its name in the folder."""
    if str(path) not in names:
        prefix = f"{len(names):02d}"
        if path.suffix.lower() == ".stl" and mesh_copies.readable_by_physics(path):
            names[str(path)] = f"{prefix}_{path.name}"
            shutil.copyfile(path, folder / names[str(path)])
        else:
            names[str(path)] = f"{prefix}_{path.stem}.stl"
            mesh_copies.as_stl(trimesh.load_scene(path).to_mesh(), folder / names[str(path)])
    return names[str(path)]


def _coloured(visual: ET.Element, path: Path, folder: Path) -> list[ET.Element]:
    """Return a <visual> for each material of a mesh file, in place of one for all."""
    scene, found = trimesh.load_scene(path), []
    stated = visual.find("material")
    for k, node in enumerate(sorted(scene.graph.nodes_geometry)):
        pose, name = scene.graph.get(node)
        mesh = scene.geometry[name]
        if not isinstance(mesh, trimesh.Trimesh) or not len(mesh.faces):
            continue
        part = copy.deepcopy(visual)
        shape = part.find("geometry/mesh")
        assert shape is not None
        file = f"{path.parent.parent.name}_{path.stem}_{k}.obj"
        plain = trimesh.Trimesh(mesh.vertices, mesh.faces, process=False).apply_transform(pose)
        (folder / file).write_text(
            trimesh.exchange.obj.export_obj(plain, header=None), encoding="utf-8"
        )
        shape.set("filename", f"meshes/{file}")
        if stated is None:
            rgba = " ".join(f"{value:.4f}" for value in (*colour(mesh), 1.0))
            material = ET.SubElement(part, "material", name=file.removesuffix(".obj"))
            ET.SubElement(material, "color", rgba=rgba)
        found.append(part)
    return found
