"""A sheet that says what the lab understood of a robot: a picture with its axes, its figures."""

from __future__ import annotations

import base64
import io
import textwrap
from dataclasses import dataclass
from math import degrees
from pathlib import Path
from typing import Any

from mrlab_ros.adapters.robots import drawing, urdf
from mrlab_ros.adapters.robots.diagnostics import SHEET_FORMAT
from mrlab_ros.adapters.robots.library import TIP, RobotLibrary
from mrlab_ros.core.base.errors import BadInput
from mrlab_ros.core.base.foreign_text import for_html, visible
from mrlab_ros.core.base.geometry import Array
from mrlab_ros.core.robots.model import KinematicChain
from mrlab_ros.core.robots.reach import reach

REACHES = {
    "wrist_centre": "the wrist centre",
    "flange": "the flange",
    "stretched": "the flange, arm stretched",
}
FORMATS = (".png", ".html")
# Colours of the axes in the picture and of their numbers, as joints have them in plots.
COLOURS = ("#00507B", "#B44809", "#007F7F", "#8A39D3", "#E27900", "#2C9ED9", "#173900")
INK, SECOND = "#16202B", "#4A5766"
AXIS = 0.16  # length of an axis in the picture as a share of half of its side
WIDTH = 100  # characters of a note's line in the picture


@dataclass(frozen=True)
class Sheet:
    """The contents of a sheet. facts: (name, value). joints, fingers: rows of their tables."""

    title: str
    facts: tuple[tuple[str, str], ...]
    joints: tuple[tuple[str, ...], ...]
    fingers: tuple[tuple[str, ...], ...]
    notes: tuple[str, ...]


JOINTS = ("", "column of the motion", "kind", "from", "to", "home", "speed")
FINGERS = ("joint of the hand", "open", "closed", "follows")


def of(library: RobotLibrary, robot_id: str) -> Sheet:
    """Return the sheet of a robot of the library; raise BadInput for an unknown id."""
    model, facts = library.model(robot_id), library.facts(robot_id)
    every = urdf.joints(urdf.parse(library.description(robot_id), robot_id), robot_id)
    by_name = {joint.name: joint for joint in every}
    rows = []
    for k, (joint, home) in enumerate(zip(model.joints, model.home, strict=True), start=1):
        kind = by_name[joint.name].kind
        numbers = [_number(v, kind) for v in (joint.lower, joint.upper, float(home))]
        if kind == "continuous":
            numbers[:2] = ["endless", ""]
        speed = f"{_number(joint.max_velocity, kind)}/s"
        rows.append((str(k), joint.name, kind, *numbers, speed))
    hand = library.hand(robot_id)
    fingers = tuple(_finger(joint) for joint in every if joint.name in hand)
    payload = f"{model.payload:g} kg" if model.payload else "not stated: write it into robot.yaml"
    columns = f"{len(model.joints)}, and one for the hand" if fingers else str(len(model.joints))
    # Of an imported robot the flange is the tip that was chosen.
    tip = facts.get("tip_link")
    end = "the tip" if tip else REACHES[facts["reach_definition"]]
    about = [
        ("id", robot_id),
        ("columns of a motion", columns),
        ("base and tip", f"{model.chain.base}, {tip or TIP}"),
        ("reach", f"{reach(model, facts['reach_definition']):.3f} m, to {end}"),
        ("payload", payload),
    ]
    if facts.get("arm"):
        about.insert(3, ("the arm is", str(facts["arm"])))
    notes = tuple(str(note) for note in facts.get("notes", ()))
    title = f"{model.manufacturer} {model.product}".strip()
    return Sheet(title, tuple(about), tuple(rows), fingers, notes)


def checked_format(path: Path) -> None:
    """Raise BadInput for a file that is no sheet."""
    if path.suffix.lower() not in FORMATS:
        raise BadInput(SHEET_FORMAT(file=path.name, formats=[*FORMATS]))


