"""Where ROS writes its logs; without a folder for them rclpy.init() fails."""

from __future__ import annotations

import os
import sys
import tempfile
from pathlib import Path

VARIABLE = "ROS_LOG_DIR"


def prepare() -> None:
    """Let ROS log into a temporary folder where its own cannot be written; call before init().

    The processes that this one starts do the same.
    """
    try:
        folder = chosen()
        folder.mkdir(parents=True, exist_ok=True)
        why = "" if os.access(folder, os.W_OK | os.X_OK) else "it cannot be written"
    except OSError as error:
        why = error.strerror or str(error)
    except RuntimeError:  # neither HOME nor an entry of this user in the system's list
        folder, why = Path("~/.ros/log"), "this user has no home"
    if not why:
        if not os.environ.get("HOME"):  # rcl finds no other home
            os.environ[VARIABLE] = str(folder)
        return
    instead = Path(tempfile.gettempdir()) / f"mrlab-{os.getuid()}" / "log"
    instead.mkdir(mode=0o700, parents=True, exist_ok=True)
    os.environ[VARIABLE] = str(instead)
    sys.stderr.write(f"mrlab: ROS logs into {instead}, not into {folder}: {why}\n")


def chosen() -> Path:
    """Return the folder that ROS would log into, by the rule of rcl_logging."""
    if folder := os.environ.get(VARIABLE):
        return Path(folder).expanduser()
    if home := os.environ.get("ROS_HOME"):
        return Path(home).expanduser() / "log"
    return Path.home() / ".ros" / "log"
