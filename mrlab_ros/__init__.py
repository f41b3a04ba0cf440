"""MR-Lab: a mixed-reality robotics laboratory without robots.

`Lab` is the Python API of a running lab, `Options` says how a file is converted.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from mrlab_ros.client.lab import Lab as Lab
    from mrlab_ros.core.conversion.options import Options as Options

# As in setup.py and package.xml; a test compares them.
__version__ = "0.1.0"
__all__ = ["Lab", "Options", "__version__"]


def __getattr__(name: str) -> Any:
    """Import the API when it is asked for: no part of the lab pays for it."""
    if name == "Lab":
        from mrlab_ros.client.lab import Lab

        return Lab
    if name == "Options":
        from mrlab_ros.core.conversion.options import Options

        return Options
    raise AttributeError(f"module 'mrlab_ros' has no attribute '{name}'")
