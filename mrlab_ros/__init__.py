"""MR-Lab: a mixed-reality robotics laboratory without robots.

`Lab` is the Python API of a running lab, and `check` needs none; `Options` says how a file is
converted.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from mrlab_ros.app.check.array import ArrayCheck as ArrayCheck
    from mrlab_ros.app.check.array import check as check
    from mrlab_ros.client.lab import FileRefused as FileRefused
    from mrlab_ros.client.lab import Lab as Lab
    from mrlab_ros.client.recording import Recording as Recording
    from mrlab_ros.client.robot import JointSample as JointSample
    from mrlab_ros.client.robot import LabRobot as LabRobot
    from mrlab_ros.client.robot import Motion as Motion
    from mrlab_ros.client.robot import Run as Run
    from mrlab_ros.core.base.errors import LabError as LabError
    from mrlab_ros.core.conversion.options import Options as Options

    __version__: str
else:

    def __getattr__(name: str) -> object:
        """Import the API, and read the version, when it is asked for: no part of the lab pays."""
        if name == "__version__":
            return _version()
        if name not in _MODULES:
            raise AttributeError(f"module 'mrlab_ros' has no attribute '{name}'")
        from importlib import import_module

        return getattr(import_module(f"mrlab_ros.{_MODULES[name]}"), name)


_MODULES = {
    "ArrayCheck": "app.check.array",
    "check": "app.check.array",
    "FileRefused": "client.lab",
    "JointSample": "client.robot",
    "Lab": "client.lab",
    "LabError": "core.base.errors",
    "LabRobot": "client.robot",
    "Motion": "client.robot",
    "Options": "core.conversion.options",
    "Recording": "client.recording",
    "Run": "client.robot",
}
__all__ = [
    "ArrayCheck",
    "FileRefused",
    "JointSample",
    "Lab",
    "LabError",
    "LabRobot",
    "Motion",
    "Options",
    "Recording",
    "Run",
    "__version__",
    "check",
]


def _version() -> str:
    """Return the version in package.xml, the only place that has it, or of what is installed."""
    import re
    from importlib import metadata
    from pathlib import Path

    manifest = Path(__file__).resolve().parents[1] / "package.xml"
    if manifest.is_file():
        return str(re.findall("<version>(.+)</version>", manifest.read_text())[0])
    return metadata.version("mrlab_ros")
