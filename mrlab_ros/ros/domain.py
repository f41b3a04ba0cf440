"""The ROS domain of this process."""

from __future__ import annotations

import os

from mrlab_ros.core.errors import Misuse


def domain_id() -> int:
    """Return the ROS domain of this process's environment."""
    text = os.environ.get("ROS_DOMAIN_ID", "") or "0"
    if not text.isdecimal() or int(text) > 232:
        raise Misuse(f"ROS_DOMAIN_ID is '{text}'; expected a number from 0 to 232")
    return int(text)
