"""What the lab sets about Fast DDS, the middleware that ROS's wheels come with."""

from __future__ import annotations

import os
from pathlib import Path

from mrlab_ros.ros import share
from mrlab_ros.ros.shared_memory import remove_abandoned

# Where Fast DDS looks for its profiles; other middlewares ignore it.
PROFILES = "FASTRTPS_DEFAULT_PROFILES_FILE"


def prepare() -> None:
    """Set what the first participant of this process reads; call it before rclpy.init().

    Profiles that the user has chosen stay.
    """
    remove_abandoned()
    profiles = profile_file()
    if profiles.is_file():
        os.environ.setdefault(PROFILES, str(profiles))


def profile_file() -> Path:
    """Return the file of the lab's profiles; it says what they are for."""
    return share.directory() / "config" / "fastdds.xml"
