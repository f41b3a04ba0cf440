"""Access of people to keys: one policy for the pages, the socket and zenoh's access control.

It is read from the allow-list (config/bridge.yaml). zenoh's rule applies to a message where its
key expression includes the message's whole key expression: a person who may call `*/play` but not
`*/load` cannot query `**` either. A deny rule overrides every allow rule; anything that no rule
names is denied. Flows are seen from the bridge: ingress is what clients send.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from enum import Enum
from typing import Any

from mrlab_ros.core.bridge.assets import ASSETS, SCHEMA
from mrlab_ros.core.bridge.links import LOCAL_PROTOCOL, key_of
from mrlab_ros.core.bridge.rules import (
    Direction,
    Role,
    Rules,
    RuleT,
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
# Bytes that an attachment, such as stamps, may add to a message of the largest size.
ATTACHED = 1024
# The lab's own subject at a router; a person's name cannot contain a space.
LAB = "the lab"
# The user of the lab's own machine.
HERE = "this machine"


class Login(Enum):
    """How a client authenticates."""

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
    """A person who may connect; common_name: of the certificate, never reused."""

    name: str
    role: Role
    common_name: str


def access_control(
    rules: Rules,
    people: Iterable[Person],
    login: Login,
    prefix: str = "",
    labs: Mapping[str, str] | None = None,
    *,
    local: bool = False,
) -> dict[str, Any]:
    """Return zenoh's `access_control` for a lab that forwards what `rules` name below `prefix`.

    prefix: of what people may do; in the router of several labs a part of it is `*`. labs: for a
    router, the common name of the certificate with which each lab connects, and the prefix below
    which that lab may do everything. local: who connects through a Unix socket, which the system
    guards, may do everything.
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
    trusted: list[tuple[str, str, dict[str, Any]]] = [
        (
            LAB if below == prefix else f"{LAB} {below}",
            below,
            {"link_protocols": list(LINKS), "cert_common_names": [cn]},
        )
        for cn, below in (labs or {}).items()
    ]
    if local:
        trusted.append((HERE, prefix, {"link_protocols": [LOCAL_PROTOCOL]}))
    for subject_id, below, proof in trusted:
        rule = _lab_rule(below)
        found.append(rule)
        subjects.append({"id": subject_id, **proof})
        policies.append({"id": subject_id, "rules": [rule["id"]], "subjects": [subject_id]})
    return {
        "enabled": True,
        "default_permission": "deny",
        "rules": found,
        "subjects": subjects,
        "policies": policies,
    }


def bounds(rules: Rules, prefix: str = "") -> dict[str, list[dict[str, Any]]]:
    """Return zenoh's settings, path -> value, that bound what clients publish.

    zenoh drops what is too large or comes too often from one session before the bridge receives
    it. Its rules have no order: where patterns overlap, all have the largest of their bounds, and
    the bridge checks the bound of the rule that decides.
    """
    topics = [rule for rule in rules.topics if rule.direction is Direction.IN]
    sizes, rates = [], []
    for topic in topics:
        alike = [one for one in topics if overlap(_parts(one.name), _parts(topic.name))]
        key = _key(topic.name, prefix)
        sizes.append(
            {
                "messages": ["put", "reply"],
                "flows": ["ingress"],
                "key_exprs": [key, f"{key}/@adv/**"],
                "size_limit": max(one.max_size for one in alike) + ATTACHED,
            }
        )
        if all(one.max_rate for one in alike):
            rates.append({"key_expr": key, "freq": max(one.max_rate for one in alike)})
    found = {"low_pass_filter": sizes} if sizes else {}
    if rates:
        limited = {"messages": ["put"], "flows": ["ingress"], "rules": rates}
        found["downsampling"] = [limited]
    return found


def role_rules(rules: Rules, role: Role, prefix: str = "") -> list[dict[str, Any]]:
    """Return zenoh's rules for the people of one role."""
    everything, history, statistics = _all_keys(prefix)
    # Topics come last: a topic must not allow the service of the same name.
    queried = [_Entry(rule.name, rule.type, role.may(rule.role)) for rule in rules.services]
    messages = []
    for topic in rules.topics:
        comes_in = topic.direction is Direction.IN
        messages.append(_Entry(topic.name, topic.type, comes_in and role.may(topic.role)))
        if not comes_in:
            queried.append(_Entry(topic.name, topic.type, True))
    queries, queries_not = _divided(queried, prefix)
    published, published_not = _divided(messages, prefix)
    histories = [f"{key}/@adv/**" for key in published]
    seen = [TOKENS, history]
    answered = [*queries, *_asset_keys(prefix), statistics, history]
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
    rule("queries", "ingress", ["query"], answered)
    rule("queries_not", "ingress", ["query"], queries_not, "deny")
    rule("finds_queryables", "egress", ["declare_queryable"], answered)
    rule("receives_replies", "egress", ["reply"], [everything, statistics, history])
    rule("watches_tokens", "ingress", ["liveliness_query", "declare_liveliness_subscriber"], seen)
    rule("receives_tokens", "egress", ["liveliness_token"], seen)
    rule("publishes", "ingress", ["put"], [*published, *histories])
    rule("publishes_not", "ingress", ["put"], published_not, "deny")
    rule("finds_subscribers", "egress", ["declare_subscriber"], [*published, *histories])
    # The bridge queries clients for the history of latched topics that come in.
    rule("offers_history", "ingress", ["declare_queryable", "liveliness_token"], histories)
    rule("is_queried_for_history", "egress", ["query", "liveliness_query"], histories)
    rule("has_history_watched", "egress", ["declare_liveliness_subscriber"], histories)
    rule("replies_history", "ingress", ["reply"], [*published, *histories])
    return found


