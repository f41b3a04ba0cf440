"""A trajectory of the lab's catalogue."""

from __future__ import annotations

from dataclasses import dataclass, field

from mrlab_msgs import msg

from mrlab_ros.core.base.diagnostic import Diagnostic


@dataclass(frozen=True)
class Motion:
    """A trajectory of the catalogue. frame_rate: Hz; duration: s.

    version: grows with each conversion under the same id; 0: not known. Known only of a file that
    was just converted: warnings, sentences, and findings, with the notes and each with its remedy.
    """

    id: str
    robot_model: str
    frame_rate: float
    frame_count: int
    duration: float
    warnings: tuple[str, ...] = ()
    version: int = 0
    findings: tuple[Diagnostic, ...] = field(default=(), repr=False)


def motion_of(info: msg.TrajectoryInfo) -> Motion:
    """Return the catalogue's entry."""
    return Motion(
        info.id,
        info.robot_model,
        info.frame_rate,
        info.frame_count,
        info.duration,
        tuple(warning.message for warning in info.warnings),
        info.version,
    )
