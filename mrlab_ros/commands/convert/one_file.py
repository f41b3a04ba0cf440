"""One file for a command that shows or checks it: a workspace, a table, or a trajectory file."""

from __future__ import annotations

from pathlib import Path

from mrlab_ros.adapters.robots.library import RobotLibrary
from mrlab_ros.core.conversion.convert import ConversionResult, Outcome
from mrlab_ros.core.conversion.options import Options
from mrlab_ros.core.errors import BadInput, Misuse


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
        raise Misuse(
            f"'{file.name}' does not say which robot it is for; add --robot, one of: "
            f"{', '.join(library.ids())}"
        )
    from mrlab_ros.commands.convert import batch

    return batch.convert_file(file, library.model(robot), options, end_effector or None)


def of_trajectory_file(file: Path) -> ConversionResult | None:
    """Return the trajectory in a file that the lab wrote as JSON, or None: it is another file."""
    if file.suffix.lower() != ".json":
        return None
    from mrlab_ros.adapters.trajectories import json_file

    try:
        trajectory = json_file.parse(file.read_bytes(), file.name)
    except OSError as error:
        raise BadInput(f"{file} cannot be read: {error.strerror}") from None
    return ConversionResult(
        file.name, Outcome.ACCEPTED, trajectory, (), tuple(trajectory.warnings)
    )