def _all_keys(prefix: str) -> list[str]:
    """Return the keys of messages and services, of histories, and of the bridge itself.

    A wildcard does not match parts that begin with @.
    """
    return [key_of(name, prefix) for name in ("/**", "/**/@adv/**", "/@mrlab/**")]


def _asset_keys(prefix: str) -> list[str]:
    """Return the keys of what a client draws and decodes with; everybody may get them."""
    return [key_of(f"/{name}", prefix) for name in (f"{ASSETS}/**", SCHEMA)]


def _lab_rule(prefix: str) -> dict[str, Any]:
    """Return the rule that allows the lab everything below its prefix at a router."""
    return {
        "id": f"everything_below_{prefix}",
        "permission": "allow",
        "flows": ["ingress", "egress"],
        "messages": list(MESSAGES),
        "key_exprs": [*_all_keys(prefix), TOKENS],
    }


@dataclass(frozen=True)
class _Entry:
    """A line of the allow-list, and whether a role may use it."""

    name: str
    type: str
    allowed: bool


def _divided(entries: list[_Entry], prefix: str) -> tuple[list[str], list[str]]:
    """Return the keys to allow, and the keys to deny because an allowed one overlaps them.

    In the allow-list the first entry that fits a name and its type decides. zenoh's rules have
    neither order nor type; where that matters, more is denied, never more allowed.
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
    """Return whether a name can match both patterns, given as parts with `*` and `**`."""
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
    """Return the key expression of an allow-list name in zenoh's canonical form."""
    parts: list[str] = []
    for part in _parts(name):
        if parts[-1:] == ["**"] and part == "*":
            parts.insert(len(parts) - 1, part)
        elif parts[-1:] != ["**"] or part != "**":
            parts.append(part)
    return key_of("/" + "/".join(parts), prefix)


# Assets that clients draw the lab from; offered beside the graph, to everybody who may connect.
OFFERED = ("assets", "schema")


class Verb(Enum):
    """Uses of a key by a person."""

    RECEIVE = "receive"  # subscribe to a topic, or get its newest message or an asset
    PUBLISH = "publish"  # put a message on a topic
    CALL = "call"  # query a service


class Policy:
    """The role that each verb needs on each key; keys have no prefix: `ur5e_1/play`.

    rules: the allow-list that it is read from.
    """

    def __init__(self, rules: Rules) -> None:
        self.rules = rules

    def may(self, role: Role, verb: Verb, key: str, *, own: bool = False) -> bool:
        """Return whether a role may do this; own: with what belongs to the person who asks.

        Only the gateway knows what belongs to whom. Over zenoh itself nothing is one's own.
        """
        needed = self.needed(verb, key, own=own)
        return needed is not None and role.may(needed)

    def needed(self, verb: Verb, key: str, *, own: bool = False) -> Role | None:
        """Return the least role that may do this; None where nobody may."""
        name = f"/{key}"
        if verb is Verb.CALL:
            services = list(_fitting(self.rules.services, name))
            return _strictest(rule.needed(own=own) for rule in services)
        topics = list(_fitting(self.rules.topics, name))
        if verb is Verb.PUBLISH:
            if any(rule.direction is not Direction.IN for rule in topics):
                return None
            return _strictest(rule.needed(own=own) for rule in topics)
        if topics or key.partition("/")[0] in OFFERED:
            return Role.DISPLAY
        return None

    def moves(self, key: str) -> bool:
        """Return whether a call of a service may move or change something."""
        rules = list(_fitting(self.rules.services, f"/{key}"))
        return not rules or any(rule.moves for rule in rules)

    def urgent(self, key: str) -> bool:
        """Return whether a call of a service stops something."""
        rules = list(_fitting(self.rules.services, f"/{key}"))
        return bool(rules) and all(rule.urgent for rule in rules)


def _fitting(rules: Iterable[RuleT], name: str) -> Iterator[RuleT]:
    """Return the rules of which one decides about `name`, whatever its type is."""
    for rule in rules:
        if rule.pattern.fullmatch(name):
            yield rule
            if not rule.type:
                return


def _strictest(roles: Iterable[Role]) -> Role | None:
    return max(roles, key=list(Role).index, default=None)