def write(library: RobotLibrary, robot_id: str, path: Path) -> None:
    """Write the sheet of a robot as a picture or a page; raise BadInput for another suffix."""
    checked_format(path)
    sheet = of(library, robot_id)
    path.parent.mkdir(parents=True, exist_ok=True)
    if path.suffix.lower() == ".png":
        _figure(library, robot_id, sheet).savefig(path, dpi=110)
        return
    picture = io.BytesIO()
    _robot(library, robot_id, (7, 7)).savefig(picture, format="png", dpi=110)
    path.write_text(_page(sheet, picture.getvalue()), encoding="utf-8")


def _number(value: float, kind: str) -> str:
    return f"{value * 1e3:.4g} mm" if kind == "prismatic" else f"{degrees(value):.4g}°"


def _finger(joint: urdf.UrdfJoint) -> tuple[str, ...]:
    limit, follows = joint.limit or {}, "driven"
    if joint.mimic is not None:
        follows = f"{joint.mimic.joint} x {joint.mimic.multiplier:.3g}"
        if joint.mimic.offset:
            follows += f" {joint.mimic.offset:+.3g}"
    ends = (_number(limit.get(end, 0.0), joint.kind) for end in ("lower", "upper"))
    return (joint.name, *ends, follows)


def _axes(chain: KinematicChain, home: Array) -> list[tuple[Array, Array]]:
    """Return origin and direction of each moving joint at home, in the frame of the base."""
    found: list[tuple[Array, Array]] = []
    for k, segment in enumerate(chain.segments, start=1):
        if segment.axis is not None:
            # A joint leaves its own axis where it is.
            link = KinematicChain(chain.base, chain.segments[:k]).tool0(home[: len(found) + 1])
            found.append((link[:3, 3], link[:3, :3] @ segment.axis))
    return found


def _draw(axes: Any, library: RobotLibrary, robot_id: str) -> None:
    model = library.model(robot_id)
    axes.computed_zorder = False
    half = drawing.paint(axes, drawing.bodies(library, robot_id))
    for k, (origin, way) in enumerate(_axes(model.chain, model.home)):
        colour, end = COLOURS[k % len(COLOURS)], origin + way * AXIS * half * 1.6
        start = origin - way * AXIS * half
        axes.plot(*zip(start, end, strict=True), color=colour, linewidth=2, zorder=10)
        axes.text(
            *(end + way * AXIS * half * 0.35), str(k + 1), color="white", fontsize=9,
            ha="center", va="center", zorder=11,
            bbox={"boxstyle": "circle,pad=0.25", "facecolor": colour, "edgecolor": "white"},
        )  # fmt: skip


def _robot(library: RobotLibrary, robot_id: str, size: tuple[float, float]) -> Any:
    from mrlab_ros.adapters.plotting import Figure

    figure = Figure(figsize=size)
    axes = figure.add_axes((-0.05, -0.02, 1.05, 1.04), projection="3d", proj_type="persp",
                           focal_length=2)  # fmt: skip
    _draw(axes, library, robot_id)
    return figure


