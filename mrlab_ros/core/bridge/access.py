"""Who may do what over zenoh: access-control rules from the allow-list and the people's roles.

zenoh lets a message pass a link where a rule's key expression includes the message's whole key
expression. So who may call `*/play` and not `*/load` cannot ask `**` either. A deny rule wins
over every allow rule; what no rule names is denied. Flows are the bridge's: ingress comes from a
client.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from enum import Enum
from typing import Any

from mrlab_ros.core.bridge.rules import (
    Direction,
    Role,
    Rules,
    key_of,
)

TOKENS = "@/*/@ros2_lv/**"
LINKS = ("tls", "quic")
# All kinds of messages that zenoh's access control knows.
MESSAGES = (
    "put",
    "delete",
    "declare_subscriber",
    "query",
    "declare_queryable",
    "reply",
    "liveliness_token",
    "declare_liveliness_subscriber",
    "liveliness_query",
)
# The lab among a router's subjects; no person's name has a space.
LAB = "the lab"


class Login(Enum):
    """How a client proves who it is."""

    CERTIFICATE = "certificate"  # mutual TLS
    PASSWORD = "password"  # TLS, then user name and password
    BOTH = "both"

    @property
    def by_certificate(self) -> bool:
        return self is not Login.PASSWORD

    @property
    def by_password(self) -> bool:
        return self is not Login.CERTIFICATE


@dataclass(frozen=True)
class Person:
    """Somebody who may connect; common_name: of the person's certificate, never used twice."""

    name: str
    role: Role
    common_name: str


def access_control(
    rules: Rules, people: Iterable[Person], login: Login, prefix: str = "", lab: str = ""
) -> dict[str, Any]:
    """Return zenoh's `access_control` for a lab that carries what `rules` name below `prefix`.

    lab: for a router, the common name of the certificate with which the lab itself connects.
    """
    people = list(people)
    subjects, policies = [], []
    for person in people:
        subject: dict[str, Any] = {"id": person.name, "link_protocols": list(LINKS)}
        if login.by_certificate:
            subject["cert_common_names"] = [person.common_name]
        if login.by_password:
            subject["usernames"] = [person.name]
        subjects.append(subject)
    permitted = {role: role_rules(rules, role, prefix) for role in Role}
    for role, entries in permitted.items():
        names = [person.name for person in people if person.role is role]
        if names:
            ids = [entry["id"] for entry in entries]
            policies.append({"id": role.value, "rules": ids, "subjects": names})
    found = [entry for entries in permitted.values() for entry in entries]
    if lab:
        found.append(_lab_rule(prefix))
        subjects.append(
            {"id": LAB, "link_protocols": list(LINKS), "cert_common_names": [lab]},
        )
        policies.append({"id": LAB, "rules": [_lab_rule(prefix)["id"]], "subjects": [LAB]})
    return {
        "enabled": True,
        "default_permission": "deny",
        "rules": found,
        "subjects": subjects,
        "policies": policies,
    }


