"""What calls and services of the graph say."""

from __future__ import annotations

from mrlab_ros.core.base.diagnostic import Code

FAULT = Code(
    "fault",
    "the lab failed at {service} ({error}); its log has the details",
    meaning="A fault of the lab: what was asked for was not done, or only in part.",
)
