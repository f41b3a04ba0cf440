"""What descriptions say to those that draw robots, and the packed levels of detail they name."""

from __future__ import annotations

import hashlib
import json
import shutil
import struct
import subprocess
import sys
import xml.etree.ElementTree as ET
from pathlib import Path
from typing import Any

import pytest
import yaml
from generated_meshes import SURFACE, TRIANGLES

from mrlab_ros.adapters.assets.files import AssetFiles
from mrlab_ros.adapters.robots import library
from mrlab_ros.adapters.robots.library import RobotLibrary
from mrlab_ros.adapters.robots.publishing import published

ROBOTS = Path(__file__).resolve().parents[4] / "robots"
LIBRARY = RobotLibrary(ROBOTS, ROBOTS / "none")
BODIES = ROBOTS.parent / "scripts" / "bodies"
DETAILS = BODIES / "details"
MODELS = sorted(path.parent for path in ROBOTS.rglob("lod"))
BUDGETS = {"near": (400_000, 40_000), "far": (100_000, 4_000)}  # bytes, triangles
SMALL, FEW = 1.4, 15_000  # m of reach; triangles of what is smaller


def document(path: Path) -> dict[str, Any]:
    """Return the JSON part of a GLB."""
    data = path.read_bytes()
    length = struct.unpack_from("<I", data, 12)[0]
    found: dict[str, Any] = json.loads(data[20 : 20 + length])
    return found


def test_a_description_names_the_packed_levels_of_robot_and_end_effector() -> None:
    root = ET.fromstring(LIBRARY.description("ur5e", "parallel_gripper"))
    levels = [element.attrib for element in root.iterfind("level_of_detail")]
    assert [level["near"] for level in levels] == [
        "package://mrlab_ros/robots/ur5e/lod/near.glb",
        "package://mrlab_ros/robots/end_effectors/parallel_gripper/lod/near.glb",
    ]
    files = AssetFiles(ROBOTS.parent, LIBRARY)
    for level in levels:
        for name in ("near", "far"):
            assert files.find(level[name].removeprefix("package://")) is not None
        assert LIBRARY.mesh_path(level["near"]).is_file()
        assert LIBRARY.mesh_path(level["far"]).is_file()


def test_a_robot_in_imported_meshes_is_drawn_from_these(tmp_path: Path) -> None:
    (tmp_path / "ur5e").mkdir()
    text = '<robot name="ur5e"><link name="base"/></robot>'
    (tmp_path / "ur5e" / "robot.urdf").write_text(text)
    assert RobotLibrary(ROBOTS, tmp_path).description("ur5e") == text


def test_levels_are_named_only_where_both_are(tmp_path: Path) -> None:
    (tmp_path / "lod").mkdir()
    (tmp_path / "lod" / "near.glb").write_bytes(b"")
    assert library.levels(tmp_path, "package://p/r") == []
    (tmp_path / "lod" / "far.glb").write_bytes(b"")
    (level,) = library.levels(tmp_path, "package://p/r")
    assert level.get("near") == "package://p/r/lod/near.glb"


def test_hoses_stand_beside_the_links() -> None:
    end = {"link": "link_1", "xyz": [0.1, 0, 0.2], "direction": [0, 0, 1]}
    facts = {"hoses": [{"radius": 0.02, "length": 1, "ends": [end, {**end, "link": "link_3"}]}]}
    text = library.added('<robot name="r"><link name="link_1"/></robot>\n', library.hoses(facts))
    root = ET.fromstring(text)
    assert root.find("hose").attrib == {"radius": "0.02", "length": "1.0"}  # type: ignore[union-attr]
    assert [one.attrib for one in root.iterfind("hose/end")] == [
        {"link": "link_1", "xyz": "0.1 0.0 0.2", "direction": "0.0 0.0 1.0"},
        {"link": "link_3", "xyz": "0.1 0.0 0.2", "direction": "0.0 0.0 1.0"},
    ]
    assert library.hoses({}) == []
    sent = ET.fromstring(published(text, "kr16_1"))
    ends = [one.get("link") for one in sent.iterfind("hose/end")]
    assert ends == ["kr16_1/link_1", "kr16_1/link_3"]


