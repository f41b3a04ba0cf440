"""A robot system as a YAML file.

```yaml
name: cell                    # optional
mode: parallel                # or sequential
policy: halt_all              # or halt_member
loop: false
members:                      # in order of their turns
  - robot: ur5e_1
    trajectory: handover_ur5e # optional; default: the one that the robot has loaded
    dwell: 0.5                # s after its end, sequential mode
    after: kr6_1.frame 120    # before its first frame
  - robot: kr6_1
    trajectory: handover_kr6
    holds:
      - {frame: 200, wait: object cube_1 held by ur5e_1}
```
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from mrlab_ros.core.errors import BadInput
from mrlab_ros.core.records import (
    FILLED_TEXT,
    FLAG,
    TEXT,
    Integer,
    Number,
    Range,
    Record,
    Texts,
    at_least,
    enum_names,
    every,
)
from mrlab_ros.core.systems.robot_system import Policy
from mrlab_ros.core.systems.timeline import Member, Mode
from mrlab_ros.core.systems.waits import Wait, parse

PLACE = "the system file"
SYSTEM_FIELDS = ("name", "mode", "policy", "loop", "members")
MEMBER_FIELDS = ("robot", "trajectory", "dwell", "after", "wait", "holds")
HOLD_FIELDS = ("frame", "after", "wait")
DWELL = Number(Range(0, 3600, high_open=True), "s")
FRAME = Integer(at_least(0))
WAITS = Texts(single=True)


@dataclass(frozen=True)
class Cell:
    """A system as its file describes it; an empty name lets the coordinator choose one."""

    name: str
    mode: Mode
    policy: Policy
    loop: bool
    members: tuple[Member, ...]


def read(document: Any) -> Cell:
    """Return the cell that a parsed file describes; raise BadInput that names the place."""
    record = Record(document, PLACE, SYSTEM_FIELDS)
    entries = record.entries("members")
    if not entries:
        raise record.error("members is empty; expected a list of at least one robot")
    return Cell(
        name=record.value("name", TEXT, ""),
        mode=record.value("mode", enum_names(Mode), Mode.PARALLEL),
        policy=record.value("policy", enum_names(Policy), Policy.HALT_ALL),
        loop=record.value("loop", FLAG, False),
        members=tuple(every(_member, enumerate(entries, 1), PLACE)),
    )


def _member(numbered: tuple[int, object]) -> Member:
    number, value = numbered
    entry = Record(value, f"{PLACE}, member {number}", MEMBER_FIELDS)
    robot = entry.required("robot", FILLED_TEXT)
    entry.place = f"{PLACE}, member {robot}"
    waits = _waits(entry, 0)
    for hold in entry.records("holds", HOLD_FIELDS, "hold"):
        waits += _waits(hold, hold.required("frame", FRAME))
    return Member(
        robot=robot,
        trajectory_id=entry.value("trajectory", TEXT, ""),
        dwell=entry.value("dwell", DWELL, 0.0),
        waits=tuple(waits),
    )


def _waits(entry: Record, frame: int) -> list[Wait]:
    texts = [f"after {other}" for other in entry.value("after", WAITS, ())]
    texts += entry.value("wait", WAITS, ())
    try:
        return [parse(f"frame {frame}: {text}") for text in texts]
    except BadInput as error:
        raise entry.error(str(error)) from None
