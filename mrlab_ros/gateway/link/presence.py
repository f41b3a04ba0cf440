"""Presence in the room: a display says where it is; name and role are those of the sign-in.

Objects held by clients are released when the client leaves.
"""

from __future__ import annotations

import math
import struct
from collections.abc import Iterator
from typing import Any

from mrlab_ros.core.base.errors import BadInput
from mrlab_ros.core.bridge.rules import Role
from mrlab_ros.gateway.errors import NotAllowed
from mrlab_ros.gateway.lab.definitions import Definitions, plain
from mrlab_ros.gateway.link.diagnostics import BAD_DISPLAY_ID, DISPLAY_TAKEN, DISPLAY_TOO_FAR
from mrlab_ros.gateway.people.person import Person

KEY = "presence"
TYPE = "mrlab_msgs/msg/Presence"
LONGEST_ID = 64
FRAME = "world"
# s between two messages of a display, at least: 20 a second, and what a network bunches.
PERIOD = 0.04
# m: nobody is farther from the lab's origin.
FARTHEST = 1000.0
WATCHES, DRIVES, TEACHES = 0, 1, 2


def part_of(role: Role) -> int:
    """Return what somebody of a role does in the room, as in Presence.msg."""
    if role.may(Role.INSTRUCTOR):
        return TEACHES
    return DRIVES if role.may(Role.OPERATOR) else WATCHES


def display(payload: bytes) -> str:
    """Return the id of the display that a Presence is of; empty where the payload is too short.

    Read from the CDR itself: it is asked for once for each message and each client.
    """
    order = "<" if payload[1:2] == b"\x01" else ">"
    try:
        # Behind the CDR header: the stamp (8 bytes), then two strings, each aligned to 4.
        at = 4 + 8
        (frame,) = struct.unpack_from(f"{order}I", payload, at)
        at += 4 + frame
        at += -at % 4
        (length,) = struct.unpack_from(f"{order}I", payload, at)
    except struct.error:
        return ""
    return payload[at + 4 : at + 4 + max(length - 1, 0)].decode(errors="replace")


class Displays:
    """Which client each display belongs to. Times are s, monotonic."""

    def __init__(self, definitions: Definitions) -> None:
        self._definitions = definitions
        # By a client's token: its display, and when it last said where it is.
        self._seen: dict[str, tuple[str, float]] = {}

    def admit(self, token: str, person: Person, payload: bytes, now: float) -> bytes | None:
        """Return a Presence as the lab gets it; None: it comes too soon after the last one.

        Raises BadInput where it is none, and NotAllowed for the id of another client's display.
        """
        message = self._definitions.decode(TYPE, payload)
        owner = next((each for each, (name, _) in self._seen.items() if name == message.id), token)
        if not 1 <= len(message.id) <= LONGEST_ID or not message.id.isprintable():
            raise BadInput(BAD_DISPLAY_ID(id=message.id[:80], most=LONGEST_ID))
        if owner != token:
            raise NotAllowed(DISPLAY_TAKEN(id=message.id))
        for value in _numbers(message):
            if not math.isfinite(value) or abs(value) > FARTHEST:
                raise BadInput(DISPLAY_TOO_FAR(id=message.id, at=value, most=FARTHEST))
        name, last = self._seen.get(token, (message.id, -math.inf))
        if name == message.id and now - last < PERIOD and not message.away:
            return None
        self._seen[token] = message.id, now
        message.name = person.name
        message.part = part_of(person.role)
        # The lab's frame, or that of another place or display in which the poses are measured.
        frame = message.header.frame_id
        if not 1 <= len(frame) <= LONGEST_ID or not frame.isprintable():
            message.header.frame_id = FRAME
        if message.away:
            del self._seen[token]
        return self._definitions.encode(TYPE, message)

    def leave(self, token: str, person: Person) -> bytes | None:
        """Return what says that a client's display is gone; None: it has none."""
        if token not in self._seen:
            return None
        name, _ = self._seen.pop(token)
        gone: dict[str, Any] = {
            "id": name,
            "name": person.name,
            "part": part_of(person.role),
            "away": True,
        }
        return self._definitions.encode(TYPE, gone)


