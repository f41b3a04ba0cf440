"""Converts a file in a process that is walled off already, so that no other one is started."""

from __future__ import annotations

import contextlib
from pathlib import Path

from mrlab_ros.adapters import share
from mrlab_ros.adapters.robots.library import RobotLibrary
from mrlab_ros.adapters.trajectories.files import load_coefficients
from mrlab_ros.adapters.workspaces import content, worker
from mrlab_ros.adapters.workspaces.reader import Limits, opened
from mrlab_ros.adapters.workspaces.results import Task, converted, refused
from mrlab_ros.app.convert import of_trajectory_file_here
from mrlab_ros.commands.classroom.diagnostics import NO_ROBOT_IN_RUBRIC
from mrlab_ros.core.base.errors import BadInput, Misuse
from mrlab_ros.core.conversion.convert import ConversionResult, id_from
from mrlab_ros.core.conversion.options import DEFAULT_FRAME_RATE, Options
from mrlab_ros.core.conversion.workspace import Workspace


class Inside:
    """Converts files here; callable as `app.convert.converted` is.

    limits: of time, s, for what the second reader says; memory: bytes, for words and buffers.
    """

    def __init__(self, limits: Limits) -> None:
        self.limits = limits
        worker.load_encodings()
        for module in worker.SELDOM:
            with contextlib.suppress(ImportError):  # mat-io is not there for every Python
                worker.import_whole(module)
        path = share.directory() / "config" / "torque_proxy.yaml"
        self._coefficients = load_coefficients(path)

    def __call__(
        self, file: Path, robot: str, end_effector: str, options: Options, library: RobotLibrary
    ) -> ConversionResult:
        """Return what became of a file; a refusal is a result. Raises LabError."""
        found = of_trajectory_file_here(file)
        if found is not None:
            return found
        if not robot:
            raise Misuse(NO_ROBOT_IN_RUBRIC(file=file.name))
        task = Task(
            file=file.name,
            options=options,
            robot=library.model(robot),
            coefficients=self._coefficients,
            end_effector=end_effector or None,
            trajectory_id=id_from(file.name),
            created_ns=0,  # equal files give equal trajectories
            default_frame_rate=DEFAULT_FRAME_RATE,
        )
        limits = self.limits
        request = {**vars(limits), "name": file.name}
        try:
            with opened(file) as source:
                copy = content.copied(source, limits.file_size, file.name)

                def read() -> Workspace:
                    return worker.workspace(copy, request)

                return converted(task, read, limits.memory, limits.rows)
        except BadInput as error:
            return refused(file.name, error.diagnostic)
