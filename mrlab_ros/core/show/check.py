"""A check as a page shows it: a session document of the rehearsal, and what it says in HTML."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from mrlab_ros.core.base.diagnostic import Diagnostic
from mrlab_ros.core.checking.diagnostics import CLAIM
from mrlab_ros.core.checking.hardware import Condition, State
from mrlab_ros.core.checking.motion import MotionFigures
from mrlab_ros.core.checking.recording import Course, Distances, Rehearsed
from mrlab_ros.core.checking.report import CheckReport, RobotReport
from mrlab_ros.core.foreign_text import for_html as escape
from mrlab_ros.core.physics.catalogue import ObjectType
from mrlab_ros.core.physics.engine import Kind, Shape
from mrlab_ros.core.physics.surfaces import Surface
from mrlab_ros.core.rubrics.marking import Marks
from mrlab_ros.core.show.marks_body import marks_body
from mrlab_ros.core.show.motion_body import ICONS
from mrlab_ros.core.show.session import SCHEMA, Track
from mrlab_ros.core.show.svg import HATCH, Array, Mark, Strip, strip_svg, time_axis_svg
from mrlab_ros.core.trajectory.trajectory import Trajectory

# The numbers of shape_msgs/SolidPrimitive.
PRIMITIVES = {Shape.BOX: 1, Shape.SPHERE: 2, Shape.CYLINDER: 3}
HALTED = "COLLISION_HALT"
MOST_DISTANCES, MOST_FINDINGS = 10, 200
SEVERITIES = {"error": "refuses", "warning": "warning", "info": "note"}
# The result classes of a session's runs, for their colours.
CLASSES = {State.OK: "completed", State.NOT: "halted", State.UNKNOWN: "stopped"}
# Which icon of a verdict each state has.
STATE_ICONS = {State.OK: "accepted", State.NOT: "refused", State.UNKNOWN: "ambiguous"}
WORDS = {State.OK: "ok", State.NOT: "not ok", State.UNKNOWN: "not known"}


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
) -> dict[str, Any]:
    """Return what was rehearsed as a session document of web/src/playback/session.ts."""
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
                "base": Track([0.0], [list(robot.base)]).document(),
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
    return Track(course.times, course.values).document()


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


def check_body(
    report: CheckReport,
    digest: str,
    recorded: Rehearsed,
    robots: Sequence[PlayedRobot],
    film: Sequence[tuple[float, str]],
    marks: Marks | None = None,
) -> str:
    """Return the HTML of a check. film: times, s, and pictures at them as data: URLs. marks: by
    a rubric, None where there is none."""
    kind = "refused" if report.refusing else "accepted"
    facts = " · ".join(
        f"{r.model}{f' with {r.end_effector}' if r.end_effector else ''}" for r in report.robots
    )
    shown = report.findings[:MOST_FINDINGS]
    pictures = "".join(
        f'<img src="{url}" alt="The robot at {time:.2f} s" title="{time:.2f} s">'
        for time, url in film
    )
    return "\n".join(
        (
            '<header class="head">',
            f"<h1>{escape(report.title)}</h1>",
            f'<p class="facts">{escape(facts)} · {report.duration or 0:.2f} s</p>',
            f'<p class="verdict {kind}"><svg viewBox="0 0 24 24" aria-hidden="true">'
            f'<path d="{ICONS[kind]}"/></svg><span>{escape(str(report.summary))}</span></p>',
            "</header>",
            f'<main class="{"with" if shown else "without"}-findings">',
            '<section id="view" aria-label="3D view"></section>',
            f'<figure class="poster">{pictures}</figure>' if pictures else "",
            _findings(shown, several=len(report.robots) > 1),
            "" if marks is None else marks_body(marks),
            *(_hardware(robot, several=len(report.robots) > 1) for robot in report.robots),
            _plots(shown, recorded, robots),
            "</main>",
            f'<footer class="foot">{escape(str(CLAIM()))} · <span title="{digest}">report '
            f"{digest[:12]}</span> · made by MR-Lab</footer>",
        )
    )


def _hardware(robot: RobotReport, *, several: bool) -> str:
    rows = "".join(map(_condition, robot.hardware))
    name = f": {escape(robot.name)}" if several else ""
    return (
        f'<section class="runs" aria-label="Ready for hardware"><h2>Ready for hardware{name}</h2>'
        f"<table><tbody>{rows}</tbody></table></section>"
    )


def _condition(one: Condition) -> str:
    return (
        f'<tr><td class="result {CLASSES[one.state]}"><svg viewBox="0 0 24 24" '
        f'aria-hidden="true"><path d="{ICONS[STATE_ICONS[one.state]]}"/></svg>'
        f"<span>{WORDS[one.state]}</span></td>"
        f'<td class="robot">{escape(str(one.condition))}</td>'
        f"<td>{escape(str(one.found))}</td></tr>"
    )


def _findings(findings: Sequence[Diagnostic], *, several: bool) -> str:
    if not findings:
        return ""
    items = []
    for number, one in enumerate(findings, 1):
        severity = one.severity.name.lower()
        where = " · ".join(
            part
            for part in (
                SEVERITIES[severity],
                "" if one.time is None else f"{one.time:.2f} s",
                one.robot if several else "",
                one.link or one.joint,
            )
            if part
        )
        items.append(
            f'<li class="{severity}"><button type="button" data-time="{one.time or 0:.3f}">'
            f'<span class="number" aria-hidden="true">{number}</span>'
            f"<span><b>{escape(where)}</b></span></button><p>{escape(one.message)}</p>"
            f'<p class="remedy">{escape(one.remedy)}</p></li>'
        )
    return (
        '<section class="findings" aria-label="Findings"><h2>Findings</h2>'
        f"<ol>{''.join(items)}</ol></section>"
    )


def _plots(
    findings: Sequence[Diagnostic], recorded: Rehearsed, robots: Sequence[PlayedRobot]
) -> str:
    moving = [r for r in robots if r.trajectory is not None and r.figures is not None]
    groups = [("Distances", _distances(findings, recorded, several=len(moving) > 1))]
    for robot in moving:
        name = f" of {robot.name}" if len(moving) > 1 else ""
        start = recorded.starts.get(robot.name, 0.0)
        groups.append((f"Tool{name}", _tool(findings, robot, start)))
        groups.append((f"Joints{name}", _joints(findings, robot, start)))
    axis = time_axis_svg(recorded.duration)
    parts = []
    for number, (heading, strips) in enumerate(groups):
        rows = "".join(
            f"<div><h3>{escape(strip.name)}</h3>"
            f"{strip_svg(strip, times, recorded.duration)}{axis}</div>"
            for strip, times in strips
        )
        if rows:
            parts.append(
                f"<details{' open' * (number < 2)}><summary><h2>{escape(heading)}</h2></summary>"
                f'{HATCH * (number == 0)}<div class="strips">{rows}</div></details>'
            )
    return f'<section class="plots" aria-label="Plots">{"".join(parts)}</section>'


def _marks(findings: Sequence[Diagnostic], robot: str, *words: str, link: str = "") -> Any:
    """Return the marks of the findings of a robot whose code is one of `words`, or of a link."""
    return tuple(
        Mark(n, f.severity.name.lower(), f.time, f.end if f.end is not None else f.time)
        for n, f in enumerate(findings, 1)
        if f.time is not None
        and f.robot == robot
        and (f.code in words or (link and f.joint == link))
    )


def _distances(
    findings: Sequence[Diagnostic], recorded: Rehearsed, *, several: bool
) -> list[tuple[Strip, Array]]:
    near = [
        (key, series)
        for key, series in recorded.distances.items()
        if (any(series.links) and key[1][0] is not Kind.SURFACE) or _approaches(series)
    ]
    near.sort(key=lambda each: each[1].values[each[1].least()])
    strips = []
    for (robot, (kind, other)), series in near[:MOST_DISTANCES]:
        at = series.least()
        values = np.array(series.values) * 1e3
        values[[not link for link in series.links]] = np.nan
        met = (robot, kind.name.lower(), other)
        who = series.held[at] or series.links[at]
        name = f"{who} to {other} {series.other_links[at]}".strip()
        marks = tuple(
            Mark(n, f.severity.name.lower(), f.time, f.end if f.end is not None else f.time)
            for n, f in enumerate(findings, 1)
            if (f.robot, f.kind, f.other) == met and f.time is not None
        )
        title = f"{robot}: {name}" if several else name
        strip = Strip(title, "mm", values, (0.0, None), marks=marks)
        strips.append((strip, np.array(recorded.times)))
    return strips


def _approaches(series: Distances) -> bool:
    """Return whether a distance changes at all."""
    return any(series.links) and max(series.values) - min(series.values) > 1e-3


def _tool(
    findings: Sequence[Diagnostic], robot: PlayedRobot, start: float
) -> list[tuple[Strip, Array]]:
    figures = robot.figures
    assert figures is not None
    dexterity = figures.dexterity
    return [
        (
            Strip(
                "speed of tool0", "m/s", figures.speeds,
                marks=_marks(findings, robot.name, "misses_point", "point_out_of_order"),
            ),
            figures.times + start,
        ),
        (
            Strip(
                "conditioning (0: singular)", "", dexterity.conditioning, (0.0, None), 2,
                _marks(findings, robot.name, "near_singularity"),
            ),
            dexterity.times + start,
        ),
    ]  # fmt: skip


def _joints(
    findings: Sequence[Diagnostic], robot: PlayedRobot, start: float
) -> list[tuple[Strip, Array]]:
    trajectory, figures = robot.trajectory, robot.figures
    assert trajectory is not None
    assert figures is not None
    strips: list[tuple[Strip, Array]] = []
    for j, one in enumerate(figures.joints):
        limits = (float(np.degrees(one.joint.lower)), float(np.degrees(one.joint.upper)))
        strips.append(
            (
                Strip(
                    one.joint.name, "deg", np.degrees(trajectory.positions[:, j]), limits,
                    j % 7 + 1, _marks(findings, robot.name, link=one.joint.name),
                ),
                figures.times + start,
            )
        )  # fmt: skip
    return strips