def _figure(library: RobotLibrary, robot_id: str, sheet: Sheet) -> Any:
    from mrlab_ros.adapters.plotting import Figure

    notes = [line for note in sheet.notes for line in textwrap.wrap(note, WIDTH)]
    lines = 5 + len(sheet.facts) + len(sheet.joints) + len(sheet.fingers) + len(notes)
    height = max(7.0, 0.28 * lines + 1)
    figure = Figure(figsize=(15, height))
    axes = figure.add_axes((0.0, 0.0, 0.44, 1.0), projection="3d", proj_type="persp",
                           focal_length=2)  # fmt: skip
    _draw(axes, library, robot_id)
    y, step = 1 - 0.5 / height, 0.28 / height

    def line(cells: tuple[str, ...], places: tuple[float, ...], **look: Any) -> None:
        nonlocal y
        drawn: dict[str, Any] = {"color": INK, "fontsize": 10} | look
        for cell, x in zip(cells, places, strict=True):
            figure.text(x, y, visible(cell), va="center", **drawn)
        y -= step

    line((sheet.title,), (0.46,), fontsize=17, weight="bold")
    y -= step / 2
    for name, value in sheet.facts:
        figure.text(0.46, y, name, va="center", color=SECOND, fontsize=10)
        line((value,), (0.58,))
    head: dict[str, Any] = {"color": SECOND, "fontsize": 9}
    places = (0.46, 0.48, 0.67, 0.745, 0.81, 0.87, 0.93)
    y -= step / 2
    line(JOINTS, places, **head)
    for k, row in enumerate(sheet.joints):
        colour = COLOURS[k % len(COLOURS)]
        figure.text(0.46, y, row[0], va="center", weight="bold", color=colour, fontsize=10)
        line(row[1:], places[1:])
    if sheet.fingers:
        y -= step / 2
        line(FINGERS, (0.48, 0.67, 0.745, 0.81), **head)
        for row in sheet.fingers:
            line(row, (0.48, 0.67, 0.745, 0.81))
    y -= step / 2
    for text in notes:
        line((text,), (0.46,), **head)
    return figure


STYLE = """
body { font: 15px/1.5 system-ui, sans-serif; color: #16202B; background: #F7F8FA;
  margin: 32px auto; max-width: 1180px; padding: 0 24px }
main { display: grid; grid-template-columns: minmax(320px, 5fr) 7fr; gap: 32px;
  align-items: start }
img { width: 100%; border: 1px solid #DCE1E7; border-radius: 10px; background: white }
h1 { font-size: 25px } table { border-collapse: collapse; width: 100%; margin: 0 0 24px }
th { text-align: left; font-weight: 500; color: #4A5766; font-size: 13px }
th, td { padding: 4px 12px 4px 0; border-bottom: 1px solid #DCE1E7; vertical-align: top }
li { color: #4A5766 } b { color: white; border-radius: 10px; padding: 0 7px; font-size: 13px }
@media (max-width: 860px) { main { grid-template-columns: 1fr } }
@media print { body { background: white; margin: 0 } main { break-inside: avoid } }
"""


def _page(sheet: Sheet, picture: bytes) -> str:
    def table(heads: tuple[str, ...], rows: list[list[str]]) -> str:
        head = "".join(f"<th>{for_html(name)}</th>" for name in heads)
        body = "".join("<tr>" + "".join(f"<td>{c}</td>" for c in row) + "</tr>" for row in rows)
        return f"<table><tr>{head}</tr>{body}</table>" if heads else f"<table>{body}</table>"

    def cells(row: tuple[str, ...]) -> list[str]:
        return [for_html(cell) for cell in row]

    joints = []
    for k, row in enumerate(sheet.joints):
        number = f'<b style="background:{COLOURS[k % len(COLOURS)]}">{row[0]}</b>'
        joints.append([number, *cells(row[1:])])
    parts = [table((), [cells(fact) for fact in sheet.facts]), table(JOINTS, joints)]
    if sheet.fingers:
        parts.append(table(FINGERS, [cells(row) for row in sheet.fingers]))
    notes = "".join(f"<li>{for_html(note)}</li>" for note in sheet.notes)
    source = base64.b64encode(picture).decode()
    title = for_html(sheet.title)
    return (
        f'<!doctype html><html lang="en"><meta charset="utf-8"><title>{title}</title>'
        '<meta name="viewport" content="width=device-width">'
        f"<style>{STYLE}</style><h1>{title}</h1><main>"
        f'<img alt="{title} with its numbered axes" src="data:image/png;base64,{source}">'
        f"<div>{''.join(parts)}<ul>{notes}</ul></div></main></html>\n"
    )
