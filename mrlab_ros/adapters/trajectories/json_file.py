"""Writes and reads the trajectory file of trajectory.schema.json: the format for other tools."""

from __future__ import annotations

from collections.abc import Iterator
from functools import cache
from pathlib import Path
from typing import Any

import jsonschema
import orjson
from ament_index_python.packages import PackageNotFoundError, get_package_share_directory

from mrlab_ros.adapters.whole_file import replaced
from mrlab_ros.core.base.errors import BadInput
from mrlab_ros.core.trajectory import document as trajectory_document
from mrlab_ros.core.trajectory.diagnostics import NOT_AS_SCHEMA, NOT_JSON
from mrlab_ros.core.trajectory.trajectory import Trajectory

SUFFIX = ".json"
BLOCK = 8192  # frames turned into text at once
NUMPY = orjson.OPT_SERIALIZE_NUMPY


@cache
def schema() -> Any:
    """Return the validator of trajectory.schema.json."""
    return jsonschema.Draft202012Validator(orjson.loads(_schema_file().read_bytes()))


def _schema_file() -> Path:
    """Return the schema of the messages' package, of an installed wheel, or of the source tree."""
    for package, inside in (("mrlab_msgs", ""), ("mrlab_ros", "msg_schemas")):
        try:
            file = Path(get_package_share_directory(package), inside, "trajectory.schema.json")
        except PackageNotFoundError:
            continue
        if file.is_file():
            return file
    return Path(__file__).resolve().parents[3] / "msg_schemas" / "trajectory.schema.json"


def chunks(trajectory: Trajectory) -> Iterator[bytes | memoryview]:
    """Yield the trajectory file piece by piece, so that no whole copy of it is in memory."""
    yield orjson.dumps(trajectory_document.metadata(trajectory))[:-1] + b',"frames":{'
    columns = list(trajectory_document.frames(trajectory, 0, 2))
    for number, name in enumerate(columns):
        yield (b"," if number else b"") + b'"' + name.encode() + b'":'
        for begin in range(0, trajectory.frame_count, BLOCK):
            block = trajectory_document.frames(trajectory, begin, begin + BLOCK, (name,))[name]
            text = memoryview(orjson.dumps(block, option=NUMPY))
            yield b"," if begin else b"["
            yield text[1:-1]
        yield b"]"
    yield b"}}"


def check(document: Any, name: str) -> None:
    """Pass where `document` agrees with the schema; raise BadInput otherwise.

    The schema checks the metadata and the first two frames. `document.trajectory` checks all
    frames with numpy: jsonschema would take minutes for a million of them.
    """
    sample = document
    if isinstance(document, dict) and isinstance(document.get("frames"), dict):
        head = {k: v[:2] if isinstance(v, list) else v for k, v in document["frames"].items()}
        sample = {**document, "frames": head}
    error = jsonschema.exceptions.best_match(schema().iter_errors(sample))
    if error is not None:
        place = "/".join(str(p) for p in error.absolute_path)
        raise BadInput(NOT_AS_SCHEMA(file=name, place=place, error=f"{error.message:.200}"))


def parse(data: bytes, name: str) -> Trajectory:
    """Return the trajectory in the bytes of a file called `name`; raise BadInput."""
    try:
        document = orjson.loads(data)
    except orjson.JSONDecodeError as error:
        raise BadInput(NOT_JSON(file=name, error=str(error))) from None
    check(document, name)
    return trajectory_document.trajectory(document)


def write(trajectory: Trajectory, path: Path) -> None:
    """Write the trajectory file `path`, replacing it as a whole; an error leaves the old one."""
    with replaced(path) as file:
        file.writelines(chunks(trajectory))
