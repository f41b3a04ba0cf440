"""The drawing of a conversion for a page: kept as a document, or made from the draft on request.

The converter's answer, as it comes over zenoh, in core objects and as fields of JSON.
"""

from __future__ import annotations

import math
import tempfile
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np
import orjson

from mrlab_ros.adapters.store import keys
from mrlab_ros.adapters.store.port import Missing
from mrlab_ros.adapters.trajectories import npz_file
from mrlab_ros.app.show import document
from mrlab_ros.core.base.diagnostic import Diagnostic, Severity, from_plain, of_record, plain
from mrlab_ros.core.base.errors import BadInput
from mrlab_ros.core.conversion.candidates import Preview
from mrlab_ros.core.conversion.options import DEFAULT_FRAME_RATE
from mrlab_ros.core.trajectory.trajectory import Trajectory
from mrlab_ros.gateway.errors import NotFound
from mrlab_ros.gateway.store.shelf import Shelf, finding_fields
from mrlab_ros.gateway.uploads.diagnostics import NO_MOTION


def keep_accepted(
    shelf: Shelf, user: str, draft: str, message: str, diagnostics: Sequence[Diagnostic]
) -> str:
    """Keep what a page says of a draft; return the motion's number."""
    note = {"draft": draft, "message": message, "diagnostics": finding_fields(tuple(diagnostics))}
    shelf.store.put(keys.motion(user, draft), orjson.dumps(note))
    return draft


def keep_preview(
    shelf: Shelf,
    user: str,
    preview: Preview,
    *,
    model: str,
    end_effector: str,
    file: str,
    message: str,
    verdict: str,
    frame_rate: float,
    diagnostics: Sequence[Diagnostic],
) -> str | None:
    """Keep the document of rows that were not taken; None where they are no motion."""
    try:
        robot = shelf.robots.shown(model, end_effector or None)
    except BadInput:
        return None
    made = document.preview_motion(
        preview,
        robot,
        file=file,
        message=message,
        verdict=verdict,
        frame_rate=frame_rate or DEFAULT_FRAME_RATE,
        diagnostics=diagnostics,
    )
    if made is None:
        return None
    number = keys.unique()
    shelf.store.put(keys.motion(user, number), orjson.dumps(made))
    return number


def motion(shelf: Shelf, user: str, number: str) -> bytes:
    """Return the document of a motion; raise NotFound where it is gone, or another's."""
    try:
        text = shelf.store.get(keys.motion(user, number))
        note: dict[str, Any] = orjson.loads(text)
        if "schema" in note:
            return text
        return _accepted(shelf, of_draft(shelf, user, note["draft"]), note)
    except (Missing, BadInput, orjson.JSONDecodeError):
        raise NotFound(NO_MOTION()) from None


def of_draft(shelf: Shelf, user: str, number: str) -> Trajectory:
    """Return the trajectory of a draft of a user's; raise Missing."""
    draft = keys.draft(user, number)
    path = shelf.store.path(draft)
    if path is not None:
        shelf.store.size(draft)
        return npz_file.read(path)
    with tempfile.NamedTemporaryFile(dir=shelf.work) as file:
        shelf.store.get_file(draft, file)  # type: ignore[arg-type]
        file.flush()
        return npz_file.read(Path(file.name))


def _accepted(shelf: Shelf, loaded: Trajectory, note: dict[str, Any]) -> bytes:
    robot = shelf.robots.shown(loaded.robot_model, loaded.end_effector)
    found = [from_plain(fields) for fields in note["diagnostics"]]
    return orjson.dumps(document.motion(loaded, robot, message=note["message"], diagnostics=found))


OUTCOMES = ("rejected", "accepted", "ambiguous")


def diagnostics_of(answer: Any) -> tuple[Diagnostic, ...]:
    """Return the findings of a response of ConvertTrajectory."""
    return tuple(of_record(each) for each in answer.diagnostics)


def preview_of(message: Any) -> Preview | None:
    """Return the rows of a message of Preview; None where it holds none."""
    columns = int(message.columns)
    if not columns or not len(message.rows):
        return None
    values = np.asarray(message.values, dtype=np.float32).reshape(-1, columns)
    return Preview(message.variable, np.asarray(message.rows, dtype=np.uint32), values)


def preview_fields(message: Any) -> dict[str, Any]:
    """Return the fields of answers.Preview."""
    return {
        "variable": message.variable,
        "rows": [int(row) for row in message.rows],
        "columns": int(message.columns),
        "values": [finite(value) for value in message.values],
    }


def candidate_fields(message: Any) -> dict[str, Any]:
    """Return the fields of answers.Candidate."""
    return {
        "variable": message.variable,
        "rows": int(message.rows),
        "columns": int(message.columns),
        "minimum": finite(message.minimum),
        "maximum": finite(message.maximum),
        "score": finite(message.score) or 0.0,
        "reasons": [plain(of_record(each)) for each in message.reasons],
        "preview": preview_fields(message.preview),
    }


def head_of(info: Any) -> dict[str, Any]:
    """Return the metadata of a trajectory from a message of TrajectoryInfo, its warnings left out.

    The findings of the whole answer hold the warnings too.
    """
    return {
        "id": info.id,
        "robot_model": info.robot_model,
        "end_effector": info.end_effector,
        "source": {
            "file": info.source_file,
            "variable": info.source_variable,
            "sha256": info.source_sha256,
        },
        "created_ns": int(info.created.sec) * 1_000_000_000 + int(info.created.nanosec),
        "frame_rate": float(info.frame_rate),
        "frame_count": int(info.frame_count),
        "has_gripper": bool(info.has_gripper),
        "warnings": [],
    }


def finite(value: Any) -> float | None:
    """Return a number, None where it is NaN or infinite."""
    number = float(value)
    return number if math.isfinite(number) else None


def said(answer: Any) -> Diagnostic:
    """Return what a response says; its values stay texts, as the wire has them."""
    values = {each.key: each.value for each in answer.values}
    return Diagnostic(answer.code, Severity.ERROR, answer.message, values=values)
