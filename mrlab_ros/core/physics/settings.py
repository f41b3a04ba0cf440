"""The figures of the physics that a lab may change: config/physics.yaml, checked."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from mrlab_ros.core.base import records
from mrlab_ros.core.base.checks import Choice, Integer, Number, above, between
from mrlab_ros.core.base.records import field

PLACE = "config/physics.yaml"


@dataclass(frozen=True)
class Settings:
    """The content of config/physics.yaml. SI units."""

    step_rate: float = field(Number(between(60, 2000), "Hz"), "Rate of the world's steps.", 240.0)
    max_travel: float = field(
        Number(above(0, 0.1), "m"),
        "How far the fastest point of an arm may move between two checks for contacts; a faster "
        "step is divided.",
        0.004,
    )
    max_divisions: int = field(
        Integer(between(1, 100)), "Into how many parts a fast step is divided at most.", 10
    )
    clear_margin: float = field(
        Number(above(0, 1), "m"),
        "Distance between an arm and what it hit that is needed to end a collision halt.",
        0.01,
    )
    clear_time: float = field(
        Number(above(0, 60), "s"), "How long that distance is kept without a break.", 0.2
    )
    stall_share: float = field(
        Number(above(0, 1)),
        "A finger is stalled when it closes by less than this share of its free travel in "
        "stall_time.",
        0.1,
    )
    stall_time: float = field(Number(above(0, 10), "s"), "See stall_share.", 0.1)
    grasp_timeout: float = field(
        Number(above(0, 60), "s"),
        "After this time stalled fingers that touch no object count as closed on nothing.",
        0.5,
    )
    set_down: float = field(
        Number(above(0, 0.05), "m"),
        "How far a held object may be pressed on what it is set down on, or put into, before that "
        "is a collision.",
        0.002,
    )
    graze: float = field(
        Number(above(0, 0.05), "m"),
        "How far a held object may be moved against anything in another direction.",
        0.0005,
    )
    hold: str = field(
        Choice({"friction": "friction", "infinite": "infinite"}),
        "friction: what friction or suction cannot hold slips and drops; infinite: a grasp holds "
        "whatever it bears.",
        "friction",
    )
    attach_reach: float = field(
        Number(above(0, 1000), "m"),
        "How far from a robot's hand an object may be that is attached to it by service.",
        0.2,
    )
    max_objects: int = field(
        Integer(between(1, 10_000)),
        "Objects that can be active at once; a new one replaces the oldest that nothing holds.",
        32,
    )
    max_triangles: int = field(
        Integer(between(1, 1_000_000)), "Triangles of one surface of the room.", 20_000
    )
    max_silence: float = field(
        Number(above(0, 3600), "s"),
        "How long the world waits for the next joint state of a moving arm.",
        1.0,
    )
    max_catch_up: float = field(
        Number(above(0, 60), "s"), "Backlog of steps beyond which time is skipped.", 2.0
    )
    snapshot_rate: float = field(
        Number(above(0, 20), "Hz"),
        "How often the objects of a run are stored for scrubbing.",
        10.0,
    )
    snapshot_count: int = field(
        Integer(between(2, 100_000)),
        "Snapshots of one run; a longer run keeps fewer a second.",
        600,
    )

    def __post_init__(self) -> None:
        records.check_fields(self, PLACE)

    @classmethod
    def from_mapping(cls, values: Mapping[str, Any]) -> Settings:
        """Build from the content of the file; raise BadInput that names all mistakes."""
        return records.read(cls, values, PLACE)
