"""Whether this Python can run the lab's physics, and whether a lab has it."""

from __future__ import annotations

import importlib.util
import sys

from mrlab_ros.core.errors import BadInput


def missing() -> str:
    """Return why physics cannot run here and what to do; empty where it can."""
    if importlib.util.find_spec("pybullet") is not None:
        return ""
    version = ".".join(map(str, sys.version_info[:2]))
    return (
        f"pybullet is not installed for this Python {version}; it has wheels for 3.10 and 3.11: "
        "install one of those and set up again (make clean, then make demo), or build it with "
        "pip install pybullet, which takes minutes"
    )


def wanted(chosen: bool | None) -> tuple[bool, str]:
    """Return whether to start physics, and a sentence where it is left out for a reason.

    chosen: what the user said, None for nothing: then it starts where it can. Raises BadInput
    where it is asked for and cannot be had.
    """
    why_not = missing()
    if chosen and why_not:
        raise BadInput(f"there is no physics: {why_not}")
    if chosen is None and why_not:
        return False, f"runs without physics: {why_not}"
    return chosen is not False, ""