def role_rules(rules: Rules, role: Role, prefix: str = "") -> list[dict[str, Any]]:
    """Return all of zenoh's rules for the people of one role."""
    everything, history, statistics = _all_keys(prefix)
    # Topics come last: a topic's name must not open a service that has the same one.
    questions = [_Entry(rule.name, rule.type, role.may(rule.role)) for rule in rules.services]
    messages = []
    for topic in rules.topics:
        comes_in = topic.direction is Direction.IN
        messages.append(_Entry(topic.name, topic.type, comes_in and role.may(topic.role)))
        if not comes_in:
            questions.append(_Entry(topic.name, topic.type, True))
    asks, asks_not = _divided(questions, prefix)
    sends, sends_not = _divided(messages, prefix)
    histories = [f"{key}/@adv/**" for key in sends]
    seen = [TOKENS, history]
    found: list[dict[str, Any]] = []

    def rule(
        name: str, flow: str, messages: Sequence[str], keys: list[str], permission: str = "allow"
    ) -> None:
        if keys:
            found.append(
                {
                    "id": f"{role.value}_{name}",
                    "permission": permission,
                    "flows": [flow],
                    "messages": list(messages),
                    "key_exprs": keys,
                }
            )

    rule("subscribes", "ingress", ["declare_subscriber"], [everything, history])
    rule("receives", "egress", ["put"], [everything, history])
    rule("asks", "ingress", ["query"], [*asks, statistics, history])
    rule("asks_not", "ingress", ["query"], asks_not, "deny")
    rule("finds", "egress", ["declare_queryable"], [*asks, statistics, history])
    rule("is_answered", "egress", ["reply"], [everything, statistics, history])
    rule("looks", "ingress", ["liveliness_query", "declare_liveliness_subscriber"], seen)
    rule("sees", "egress", ["liveliness_token"], seen)
    rule("sends", "ingress", ["put"], [*sends, *histories])
    rule("sends_not", "ingress", ["put"], sends_not, "deny")
    rule("is_heard", "egress", ["declare_subscriber"], [*sends, *histories])
    # The history of a latched topic that comes in: the bridge asks the client for it.
    rule("keeps", "ingress", ["declare_queryable", "liveliness_token"], histories)
    rule("is_asked", "egress", ["query", "liveliness_query"], histories)
    rule("is_watched", "egress", ["declare_liveliness_subscriber"], histories)
    rule("answers", "ingress", ["reply"], [*sends, *histories])
    return found


def _all_keys(prefix: str) -> list[str]:
    """Return the keys of messages and services, of histories, and of the bridge itself.

    A wildcard includes no part that begins with an @.
    """
    return [key_of(name, prefix) for name in ("/**", "/**/@adv/**", "/@mrlab/**")]


def _lab_rule(prefix: str) -> dict[str, Any]:
    """Return the rule of the lab at a router, which may do everything below its prefix."""
    return {
        "id": "lab_does_everything",
        "permission": "allow",
        "flows": ["ingress", "egress"],
        "messages": list(MESSAGES),
        "key_exprs": [*_all_keys(prefix), TOKENS],
    }


@dataclass(frozen=True)
class _Entry:
    """A line of the allow-list, and whether a role may use what it names."""

    name: str
    type: str
    allowed: bool


def _divided(entries: list[_Entry], prefix: str) -> tuple[list[str], list[str]]:
    """Return the keys to allow, and those to deny as an allowed one would include some of them.

    The first entry that fits a name and its type decides. zenoh knows neither order nor type:
    where they matter, more is denied, never more allowed.
    """
    allow, deny = [], []
    for i, entry in enumerate(entries):
        if entry.allowed:
            allow.append(_key(entry.name, prefix))
            continue
        for j, other in enumerate(entries):
            decides = j > i or other.type not in ("", entry.type)
            if other.allowed and decides and overlap(_parts(entry.name), _parts(other.name)):
                deny.append(_key(entry.name, prefix))
                break
    return allow, deny


def overlap(one: Sequence[str], other: Sequence[str]) -> bool:
    """Return whether some name fits both; given as parts, `*` and `**` as in the allow-list."""
    if not one or not other:
        return all(part == "**" for part in (*one, *other))
    if one[0] == "**":
        return overlap(one[1:], other) or overlap(one, other[1:])
    if other[0] == "**":
        return overlap(other, one)
    return (one[0] == other[0] or "*" in (one[0], other[0])) and overlap(one[1:], other[1:])


def _parts(name: str) -> list[str]:
    return name[1:].split("/")


def _key(name: str, prefix: str) -> str:
    """Return the key expression of an allow-list name in the one form that zenoh accepts."""
    parts: list[str] = []
    for part in _parts(name):
        if parts[-1:] == ["**"] and part == "*":
            parts.insert(len(parts) - 1, part)
        elif parts[-1:] != ["**"] or part != "**":
            parts.append(part)
    return key_of("/" + "/".join(parts), prefix)
