"""The report page of a recorded session: SessionDocument of web/src/playback/session.ts.

Times are s from the bag's first message; positions rad or m as float32; poses x, y, z, qx, qy,
qz, qw in the frame world, m.
"""

from __future__ import annotations

from itertools import pairwise
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mrlab_ros.adapters.bags.motion import mesh_files, read_motion
from mrlab_ros.adapters.bags.reader import Bag
from mrlab_ros.adapters.bags.session import read_session
from mrlab_ros.app.show import ingredients, still_text
from mrlab_ros.app.show.packed import packed
from mrlab_ros.app.show.page import page
from mrlab_ros.core.base.geometry import Array
from mrlab_ros.core.recording.recorded_motion import RecordedMotion, Track
from mrlab_ros.core.recording.report import Hop, Series, SessionReport
from mrlab_ros.core.recording.runs import Run

SCHEMA = "mrlab.session.1"
# Of one robot or object; of more samples every k-th is taken.
MOST_SAMPLES = 6000
# Of more runs only the first ones are drawn: a page that opens at once is worth more.
MOST_RUNS, MOST_SERIES = 40, 16
# Of a curve about so many samples are kept, its peaks among them.
CURVE = 600


def track_document(track: Track) -> dict[str, Any]:
    """Return the samples of a track, thinned; a value that stood still between two stays so."""
    if not track.times:
        return {
            "times": packed(np.zeros(0), "float32"),
            "values": packed(np.zeros((0, 0)), "float32"),
        }
    times, values = np.array(track.times), np.array(track.values)
    step = -(-len(times) // MOST_SAMPLES)
    moved = np.ones(len(times), dtype=bool)
    moved[1:-1] = (values[1:-1] != values[:-2]).any(axis=1) | (values[1:-1] != values[2:]).any(
        axis=1
    )
    kept = moved & (np.arange(len(times)) % step == 0)
    kept[0] = kept[-1] = True
    return {
        "times": packed(times[kept], "float32"),
        "values": packed(values[kept], "float32"),
    }


def session(title: str, report: SessionReport, motion: RecordedMotion) -> dict[str, Any]:
    """Return the document of a session: what moved, what is said of it, and its curves."""
    facts = report.facts()
    return {
        "schema": SCHEMA,
        "title": title,
        "duration": report.duration,
        "robots": [
            {
                "name": name,
                "model": robot.model,
                "end_effector": robot.end_effector,
                "urdf": robot.urdf,
                "joints": robot.joints,
                "track": track_document(robot.track),
                "base": track_document(robot.base),
                "states": [[span.start, span.label] for span in _states(report, name)],
                "there": [list(span) for span in robot.there],
                "collisions": _collisions(report, name),
            }
            for name, robot in motion.robots.items()
            if robot.urdf
        ],
        "objects": [
            {
                "name": name,
                **thing.shape,
                "first": thing.first,
                "last": thing.last,
                "track": track_document(thing.track),
                "holders": [list(change) for change in thing.holders],
            }
            for name, thing in motion.objects.items()
        ],
        "surfaces": [],
        "events": facts["events"],
        "report": {
            "start_ns": report.start_ns,
            "summary": facts["summary"],
            "troubles": facts["troubles"],
            "runs": [
                {**told, "curves": _curves(run) if number < MOST_RUNS else None}
                for number, (told, run) in enumerate(zip(facts["runs"], report.runs, strict=True))
            ],
            "robots": facts["robots"],
            "series": _series(report),
        },
    }


def _states(report: SessionReport, name: str) -> list[Any]:
    known = report.robots.get(name)
    return [] if known is None else known.states.spans(report.duration)


def _collisions(report: SessionReport, name: str) -> list[list[Any]]:
    known = report.robots.get(name)
    return [] if known is None else [[each.time, each.link] for each in known.collisions]


def _curves(run: Run) -> dict[str, Any] | None:
    """Return the recorded curves of a run, and of its reference where there is one."""
    course = run.course
    if course is None:
        return None
    columns = (course.joints, course.expected, course.tool, course.expected_tool)
    kept = drawn(np.column_stack([each for each in columns if each is not None]))
    return {"times": packed(course.times[kept], "float64")} | {
        name: None if each is None or np.isnan(each).all() else packed(each[kept], "float32")
        for name, each in zip(
            ("joints", "expected", "tool", "expected_tool"), columns, strict=True
        )
    }


def _series(report: SessionReport) -> list[dict[str, Any]]:
    """Return what was measured of the lab itself, s or rad, by robot; empty: of all topics."""
    found: list[tuple[str, str, Hop | None, Series]] = []
    for robot in report.robots.values():
        found.append((robot.name, "deadline", None, robot.deadline))
        found.append((robot.name, "tracking", None, robot.tracking))
        found += [(robot.name, "latency", hop, series) for hop, series in robot.latency.items()]
    found += [("", "latency", hop, series) for hop, series in report.latency.items()]
    measured = [each for each in found if each[3].values]
    return [
        {
            "robot": robot,
            "quantity": quantity,
            "hop": None if hop is None else hop._asdict(),
            **series.summary(),
            "curve": _curve(series) if number < MOST_SERIES else None,
        }
        for number, (robot, quantity, hop, series) in enumerate(measured)
    ]


def _curve(series: Series) -> dict[str, Any]:
    values = np.array(series.values)
    kept = drawn(values[:, None])
    return {
        "times": packed(np.array(series.times)[kept], "float64"),
        "values": packed(values[kept], "float32"),
    }


def drawn(values: Array) -> NDArray[np.int64]:
    """Return which rows of (N, C) are drawn: all, or of each block the peaks of each column."""
    count, columns = values.shape
    if count <= CURVE:
        return np.arange(count)
    edges = np.linspace(0, count, max(CURVE // (2 * columns), 50) + 1).astype(int)
    low, high = (np.nan_to_num(values, nan=worst) for worst in (np.inf, -np.inf))
    peaks = [
        begin + of[begin:end].argmin(axis=0)
        for begin, end in pairwise(edges.tolist())
        for of in (low, -high)
    ]
    return np.unique(np.concatenate([[0, count - 1], *peaks]))


def session_page(bag: Bag, share: Path, report: SessionReport | None = None) -> str:
    """Return one HTML file that shows what a bag recorded.

    share: folder with the built pages. report: of the bag, where it was read already.
    """
    said = report or read_session(bag)
    motion = read_motion(bag)
    title = bag.path.name
    document = session(title, said, motion)
    with mesh_files(bag, share) as resolve:
        meshes = ingredients.meshes_of((robot["urdf"] for robot in document["robots"]), resolve)
        objects = {thing["mesh"] for thing in document["objects"] if thing["mesh"]}
        meshes |= ingredients.small(objects, resolve)
    text = still_text.session(document)
    return page(title, text, document, meshes, ingredients.code(share))
