"""The report page of a check: the rehearsal in 3D, a filmstrip, findings on the plots."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np

from mrlab_ros.adapters.diagnostics import NOTHING_TO_SHOW
from mrlab_ros.adapters.robots.library import RobotLibrary, from_library
from mrlab_ros.adapters.whole_file import write_text
from mrlab_ros.app.check.file import CheckedFile
from mrlab_ros.app.check.stage import Stage
from mrlab_ros.app.show import ingredients, still_text
from mrlab_ros.app.show.packed import packed
from mrlab_ros.app.show.page import Picture, page
from mrlab_ros.app.show.poster import poster
from mrlab_ros.app.show.session import drawn, track_document
from mrlab_ros.core.base.diagnostic import plain
from mrlab_ros.core.base.errors import BadInput
from mrlab_ros.core.base.geometry import Array
from mrlab_ros.core.checking.diagnostics import CLAIM
from mrlab_ros.core.checking.motion import MotionFigures
from mrlab_ros.core.checking.rehearsal_record import Course, Distances, Rehearsed
from mrlab_ros.core.checking.report import CheckReport
from mrlab_ros.core.physics.catalogue import ObjectType
from mrlab_ros.core.physics.engine import Kind, Shape
from mrlab_ros.core.recording.recorded_motion import Track
from mrlab_ros.core.scene.surfaces import Surface
from mrlab_ros.core.trajectory.trajectory import Trajectory

SCHEMA = "mrlab.check.1"
# The numbers of shape_msgs/SolidPrimitive.
PRIMITIVES = {Shape.BOX: 1, Shape.SPHERE: 2, Shape.CYLINDER: 3}
HALTED = "COLLISION_HALT"
MOST_DISTANCES, MOST_FINDINGS = 10, 200
# m; what changes by less stands still.
STILL = 1e-3


@dataclass(frozen=True, eq=False)
class PlayedRobot:
    """A robot as the page draws it. joints: arm first, then fingers. trajectory and figures: None
    for one that stands."""

    name: str
    model: str
    end_effector: str
    urdf: str
    joints: Sequence[str]
    base: Sequence[float]
    trajectory: Trajectory | None = None
    figures: MotionFigures | None = None


def check_document(
    report: CheckReport,
    recorded: Rehearsed,
    robots: Sequence[PlayedRobot],
    objects: Mapping[str, ObjectType],
    digest: str,
    marks: Mapping[str, Any] | None = None,
) -> dict[str, Any]:
    """Return what was rehearsed as a session document of web/src/playback/session.ts.

    digest: of the report. marks: by a rubric, as JSON has them.
    """
    return {
        "schema": SCHEMA,
        "title": report.title,
        "duration": recorded.duration,
        "robots": [
            {
                "name": robot.name,
                "model": robot.model,
                "end_effector": robot.end_effector,
                "urdf": robot.urdf,
                "joints": list(robot.joints),
                "track": _track(recorded.robots[robot.name]),
                "base": track_document(Track([0.0], [list(robot.base)])),
                "states": _states(recorded, robot.name),
                "there": [],
                "collisions": [],
            }
            for robot in robots
            if robot.name in recorded.robots
        ],
        "objects": [
            {
                "name": name,
                **_shape(objects[name]),
                "first": course.times[0],
                "last": course.times[-1],
                "track": _track(course),
                "holders": [list(change) for change in course.holders],
            }
            for name, course in recorded.objects.items()
            if name in objects
        ],
        "surfaces": [_surface(each) for each in recorded.surfaces],
        "events": [],
        "check": {
            "verdict": report.verdict,
            "summary": plain(report.summary),
            "robots": [
                {
                    "name": robot.name,
                    "model": robot.model,
                    "end_effector": robot.end_effector,
                    "hardware": [one.plain() for one in robot.hardware],
                }
                for robot in report.robots
            ],
            "findings": plain(report.findings[:MOST_FINDINGS]),
            "marks": marks,
            "distances": _distances(recorded),
            "motions": [
                _motion(robot, recorded.starts.get(robot.name, 0.0))
                for robot in robots
                if robot.trajectory is not None
            ],
            "claim": plain(CLAIM()),
            "hash": digest,
        },
    }


def _surface(surface: Surface) -> dict[str, Any]:
    """Return a surface of the room, its fields named as those of mrlab_msgs/Surface."""
    pose = surface.pose
    return {
        "name": surface.name,
        "label": surface.label,
        "pose": {
            "position": dict(zip("xyz", pose.position, strict=True)),
            "orientation": dict(zip("xyzw", pose.orientation, strict=True)),
        },
        "vertices": [dict(zip("xyz", v, strict=True)) for v in surface.vertices.tolist()],
        "triangles": surface.triangles.ravel().tolist(),
    }


def _track(course: Course) -> dict[str, Any]:
    return track_document(Track(course.times, course.values))


def _shape(kind: ObjectType) -> dict[str, Any]:
    solid = kind.solid
    primitive: dict[str, Any] = {"type": 0, "dimensions": []}
    if solid is not None:
        # shape_msgs has the height of a cylinder before its radius.
        size = solid.size[::-1] if solid.shape is Shape.CYLINDER else solid.size
        primitive = {"type": PRIMITIVES[solid.shape], "dimensions": list(size)}
    return {
        "mesh": kind.mesh,
        "size": dict(zip("xyz", kind.size, strict=True)),
        "color": dict(zip("rgba", kind.color, strict=True)),
        "primitive": primitive,
    }


def _states(recorded: Rehearsed, robot: str) -> list[list[Any]]:
    """Return a robot's states, halted where it collides: there the lab would have halted it."""
    changes = [(time, label) for time, label in recorded.states.get(robot, [(0.0, "IDLE")])]
    spans = [(c.time, c.end) for c in recorded.of(robot)]
    times = sorted({t for t, _ in changes} | {t for span in spans for t in span if t is not None})
    found: list[list[Any]] = []
    for time in times:
        label = [name for since, name in changes if since <= time] or ["READY"]
        halted = any(b <= time and (e is None or time < e) for b, e in spans)
        found.append([time, HALTED if halted else label[-1]])
    return found


