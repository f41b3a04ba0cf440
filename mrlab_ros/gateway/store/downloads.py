"""A trajectory as a file to keep: JSON, MATLAB or CSV."""

from __future__ import annotations

import tempfile
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path
from typing import BinaryIO
from urllib.parse import quote

from fastapi.responses import StreamingResponse
from starlette.background import BackgroundTask

from mrlab_ros.adapters.store.port import StoreFailure
from mrlab_ros.core.trajectory.trajectory import Trajectory
from mrlab_ros.gateway.uploads.diagnostics import NO_ROOM

MEDIA_TYPES = {
    "json": "application/json",
    "mat": "application/x-matlab-data",
    "csv": "text/csv; charset=utf-8",
}
BLOCK = 1 << 18
FOLDER = "download-"


def written(trajectory: Trajectory, name: str, form: str, work: Path) -> tuple[BinaryIO, int]:
    """Return the open file, which has no name any more, and its size, bytes.

    name: what the trajectory is called in it. Raises StoreFailure where there is no room.
    """
    # scipy and rosbags, which the first download can wait for, not the start of the gateway
    from mrlab_ros.adapters.trajectories import formats

    try:
        with tempfile.TemporaryDirectory(dir=work, prefix=FOLDER) as folder:
            path = formats.writer(form)(replace(trajectory, id=name), Path(folder))
            size = path.stat().st_size
            return path.open("rb"), size
    except OSError as error:
        raise StoreFailure(NO_ROOM(file=name, why=str(error.strerror))) from None


def pieces(file: BinaryIO) -> Iterator[bytes]:
    """Yield the bytes of an open file, and close it."""
    with file:
        while piece := file.read(BLOCK):
            yield piece


def sent(opened: BinaryIO, size: int, name: str, form: str) -> StreamingResponse:
    """Return the answer that delivers what `written` returned."""
    headers = {
        "Content-Disposition": f'attachment; filename="{quote(f"{name}.{form}")}"',
        "Content-Length": str(size),
    }
    return StreamingResponse(
        pieces(opened),
        headers=headers,
        media_type=MEDIA_TYPES[form],
        background=BackgroundTask(opened.close),
    )
