"""Reads messages that were written as YAML: what `ros2 topic echo` prints, and goals of actions.

A JointTrajectory is found wherever it stands in a document, as in the goal of an action. Joint
states, one a document, become a motion as those of a bag do. The rest of such a document, and its
comments, stand beside the motion, as in a file of JSON.
"""

from __future__ import annotations

import itertools
import math
import re
from collections.abc import Iterator, Sequence
from types import SimpleNamespace
from typing import Any

from mrlab_ros.adapters.workspaces import joint_trajectories
from mrlab_ros.adapters.workspaces.diagnostics import LIBRARY_FAILED, NO_MESSAGES
from mrlab_ros.adapters.workspaces.matlab.elements import Damaged
from mrlab_ros.adapters.workspaces.matlab.mat5 import LONGEST_TEXT
from mrlab_ros.adapters.workspaces.recorded_states import RecordedStates
from mrlab_ros.adapters.workspaces.sinks import Found, Sink
from mrlab_ros.adapters.workspaces.tables.table import MOST_COMMENTS, add_document, add_members
from mrlab_ros.core.conversion.workspace import COMMENT as COMMENT_KIND

SUFFIXES = (".yaml", ".yml")
# Levels of a document in which a trajectory is looked for.
DEEPEST = 6
COMMENT = re.compile(r"(?:^|\s)#(.*)$", re.M)
# A few bytes of aliases of aliases stand for any number of values.
MOST_VALUES = 20_000_000
# Fields of messages and goals, which say nothing more of the motion.
OWN_FIELDS = ("header", "joint_names", "points", "name", "position", "velocity", "effort")
OF_GOALS = ("path_tolerance", "goal_tolerance", "goal_time_tolerance", "component_path_tolerance")


def read_yaml(data: memoryview, sink: Sink, joints: Sequence[str]) -> None:
    """Hand every JointTrajectory of a file to the sink, and the motion that its joint states are.

    joints: of the robot whose motion is wanted. A mapping or a list without a message is read as
    JSON of the same structure. Raises Damaged where the file is no YAML, holds neither, or where
    a number in a message is none: `ros2 topic echo` shortens long lists.
    """
    documents = _documents(data)
    found = [each for document in documents for each in _trajectories(document, DEEPEST)]
    states = [each for each in documents if _has(each, "name", "position")]
    try:
        if not found and not states:
            # what a program of one's own wrote: as an object or a list of JSON
            whole = documents[0] if len(documents) == 1 else None
            if not (_holds_numbers(whole) and add_document(whole, sink)):
                raise Damaged(NO_MESSAGES())
            _add_comments(data, sink)
            return
        for number, trajectory in enumerate(found, 1):
            path = "trajectory" if len(found) == 1 else f"trajectory({number})"
            joint_trajectories.hand_over(path, _message(trajectory), sink)
        if states:
            recorded = RecordedStates()
            for each in states:
                recorded.add(_state(each), 0)
            recorded.hand_over("joint_states", joints, sink)
        _add_comments(data, sink)
        for document in documents:
            add_members(_beside(document), "", sink, DEEPEST)
    except (TypeError, ValueError, AttributeError) as error:
        raise Damaged(LIBRARY_FAILED(part="message", error=str(error))) from None


def _documents(data: memoryview) -> list[Any]:
    import yaml

    # Written in C where that is there; it reads 1e-1 as a text, which float() takes.
    loader = getattr(yaml, "CSafeLoader", yaml.SafeLoader)
    try:
        found = list(yaml.load_all(bytes(data), Loader=loader))
        if _values(found, {}) > MOST_VALUES:
            raise ValueError("its aliases stand for more than a file can hold")
        return found
    except (yaml.YAMLError, ValueError, RecursionError) as error:
        why = getattr(error, "problem", "") or str(error)
        raise Damaged(LIBRARY_FAILED(part="yaml", error=why)) from None


def _values(document: Any, known: dict[int, float]) -> float:
    """Return how many values a document has where each alias counts as what it stands for.

    known: by id of a list or mapping its values; one that holds itself has infinitely many.
    """
    if not isinstance(document, dict | list):
        return 1
    if id(document) not in known:
        known[id(document)] = math.inf
        inside = document.values() if isinstance(document, dict) else document
        known[id(document)] = 1 + sum(_values(each, known) for each in inside)
    return known[id(document)]


def _holds_numbers(document: Any) -> bool:
    """Say whether two numbers stand behind one another somewhere, or under one key of a list."""
    inside = document.values() if isinstance(document, dict) else document
    if not isinstance(document, dict | list):
        return False
    if isinstance(document, list) and document and isinstance(document[0], dict):
        return any(isinstance(each, int | float) for each in document[0].values())
    numbers = isinstance(document, list) and all(isinstance(n, int | float) for n in document[:2])
    return (numbers and len(document) > 1) or any(map(_holds_numbers, inside))


def _has(document: Any, *keys: str) -> bool:
    return isinstance(document, dict) and all(isinstance(document.get(k), list) for k in keys)


def _trajectories(document: Any, deepest: int) -> Iterator[dict[str, Any]]:
    if _has(document, "joint_names", "points"):
        yield document
    elif isinstance(document, dict | list) and deepest:
        inside = document.values() if isinstance(document, dict) else document
        yield from itertools.chain.from_iterable(_trajectories(i, deepest - 1) for i in inside)


def _beside(document: Any) -> dict[str, Any]:
    """Return what a document holds beside the messages in it."""
    if not isinstance(document, dict):
        return {}
    own = (*OWN_FIELDS, *OF_GOALS)
    kept = {str(key): each for key, each in document.items() if key not in own}
    return {key: _beside(each) if isinstance(each, dict) else each for key, each in kept.items()}


def _add_comments(data: memoryview, sink: Sink) -> None:
    lines = COMMENT.findall(bytes(data).decode(errors="replace"))
    for number, line in enumerate(lines[:MOST_COMMENTS], 1):
        sink.add(Found(f"comment{{{number}}}", COMMENT_KIND, text=line.strip()[:LONGEST_TEXT]))


def _message(document: dict[str, Any]) -> SimpleNamespace:
    points = [
        SimpleNamespace(
            positions=[float(each) for each in point.get("positions") or ()],
            velocities=[float(each) for each in point.get("velocities") or ()],
            time_from_start=_instant(point.get("time_from_start")),
        )
        for point in document["points"]
    ]
    names = [str(name) for name in document["joint_names"]]
    return SimpleNamespace(joint_names=names, points=points)


def _state(document: dict[str, Any]) -> SimpleNamespace:
    header = document.get("header") or {}
    return SimpleNamespace(
        header=SimpleNamespace(stamp=_instant(header.get("stamp"))),
        name=[str(name) for name in document["name"]],
        position=[float(each) for each in document["position"]],
    )


def _instant(document: Any) -> SimpleNamespace:
    """Return an instant or a duration; fields that are left out are 0, as in `ros2 topic pub`."""
    given = document or {}
    sec, nanosec = int(given.get("sec", 0)), int(given.get("nanosec", 0))
    return SimpleNamespace(sec=sec, nanosec=nanosec)
