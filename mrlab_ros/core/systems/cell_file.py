"""A robot system as an entry of a file: a cell is a document with systems alone.

```yaml
name: cell                    # optional in a cell: the coordinator chooses one
mode: parallel                # or sequential
policy: halt_all              # or halt_member
loop: false
rate: 1.0                     # 0.1 to 4; negative: backwards
at: 0.0                       # position on its timeline, s
members:                      # in order of their turns
  - robot: ur5e_1
    trajectory: handover_ur5e # optional; default: the one that the robot has loaded
    dwell: 0.5                # s after its end, sequential mode
    after: kr6_1.frame 120    # before its first frame
  - robot: kr6_1
    trajectory: handover_kr6
    holds:
      - {frame: 200, wait: object cube_1 held by ur5e_1}
    waits: ["frame 310: object cube_1 free"]   # the same, as mrlab_msgs/SystemMember has it
```
"""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum
from typing import Any

from mrlab_ros.core.base.checks import (
    FILLED_TEXT,
    FLAG,
    TEXT,
    TEXTS,
    Choice,
    Integer,
    Number,
    Range,
    Texts,
    Words,
    at_least,
    between,
)
from mrlab_ros.core.base.clock import RATE_RANGE
from mrlab_ros.core.base.diagnostics import ONE_OF
from mrlab_ros.core.base.errors import BadInput
from mrlab_ros.core.base.records import Record, entry_place, every
from mrlab_ros.core.systems import diagnostics as say
from mrlab_ros.core.systems.states import Policy
from mrlab_ros.core.systems.timeline import Mode
from mrlab_ros.core.systems.waits import parse

SYSTEM_FIELDS = ("name", "mode", "policy", "loop", "rate", "at", "members")
MEMBER_FIELDS = ("robot", "trajectory", "dwell", "after", "wait", "holds", "waits")
HOLD_FIELDS = ("frame", "after", "wait")
RATE = Number(between(*RATE_RANGE), mirrored=True)
# s; no trajectory is longer.
POSITION = Number(between(0, 1e6), "s")
DWELL = Number(Range(0, 3600, high_open=True), "s")
FRAME = Integer(at_least(0))
WAITS = Texts(single=True)


class _Named(Choice[Any]):
    """An enum by its name in lower case; by its value too, as mrlab_msgs/RobotSystem has it."""

    def __init__(self, kind: type[Enum]) -> None:
        names = {name.lower(): member for name, member in kind.__members__.items()}
        super().__init__({**names, **{member.value: member for member in kind}})

    @property
    def expected(self) -> Words:
        return ONE_OF(choices=[key for key in self.values if isinstance(key, str)])


MODE, POLICY = _Named(Mode), _Named(Policy)


@dataclass(frozen=True)
class MemberEntry:
    """trajectory: its id, empty for what the robot has loaded. dwell: s. waits: each as in
    mrlab_msgs/SystemMember."""

    robot: str
    trajectory: str = ""
    dwell: float = 0.0
    waits: tuple[str, ...] = ()


@dataclass(frozen=True)
class SystemEntry:
    """name: empty where the coordinator chooses one. at: position on its timeline, s."""

    name: str
    members: tuple[MemberEntry, ...]
    mode: Mode = Mode.PARALLEL
    policy: Policy = Policy.HALT_ALL
    loop: bool = False
    rate: float = 1.0
    at: float = 0.0


def read_system(value: object, place: Words) -> SystemEntry:
    """Return the system that a mapping describes; raise BadInput that names `place`."""
    record = Record(value, place, SYSTEM_FIELDS)
    entries = record.entries("members")
    if not entries:
        raise record.error(say.NO_MEMBERS_IN_FILE())
    members = every(lambda numbered: _member(place, *numbered), enumerate(entries, 1), place)
    return SystemEntry(
        name=record.value("name", TEXT, ""),
        members=tuple(members),
        mode=record.value("mode", MODE, Mode.PARALLEL),
        policy=record.value("policy", POLICY, Policy.HALT_ALL),
        loop=record.value("loop", FLAG, False),
        rate=record.value("rate", RATE, 1.0),
        at=record.value("at", POSITION, 0.0),
    )


def plain_system(system: SystemEntry) -> dict[str, Any]:
    """Return the system as a mapping of texts and numbers, which read_system() reads."""
    return {
        "name": system.name,
        "members": [
            {"robot": m.robot, "trajectory": m.trajectory, "dwell": m.dwell, "waits": [*m.waits]}
            for m in system.members
        ],
        "mode": system.mode.name.lower(),
        "policy": system.policy.name.lower(),
        "loop": system.loop,
        "rate": system.rate,
        "at": system.at,
    }


def _member(place: Words, number: int, value: object) -> MemberEntry:
    entry = Record(value, entry_place(place, "member", number), MEMBER_FIELDS)
    robot = entry.required("robot", FILLED_TEXT)
    entry.place = say.MEMBER_PLACE(place=place, robot=robot)
    waits = _waits(entry, 0)
    for hold in entry.records("holds", HOLD_FIELDS, "hold"):
        frame = hold.required("frame", FRAME)
        conditions = _waits(hold, frame)
        if not conditions:
            raise hold.error(say.ENDLESS_HOLD(frame=frame))
        waits += conditions
    waits += _parsed(entry, entry.value("waits", TEXTS, ()))
    return MemberEntry(
        robot=robot,
        trajectory=entry.value("trajectory", TEXT, ""),
        dwell=entry.value("dwell", DWELL, 0.0),
        waits=tuple(waits),
    )


def _waits(entry: Record, frame: int) -> list[str]:
    texts = [f"after {other}" for other in entry.value("after", WAITS, ())]
    texts += entry.value("wait", WAITS, ())
    return _parsed(entry, [f"frame {frame}: {text}" for text in texts])


def _parsed(entry: Record, texts: Any) -> list[str]:
    """Return the waits as parse() writes them."""
    try:
        return [parse(text).text for text in texts]
    except BadInput as error:
        raise entry.error(error.diagnostic) from None
