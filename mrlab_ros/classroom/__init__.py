"""The class: rubrics, marking of submissions, the gradebook, their commands and routes.

The lab works without this package; `mrlab_ros.extensions` names it, and reads from it COMMANDS,
ROUTERS and POLICY, and calls `check`.
"""

from __future__ import annotations

from pathlib import Path
from typing import Protocol

COMMANDS = {
    "class": "mrlab_ros.classroom.commands:grade",
    "rubric": "mrlab_ros.classroom.commands:app",
}
ROUTERS = ("mrlab_ros.classroom.routes:router",)
# Names and marks of a class are its teachers'.
POLICY = {
    ("GET", "/api/class"): "instructor",
    ("PUT", "/api/class/sources/{name}"): "instructor",
    ("POST", "/api/class/run"): "instructor",
    ("DELETE", "/api/class/run"): "instructor",
    ("POST", "/api/class/proposed"): "instructor",
    ("DELETE", "/api/class/proposed"): "instructor",
    ("POST", "/api/class/acts"): "instructor",
    ("POST", "/api/class/release"): "instructor",
    ("GET", "/api/class/feedback.zip"): "instructor",
    ("GET", "/api/class/{table}.csv"): "instructor",
    ("GET", "/api/class/{key}/motion"): "instructor",
    ("GET", "/api/class/{key}/file"): "instructor",
}


class GatewaySettings(Protocol):
    """Settings of a gateway. classroom: folder of a marked class, None: none is shown."""

    @property
    def classroom(self) -> Path | None: ...


def check(settings: GatewaySettings) -> None:
    """Raise BadInput where a gateway cannot show the class that its settings name."""
    if settings.classroom is None:
        return
    from mrlab_ros.classroom import folder

    folder.check(settings.classroom)
