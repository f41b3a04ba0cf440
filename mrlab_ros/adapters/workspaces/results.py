"""A conversion in the sandbox: what is asked, and the small document that comes back.

The document is JSON and not a pickle: it comes from a process that touched a file from outside.
"""

from __future__ import annotations

import base64
import contextlib
import json
import traceback
from collections.abc import Callable
from dataclasses import dataclass, fields, is_dataclass, replace
from enum import Enum
from typing import Any, BinaryIO

import numpy as np

from mrlab_ros.adapters.trajectories import npz_file
from mrlab_ros.adapters.workspaces.diagnostics import (
    CONVERTER_FAILED,
    LAB_FAILED,
    NO_ROOM,
    TOO_LARGE,
)
from mrlab_ros.core.base.diagnostic import Diagnostic, from_plain, plain
from mrlab_ros.core.base.errors import BadInput
from mrlab_ros.core.base.machine import lack
from mrlab_ros.core.conversion.candidates import Candidate, Preview
from mrlab_ros.core.conversion.convert import ConversionResult, Outcome, convert
from mrlab_ros.core.conversion.options import MOST_ROWS, Options
from mrlab_ros.core.conversion.workspace import Workspace
from mrlab_ros.core.robots.model import RobotModel
from mrlab_ros.core.trajectory.derived_signals import ProxyCoefficients
from mrlab_ros.core.trajectory.document import metadata

# Types that a document may hold beside plain values.
RECORDS: dict[str, type[Any]] = {
    kind.__name__: kind for kind in (ConversionResult, Candidate, Preview)
}


@dataclass(frozen=True)
class Task:
    """A request to `convert`, beside the file.

    file: its name. read_as: the name whose ending says what it is, where that is another one.
    """

    file: str
    options: Options
    robot: RobotModel
    coefficients: ProxyCoefficients
    end_effector: str | None
    trajectory_id: str
    created_ns: int
    default_frame_rate: float
    read_as: str = ""


@dataclass(frozen=True)
class Converted:
    """The outcome for a file, without its frames.

    result: as `convert` returns it, but its trajectory is None. said: what a person is told first.
    head: the metadata of the trajectory where the file was accepted, else None.
    """

    result: ConversionResult
    said: Diagnostic
    head: dict[str, Any] | None = None


def run(
    task: Task,
    read: Callable[[], Workspace],
    memory: int,
    trajectory: BinaryIO,
    most_rows: int = MOST_ROWS,
) -> bytes:
    """Convert, write an accepted trajectory into its file, and return the document.

    memory: bytes that this process may use, said where they are not enough. most_rows: a matrix
    with more samples is refused.
    """
    try:
        result = converted(task, read, memory, most_rows)
        if result.trajectory is not None:
            npz_file.write(result.trajectory, trajectory)
            trajectory.flush()
    except BadInput as error:
        return json.dumps({"bad_input": plain(error)}).encode()
    except OSError as error:
        # what did not fit is not written again when the file is closed
        with contextlib.suppress(OSError):
            trajectory.close()
        return json.dumps({"bad_input": plain(failed_here(task.file, error))}).encode()
    except MemoryError:
        result = _too_large(task, memory)
    head = metadata(result.trajectory) if result.trajectory is not None else None
    small = replace(result, trajectory=None)
    document = {"result": _plain(small), "said": plain(result.said), "head": head}
    return json.dumps(document).encode()


def converted(
    task: Task, read: Callable[[], Workspace], memory: int, most_rows: int = MOST_ROWS
) -> ConversionResult:
    """Return what became of a file, whatever it does to the converter; raise BadInput for a task
    that is wrong. memory, most_rows: as for `run`."""
    try:
        return convert(
            task.file,
            read,
            task.options,
            task.robot,
            task.coefficients,
            end_effector=task.end_effector,
            trajectory_id=task.trajectory_id,
            created_ns=task.created_ns,
            default_frame_rate=task.default_frame_rate,
            most_rows=most_rows,
        )
    except (BadInput, OSError):
        raise
    except MemoryError:
        return _too_large(task, memory)
    except Exception as error:
        # one file may end neither a batch nor the converter
        traceback.print_exc()
        return refused(task.file, unexpected(task.file, error))


def _too_large(task: Task, memory: int) -> ConversionResult:
    why = TOO_LARGE(file=task.file, part="converting", limit=memory)
    return refused(task.file, why)


def parse(data: bytes) -> Converted:
    """Return what `run` wrote; raise BadInput where it says that the request was wrong."""
    document = json.loads(data)
    if "bad_input" in document:
        raise BadInput(from_plain(document["bad_input"]))
    said = from_plain(document["said"])
    return Converted(_record(document["result"]), said, document["head"])


def unexpected(file: str, error: Exception) -> Diagnostic:
    """Return what is said of a file on which the converter itself fails."""
    said = f"{type(error).__name__}: {error}" if str(error) else type(error).__name__
    return CONVERTER_FAILED(file=file, error=said)


def failed_here(file: str, error: OSError, folder: str = "") -> Diagnostic:
    """Return what is said where this machine fails, and not the file."""
    found, why = lack(error), error.strerror or str(error)
    if found is not None and found.is_room:
        return NO_ROOM(file=file, error=why, folder=folder or None)
    return LAB_FAILED(file=file, error=why)


def refused(file: str, why: Diagnostic) -> ConversionResult:
    """Return the result of a file that could not be read."""
    return ConversionResult(file, Outcome.REJECTED, None, (), (why,))


def _plain(value: Any) -> Any:
    if isinstance(value, Diagnostic):
        return {"diagnostic": plain(value)}
    if is_dataclass(value) and not isinstance(value, type):
        content = {field.name: _plain(getattr(value, field.name)) for field in fields(value)}
        return {"record": type(value).__name__, **content}
    if isinstance(value, Enum):
        return {"enum": value.value}
    if isinstance(value, np.ndarray):
        data = base64.b64encode(np.ascontiguousarray(value).tobytes()).decode()
        return {"array": data, "dtype": value.dtype.str, "shape": list(value.shape)}
    if isinstance(value, np.generic):
        return value.item()
    if isinstance(value, tuple | list):
        return [_plain(item) for item in value]
    return value


def _record(value: Any) -> Any:
    if isinstance(value, list):
        return tuple(_record(item) for item in value)
    if not isinstance(value, dict):
        return value
    if "diagnostic" in value:
        return from_plain(value["diagnostic"])
    if "enum" in value:
        return Outcome(value["enum"])
    if "array" in value:
        flat = np.frombuffer(base64.b64decode(value["array"]), np.dtype(value["dtype"]))
        return flat.reshape(value["shape"])
    content = {name: _record(item) for name, item in value.items() if name != "record"}
    return RECORDS[value["record"]](**content)
