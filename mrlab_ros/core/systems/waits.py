"""The conditions for which a member of a robot system waits before it plays past a frame.

A wait is written as `frame 0: after kr6_1.frame 120`, `frame 200: object cube_1 held by ur5e_1` or
`frame 310: object cube_1 free`.
"""

from __future__ import annotations

import re
from dataclasses import dataclass

from mrlab_ros.core.base.errors import BadInput
from mrlab_ros.core.systems.diagnostics import BAD_WAIT

GRAMMAR = re.compile(
    r"frame (?P<frame>\d+): (?:"
    r"after (?P<other>\w+)\.frame (?P<number>\d+)"
    r"|object (?P<held>\w+) held by (?P<holder>\w+)"
    r"|object (?P<free>\w+) free"
    r")"
)


@dataclass(frozen=True)
class AfterFrame:
    """True once `robot`, a member of the same system, has reached its source frame."""

    robot: str
    frame: int


@dataclass(frozen=True)
class Held:
    """True while `robot` holds `object`; with robot None: while no robot holds it."""

    object: str
    robot: str | None


@dataclass(frozen=True)
class Wait:
    """The condition must have been true once before the member plays past `frame`."""

    frame: int
    condition: AfterFrame | Held
    text: str


def parse(text: str) -> Wait:
    """Parse the text of a wait; raise BadInput where it does not follow the grammar."""
    match = GRAMMAR.fullmatch(" ".join(text.split()))
    if match is None:
        raise BadInput(BAD_WAIT(wait=text))
    condition: AfterFrame | Held
    if match["other"]:
        condition = AfterFrame(match["other"], int(match["number"]))
    elif match["held"]:
        condition = Held(match["held"], match["holder"])
    else:
        condition = Held(match["free"], None)
    return Wait(int(match["frame"]), condition, " ".join(text.split()))
