"""Rights that each route needs: the same policy as the lab's keys have, route by route.

A route without a line here answers nobody: a new route cannot be open by mistake.
"""

from __future__ import annotations

import logging
import threading
import time
from collections.abc import Mapping
from dataclasses import dataclass
from enum import Enum
from pathlib import Path
from typing import Annotated

import yaml
from fastapi import Depends
from fastapi.requests import HTTPConnection

from mrlab_ros.adapters.share import directory
from mrlab_ros.adapters.yaml_files import Loader
from mrlab_ros.core.base.errors import BadInput
from mrlab_ros.core.bridge.access import Policy, Verb
from mrlab_ros.core.bridge.rules import Role, parse
from mrlab_ros.core.runtime.bucket import Occurrences
from mrlab_ros.extensions import extensions
from mrlab_ros.gateway.diagnostics import (
    ALLOW_LIST_UNREADABLE,
    NO_ROLE_MAY,
    NOT_SIGNED_IN,
    ROLE_TOO_LOW,
    ROUTE_WITHOUT_POLICY,
)
from mrlab_ros.gateway.errors import NotAllowed, NotSignedIn
from mrlab_ros.gateway.people.person import KnownPerson, Person


class Everybody(Enum):
    """No sign-in is needed: the sign-in itself, health, and the pages."""

    EVERYBODY = "everybody"


@dataclass(frozen=True)
class Need:
    """The right that a route needs: a verb on a key of the lab.

    own: the right to one's own is enough; the route checks whose it is.
    """

    verb: Verb
    key: str
    own: bool = False


log = logging.getLogger("mrlab.gateway")
_refused, _refusing = Occurrences(), threading.Lock()

EVERYBODY = Everybody.EVERYBODY
CONVERTS_OWN = Need(Verb.CALL, "converter/convert", own=True)
READS = Need(Verb.CALL, "converter/get")
DRIVES = Need(Verb.CALL, "robot/play")
SOCKET = "WEBSOCKET"

ROUTES: Mapping[tuple[str, str], Everybody | Role | Need] = {
    ("GET", "/healthz"): EVERYBODY,
    ("GET", "/ca"): EVERYBODY,
    ("GET", "/ca.css"): EVERYBODY,
    ("GET", "/ca.pem"): EVERYBODY,
    ("GET", "/{path:path}"): EVERYBODY,
    ("HEAD", "/{path:path}"): EVERYBODY,
    ("GET", "/api/session"): EVERYBODY,
    ("POST", "/api/session"): EVERYBODY,
    ("DELETE", "/api/session"): EVERYBODY,
    ("GET", "/api/oidc/start"): EVERYBODY,
    ("GET", "/api/oidc/callback"): EVERYBODY,
    ("GET", "/api/invitations/{token}"): EVERYBODY,
    ("POST", "/api/invitations/{token}"): EVERYBODY,
    ("POST", "/api/pairings"): EVERYBODY,
    ("GET", "/api/pairings/{secret}"): EVERYBODY,
    # A device can let no further device in.
    ("GET", "/api/pairings/shown/{code}"): Role.STUDENT,
    ("POST", "/api/pairings/approve"): Role.STUDENT,
    ("GET", "/api/people"): Role.INSTRUCTOR,
    ("POST", "/api/people"): Role.INSTRUCTOR,
    ("POST", "/api/people/{name}/invitation"): Role.INSTRUCTOR,
    ("PATCH", "/api/people/{name}"): Role.INSTRUCTOR,
    ("DELETE", "/api/people/{name}"): Role.INSTRUCTOR,
    ("POST", "/api/tokens"): Role.DISPLAY,
    ("GET", "/api/devices"): Role.STUDENT,
    ("DELETE", "/api/devices/{sign_in}"): Role.STUDENT,
    ("PUT", "/api/uploads/{file_name}"): CONVERTS_OWN,
    ("PUT", "/api/uploads/"): CONVERTS_OWN,
    ("POST", "/api/conversions"): CONVERTS_OWN,
    ("GET", "/api/motions/{motion}"): READS,
    ("PUT", "/api/live/{file_name}"): CONVERTS_OWN,
    ("GET", "/api/live"): READS,
    ("GET", "/api/live/{draft}/file"): CONVERTS_OWN,
    ("GET", "/api/robots"): READS,
    ("GET", "/api/schema"): Need(Verb.RECEIVE, "assets"),
    ("POST", "/api/robots/{robot}/play"): DRIVES,
    ("POST", "/api/robots/{robot}/stop"): Need(Verb.CALL, "robot/stop"),
    ("GET", "/api/trajectories"): Need(Verb.CALL, "converter/list"),
    ("POST", "/api/trajectories"): CONVERTS_OWN,
    ("GET", "/api/trajectories/{trajectory:path}/motion"): READS,
    ("GET", "/api/trajectories/{trajectory:path}/sketch"): READS,
    ("GET", "/api/trajectories/{trajectory:path}/versions"): READS,
    ("GET", "/api/trajectories/{trajectory:path}/file"): READS,
    ("PATCH", "/api/trajectories/{trajectory:path}"): CONVERTS_OWN,
    ("DELETE", "/api/trajectories/{trajectory:path}"): CONVERTS_OWN,
    ("POST", "/api/trajectories/{trajectory:path}/restore"): CONVERTS_OWN,
    # A person who may play a motion may have it checked; all may read the findings.
    ("POST", "/api/checks"): DRIVES,
    ("GET", "/api/checks"): READS,
    ("DELETE", "/api/checks"): DRIVES,
    ("GET", "/api/checks/drafts/{draft}"): CONVERTS_OWN,
    ("GET", "/assets/{path:path}"): Need(Verb.RECEIVE, "assets"),
    ("HEAD", "/assets/{path:path}"): Need(Verb.RECEIVE, "assets"),
    # The socket itself checks the rights of the keys that it is asked for.
    (SOCKET, "/link"): Role.DISPLAY,
    **{
        route: EVERYBODY if role == EVERYBODY.value else Role(role)
        for each in extensions()
        for route, role in each.POLICY.items()
    },
}


