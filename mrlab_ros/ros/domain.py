"""The ROS domain of this process."""

from __future__ import annotations

import os

from mrlab_ros.core.base.errors import Misuse
from mrlab_ros.ros.diagnostics import BAD_DOMAIN


def domain_id() -> int:
    """Return the ROS domain of this process's environment."""
    text = os.environ.get("ROS_DOMAIN_ID", "") or "0"
    if not text.isdecimal() or int(text) > 232:
        raise Misuse(BAD_DOMAIN(found=text))
    return int(text)
