"""Exports a robot as a folder for other programs: a URDF with OBJ and STL files beside it.

Robots' URDFs as they are published: links named as their frames, for RViz, Foxglove, MoveIt.
"""

from __future__ import annotations

import copy
import shutil
import xml.etree.ElementTree as ET
from collections.abc import Mapping
from pathlib import Path

import trimesh

from mrlab_ros.adapters.robots import mesh_files, urdf
from mrlab_ros.adapters.robots.diagnostics import FOLDER_IN_USE
from mrlab_ros.adapters.robots.drawing import colour
from mrlab_ros.adapters.robots.library import RobotLibrary, state_masses
from mrlab_ros.core.base.errors import BadInput
from mrlab_ros.core.robots.frames import WORLD, frame_name, joint_name


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
        if path.suffix.lower() == ".stl" and mesh_files.readable_by_physics(path):
            names[str(path)] = f"{prefix}_{path.name}"
            shutil.copyfile(path, folder / names[str(path)])
        else:
            names[str(path)] = f"{prefix}_{path.stem}.stl"
            mesh_files.as_stl(trimesh.load_scene(path).to_mesh(), folder / names[str(path)])
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


DECLARATION = '<?xml version="1.0"?>\n'


def published(text: str, robot: str) -> str:
    """Return a robot's URDF with its links named as their frames; the joints keep their names."""
    root = urdf.parse(text, f"the URDF of {robot}")
    for link in root.iterfind("link"):
        link.set("name", frame_name(robot, link.get("name", "")))
    for path in ("joint/parent", "joint/child", "hose/end"):
        for end in root.iterfind(path):
            end.set("link", frame_name(robot, end.get("link", "")))
    return f"{DECLARATION}{ET.tostring(root, encoding='unicode')}\n"


def together(descriptions: Mapping[str, str]) -> str:
    """Return one URDF of all robots of the lab, so that one display shows them all.

    descriptions: by robot its published URDF. Each base hangs at `world` by a floating joint:
    /tf_static says where it stands. Joints and materials are named by robot, too, since one URDF
    must not name two alike; joints as /joint_states has them.
    """
    lab = ET.Element("robot", name="lab")
    ET.SubElement(lab, "link", name=WORLD)
    for robot, text in descriptions.items():
        root = urdf.parse(text, f"the URDF of {robot}")
        base = urdf.frames(root, f"the URDF of {robot}").root
        stand = ET.SubElement(lab, "joint", name=joint_name(robot, "base"), type="floating")
        ET.SubElement(stand, "parent", link=WORLD)
        ET.SubElement(stand, "child", link=base)
        attributes = (
            *((element, "name") for element in root if element.tag in ("joint", "material")),
            *((element, "joint") for element in root.iterfind("joint/mimic")),
            *((element, "name") for element in root.iterfind("link/visual/material")),
        )
        for element, attribute in attributes:
            named = joint_name if element.tag in ("joint", "mimic") else frame_name
            element.set(attribute, named(robot, element.get(attribute, "")))
        lab.extend(e for e in root if e.tag in ("link", "joint", "material"))
    return f"{DECLARATION}{ET.tostring(lab, encoding='unicode')}\n"
