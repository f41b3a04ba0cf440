"""Findings of a check: what, when, which link, the value against its limit, and the remedy."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from typing import Any

from mrlab_ros.core.base.diagnostic import Diagnostic, Severity


@dataclass(frozen=True)
class Finding:
    """One finding. time, end: s from the first frame, None where it has no instant.

    link: the robot's link or joint, empty where none is meant. value and limit in `unit`. kind,
    other: what the robot meets, by engine.Kind's name, such as robot or object, and its name;
    empty where it meets nothing. An ERROR refuses the motion, a WARNING does not.
    """

    code: str
    severity: Severity
    message: str
    remedy: str = ""
    robot: str = ""
    link: str = ""
    time: float | None = None
    end: float | None = None
    value: float | None = None
    limit: float | None = None
    unit: str = ""
    kind: str = ""
    other: str = ""

    @property
    def refuses(self) -> bool:
        return self.severity is Severity.ERROR


def in_order(findings: Iterable[Finding]) -> tuple[Finding, ...]:
    """Return the findings that refuse first, each kind by time; one a code, robot, link, time."""
    kept = {(f.code, f.robot, f.link, f.time, f.message): f for f in findings}
    return tuple(
        sorted(
            kept.values(),
            key=lambda f: (-f.severity, f.time if f.time is not None else -1.0, f.robot, f.code),
        )
    )


def from_diagnostic(found: Diagnostic, robot: str, frame_rate: float | None) -> Finding:
    """Return what the conversion found as a finding of the check.

    frame_rate: Hz of the motion, None where it is not known. A joint that moves faster than it can
    is a warning to the converter, since the lab can play it; no controller can.
    """
    severity = Severity.ERROR if found.code == "velocity_limit" else found.severity
    timed = found.first_row and frame_rate
    return Finding(
        found.code,
        severity,
        found.message,
        found.remedy,
        robot,
        found.joint,
        (found.first_row - 1) / frame_rate if timed and frame_rate else None,
        (max(found.last_row, found.first_row) - 1) / frame_rate if timed and frame_rate else None,
        found.value,
        found.limit,
        found.unit,
    )


def plain(finding: Finding) -> dict[str, Any]:
    """Return a finding as a mapping for JSON."""
    return {**vars(finding), "severity": finding.severity.name.lower()}
