"""Whether pybullet is installed for this Python."""

from __future__ import annotations

import importlib.util
import sys


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