def may(person: Person, policy: Policy, verb: Verb, key: str, *, own: bool = False) -> bool:
    """Return whether a person may do this; for a socket, and where a route has read the owner."""
    return policy.may(person.role, verb, key, own=own)


def read_policy(allow_list: Path | None) -> Policy:
    """Return the policy of an allow-list, the shipped one where none is named.

    Raises BadInput where the file cannot be read.
    """
    path = allow_list or directory() / "config" / "bridge.yaml"
    try:
        return Policy(parse(yaml.load(path.read_text(), Loader=Loader)))
    except (OSError, yaml.YAMLError) as error:
        raise BadInput(ALLOW_LIST_UNREADABLE(path=str(path), why=str(error))) from error


def policy_of(connection: HTTPConnection) -> Policy:
    """Return the policy of a gateway, as a dependency."""
    found: Policy = connection.app.state.policy
    return found


ThePolicy = Annotated[Policy, Depends(policy_of)]


def authorise(connection: HTTPConnection, policy: ThePolicy, person: KnownPerson) -> None:
    """Refuse a request that its person may not make; a dependency of every route.

    Raises NotSignedIn or NotAllowed.
    """
    method = connection.scope.get("method", SOCKET)
    path = connection.scope["route"].path
    if (method, path) not in ROUTES:
        raise NotAllowed(ROUTE_WITHOUT_POLICY(method=method, path=path))
    need = ROUTES[method, path]
    if isinstance(need, Everybody):
        return
    if person is None:
        raise NotSignedIn(NOT_SIGNED_IN())
    role = policy.needed(need.verb, need.key, own=need.own) if isinstance(need, Need) else need
    if role is None:
        raise NotAllowed(NO_ROLE_MAY())
    if not person.role.may(role):
        with _refusing:
            due = _refused.again((person.id, method, path), time.monotonic())
        if due is not None:
            log.warning("%s may not %s %s (%d times)", person.name, method, path, due)
        raise NotAllowed(
            ROLE_TOO_LOW(person=person.name, role=person.role.value, needed=role.value)
        )
