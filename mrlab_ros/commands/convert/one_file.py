"""One file for a command that shows or checks it: a workspace, a table, or a trajectory file."""

from __future__ import annotations

import tempfile
from pathlib import Path
from typing import TYPE_CHECKING

from mrlab_ros.adapters.diagnostics import FILE_UNREADABLE
from mrlab_ros.adapters.robots.library import RobotLibrary
from mrlab_ros.commands.convert.diagnostics import ROBOT_NOT_NAMED
from mrlab_ros.core.base.errors import BadInput, Misuse
from mrlab_ros.core.base.foreign_text import file_name
from mrlab_ros.core.conversion.convert import ConversionResult, Outcome
from mrlab_ros.core.conversion.options import Options

if TYPE_CHECKING:
    from mrlab_ros.core.trajectory.trajectory import Trajectory


def converted(
    file: Path, robot: str, end_effector: str, options: Options, library: RobotLibrary
) -> ConversionResult:
    """Return what became of a file; a refusal is a result.

    robot: a model; empty: the one that a trajectory file names. Raises BadInput where the file or
    the model is unknown, and Misuse where a model is needed.
    """
    result = of_trajectory_file(file)
    if result is not None:
        return result
    if not robot:
        raise Misuse(ROBOT_NOT_NAMED(file=file.name, known=list(library.ids())))
    from mrlab_ros.commands.convert import batch

    return batch.convert_file(file, library.model(robot), options, end_effector or None)


def of_trajectory_file(file: Path) -> ConversionResult | None:
    """Return the trajectory in a file that the lab wrote as JSON, or None: it is another file."""
    if file.suffix.lower() != ".json":
        return None
    from mrlab_ros.adapters.trajectories import npz_file
    from mrlab_ros.commands import behind_wall

    with tempfile.TemporaryDirectory(prefix="mrlab-") as folder:
        stored = Path(folder, "trajectory.npz")
        behind_wall.run(
            store, str(file), str(stored), name=file.name, read=[file], write=[Path(folder)]
        )
        return _accepted(file, npz_file.read(stored))


def store(file: str, stored: str) -> None:
    """Write the trajectory in a JSON file as numbers, which whoever trusts neither reads."""
    from mrlab_ros.adapters.trajectories import npz_file

    with Path(stored).open("wb") as target:
        npz_file.write(_parsed(Path(file)), target)


def of_trajectory_file_here(file: Path) -> ConversionResult | None:
    """Do what of_trajectory_file() does, in a process that is behind the wall already."""
    return _accepted(file, _parsed(file)) if file.suffix.lower() == ".json" else None


def _parsed(file: Path) -> Trajectory:
    from mrlab_ros.adapters.trajectories import formats

    try:
        return formats.parse(file.read_bytes(), file_name(file.name))
    except OSError as error:
        raise BadInput(FILE_UNREADABLE(file=str(file), why=error.strerror)) from None


def _accepted(file: Path, found: Trajectory) -> ConversionResult:
    return ConversionResult(
        file_name(file.name), Outcome.ACCEPTED, found, (), tuple(found.warnings)
    )