def _distances(recorded: Rehearsed) -> list[dict[str, Any]]:
    """Return the distances to what a robot comes near, m, the least first; NaN: farther."""
    near = [
        (key, series)
        for key, series in recorded.distances.items()
        if (any(series.links) and key[1][0] is not Kind.SURFACE) or _approaches(series)
    ]
    near.sort(key=lambda each: each[1].values[each[1].least()])
    times = np.array(recorded.times)
    found = []
    for (robot, (kind, other)), series in near[:MOST_DISTANCES]:
        at = series.least()
        values = np.array(series.values)
        values[[not link for link in series.links]] = np.nan
        found.append(
            {
                "robot": robot,
                "part": series.held[at] or series.links[at],
                "kind": kind.name.lower(),
                "other": other,
                "other_link": series.other_links[at],
                **_curve(times, values),
            }
        )
    return found


def _approaches(series: Distances) -> bool:
    """Return whether a distance changes at all."""
    return any(series.links) and max(series.values) - min(series.values) > STILL


def _motion(robot: PlayedRobot, start: float) -> dict[str, Any]:
    """Return the curves of a robot's motion; start: when it left its first frame, s."""
    trajectory, figures = robot.trajectory, robot.figures
    assert trajectory is not None
    assert figures is not None
    joints = [figure.joint for figure in figures.joints]
    return {
        "robot": robot.name,
        "joints": [
            {"name": joint.name, "lower": joint.lower, "upper": joint.upper} for joint in joints
        ],
        "positions": _curve(figures.times + start, trajectory.positions),
        "speed": _curve(figures.times + start, figures.speeds),
        "conditioning": _curve(figures.dexterity.times + start, figures.dexterity.conditioning),
    }


def _curve(times: Array, values: Array) -> dict[str, Any]:
    kept = drawn(values.reshape(len(values), -1))
    return {"times": packed(times[kept], "float64"), "values": packed(values[kept], "float32")}


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
    text = still_text.check(document)
    return page(report.title, text, document, meshes, ingredients.code(share), film)


def write_page(
    out: Path,
    found: CheckedFile,
    stage: Stage,
    folder: Path,
    marks: Mapping[str, Any] | None = None,
    *,
    title: str = "",
    with_film: bool = True,
) -> int:
    """Write the page of a file that was rehearsed; return how many characters it has.

    For marks, title, with_film see `page_of`. Raises BadInput where it cannot be written.
    """
    text = page_of(found, stage, folder, marks, title=title, with_film=with_film)
    write_text(out, text)
    return len(text)


def page_of(
    found: CheckedFile,
    stage: Stage,
    folder: Path,
    marks: Mapping[str, Any] | None = None,
    *,
    title: str = "",
    with_film: bool = True,
) -> str:
    """Return the page of a file that was rehearsed.

    marks: by a rubric, as JSON has them. title: empty: the file's name. with_film: see
    `check_page`. Raises BadInput where the file holds no motion.
    """
    if found.played is None:
        raise BadInput(NOTHING_TO_SHOW(why=found.why or found.checked.report.summary))
    motions = {m.robot.name: (m.trajectory, m.figures) for m in found.checked.motions}
    shown = [
        PlayedRobot(
            r.name,
            r.model.id,
            r.end_effector,
            stage.library.description(r.model.id, r.end_effector or None),
            (*r.model.joint_names, *found.played.fingers[r.name]),
            (*r.pose.position, *r.pose.orientation),
            *motions.get(r.name, (None, None)),
        )
        for r in found.robots
    ]
    return check_page(
        replace(found.checked.report, title=title or found.checked.report.title),
        found.checked.document["hash"], found.played.recorded, shown, found.played.objects,
        stage.library, folder, marks, with_film=with_film,
    )  # fmt: skip


def _film(
    recorded: Rehearsed, robots: Sequence[PlayedRobot], library: RobotLibrary
) -> list[Picture]:
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
        url = poster(library, shown, positions)
        film.append(Picture(url, f"The robot at {course.times[at]:.2f} s"))
    return film
