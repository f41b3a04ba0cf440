"""The class: rubrics, marking of submissions, the gradebook, their commands and routes.

The lab works without this package; `mrlab_ros.extensions` names it, and reads from it COMMANDS,
ROUTERS, POLICY and POSTED, and calls `check`.
"""

from __future__ import annotations

from pathlib import Path
from typing import Protocol

COMMANDS = {
    "class": "mrlab_ros.classroom.commands:grade",
    "rubric": "mrlab_ros.classroom.commands:app",
}
ROUTERS = ("mrlab_ros.classroom.lti.routes:router", "mrlab_ros.classroom.routes:router")
# A launch is bound to its browser by a cookie and signed by the platform: see lti/launch.py.
POSTED = ("/api/lti/login", "/api/lti/launch")
# Names and marks of a class are its teachers'.
POLICY = {
    ("GET", "/api/class"): "instructor",
    ("PUT", "/api/class/sources/{name}"): "instructor",
    ("POST", "/api/class/run"): "instructor",
    ("DELETE", "/api/class/run"): "instructor",
    ("POST", "/api/class/proposed"): "instructor",
    ("DELETE", "/api/class/proposed"): "instructor",
    ("POST", "/api/class/before"): "instructor",
    ("POST", "/api/class/acts"): "instructor",
    ("POST", "/api/class/release"): "instructor",
    ("GET", "/api/class/feedback.zip"): "instructor",
    ("GET", "/api/class/{table}.csv"): "instructor",
    ("GET", "/api/class/{key}/motion"): "instructor",
    ("GET", "/api/class/{key}/file"): "instructor",
    ("GET", "/api/class/course"): "instructor",
    ("DELETE", "/api/class/course"): "instructor",
    ("POST", "/api/class/course/members"): "instructor",
    ("POST", "/api/class/course/export"): "instructor",
    ("POST", "/api/class/course/marks"): "instructor",
    ("GET", "/api/hand_in"): "student",
    ("PUT", "/api/hand_in/{name}"): "student",
    ("GET", "/api/lti/login"): "everybody",
    ("POST", "/api/lti/login"): "everybody",
    ("POST", "/api/lti/launch"): "everybody",
    ("GET", "/api/lti/keys"): "everybody",
}


class GatewaySettings(Protocol):
    """Settings of a gateway. classroom: folder of a marked class, None: none is shown. lti: file
    of the learning platform whose course it is."""

    @property
    def classroom(self) -> Path | None: ...
    @property
    def lti(self) -> Path | None: ...


def check(settings: GatewaySettings) -> None:
    """Raise BadInput where a gateway cannot show the class that its settings name."""
    if settings.lti is not None:
        from mrlab_ros.classroom.lti.diagnostics import LTI_WITHOUT_CLASS, WITH_CLASS
        from mrlab_ros.classroom.lti.platform import read_platform
        from mrlab_ros.core.base.errors import BadInput

        read_platform(settings.lti)
        if settings.classroom is None:
            raise BadInput(LTI_WITHOUT_CLASS(fixes=WITH_CLASS))
    if settings.classroom is None:
        return
    from mrlab_ros.classroom import folder

    folder.check(settings.classroom)
