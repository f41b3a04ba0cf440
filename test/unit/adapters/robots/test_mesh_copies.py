"""The meshes of a description: what lies beside it comes along, and no other file does."""

from __future__ import annotations

import base64
import json
from pathlib import Path

import numpy as np
import pytest
import trimesh
from PIL import Image

from mrlab_ros.adapters.robots.importing.robot import import_robot
from mrlab_ros.adapters.robots.library import RobotLibrary
from mrlab_ros.core.base.diagnostic import Severity

# Each file is read by a process of its own.
pytestmark = pytest.mark.slow

ROBOTS = Path(__file__).resolve().parents[4] / "robots"
MARKER = b"BEGIN PRIVATE KEY 7f3a"
RED, BLUE, SECRET = (200, 0, 0), (0, 0, 200), (1, 2, 3)

ARM = """<robot name="arm">
  <link name="base">{shapes}</link><link name="tip"/>
  <joint name="one" type="revolute"><parent link="base"/><child link="tip"/>
    <axis xyz="0 0 1"/><limit lower="-1" upper="2" velocity="3" effort="4"/></joint>
</robot>"""
SHAPE = '<{0}><geometry><mesh filename="{1}"/></geometry></{0}>'

OBJ = """mtllib {mtl}
v 0 0 0
v 1 0 0
v 0 1 0
v 0 0 1
vt 0 0
vt 1 0
vt 0 1
usemtl paint
o first of {marker}
f 1/1 2/2 3/3
f 1/1 4/2 2/3
f 1/1 3/2 4/3
f 2/1 4/2 3/3
"""


@pytest.fixture
def library(tmp_path: Path) -> RobotLibrary:
    return RobotLibrary(ROBOTS, tmp_path / "imported")


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    """Return the folder of a description; beside it lies one that is none of its business."""
    outside = tmp_path / "outside"
    outside.mkdir()
    trimesh.creation.box((0.1, 0.2, 0.3)).export(outside / "secret.stl")
    content = bytearray((outside / "secret.stl").read_bytes())
    content[: len(MARKER)] = MARKER
    (outside / "secret.stl").write_bytes(content)
    picture(outside / "secret.png", SECRET)
    (outside / "secret.bin").write_bytes(MARKER * 40)
    folder = tmp_path / "tree" / "robot"
    folder.mkdir(parents=True)
    return folder


def picture(file: Path, colour: tuple[int, int, int]) -> None:
    Image.new("RGB", (4, 4), colour).save(file)


def imported(folder: Path, library: RobotLibrary, *meshes: str, tag: str = "visual") -> set[str]:
    """Import a robot with these meshes; return the codes of its findings."""
    source = folder / "arm.urdf"
    source.write_text(ARM.format(shapes="".join(SHAPE.format(tag, name) for name in meshes)))
    found = import_robot(source, "mine", library, {"arm": folder}).findings
    for file in library.imported.rglob("*"):
        if file.is_file():
            assert MARKER not in file.read_bytes(), file
            assert SECRET not in colours(file), file
    return {one.code for one in found if one.severity > Severity.INFO} - {"robot_no_mass"}


def colours(file: Path) -> set[tuple[int, ...]]:
    """Return the colours of the pictures inside a GLB."""
    if file.suffix != ".glb":
        return set()
    pictures = [
        getattr(mesh.visual, "material", None)
        for mesh in trimesh.load_scene(file).geometry.values()
    ]
    found = [getattr(one, "baseColorTexture", None) for one in pictures]
    return {one.convert("RGB").getpixel((1, 1)) for one in found if one is not None}


def painted(folder: Path, name: str, texture: str) -> str:
    """Write an OBJ that wears a picture; return its name."""
    (folder / f"{name}.obj").write_text(OBJ.format(mtl=f"{name}.mtl", marker="all"))
    (folder / f"{name}.mtl").write_text(f"newmtl paint\nmap_Kd {texture}\n")
    return f"{name}.obj"


