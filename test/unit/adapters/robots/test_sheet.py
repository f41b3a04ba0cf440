"""The sheet that says what the lab understood of a robot."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from PIL import Image
from refusals import refused

from mrlab_ros.adapters.robots import sheet
from mrlab_ros.adapters.robots.diagnostics import SHEET_FORMAT
from mrlab_ros.adapters.robots.importing.robot import import_robot
from mrlab_ros.adapters.robots.library import RobotLibrary
from mrlab_ros.core.base.errors import BadInput

ROBOTS = Path(__file__).resolve().parents[4] / "robots"
LIMIT = '<limit lower="{}" upper="{}" velocity="1" effort="1"/>'


def _link(name: str) -> str:
    return f"""<link name="{name}"><visual><material name="red"><color rgba="0.9 0.1 0.1 1"/>
      </material><geometry><box size="0.1 0.1 0.2"/></geometry></visual></link>"""


def _joint(name: str, kind: str, parent: str, child: str, axis: str, more: str) -> str:
    return f"""<joint name="{name}" type="{kind}"><parent link="{parent}"/><child link="{child}"/>
      <origin xyz="0 0 0.2"/><axis xyz="{axis}"/>{more}</joint>"""


@pytest.fixture
def library(tmp_path: Path) -> RobotLibrary:
    file = tmp_path / "tried.urdf"
    file.write_text("<robot name='tried'>" + "".join([
        *map(_link, ("base", "lift", "upper", "palm", "left", "right")),
        _joint("slide", "prismatic", "base", "lift", "0 0 1", LIMIT.format(0, 0.4)),
        _joint("turn", "continuous", "lift", "upper", "0 1 0", LIMIT.format(0, 0)),
        _joint("bend", "revolute", "upper", "palm", "0 0 -1", LIMIT.format(-0.01, 3)),
        _joint("finger_1", "prismatic", "palm", "left", "0 1 0", LIMIT.format(0, 0.04)),
        _joint("finger_2", "prismatic", "palm", "right", "0 -1 0", LIMIT.format(0, 0.04)
               + '<mimic joint="finger_1" multiplier="2" offset="0.01"/>'),
    ]) + "</robot>")  # fmt: skip
    library = RobotLibrary(ROBOTS, tmp_path / "imported")
    import_robot(file, "tried", library, {})
    return library


def test_it_says_axes_limits_home_and_hand(library: RobotLibrary) -> None:
    made = sheet.of(library, "tried")
    assert made.joints == (
        ("1", "slide", "prismatic", "0 mm", "400 mm", "200 mm", "1000 mm/s"),
        ("2", "turn", "continuous", "endless", "", "0°", "57.3°/s"),
        # Home is the middle where 0 is at the end of the range.
        ("3", "bend", "revolute", "-0.573°", "171.9°", "85.66°", "57.3°/s"),
    )
    assert [row[0] for row in made.fingers] == ["finger_1", "finger_2"]
    assert made.fingers[1][3] == "finger_1 x 2 -0.01"
    assert dict(made.facts)["columns of a motion"] == "3, and one for the hand"
    assert dict(made.facts)["the arm is"] == "the longest chain of driven joints"


def test_axes_are_drawn_where_the_joints_are(library: RobotLibrary) -> None:
    model = library.model("tried")
    (slide, up), (turn, across), (bend, down) = sheet._axes(model.chain, model.home)
    assert np.allclose(up, [0, 0, 1])
    assert np.allclose(slide, [0, 0, 0.4])
    assert np.allclose(across, [0, 1, 0])
    assert np.allclose(turn, [0, 0, 0.6])
    assert np.allclose(down, [0, 0, -1])
    assert np.allclose(bend, [0, 0, 0.8])


@pytest.mark.slow
def test_it_is_a_picture_or_a_page(library: RobotLibrary, tmp_path: Path) -> None:
    sheet.write(library, "tried", tmp_path / "made" / "tried.png")
    with Image.open(tmp_path / "made" / "tried.png") as image:
        pixels = np.asarray(image.convert("RGB"), dtype=int)
    red = (pixels[..., 0] > 2 * pixels[..., 1]) & (pixels[..., 0] > 2 * pixels[..., 2])
    assert red.mean() > 0.01
    sheet.write(library, "tried", tmp_path / "tried.html")
    page = (tmp_path / "tried.html").read_text()
    assert "data:image/png;base64," in page
    assert "finger_1 x 2 -0.01" in page
    assert "<script" not in page
    with refused(SHEET_FORMAT, BadInput, file="tried.pdf"):
        sheet.write(library, "tried", tmp_path / "tried.pdf")
