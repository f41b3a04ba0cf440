"""Whether a lab is started with physics."""

from __future__ import annotations

from mrlab_ros.adapters.bullet.support import missing
from mrlab_ros.core.errors import BadInput


def wanted(chosen: bool | None) -> tuple[bool, str]:
    """Return whether to start physics, and a sentence where it is left out for a reason.

    chosen: the user's choice; None: none was made, and physics starts where it can. Raises
    BadInput where physics is chosen and cannot run.
    """
    why_not = missing()
    if chosen and why_not:
        raise BadInput(f"there is no physics: {why_not}")
    if chosen is None and why_not:
        return False, f"runs without physics: {why_not}"
    return chosen is not False, ""