@pytest.mark.parametrize("folder", MODELS, ids=lambda folder: folder.name)
def test_levels_keep_their_budgets_and_show_the_same_links(folder: Path) -> None:
    links = {path.stem for path in (folder / "meshes").glob("*.glb")}
    made_of = hashlib.sha256()
    for path in sorted((folder / "meshes").glob("*.glb")):
        made_of.update(path.name.encode() + path.read_bytes())
    robot = folder / "robot.yaml"
    reach = yaml.safe_load(robot.read_text())["reach"] if robot.is_file() else 0.0
    for level, (most_bytes, most_triangles) in BUDGETS.items():
        if reach <= SMALL:
            most_triangles = min(most_triangles, FEW)
        file = folder / "lod" / f"{level}.glb"
        assert file.stat().st_size <= most_bytes
        found = document(file)
        accessors = found["accessors"]
        primitives = [p for mesh in found["meshes"] for p in mesh["primitives"]]
        triangles = sum(accessors[p["indices"]]["count"] for p in primitives) // 3
        # scripts/bodies/levels.py makes them anew where meshes change
        extras = found["asset"]["extras"]
        assert extras["made_of"] == made_of.hexdigest()
        table = DETAILS / f"{folder.name}.yaml"
        if table.is_file():
            assert extras["details"] == hashlib.sha256(table.read_bytes()).hexdigest()
        assert len(links) * 12 <= triangles <= most_triangles
        assert len(found["materials"]) == 1
        assert len(primitives) <= max(8, len(links))
        assert set(found["extensionsRequired"]) == {
            "EXT_meshopt_compression",
            "KHR_mesh_quantization",
        }
        roots = [found["nodes"][n] for n in found["scenes"][0]["nodes"]]
        assert {node["name"] for node in roots} == links
        # a link's own frame: it can be put below the frame of a description as it is
        assert not any({"translation", "rotation", "scale", "matrix"} & set(n) for n in roots)


@pytest.mark.slow
def test_the_maker_of_levels_makes_what_is_shipped(tmp_path: Path) -> None:
    robot = "kuka_kr10_r900_2"
    for part in ("robot.yaml", "meshes"):
        copy = shutil.copytree if (ROBOTS / robot / part).is_dir() else shutil.copyfile
        (tmp_path / robot).mkdir(exist_ok=True)
        copy(ROBOTS / robot / part, tmp_path / robot / part)
    command = [sys.executable, BODIES / "levels.py", "--out", tmp_path, robot]
    subprocess.run(command, check=True, capture_output=True, timeout=300)
    for level in BUDGETS:
        made, shipped = (
            document(at / robot / "lod" / f"{level}.glb") for at in (tmp_path, ROBOTS)
        )
        for key in ("asset", "materials"):
            assert made[key] == shipped[key]
        for ours, theirs in zip(_bodies(made), _bodies(shipped), strict=True):
            assert ours["name"] == theirs["name"]
            assert ours["triangles"] == pytest.approx(theirs["triangles"], rel=TRIANGLES)
            assert ours["corners"] == pytest.approx(theirs["corners"], abs=SURFACE * ours["size"])


def _bodies(found: dict[str, Any]) -> list[dict[str, Any]]:
    """Return name, number of triangles and corners, m, of what is drawn on each link."""
    result = []
    for node in found["nodes"]:
        if "mesh" in node:
            (primitive,) = found["meshes"][node["mesh"]]["primitives"]
            places = found["accessors"][primitive["attributes"]["POSITION"]]
            corners = [
                low + scale * value
                for end in ("min", "max")
                for low, scale, value in zip(
                    node["translation"], node["scale"], places[end], strict=True
                )
            ]
            triangles = found["accessors"][primitive["indices"]]["count"] // 3
            size = max(high - low for low, high in zip(corners[:3], corners[3:], strict=True))
            result.append(
                {
                    "name": node["name"],
                    "triangles": triangles,
                    "corners": corners,
                    "size": size,
                }
            )
    return result
