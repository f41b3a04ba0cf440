"""Which trajectories a person sees: their own, the lab's, shared ones; instructors see all."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from mrlab_ros.core.base.diagnostic import Diagnostic, to_texts
from mrlab_ros.core.bridge.rules import Role
from mrlab_ros.gateway.lab.definitions import Definitions
from mrlab_ros.gateway.people.person import Person
from mrlab_ros.gateway.uploads.diagnostics import NOT_AMONG_YOURS

CATALOGUE = "mrlab_msgs/msg/TrajectoryCatalogue"
TRAJECTORY = "mrlab_msgs/msg/Trajectory"
GET = "mrlab_msgs/srv/GetTrajectory_Response"
LIST = "mrlab_msgs/srv/ListTrajectories_Response"


def sees(person: Person, info: Any) -> bool:
    """Return whether a person sees the trajectory of a TrajectoryInfo."""
    return (
        info.shared
        or not info.owner
        or info.owner == person.id
        or person.role.may(Role.INSTRUCTOR)
    )


class Visibility:
    """Takes out of messages and responses what a person does not see."""

    def __init__(self, definitions: Definitions) -> None:
        self._definitions = definitions
        self._messages: dict[str, Callable[[Person, bytes], bytes | None]] = {
            "trajectories": lambda person, payload: self._listed(person, CATALOGUE, payload),
            "trajectories/converted": self._converted,
        }
        self._responses: dict[str, Callable[[Person, bytes], bytes]] = {
            "converter/list": lambda person, payload: self._listed(person, LIST, payload),
            "converter/get": self._got,
        }

    def concerns(self, key: str) -> bool:
        """Return whether the messages of a topic differ from person to person."""
        return key in self._messages

    def message(self, person: Person, key: str, payload: bytes) -> bytes | None:
        """Return a message as a person sees it; None: not at all."""
        limit = self._messages.get(key)
        return payload if limit is None or _sees_all(person) else limit(person, payload)

    def response(self, person: Person, service: str, payload: bytes) -> bytes:
        """Return a service's response as a person sees it."""
        limit = self._responses.get(service)
        return payload if limit is None or _sees_all(person) else limit(person, payload)

    def _listed(self, person: Person, type_name: str, payload: bytes) -> bytes:
        found = self._definitions.decode(type_name, payload)
        seen = [info for info in found.trajectories if sees(person, info)]
        if len(seen) == len(found.trajectories):
            return payload
        found.trajectories = seen
        return self._definitions.encode(type_name, found)

    def _converted(self, person: Person, payload: bytes) -> bytes | None:
        found = self._definitions.decode(TRAJECTORY, payload)
        return payload if sees(person, found.info) else None

    def _got(self, person: Person, payload: bytes) -> bytes:
        found = self._definitions.decode(GET, payload)
        if not found.success or sees(person, found.trajectory.info):
            return payload
        return self._definitions.encode(
            GET,
            refusal(NOT_AMONG_YOURS(trajectory=found.trajectory.info.id)),
        )


def refusal(why: Diagnostic) -> dict[str, Any]:
    """Return the fields of a response that says why not."""
    values = [{"key": key, "value": text} for key, text in to_texts(why.values).items()]
    return {"message": str(why), "code": why.code, "values": values}


def _sees_all(person: Person) -> bool:
    return person.role.may(Role.INSTRUCTOR)
