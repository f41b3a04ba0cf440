"""What the lab sets about Fast DDS, the middleware that ROS's wheels come with."""

from __future__ import annotations

import os
from collections.abc import Mapping
from pathlib import Path

from mrlab_ros.ros import share
from mrlab_ros.ros.shared_memory import remove_abandoned

# Where Fast DDS looks for its profiles; other middlewares ignore it.
PROFILES = "FASTRTPS_DEFAULT_PROFILES_FILE"
# Has rmw_fastrtps leave what the profiles say of writers and readers.
PROFILES_OF_ENDS = "RMW_FASTRTPS_USE_QOS_FROM_XML"
RANGE = "ROS_AUTOMATIC_DISCOVERY_RANGE"
# Either of these asks for participants elsewhere.
ELSEWHERE = ("ROS_STATIC_PEERS", "ROS_DISCOVERY_SERVER")


def prepare() -> None:
    """Set what the first participant of this process reads; call it before rclpy.init().

    Profiles that the user has chosen stay.
    """
    remove_abandoned()
    os.environ.update(settings(os.environ))


def settings(environment: Mapping[str, str]) -> dict[str, str]:
    """Return the variables of a process with this environment; none where it has profiles."""
    chosen = environment.get(PROFILES)
    if chosen and not _ours(Path(chosen)):
        return {}
    profiles = profile_file(loopback=stays_here(environment))
    if not profiles.is_file():
        return {}
    return {PROFILES: str(profiles), PROFILES_OF_ENDS: environment.get(PROFILES_OF_ENDS, "1")}


def stays_here(environment: Mapping[str, str]) -> bool:
    """Return whether the graph is to stay on this machine."""
    if environment.get("ROS_LOCALHOST_ONLY") == "1":
        return True
    within = environment.get(RANGE, "").upper() == "LOCALHOST"
    return within and not any(environment.get(name) for name in ELSEWHERE)


def profile_file(*, loopback: bool = False) -> Path:
    """Return a file of the lab's profiles; it says what they are for.

    loopback: of a graph that stays on this machine.
    """
    name = "fastdds_loopback.xml" if loopback else "fastdds.xml"
    return share.directory() / "config" / name


def _ours(chosen: Path) -> bool:
    """Return whether these are the lab's profiles: a shell may name those of the source tree."""
    try:
        text = chosen.read_bytes()
        return any(text == profile_file(loopback=b).read_bytes() for b in (False, True))
    except OSError:
        return False