LOOK, LOOK_TYPE = "look_here", "mrlab_msgs/msg/LookHere"
# What displays send to each other.
SHARED = (KEY, LOOK)


def signed(definitions: Definitions, person: Person, payload: bytes) -> bytes:
    """Return a LookHere of a person, as CDR, with the name of the sign-in.

    Raises BadInput where it is none.
    """
    message = definitions.decode(LOOK_TYPE, payload)
    for value in (message.point.x, message.point.y, message.point.z):
        if not math.isfinite(value) or abs(value) > FARTHEST:
            raise BadInput(DISPLAY_TOO_FAR(id=person.name, at=value, most=FARTHEST))
    message.name, message.header.frame_id = person.name, FRAME
    return definitions.encode(LOOK_TYPE, message)


def _numbers(message: Any) -> Iterator[float]:
    for pose in (message.head, message.left, message.right):
        yield from _of_pose(pose)


def _of_pose(pose: Any) -> Iterator[float]:
    for part in (pose.position, pose.orientation):
        yield from (part.x, part.y, part.z)
    yield pose.orientation.w


SERVICE = "physics/move_object"
REQUEST = "mrlab_msgs/srv/MoveObject_Request"
MOVES, MOVE = "moves", "mrlab_msgs/msg/Move"


class Hands:
    """Holders of objects, by the calls that the lab has carried out, and where they are."""

    def __init__(self, definitions: Definitions) -> None:
        self._definitions = definitions
        # By an object: the token of the client that has it, and its last pose, as plain fields.
        self._held: dict[str, tuple[str, Any]] = {}

    def note(self, token: str, payload: bytes) -> None:
        """Note a MoveObject of a client, as CDR, that the lab has carried out."""
        request = self._definitions.decode(REQUEST, payload)
        if request.held:
            self._held[request.name] = token, plain(request)["pose"]
        else:
            self._held.pop(request.name, None)

    def follow(self, token: str, payload: bytes) -> bool:
        """Note a Move of a client, as CDR; return whether the lab may need it.

        Raises BadInput where it is none.
        """
        move = self._definitions.decode(MOVE, payload)
        if not move.object:
            return True
        finite = all(math.isfinite(value) for value in _of_pose(move.pose))
        mine = finite and self._held.get(move.object, ("",))[0] == token
        if mine:
            self._held[move.object] = token, plain(move)["pose"]
        return mine

    def held_by(self, token: str) -> dict[str, bytes]:
        """Return by object the call, as CDR, by which a client's hands let go where they were."""
        calls = {}
        for name, (owner, pose) in self._held.items():
            if owner == token:
                still = {"name": name, "pose": pose, "held": False}
                calls[name] = self._definitions.encode(REQUEST, still)
        return calls

    def forget(self, token: str, name: str) -> None:
        """Note that a client's hands let go of an object; another one may have it since."""
        if self._held.get(name, ("",))[0] == token:
            del self._held[name]


MEASURED = "physics/set_surfaces"
SURFACES = "mrlab_msgs/srv/SetSurfaces_Request"


class Measurers:
    """The client that measured the surfaces of each source, by the calls that succeeded."""

    def __init__(self, definitions: Definitions) -> None:
        self._definitions = definitions
        self._owners: dict[str, str] = {}

    def note(self, token: str, payload: bytes) -> None:
        """Note a SetSurfaces of a client, as CDR, that the lab has carried out."""
        request = self._definitions.decode(SURFACES, payload)
        if not request.source:
            self._owners.clear()
        elif request.surfaces:
            self._owners[request.source] = token
        else:
            self._owners.pop(request.source, None)

    def leave(self, token: str) -> list[bytes]:
        """Forget a client; return the calls, as CDR, that take its surfaces out of the room."""
        gone = [source for source, owner in self._owners.items() if owner == token]
        for source in gone:
            del self._owners[source]
        return [self._definitions.encode(SURFACES, {"source": source}) for source in gone]
