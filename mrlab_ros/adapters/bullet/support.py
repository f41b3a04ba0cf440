"""Tells whether pybullet is installed for this Python."""

from __future__ import annotations

import importlib.util
import sys

from mrlab_ros.adapters.bullet.diagnostics import PYBULLET_MISSING
from mrlab_ros.core.base.diagnostic import Diagnostic


def missing() -> Diagnostic | None:
    """Return why physics cannot run here and what to do; None where it can."""
    if importlib.util.find_spec("pybullet") is not None:
        return None
    return PYBULLET_MISSING(version=".".join(map(str, sys.version_info[:2])))
