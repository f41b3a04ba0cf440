"""A page about one motion: the document, the robot's meshes and a picture of it."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np

from mrlab_ros.adapters.diagnostics import NOTHING_TO_SHOW
from mrlab_ros.adapters.robots.library import RobotLibrary, from_library
from mrlab_ros.app.show import document, ingredients, still_text
from mrlab_ros.app.show.packed import unpacked
from mrlab_ros.app.show.page import Picture, page
from mrlab_ros.app.show.poster import poster
from mrlab_ros.core.base.errors import BadInput
from mrlab_ros.core.conversion.convert import ConversionResult


def motion_page(
    result: ConversionResult,
    robot_model: str,
    end_effector: str | None,
    library: RobotLibrary,
    share: Path,
    marks: Mapping[str, Any] | None = None,
    *,
    title: str = "",
    pictured: bool = True,
) -> str:
    """Return one HTML file that shows what became of a file on a robot.

    share: folder with the built pages. marks: by a rubric, as JSON has them: nobody chooses any
    more. title: empty: the file's name. pictured: draw a picture for where nothing draws in 3D,
    which takes a second. Raises BadInput where there is no motion to show: the file was refused
    before a matrix was found.
    """
    robot = from_library(library, robot_model, end_effector)
    shown = document.of_result(result, robot)
    if shown is None:
        raise BadInput(NOTHING_TO_SHOW(why=result.said))
    if marks is not None and result.trajectory is None:
        shown |= {"marks": marks, "verdict": "refused"}
    shown["title"] = title or shown["title"]
    pictures = []
    if pictured:
        row, positions = _pictured(shown)
        names = [joint.name for joint in robot.joints]
        url = poster(library, robot, dict(zip(names, positions, strict=True)))
        pictures = [Picture(url, f"The robot {robot_model} at row {row}")]
    meshes = ingredients.meshes_of([robot.urdf], library.mesh_path)
    return page(
        f"{shown['title']} on {robot_model}",
        still_text.motion(shown),
        shown,
        meshes,
        ingredients.code(share),
        pictures,
    )


def _pictured(shown: Mapping[str, Any]) -> tuple[int, list[float]]:
    """Return the row, from 1, that the picture is of, and its positions, rad or m.

    It is that of the first error, else the first one.
    """
    wrong = (f["first_row"] for f in shown["findings"] if f["severity"] == "error")
    row = next((row for row in wrong if row > 0), 1)
    positions = unpacked(shown["positions"])
    rows = np.arange(1, len(positions) + 1) if shown["rows"] is None else unpacked(shown["rows"])
    frame = int(np.abs(rows.astype(np.int64) - row).argmin())
    return int(rows[frame]), np.nan_to_num(positions[frame].astype(float)).tolist()
