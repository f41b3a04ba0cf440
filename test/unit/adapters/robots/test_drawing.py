"""Pictures, pages and glTF files of robots."""

from __future__ import annotations

import os
from pathlib import Path

import numpy as np
import pytest
import trimesh
from PIL import Image
from refusals import refused
from typer.testing import CliRunner

from mrlab_ros.adapters.robots import drawing
from mrlab_ros.adapters.robots.diagnostics import SHEET_FORMAT
from mrlab_ros.adapters.robots.library import RobotLibrary
from mrlab_ros.commands.robots import app
from mrlab_ros.core.base.errors import BadInput

ROBOTS = Path(__file__).resolve().parents[4] / "robots"
LIBRARY = RobotLibrary(ROBOTS, ROBOTS / "none imported")
ORANGE = (1.0, 0.467, 0.125)


def near(picture: Path, colour: tuple[float, float, float]) -> float:
    """Return the share of a picture's pixels whose hue is about that of `colour`, sRGB."""
    with Image.open(picture) as image:
        pixels = np.asarray(image.convert("RGB"), dtype=float).reshape(-1, 3)
    size = np.linalg.norm(pixels, axis=1) * np.linalg.norm(colour)
    return float((pixels @ np.array(colour) > 0.985 * np.maximum(size, 1)).mean())


@pytest.mark.slow
def test_a_picture_shows_the_robot_in_its_colour(tmp_path: Path) -> None:
    robot = drawing.bodies(LIBRARY, "kuka_kr6_r900_sixx")
    drawing.write(robot, tmp_path / "new" / "kr6.png")
    assert 0.03 < near(tmp_path / "new" / "kr6.png", ORANGE) < 0.5


def test_a_page_and_a_gltf_file_hold_the_robot_upright(tmp_path: Path) -> None:
    robot = drawing.bodies(LIBRARY, "ur5e", "vacuum_cup")
    _, high = trimesh.Scene(robot).bounds
    drawing.write(robot, tmp_path / "ur5e.glb")
    made = trimesh.load_scene(tmp_path / "ur5e.glb").bounds
    assert made[1, 1] == pytest.approx(high[2], abs=1e-6)
    assert made[0, 2] == pytest.approx(-high[1], abs=1e-6)
    drawing.write(robot, tmp_path / "ur5e.html")
    page = (tmp_path / "ur5e.html").read_text()
    assert "THREE" in page
    assert "src=" not in page.replace("srcdoc", "").split("<script>")[0]
    with refused(SHEET_FORMAT, BadInput, file="ur5e.gif"):
        drawing.write(robot, tmp_path / "ur5e.gif")


def test_joint_positions_count_and_hulls_are_larger() -> None:
    home = trimesh.Scene(drawing.bodies(LIBRARY, "ur5e")).bounds
    names = LIBRARY.model("ur5e").joint_names
    up = dict.fromkeys(names, 0.0) | {names[1]: -np.pi / 2}
    stretched = trimesh.Scene(drawing.bodies(LIBRARY, "ur5e", positions=up)).bounds
    assert stretched[1, 2] > 0.9 > home[1, 2]
    hulls = trimesh.Scene(drawing.bodies(LIBRARY, "ur5e", collision=True)).bounds
    assert np.abs(hulls - home).max() < 0.021


def test_colours_are_those_of_the_materials() -> None:
    plain = trimesh.creation.box()
    plain.visual.face_colors = (255, 0, 51, 255)
    assert drawing.colour(plain) == pytest.approx((1.0, 0.0, 0.2))
    shiny = trimesh.creation.box()
    # glTF's factors are linear: 0.216 is the middle of sRGB.
    material = trimesh.visual.material.PBRMaterial(baseColorFactor=[0.216, 0.0, 1.0, 1.0])
    shiny.visual = trimesh.visual.TextureVisuals(material=material)
    assert drawing.colour(shiny) == pytest.approx((0.5, 0.0, 1.0), abs=0.01)


def test_show_writes_what_its_options_say(tmp_path: Path) -> None:
    file = tmp_path / "arm.glb"
    arguments = ["show", "ur5e", "--joints", "0,-90,0,0,0,0", "--out", str(file), "--no-open"]
    done = CliRunner().invoke(app, arguments, env=dict(os.environ))
    assert done.exit_code == 0, done.output
    assert done.output.strip() == str(file)
    assert trimesh.load_scene(file).bounds[1, 1] > 0.9
    done = CliRunner().invoke(app, ["show", "ur5e", "--joints", "0,1", "--out", str(file)])
    assert "expected 6 angles in degrees" in str(done.exception)


def test_show_without_out_prints_the_robot_and_writes_nothing(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    done = CliRunner().invoke(app, ["show", "ur5e"], env=dict(os.environ))
    assert done.exit_code == 0, done.output
    assert "Universal Robots UR5e" in done.output
    assert "shoulder_pan_joint" in done.output
    assert "payload 5 kg" in done.output
    assert not list(tmp_path.iterdir())
