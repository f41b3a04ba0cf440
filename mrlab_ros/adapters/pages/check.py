"""A page about a check: the rehearsal in 3D, a filmstrip, findings on the plots."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from mrlab_ros.adapters.pages import ingredients
from mrlab_ros.adapters.pages.poster import poster
from mrlab_ros.adapters.robots.library import RobotLibrary, from_library
from mrlab_ros.core.checking.rehearsed import Rehearsed
from mrlab_ros.core.checking.report import CheckReport
from mrlab_ros.core.physics.catalogue import ObjectType
from mrlab_ros.core.show import static
from mrlab_ros.core.show.check import PlayedRobot, check_document
from mrlab_ros.core.show.page import page

PREFIX = "package://mrlab_ros/"
FRAMES = 4  # of the filmstrip


def check_page(
    report: CheckReport,
    digest: str,
    recorded: Rehearsed,
    robots: Sequence[PlayedRobot],
    objects: dict[str, ObjectType],
    library: RobotLibrary,
    share: Path,
    marks: Mapping[str, Any] | None = None,
    *,
    with_film: bool = True,
) -> str:
    """Return one HTML file that shows what was rehearsed and what is to be said of it.

    share: folder with the built pages. marks: by a rubric, as JSON has them.
    with_film: draw pictures for where nothing draws in 3D, which takes seconds.
    """
    document = check_document(report, recorded, robots, objects, digest, marks)

    def resolve(uri: str) -> Path:
        return library.mesh_path(uri) if "/robots/" in uri else share / uri.removeprefix(PREFIX)

    meshes = ingredients.meshes_of((robot.urdf for robot in robots), resolve)
    things = {thing["mesh"] for thing in document["objects"] if thing["mesh"]}
    meshes |= ingredients.small(things, resolve)
    film = _film(recorded, robots, library) if with_film else []
    body = static.check(document, film)
    return page(report.title, body, document, meshes, ingredients.code(share))


def _film(
    recorded: Rehearsed, robots: Sequence[PlayedRobot], library: RobotLibrary
) -> list[tuple[float, str]]:
    """Return pictures of a robot along the motion, for where nothing draws in 3D."""
    moving = [robot for robot in robots if robot.trajectory is not None]
    if len(moving) != 1:
        return []
    robot = moving[0]
    shown = from_library(library, robot.model, robot.end_effector or None)
    course = recorded.robots[robot.name]
    film = []
    for k in range(FRAMES):
        at = round(k * (len(course.times) - 1) / (FRAMES - 1))
        positions = dict(zip(robot.joints, course.values[at], strict=True))
        film.append((course.times[at], poster(library, shown, positions)))
    return film
