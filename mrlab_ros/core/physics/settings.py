"""The figures of the physics that a lab may change, checked."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, fields
from typing import Any

from mrlab_ros.core.errors import BadInput


@dataclass(frozen=True)
class Settings:
    """What config/physics.yaml says.

    step_rate: Hz of the world. max_travel: m that the fastest point of an arm may move between
    two looks for contacts; a faster step is divided, into max_divisions at most.
    clear_margin: m that must lie between an arm and what it hit, for clear_time s, before the
    halt ends. stall_share: a finger that closed by less than this share of its free way in
    stall_time s is stalled.
    grasp_timeout: s after which stalled fingers that hold nothing count as closed on nothing.
    max_objects: active at once. max_triangles: of one surface. max_silence: s that the world
    waits for the next joint state of a moving arm. max_catch_up: s of backlog beyond which time
    is left out. snapshot_rate: Hz; snapshot_count: most that one run keeps.
    """

    step_rate: float = 240.0
    max_travel: float = 0.004
    max_divisions: int = 10
    clear_margin: float = 0.01
    clear_time: float = 0.2
    stall_share: float = 0.1
    stall_time: float = 0.1
    grasp_timeout: float = 0.5
    max_objects: int = 32
    max_triangles: int = 20_000
    max_silence: float = 1.0
    max_catch_up: float = 2.0
    snapshot_rate: float = 10.0
    snapshot_count: int = 600

    def __post_init__(self) -> None:
        for field in fields(self):
            value = getattr(self, field.name)
            if not (math.isfinite(value) and value > 0):
                raise BadInput(
                    f"{field.name} of the physics is {value}; expected a number above 0, as in "
                    "config/physics.yaml"
                )
        if not 60 <= self.step_rate <= 2000:
            raise BadInput(f"step_rate of the physics is {self.step_rate}; expected 60 to 2000 Hz")

    @classmethod
    def from_mapping(cls, values: Mapping[str, Any]) -> Settings:
        """Build from the content of config/physics.yaml; raise BadInput where it is wrong."""
        known = {field.name: field for field in fields(cls)}
        for name, value in values.items():
            if name not in known:
                raise BadInput(f"the physics has no '{name}'; it has: {', '.join(known)}")
            if type(value) not in (int, float):
                raise BadInput(f"{name} of the physics is {value!r}; expected a number")
        typed: dict[str, Any] = {
            k: int(v) if known[k].type == "int" else float(v) for k, v in values.items()
        }
        return cls(**typed)
