"""MR-Lab: a mixed-reality robotics laboratory without robots.

`Lab` is the Python API of a running lab, `Options` says how a file is converted.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from mrlab_ros.client.lab import Lab as Lab
    from mrlab_ros.core.conversion.options import Options as Options

    __version__: str

__all__ = ["Lab", "Options", "__version__"]


def __getattr__(name: str) -> Any:
    """Import the API, and read the version, when it is asked for: no part of the lab pays."""
    if name == "Lab":
        from mrlab_ros.client.lab import Lab

        return Lab
    if name == "Options":
        from mrlab_ros.core.conversion.options import Options

        return Options
    if name == "__version__":
        return _version()
    raise AttributeError(f"module 'mrlab_ros' has no attribute '{name}'")


def _version() -> str:
    """Return the version in package.xml, the only place that has it, or of what is installed."""
    import re
    from importlib import metadata
    from pathlib import Path

    manifest = Path(__file__).resolve().parents[1] / "package.xml"
    if manifest.is_file():
        return str(re.findall("<version>(.+)</version>", manifest.read_text())[0])
    return metadata.version("mrlab_ros")
