"""What the lab sets about Fast DDS, the middleware that ROS's wheels come with."""

from __future__ import annotations

import os
from pathlib import Path

from mrlab_ros.ros import share
from mrlab_ros.ros.shared_memory import remove_abandoned

# Where Fast DDS looks for its profiles; other middlewares ignore it.
PROFILES = "FASTRTPS_DEFAULT_PROFILES_FILE"
# Has rmw_fastrtps leave what the profiles say of writers and readers.
PROFILES_OF_ENDS = "RMW_FASTRTPS_USE_QOS_FROM_XML"


def prepare() -> None:
    """Set what the first participant of this process reads; call it before rclpy.init().

    Profiles that the user has chosen stay.
    """
    remove_abandoned()
    profiles = profile_file()
    if profiles.is_file() and _same(
        Path(os.environ.setdefault(PROFILES, str(profiles))), profiles
    ):
        os.environ.setdefault(PROFILES_OF_ENDS, "1")


def profile_file() -> Path:
    """Return the file of the lab's profiles; it says what they are for."""
    return share.directory() / "config" / "fastdds.xml"


def _same(chosen: Path, profiles: Path) -> bool:
    """Return whether both are the lab's profiles: a shell may name those of the source tree."""
    try:
        return chosen.read_bytes() == profiles.read_bytes()
    except OSError:
        return False
