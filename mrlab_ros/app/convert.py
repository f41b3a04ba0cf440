"""Converts a workspace, a table or a trajectory file, in a process in the sandbox."""

from __future__ import annotations

import contextlib
import os
import tempfile
import time
from collections import deque
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import Future
from contextlib import AbstractContextManager
from dataclasses import dataclass, replace
from functools import partial
from mmap import ACCESS_READ, mmap
from pathlib import Path

from mrlab_ros.adapters import share
from mrlab_ros.adapters.diagnostics import FILE_UNREADABLE
from mrlab_ros.adapters.robots.library import RobotLibrary
from mrlab_ros.adapters.sandbox import printed
from mrlab_ros.adapters.trajectories import formats, npz_file
from mrlab_ros.adapters.trajectories.files import load_coefficients
from mrlab_ros.adapters.workspaces.diagnostics import MISSING
from mrlab_ros.adapters.workspaces.reader import (
    ConversionPool,
    Limits,
    TooSlow,
    WorkspaceReader,
    opened,
)
from mrlab_ros.adapters.workspaces.results import Task, failed_here, refused, unexpected
from mrlab_ros.adapters.yaml_files import close_file
from mrlab_ros.app.diagnostics import OTHER_JOINTS, ROBOT_NOT_NAMED
from mrlab_ros.core.base.errors import BadInput, Misuse, WrongUsage
from mrlab_ros.core.base.foreign_text import file_name
from mrlab_ros.core.conversion import motion_checks
from mrlab_ros.core.conversion.convert import ConversionResult, Outcome, id_from
from mrlab_ros.core.conversion.options import DEFAULT_FRAME_RATE, Options
from mrlab_ros.core.robots.model import RobotModel
from mrlab_ros.core.trajectory.trajectory import Trajectory

AHEAD = 64  # files that may be converted before the first of them is reported
SUFFIXES = (
    *(".mat", ".mat.gz", ".csv", ".lvm", ".npz", ".npy", ".json", ".mcap", ".db3"),
    *(".mcap.zst", ".mcap.zstd", ".db3.zst", ".db3.zstd"),
)


def converted(
    file: Path, robot: str, end_effector: str, options: Options, library: RobotLibrary
) -> ConversionResult:
    """Return what became of a file; a refusal is a result.

    robot: a model; empty: the one that a trajectory file names. Raises BadInput where the file or
    the model is unknown, and WrongUsage where a model is needed.
    """
    file = bag_in(file)
    result = of_trajectory_file(file)
    if result is not None:
        return result
    if not robot:
        raise WrongUsage(ROBOT_NOT_NAMED(file=file.name, known=list(library.ids())))
    return convert_file(file, library.model(robot), options, end_effector or None)


def bag_in(path: Path) -> Path:
    """Return the one file of the folder that ROS 2 records a bag into; another path as it is."""
    if not os.path.isdir(path):
        return path
    inside = [p for p in path.iterdir() if p.name.lower().endswith(SUFFIXES)]
    return inside[0] if len(inside) == 1 else path


def is_trajectory_file(file: Path) -> bool:
    """Return whether a file is JSON that names a version of the lab's schema; True: unreadable."""
    if file.suffix.lower() != ".json":
        return False
    try:
        with file.open("rb") as opened, mmap(opened.fileno(), 0, access=ACCESS_READ) as content:
            return content.find(b'"schema_version"') >= 0
    except (OSError, ValueError):
        return True


def of_trajectory_file(file: Path) -> ConversionResult | None:
    """Return the trajectory in a file that the lab wrote as JSON, or None: it is another file."""
    if not is_trajectory_file(file):
        return None
    with tempfile.TemporaryDirectory(prefix="mrlab-") as folder:
        stored = Path(folder, "trajectory.npz")
        printed.call(
            store, str(file), str(stored), name=file.name, read=[file], write=[Path(folder)]
        )
        return _accepted(file, npz_file.read(stored))


def store(file: str, stored: str) -> None:
    """Write the trajectory in a JSON file as numbers, which whoever trusts neither reads."""
    with Path(stored).open("wb") as target:
        npz_file.write(_parsed(Path(file)), target)


def of_trajectory_file_here(file: Path) -> ConversionResult | None:
    """Do what of_trajectory_file() does, in a process that is in the sandbox already."""
    return _accepted(file, _parsed(file)) if is_trajectory_file(file) else None


def _parsed(file: Path) -> Trajectory:
    try:
        return formats.parse(file.read_bytes(), file_name(file.name))
    except OSError as error:
        raise BadInput(FILE_UNREADABLE(file=str(file), why=error.strerror)) from None


def _accepted(file: Path, found: Trajectory) -> ConversionResult:
    return ConversionResult(
        file_name(file.name), Outcome.ACCEPTED, found, (), tuple(found.warnings)
    )


