"""Robots in the meshes of the repository that they come from: found, checked, packed, undone."""

from __future__ import annotations

import json
import struct
import subprocess
import xml.etree.ElementTree as ET
from pathlib import Path

import pytest
import trimesh
from refusals import refused

from mrlab_ros.adapters.robots import checks, exporting, urdf, vendor_levels
from mrlab_ros.adapters.robots.diagnostics import ANOTHER_SHAPE, NO_CLONE, NOT_CLONED
from mrlab_ros.adapters.robots.library import RobotLibrary
from mrlab_ros.adapters.robots.vendor_meshes import dress, remove
from mrlab_ros.adapters.robots.vendor_sources import Clone, Pinned, find_clone, pinned
from mrlab_ros.core.base.errors import BadInput

ROBOTS = Path(__file__).resolve().parents[4] / "robots"
KR3 = "kuka_kr3_r540"
PATH = "kr3_support/urdf/kr3_macro.xacro"


def git(folder: Path, *words: str) -> str:
    command = ["git", "-C", str(folder), "-c", "user.name=n", "-c", "user.email=e@x", *words]
    return subprocess.run(command, check=True, capture_output=True, text=True).stdout.strip()


@pytest.fixture
def library(tmp_path: Path) -> RobotLibrary:
    return RobotLibrary(ROBOTS, tmp_path / "imported")


@pytest.fixture
def vendor(tmp_path: Path, library: RobotLibrary) -> tuple[Path, Pinned]:
    """A folder with a clone of a repository that describes a KR 3 by the lab's own meshes."""
    place = tmp_path / "clones" / "kr3_descriptions"
    package = place / "kr3_support"
    exporting.export(library, KR3, None, tmp_path / "exported")
    root = urdf.parse((tmp_path / "exported" / f"{KR3}.urdf").read_text(), KR3)
    (package / "meshes").mkdir(parents=True)
    for mesh in root.iterfind("link/*/geometry/mesh"):
        name = Path(str(mesh.get("filename"))).name
        file = tmp_path / "exported" / str(mesh.get("filename"))
        (package / "meshes" / name).write_bytes(file.read_bytes())
        mesh.set("filename", f"package://kr3_support/meshes/{name}")
    (package / "urdf").mkdir()
    (package / "urdf" / "kr3.urdf.xacro").write_text(ET.tostring(root, encoding="unicode"))
    (package / "urdf" / "kr3_macro.xacro").write_text("<robot/>")
    (package / "package.xml").write_text("<package><name>kr3_support</name></package>")
    (place / "LICENSE").write_text("Do as you like.")
    (place / "other_support").mkdir()
    (place / "other_support" / "NOTICE").write_text("Of another part.")
    git(place, "init", "-q")
    git(place, "add", ".")
    git(place, "commit", "-q", "-m", "all")
    commit = git(place, "rev-parse", "HEAD")
    return place, Pinned("maker/kr3_descriptions", commit, PATH, "MIT")


def test_a_robot_wears_the_meshes_of_its_source_and_takes_them_off(
    vendor: tuple[Path, Pinned], library: RobotLibrary, tmp_path: Path
) -> None:
    place, source = vendor
    (place / "LICENSE").write_text("Changed since.")
    before = library.description(KR3)
    clone = find_clone(place.parent, source)
    assert clone == Clone(place, source.commit)
    worn = dress(KR3, source, clone, library, tmp_path / "pictures")
    assert checks.errors(worn.findings) == ()
    assert worn.share > 0.98
    assert worn.picture is not None
    assert worn.picture.is_file()
    root = ET.fromstring(library.description(KR3))
    (level,) = root.iterfind("level_of_detail")
    for name in ("near", "far"):
        file = library.mesh_path(str(level.get(name)))
        assert file == library.imported / KR3 / "lod" / f"vendor_{name}.glb"
        assert file.stat().st_size == worn.sizes[name] <= vendor_levels.BYTES[name]
        assert 0 < worn.triangles[name] <= vendor_levels.TRIANGLES[name]
        data = file.read_bytes()
        head = json.loads(data[20 : 20 + struct.unpack_from("<I", data, 12)[0]])
        links = {head["nodes"][n]["name"] for n in head["scenes"][0]["nodes"]}
        assert links == {path.stem for path in (ROBOTS / KR3 / "meshes").glob("*.glb")}
        assert head["asset"]["extras"]["commit"] == source.commit
    folder = library.imported / KR3 / "licence"
    assert (folder / "LICENSE").read_text() == "Do as you like."
    assert worn.notices == ("LICENSE",)
    assert source.commit in (folder / "SOURCE.txt").read_text()
    # hulls, joints and masses are the lab's
    assert library.collision_description(KR3).count("_hull_") == before.count("_hull_")
    remove(KR3, library)
    assert library.description(KR3) == before


def test_another_body_under_the_same_frames_is_refused(
    vendor: tuple[Path, Pinned], library: RobotLibrary, tmp_path: Path
) -> None:
    place, source = vendor
    for file in (place / "kr3_support" / "meshes").glob("*.obj"):
        trimesh.creation.box((0.4, 0.4, 0.4)).export(file)
    worn = dress(KR3, source, Clone(place, ""), library, tmp_path)
    assert [one.code for one in checks.errors(worn.findings)] == [ANOTHER_SHAPE.code]
    assert not (library.imported / KR3).exists()


def test_a_clone_that_is_missing_or_old_is_told_with_the_command_that_mends_it(
    vendor: tuple[Path, Pinned], tmp_path: Path
) -> None:
    place, source = vendor
    with refused(NO_CLONE, BadInput) as error:
        find_clone(tmp_path / "none", source)
    (fix,) = error.value.diagnostic.fixes
    assert fix.command.startswith("git clone https://github.com/maker/kr3_descriptions ")
    other = Pinned(source.repository, "0" * 40, PATH, "MIT")
    with refused(NOT_CLONED, BadInput) as error:
        find_clone(place, other)
    assert "0" * 40 in error.value.diagnostic.fixes[0].command


def test_only_descriptions_of_the_product_itself_are_taken(library: RobotLibrary) -> None:
    named = {robot: pinned(library.facts(robot)) for robot in library.ids()}
    assert [robot for robot, source in named.items() if source is None] == ["kuka_kr150_r2700_2"]
    assert all(source is None or len(source.commit) == 40 for source in named.values())
