"""The facts of `mrlab status` as text: tables, and blocks of lines on a narrow terminal."""

from __future__ import annotations

import math
import time
from collections.abc import Iterator, Mapping
from typing import TYPE_CHECKING, Any

from rich import box
from rich.console import Group
from rich.padding import Padding
from rich.table import Table
from rich.text import Text

from mrlab_ros.client.follow import milliseconds
from mrlab_ros.core.runtime.colours import OUTCOME_STYLES, SEVERITY_STYLES, STATE_STYLES
from mrlab_ros.core.runtime.process_states import Phase

if TYPE_CHECKING:
    from rich.console import RenderableType

# Narrower terminals get a block of lines for each row, in columns.
NARROW = 64
# A process that was started again within this time is named, s.
LATELY_S = 600.0
ROBOT_COLUMNS = ("robot", "state", "trajectory", "time", "driven by", "at x, y", "late", "max")
NONE = "-"
ERROR, WARNING = SEVERITY_STYLES["error"], SEVERITY_STYLES["warning"]
PHASE_STYLES = {"running": OUTCOME_STYLES["accepted"], "wrong configuration": ERROR}


def overview(facts: Mapping[str, Any], nodes: Mapping[str, bool], width: int) -> RenderableType:
    """Return the facts for a terminal of `width` columns. nodes: which of the lab's are there."""
    parts: list[RenderableType] = list(_head(facts, nodes))
    for title, columns, rows in _sections(facts):
        if rows or title == "Robots":
            parts += ["", _table(title, columns, rows, width)]
    return Group(*parts)


def _head(facts: Mapping[str, Any], nodes: Mapping[str, bool]) -> Iterator[Text]:
    supervisor = facts["supervisor"]
    kept = f"kept by process {supervisor['pid']}" if supervisor else "not kept by mrlab"
    yield Text(f"Lab on ROS domain {facts['domain']}, {kept}", "bold")
    if absent := [name for name, present in nodes.items() if not present]:
        yield Text(f"Not in the graph: {', '.join(absent)}", ERROR)
    # A restarted process says itself how it ended, and what was lost; one that is not back cannot.
    trouble = dict(facts["trouble"])
    for process in (supervisor or {}).get("processes", ()):
        if line := _died_lately(process):
            name = process["name"]
            if process["phase"] != "running":
                trouble.pop(name, None)
            if name not in trouble or name not in facts["restarted"]:
                yield Text(line, WARNING)
    if web := facts["web"]:
        how = "" if web["answers"] else ", which do not answer"
        yield Text(f"Pages at {web['address']}{how}; open them with: mrlab open")
    for name, said in trouble.items():
        yield Text(f"{name}: {said['message']}", ERROR)
    recorder = facts["recorder"]
    # Why a recording ended by itself is a trouble of the recorder's process, too.
    failed = trouble.get("recorder", {}).get("severity") == "error"
    if (line := recorder_line(recorder)) and not (failed and recorder["state"] == "STOPPED"):
        yield Text(line)
    for robot in facts["robots"]:
        if robot["state"] == "COLLISION_HALT":
            yield Text(
                f"{robot['name']} is halted: {robot['message']}; {_ends_halt(robot)}", ERROR
            )


def _ends_halt(robot: Mapping[str, Any]) -> str:
    if system := robot["system"]:
        return f"mrlab system stop {system} takes its arms back to their first frames"
    return f"mrlab stop {robot['name']} takes the arm back to its first frame"


def _died_lately(process: Mapping[str, Any]) -> str:
    """Return what is said of a process that froze, or ended a short while ago; empty: nothing."""
    name, age = process["name"], time.time() - process["since"]
    down = process["down"]
    if process["phase"] == Phase.RUNNING.value:
        down = min(down, process["since"])  # it froze later, and runs again
    at = time.strftime("%H:%M:%S", time.localtime(down))
    if process["phase"] == Phase.FROZEN.value:
        return f"{name} does not run since {at}: a signal stopped it"
    how = f" ({process['last_exit']})" if process["last_exit"] else ""
    died = f"{name} died at {at}{how}"
    if process["phase"] == Phase.WAITING.value:
        return f"{died}, back in {max(process['restart_in'] - age, 0.0):.1f} s"
    if not process["restarts"] or age > LATELY_S:
        return ""
    return f"{died}; {process['phase']} for {age:.0f} s, restarts: {process['restarts']}"


def recorder_line(recorder: Mapping[str, Any] | None) -> str:
    """Say what the recorder does, or why it ended by itself; nothing while it rests."""
    if recorder is None or recorder["state"] == "STOPPED":
        return str(recorder["message"]) if recorder else ""
    if recorder["state"] == "RECORDING":
        return (
            f"Records into {recorder['bag']}: {recorder['position']:.0f} s, "
            f"{recorder['messages']} messages"
        )
    how = "paused" if recorder["state"] == "PAUSED" else f"x {recorder['rate']:g}"
    return (
        f"Replays {recorder['bag']}: {recorder['position']:.1f} of {recorder['duration']:.1f} s, "
        f"{how}; the lab's own robots stand aside until it ends"
    )