def held_to_robot(result: ConversionResult, library: RobotLibrary) -> ConversionResult:
    """Return the result of a trajectory file after the checks that all other formats go through.

    Raises BadInput where its robot is unknown.
    """
    found = result.trajectory
    if found is None:
        return result
    robot = library.model(found.robot_model)
    if found.joint_names != robot.joint_names:
        return replace(result, trajectory=None, outcome=Outcome.REJECTED, diagnostics=(
            OTHER_JOINTS(file=result.file, model=robot.id, joints=list(found.joint_names)),
        ))  # fmt: skip
    said = motion_checks.against_robot(
        found.positions, found.frame_rate, robot.joints, "positions", robot.id
    )
    # The file repeats what its conversion said; a file is not believed where it says less.
    again = {(one.code, one.joint) for one in said}
    kept = (one for one in result.diagnostics if (one.code, one.joint) not in again)
    diagnostics = (*kept, *said)
    if any(one.refuses for one in said):
        return replace(result, trajectory=None, outcome=Outcome.REJECTED, diagnostics=diagnostics)
    return replace(result, diagnostics=diagnostics)


@dataclass(frozen=True)
class Input:
    """Something to convert. given: what the person wrote; name: of the file, without folder.

    read_as: the name whose ending says what it is; open: yields a descriptor of the file.
    """

    given: str
    name: str
    read_as: str
    open: Callable[[], AbstractContextManager[int]]


@dataclass(frozen=True)
class Wanted:
    """A file to convert for a robot. end_effector: None: a bare flange."""

    path: Path
    robot: RobotModel
    options: Options
    end_effector: str | None


def convert_file(
    path: Path, robot: RobotModel, options: Options, end_effector: str | None
) -> ConversionResult:
    """Convert one file in a sandboxed process; a refusal is a result."""
    return convert_files([Wanted(path, robot, options, end_effector)])[0]


def convert_files(wanted: Sequence[Wanted]) -> list[ConversionResult]:
    """Convert files in sandboxed processes, in order; raise BadInput where one is no file."""
    coefficients = load_coefficients(share.directory() / "config" / "torque_proxy.yaml")
    inputs, tasks = [], []
    for each in wanted:
        path = each.path
        name = file_name(path.name)
        inputs.append(input_of(path))
        with inputs[-1].open():
            pass  # it is there
        tasks.append(
            Task(
                file=name,
                options=each.options,
                robot=each.robot,
                coefficients=coefficients,
                end_effector=each.end_effector,
                trajectory_id=id_from(name),
                created_ns=time.time_ns(),
                default_frame_rate=DEFAULT_FRAME_RATE,
                read_as=name,
            )
        )
    return [result for _, _, result in convert_all(inputs, tasks, Limits())]


def convert_all(
    inputs: list[Input], tasks: list[Task], limits: Limits
) -> Iterator[tuple[Input, Task, ConversionResult]]:
    """Convert in several sandboxed processes; yield the results in the order of the inputs."""
    waiting: deque[tuple[Input, Task, Future[ConversionResult]]] = deque()
    workers = 1 if len(inputs) == 1 else 0
    with tempfile.TemporaryDirectory() as folder, ConversionPool(limits, workers) as pool:
        for number, (source, task) in enumerate(zip(inputs, tasks, strict=True)):
            work = partial(_convert, source, task, Path(folder) / f"{number}.npz")
            waiting.append((source, task, pool.submit(work, 0)))
            if len(waiting) > AHEAD:
                yield _awaited(*waiting.popleft())
        while waiting:
            yield _awaited(*waiting.popleft())


def _convert(source: Input, task: Task, path: Path, reader: WorkspaceReader) -> ConversionResult:
    """Convert in the sandbox; path: of a file for the trajectory in between."""
    try:
        with source.open() as file, path.open("w+b") as stored:
            converted = reader.convert(file, task, stored)
        if converted.head is None:
            return converted.result
        return replace(converted.result, trajectory=npz_file.read(path))
    except TooSlow:
        raise  # the pool decides whether it has more time
    except BadInput as error:
        return refused(task.file, error.diagnostic)
    except OSError as error:
        return refused(task.file, failed_here(task.file, error, str(path.parent)))
    finally:
        path.unlink(missing_ok=True)


def _awaited(
    source: Input, task: Task, future: Future[ConversionResult]
) -> tuple[Input, Task, ConversionResult]:
    try:
        return source, task, future.result()
    except TooSlow as error:
        return source, task, refused(task.file, error.diagnostic)
    except (BadInput, Misuse):
        raise
    except Exception as error:
        return source, task, refused(task.file, unexpected(task.file, error))


def input_of(path: Path) -> Input:
    name = file_name(path.name)
    return Input(str(path), name, name, partial(_opened, path))


@contextlib.contextmanager
def _opened(path: Path) -> Iterator[int]:
    """Open a file; where there is none, name the one that may have been meant."""
    if not os.path.exists(path):  # not Path.exists, which raises for a name that is too long
        raise BadInput(MISSING(file=str(path), close=close_file(path)))
    with opened(path) as source:
        yield source
