"""A page about one motion: the document, the robot's meshes and a picture of it."""

from __future__ import annotations

from pathlib import Path

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
) -> str:
    """Return one HTML file that shows what became of a file on a robot.

    share: folder with the built pages. Raises BadInput where there is no motion to show: the file
    was refused before a matrix was found.
    """
    robot = from_library(library, robot_model, end_effector)
    shown = document.of_result(result, robot)
    if shown is None:
        raise BadInput(NOTHING_TO_SHOW(why=result.said))
    first = np.nan_to_num(unpacked(shown["positions"])[0].astype(float))
    names = [joint.name for joint in robot.joints]
    url = poster(library, robot, dict(zip(names, first.tolist(), strict=True)))
    meshes = ingredients.meshes_of([robot.urdf], library.mesh_path)
    return page(
        f"{shown['title']} on {robot_model}",
        still_text.motion(shown),
        shown,
        meshes,
        ingredients.code(share),
        [Picture(url, f"The robot {robot_model} at the first row")],
    )
