"""A robot system as a file: everything of it in one place.

```yaml
name: cell                    # optional
mode: parallel                # or sequential
policy: halt_all              # or halt_member
loop: false
members:                      # in order of their turns
  - robot: ur5e_1
    trajectory: handover_ur5e # optional: what the robot has loaded
    dwell: 0.5                # s after its end, sequential mode
    after: kr6_1.frame 120    # before its first frame
  - robot: kr6_1
    trajectory: handover_kr6
    holds:
      - {frame: 200, wait: object cube_1 held by ur5e_1}
```
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from mrlab_ros.core.errors import BadInput
from mrlab_ros.core.systems.robot_system import Policy
from mrlab_ros.core.systems.timeline import Member, Mode
from mrlab_ros.core.systems.waits import Wait, parse

SYSTEM_KEYS = ("name", "mode", "policy", "loop", "members")
MEMBER_KEYS = ("robot", "trajectory", "dwell", "after", "wait", "holds")
HOLD_KEYS = ("frame", "after", "wait")


@dataclass(frozen=True)
class Cell:
    """A system as its file describes it; an empty name lets the coordinator choose one."""

    name: str
    mode: Mode
    policy: Policy
    loop: bool
    members: tuple[Member, ...]


def _checked(entry: Any, keys: tuple[str, ...], place: str) -> Mapping[str, Any]:
    if not isinstance(entry, Mapping):
        raise BadInput(f"{place} is {entry!r}; expected keys out of {', '.join(keys)}")
    unknown = [str(key) for key in entry if key not in keys]
    if unknown:
        raise BadInput(
            f"{place} has the unknown key {', '.join(unknown)}; expected {', '.join(keys)}"
        )
    return entry


def _choice(entry: Mapping[str, Any], key: str, kind: type[Mode] | type[Policy]) -> Any:
    value = str(entry.get(key, next(iter(kind)).name)).upper()
    if value not in kind.__members__:
        names = " or ".join(name.lower() for name in kind.__members__)
        raise BadInput(f"{key} is {entry[key]!r}; expected {names}")
    return kind[value]


def _number(entry: Mapping[str, Any], key: str, kind: type[int] | type[float], place: str) -> Any:
    value = entry.get(key, 0)
    if isinstance(value, bool) or not isinstance(value, (int, kind)) or value < 0:
        raise BadInput(f"{key} of {place} is {value!r}; expected a number, 0 or larger")
    return kind(value)


def _waits(entry: Mapping[str, Any], frame: int) -> list[Wait]:
    texts = []
    for key, prefix in (("after", "after "), ("wait", "")):
        values = entry.get(key, [])
        for value in values if isinstance(values, list) else [values]:
            texts.append(f"frame {frame}: {prefix}{value}")
    return [parse(text) for text in texts]


def _member(entry: Any, number: int) -> Member:
    place = f"member {number}"
    entry = _checked(entry, MEMBER_KEYS, place)
    if not isinstance(entry.get("robot"), str):
        raise BadInput(f"{place} names no robot; expected robot: and its name in the scene")
    place = f"member {entry['robot']}"
    waits = _waits(entry, 0)
    for hold in entry.get("holds", []):
        hold = _checked(hold, HOLD_KEYS, f"a hold of {place}")
        waits += _waits(hold, _number(hold, "frame", int, f"a hold of {place}"))
    return Member(
        robot=entry["robot"],
        trajectory_id=str(entry.get("trajectory", "")),
        dwell=_number(entry, "dwell", float, place),
        waits=tuple(waits),
    )


def read(document: Any) -> Cell:
    """Return the cell that a parsed file describes; raise BadInput that names the place."""
    document = _checked(document, SYSTEM_KEYS, "the file")
    members = document.get("members")
    if not isinstance(members, list) or not members:
        raise BadInput("the file names no members; expected a list of at least one robot")
    loop = document.get("loop", False)
    if not isinstance(loop, bool):
        raise BadInput(f"loop is {loop!r}; expected true or false")
    return Cell(
        name=str(document.get("name", "")),
        mode=_choice(document, "mode", Mode),
        policy=_choice(document, "policy", Policy),
        loop=loop,
        members=tuple(_member(entry, i + 1) for i, entry in enumerate(members)),
    )
