"""What a page draws of a conversion: kept as a document, or made from the draft when asked for."""

from __future__ import annotations

import tempfile
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import orjson

from mrlab_ros.adapters.store import keys
from mrlab_ros.adapters.store.port import Missing
from mrlab_ros.adapters.trajectories import npz_file
from mrlab_ros.core.base.diagnostic import Diagnostic, from_plain
from mrlab_ros.core.base.errors import BadInput
from mrlab_ros.core.conversion.options import DEFAULT_FRAME_RATE
from mrlab_ros.core.conversion.preview import Preview
from mrlab_ros.core.show import document
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
        return _accepted(shelf, keys.draft(user, note["draft"]), note)
    except (Missing, BadInput, orjson.JSONDecodeError):
        raise NotFound(NO_MOTION()) from None


def _accepted(shelf: Shelf, draft: str, note: dict[str, Any]) -> bytes:
    path = shelf.store.path(draft)
    if path is not None:
        shelf.store.size(draft)
        loaded = npz_file.read(path)
    else:
        with tempfile.NamedTemporaryFile(dir=shelf.work) as file:
            shelf.store.get_file(draft, file)  # type: ignore[arg-type]
            file.flush()
            loaded = npz_file.read(Path(file.name))
    robot = shelf.robots.shown(loaded.robot_model, loaded.end_effector)
    found = [from_plain(fields) for fields in note["diagnostics"]]
    return orjson.dumps(document.motion(loaded, robot, message=note["message"], diagnostics=found))
