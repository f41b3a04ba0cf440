"""Keeps trajectories as files of trajectory.schema.json in a folder, and checks what it reads."""

from __future__ import annotations

import os
import tempfile
from collections.abc import Iterator
from functools import cache
from pathlib import Path
from typing import Any

import jsonschema
import orjson
from ament_index_python.packages import PackageNotFoundError, get_package_share_directory

from mrlab_ros.core.errors import BadInput
from mrlab_ros.core.trajectory import document as trajectory_document
from mrlab_ros.core.trajectory.channels import ProxyCoefficients
from mrlab_ros.core.trajectory.trajectory import Trajectory

SUFFIX = ".json"
BLOCK = 8192  # frames turned into text at once
# Ends the metadata in what `chunks` writes. Inside a JSON string its quotes would be escaped,
# so it can stand nowhere else.
FRAMES_MARK = b',"frames":{'
NUMPY = orjson.OPT_SERIALIZE_NUMPY


@cache
def schema() -> Any:
    """Return the validator of trajectory.schema.json."""
    try:
        path = Path(get_package_share_directory("mrlab_msgs")) / "trajectory.schema.json"
    except PackageNotFoundError:
        path = Path(__file__).resolve().parents[3] / "msg_schemas" / "trajectory.schema.json"
    return jsonschema.Draft202012Validator(orjson.loads(path.read_bytes()))


def chunks(trajectory: Trajectory) -> Iterator[bytes | memoryview]:
    """Yield the trajectory file piece by piece, so that no whole copy of it is in memory."""
    yield orjson.dumps(trajectory_document.metadata(trajectory))[:-1] + FRAMES_MARK
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

    The schema judges the metadata and the first two frames. The other frames are judged by
    `contract.trajectory` with numpy: walking a million frames in jsonschema takes minutes.
    """
    sample = document
    if isinstance(document, dict) and isinstance(document.get("frames"), dict):
        head = {k: v[:2] if isinstance(v, list) else v for k, v in document["frames"].items()}
        sample = {**document, "frames": head}
    error = jsonschema.exceptions.best_match(schema().iter_errors(sample))
    if error is not None:
        place = "/".join(str(p) for p in error.absolute_path) or "the whole document"
        raise BadInput(
            f"'{name}' is no trajectory file: at {place}, {error.message[:200]}; convert the "
            "workspace again"
        )


def parse(data: bytes, name: str, coefficients: ProxyCoefficients) -> Trajectory:
    """Return the trajectory in the bytes of a file called `name`; raise BadInput."""
    try:
        document = orjson.loads(data)
    except orjson.JSONDecodeError as error:
        raise BadInput(f"'{name}' is no JSON ({error}); convert the workspace again") from None
    check(document, name)
    return trajectory_document.trajectory(document, coefficients)


class TrajectoryStore:
    """Trajectories in one folder, a file each; writing replaces a file as a whole."""

    def __init__(self, folder: Path, coefficients: ProxyCoefficients) -> None:
        self.folder = folder
        self._coefficients = coefficients
        folder.mkdir(parents=True, exist_ok=True)

    def path(self, trajectory_id: str) -> Path:
        """Return where the trajectory lies, or would lie."""
        return self.folder / f"{trajectory_id}{SUFFIX}"

    def _existing(self, trajectory_id: str) -> Path:
        ids = self.ids()
        if trajectory_id not in ids:  # also keeps names such as ../x inside the folder
            known = ", ".join(ids[:10]) or "none"
            raise BadInput(
                f"there is no trajectory '{trajectory_id}'; there are: {known}; convert a file "
                "or take one of these"
            )
        return self.path(trajectory_id)

    def ids(self) -> list[str]:
        """Return the ids of all trajectories, in order."""
        return sorted(p.name.removesuffix(SUFFIX) for p in self.folder.glob(f"*{SUFFIX}"))

    def save(self, trajectory: Trajectory) -> Path:
        """Write the trajectory, replacing one with the same id; readers see the old or the new."""
        descriptor, name = tempfile.mkstemp(dir=self.folder, prefix=".writing-")
        try:
            with os.fdopen(descriptor, "wb", buffering=1 << 20) as file:
                for chunk in chunks(trajectory):
                    file.write(chunk)
            os.chmod(name, 0o644)
            os.replace(name, self.path(trajectory.id))
        except BaseException:
            os.unlink(name)
            raise
        return self.path(trajectory.id)

    def load(self, trajectory_id: str) -> Trajectory:
        """Read a trajectory; raise BadInput where there is none or its file is damaged."""
        path = self._existing(trajectory_id)
        return parse(path.read_bytes(), path.name, self._coefficients)

    def head(self, trajectory_id: str) -> dict[str, Any]:
        """Return the metadata alone, without reading the frames of a file written here."""
        path = self._existing(trajectory_id)
        with path.open("rb") as file:
            start = file.read(1 << 16)
            end = start.find(FRAMES_MARK)
            text = start[:end] + b"}" if end >= 0 else start + file.read()
        try:
            document = orjson.loads(text)
        except orjson.JSONDecodeError as error:
            raise BadInput(f"'{path.name}' is no JSON ({error}); convert it again") from None
        if end >= 0:
            stub: dict[str, Any] = {k: [[0.0]] * 2 for k in ("q", "dq", "tau_proxy")}
            stub["t"] = [0.0, 0.0]
            if document.get("has_gripper"):
                stub["gripper"] = [0, 0]
            document["frames"] = stub
        check(document, path.name)
        del document["frames"]
        return dict(document)

    def delete(self, trajectory_id: str) -> None:
        """Remove a trajectory; raise BadInput where there is none."""
        self._existing(trajectory_id).unlink()