def gltf(folder: Path, name: str, *, buffer: str = "", texture: str = "") -> str:
    """Write a glTF that wears a picture; return its name."""
    data = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0]], "<f4").tobytes()
    data += np.array([[0, 0], [1, 0], [0, 1]], "<f4").tobytes()
    inline = "data:application/octet-stream;base64," + base64.b64encode(data).decode()
    views = [
        {"buffer": 0, "byteOffset": 0, "byteLength": 36},
        {"buffer": 0, "byteOffset": 36, "byteLength": 24},
    ]
    kinds = ("VEC3", "VEC2")
    document = {
        "asset": {"version": "2.0"},
        "buffers": [{"uri": buffer or inline, "byteLength": len(data)}],
        "bufferViews": views,
        "accessors": [
            {"bufferView": k, "componentType": 5126, "count": 3, "type": kind}
            for k, kind in enumerate(kinds)
        ],
        "images": [{"uri": texture}],
        "textures": [{"source": 0}],
        "materials": [{"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}}],
        "meshes": [
            {"primitives": [{"attributes": {"POSITION": 0, "TEXCOORD_0": 1}, "material": 0}]}
        ],
        "nodes": [{"mesh": 0}],
        "scenes": [{"nodes": [0]}],
        "scene": 0,
    }
    (folder / f"{name}.gltf").write_text(json.dumps(document))
    return f"{name}.gltf"


def collada(folder: Path, name: str, texture: str, *, head: str = "") -> str:
    """Write a COLLADA file that wears a picture; return its name."""
    text = f"""<?xml version="1.0"?>{head}
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1"><asset/>
<library_images><image id="i" name="i"><init_from>{texture}</init_from></image></library_images>
<library_effects><effect id="e"><profile_COMMON>
<newparam sid="surface"><surface type="2D"><init_from>i</init_from></surface></newparam>
<newparam sid="sampler"><sampler2D><source>surface</source></sampler2D></newparam>
<technique sid="t"><phong><diffuse><texture texture="sampler" texcoord="uv"/></diffuse></phong>
</technique></profile_COMMON></effect></library_effects>
<library_materials><material id="m"><instance_effect url="#e"/></material></library_materials>
<library_geometries><geometry id="g"><mesh>
<source id="p"><float_array id="pa" count="9">0 0 0 1 0 0 0 1 0</float_array><technique_common>
<accessor source="#pa" count="3" stride="3"><param name="X" type="float"/>
<param name="Y" type="float"/><param name="Z" type="float"/></accessor></technique_common></source>
<source id="u"><float_array id="ua" count="6">0 0 1 0 0 1</float_array><technique_common>
<accessor source="#ua" count="3" stride="2"><param name="S" type="float"/>
<param name="T" type="float"/></accessor></technique_common></source>
<vertices id="v"><input semantic="POSITION" source="#p"/></vertices>
<triangles count="1" material="s"><input semantic="VERTEX" source="#v" offset="0"/>
<input semantic="TEXCOORD" source="#u" offset="1" set="0"/><p>0 0 1 1 2 2</p></triangles>
</mesh></geometry></library_geometries>
<library_visual_scenes><visual_scene id="s"><node><instance_geometry url="#g"><bind_material>
<technique_common><instance_material symbol="s" target="#m"/></technique_common></bind_material>
</instance_geometry></node></visual_scene></library_visual_scenes>
<scene><instance_visual_scene url="#s"/></scene></COLLADA>"""
    (folder / f"{name}.dae").write_text(text)
    return f"{name}.dae"


def test_pictures_come_along_inside_the_copies(folder: Path, library: RobotLibrary) -> None:
    (folder / "tex").mkdir()
    picture(folder / "tex" / "it is.png", RED)
    picture(folder / "blue.jpg", BLUE)
    meshes = [
        painted(folder, "a", "-s 1 1 1 tex/it is.png"),
        painted(folder, "b", "blue.jpg"),
        gltf(folder, "c", texture="tex/it%20is.png"),
        collada(folder, "d", "./blue.jpg"),
    ]
    assert imported(folder, library, *meshes) == set()
    copies = sorted((library.imported / "mine" / "meshes").iterdir())
    assert [file.suffix for file in copies] == [".glb"] * 4
    shown = [colours(file) for file in copies]
    assert [len(found) for found in shown] == [1] * 4
    assert [max(range(3), key=found.pop().__getitem__) for found in shown] == [0, 2, 0, 2]


@pytest.mark.parametrize(
    "name",
    [
        "{outside}/secret.stl",
        "file://{outside}/secret.stl",
        "../../outside/secret.stl",
        "sub/../../../outside/secret.stl",
        "package://arm/../../outside/secret.stl",
        "package://../../outside/secret.stl",
        "link.stl",
        "linked/secret.stl",
        "package://linked/secret.stl",
        "package://beside/secret.stl",
        "round.stl",
    ],
)
def test_a_mesh_elsewhere_is_refused(folder: Path, library: RobotLibrary, name: str) -> None:
    outside = folder.parents[1] / "outside"
    (folder / "link.stl").symlink_to(outside / "secret.stl")
    (folder / "linked").symlink_to(outside)
    (folder / "round.stl").symlink_to(folder / "round.stl")
    (folder / "package.xml").write_text("<package><name>arm</name></package>")
    (outside / "package.xml").write_text("<package><name>beside</name></package>")
    (folder.parent / "beside").symlink_to(outside)
    assert imported(folder, library, name.format(outside=outside)) == {"robot_no_mesh"}
    assert "mine" not in library.ids()


@pytest.mark.parametrize("write", [painted, collada, gltf])
def test_pictures_elsewhere_are_left_out(folder: Path, library: RobotLibrary, write) -> None:
    outside = folder.parents[1] / "outside"
    (folder / "link.png").symlink_to(outside / "secret.png")
    textures = (f"{outside}/secret.png", "../../outside/secret.png", "link.png")
    meshes = [
        gltf(folder, f"m{i}", texture=texture)
        if write is gltf
        else write(folder, f"m{i}", texture)
        for i, texture in enumerate(textures)
    ]
    assert imported(folder, library, *meshes) == {"robot_no_texture"}
    assert "mine" in library.ids()


def test_buffers_elsewhere_or_of_another_kind_are_refused(
    folder: Path, library: RobotLibrary
) -> None:
    (folder / "link.bin").symlink_to(folder.parents[1] / "outside" / "secret.bin")
    for file in ("notes.txt", ".hidden"):
        (folder / file).write_bytes(MARKER * 40)
    names = ("../../outside/secret.bin", "notes.txt", "link.bin", ".hidden")
    meshes = [gltf(folder, f"m{i}", buffer=name) for i, name in enumerate(names)]
    assert imported(folder, library, *meshes) == {"robot_mesh_unreadable"}


def test_no_entity_of_a_file_names_another(folder: Path, library: RobotLibrary) -> None:
    secret = folder.parents[1] / "outside" / "secret.bin"
    head = f'<!DOCTYPE COLLADA [<!ENTITY x SYSTEM "file://{secret}">]>'
    codes = imported(folder, library, collada(folder, "a", "&x;", head=head))
    assert codes <= {"robot_no_texture", "robot_mesh_unreadable"}
    source = folder / "arm.urdf"
    source.write_text(head.replace("COLLADA", "robot") + ARM.format(shapes=""))
    with pytest.raises(Exception, match="document type"):
        import_robot(source, "other", library, {})


def test_what_is_no_picture_is_not_copied(folder: Path, library: RobotLibrary) -> None:
    (folder / "key.png").write_bytes(MARKER)
    (folder / "a.obj").write_text(OBJ.format(mtl="key.mtl", marker=MARKER.decode()))
    (folder / "key.mtl").write_text(f"# {MARKER.decode()}\nnewmtl paint\nmap_Kd key.png\n")
    imported(folder, library, "a.obj")
    assert "mine" in library.ids()


def test_what_collides_keeps_its_bodies_and_no_other_line(
    folder: Path, library: RobotLibrary
) -> None:
    (folder / "a.obj").write_text(OBJ.format(mtl="a.mtl", marker=MARKER.decode()))
    assert imported(folder, library, "a.obj", tag="collision") == {"robot_no_texture"}
    (solid,) = (library.imported / "mine" / "meshes").iterdir()
    kinds = [line.split()[0] for line in solid.read_text().splitlines()]
    assert kinds == ["v"] * 4 + ["o"] + ["f"] * 4
    assert trimesh.load_mesh(solid).volume == pytest.approx(-1 / 6)