Row = tuple[Text, ...]


def _sections(facts: Mapping[str, Any]) -> Iterator[tuple[str, tuple[str, ...], list[Row]]]:
    yield "Robots", ROBOT_COLUMNS, [_robot_row(robot) for robot in facts["robots"]]
    yield (
        "Systems",
        ("system", "state", "members", "duration", "message"),
        [
            _row(
                s["name"],
                _state(s["state"]),
                ", ".join(s["members"]),
                f"{s['duration']:.2f} s",
                s["message"],
            )
            for s in facts["systems"]
        ],
    )
    yield (
        "Trajectories",
        ("id", "for", "frames", "Hz", "duration"),
        [
            _row(
                t["id"],
                t["robot_model"],
                str(t["frame_count"]),
                f"{t['frame_rate']:g}",
                f"{t['duration']:.2f} s",
            )
            for t in facts["trajectories"]
        ],
    )
    yield (
        "Processes",
        ("process", "state", "id", "for", "restarts", "last end"),
        [_process_row(p) for p in (facts["supervisor"] or {}).get("processes", ())],
    )
    yield (
        "Latency",
        ("observer", "way", "count", "p50", "p95", "max", "clock"),
        [row for report in facts["latency"] for row in _latency_rows(report)],
    )


def _row(*cells: str | Text) -> Row:
    return tuple(Text(cell) if isinstance(cell, str) else cell for cell in cells)


def _state(state: str | None) -> Text:
    return Text(state, STATE_STYLES.get(state, "")) if state else Text("no playback", ERROR)


def _robot_row(robot: Mapping[str, Any]) -> Row:
    position = robot["frame"] * robot["duration"] / max(robot["frame_count"] - 1, 1)
    errors = (robot["deadline_error"], robot["deadline_error_max"])
    return _row(
        robot["name"],
        _state(robot["state"]),
        robot["trajectory"] or NONE,
        f"{position:.2f} of {robot['duration']:.2f} s" if robot["frame_count"] else NONE,
        f"system {robot['system']}" if robot["system"] else NONE,
        "{:g}, {:g}".format(*robot["position"][:2]),
        *(milliseconds(math.nan if error is None else error) for error in errors),
    )


def _process_row(process: Mapping[str, Any]) -> Row:
    return _row(
        process["name"],
        Text(process["phase"], PHASE_STYLES.get(process["phase"], WARNING)),
        str(process["pid"] or NONE),
        f"{time.time() - process['since']:.0f} s",
        str(process["restarts"]),
        process["last_exit"] or NONE,
    )


def _latency_rows(report: Mapping[str, Any]) -> list[Row]:
    """Return a row for each hop of all topics together."""
    error = f"±{milliseconds(report['clock_error'])}" if report["clock_error"] else "same"
    return [
        _row(
            report["observer"],
            f"{hop['from']} to {hop['to']}",
            str(hop["count"]),
            *(milliseconds(hop[level]) for level in ("p50", "p95", "max")),
            error,
        )
        for hop in report["hops"]
        if hop["topic"] is None
    ]


def _table(title: str, columns: tuple[str, ...], rows: list[Row], width: int) -> RenderableType:
    if not rows:
        return Text.assemble((title, "bold"), "  none yet")
    # An empty column is left out.
    kept = [
        index
        for index in range(len(columns))
        if index == 0 or any(row[index].plain not in ("", NONE) for row in rows)
    ]
    if width < NARROW:
        return _blocks(title, columns, rows, kept)
    table = Table(title=title, title_justify="left", title_style="bold", box=box.SIMPLE_HEAD)
    for index in kept:
        table.add_column(columns[index], no_wrap=index == 0, overflow="fold")
    for row in rows:
        table.add_row(*(row[index] for index in kept))
    return table


def _blocks(
    title: str, columns: tuple[str, ...], rows: list[Row], kept: list[int]
) -> RenderableType:
    """Return a line with the first cell of each row, and the others folded below it."""
    lines: list[RenderableType] = [Text(title, "bold")]
    for row in rows:
        cells = [i for i in kept[1:] if row[i].plain not in ("", NONE)]
        named = [
            Text.assemble((f"{columns[i]} ", "dim"), row[i]) if columns[i] != "state" else row[i]
            for i in cells
        ]
        lines.append(Text.assemble("  ", row[0]))
        lines.append(Padding(Text(", ").join(named), (0, 0, 0, 4)))
    return Group(*lines)
