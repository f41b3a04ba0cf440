"""A file with the trajectory that recorded runs are compared with."""

from __future__ import annotations

from pathlib import Path

from mrlab_ros.adapters import share
from mrlab_ros.adapters.bags.courses import Reference
from mrlab_ros.adapters.robots.library import RobotLibrary
from mrlab_ros.app.convert import convert_file
from mrlab_ros.commands.diagnostics import REFERENCE_REFUSED
from mrlab_ros.core.base.diagnostic import Fix
from mrlab_ros.core.base.errors import BadInput
from mrlab_ros.core.base.foreign_text import for_shell
from mrlab_ros.core.conversion.options import Options
from mrlab_ros.core.recording.report import ReferenceTrajectory


def reference_of(file: Path, model: str) -> Reference:
    """Return the trajectory in a file for a robot; raise BadInput where it is refused."""
    library = RobotLibrary(share.directory() / "robots")
    result = convert_file(file, library.model(model), Options(), None)
    if result.trajectory is None:
        converting = f"mrlab convert {for_shell([str(file)])} --robot {model} --out ."
        raise BadInput(
            REFERENCE_REFUSED(
                file=file.name,
                model=model,
                why=result.diagnostics[0],
                fixes=(Fix(command=converting),),
            )
        )
    found = result.trajectory
    return Reference(file.name, model, ReferenceTrajectory(found.frame_rate, found.positions))
