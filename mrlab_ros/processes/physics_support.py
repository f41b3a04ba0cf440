"""Decides whether a lab is started with physics."""

from __future__ import annotations

from mrlab_ros.adapters.bullet.support import missing
from mrlab_ros.core.base.diagnostic import Diagnostic
from mrlab_ros.core.base.errors import BadInput
from mrlab_ros.processes.diagnostics import NO_PHYSICS, RUNS_WITHOUT_PHYSICS


def wanted(chosen: bool | None) -> tuple[bool, Diagnostic | None]:
    """Return whether to start physics, and why not where it is left out for a reason.

    chosen: the user's choice; None: none was made, and physics starts where it can. Raises
    BadInput where physics is chosen and cannot run.
    """
    why_not = missing()
    if chosen and why_not:
        raise BadInput(NO_PHYSICS(why=why_not))
    if chosen is None and why_not:
        return False, RUNS_WITHOUT_PHYSICS(why=why_not)
    return chosen is not False, None
