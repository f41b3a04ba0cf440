"""What the bridge carries: the allow-list, the keys, the rate caps. No zenoh and no ROS here.

Keys, payloads and liveliness tokens are those of zenoh-plugin-ros2dds: the key of a topic or a
service is its name without the leading slash, below an optional prefix.
"""

from __future__ import annotations

import math
import re
from collections.abc import Mapping
from dataclasses import dataclass, fields
from enum import Enum
from functools import cached_property
from typing import Any, Generic, TypeVar

from mrlab_ros.core.errors import BadInput

SECOND = 1_000_000_000
NAME = re.compile(r"(?:/(?:[A-Za-z_][A-Za-z0-9_]*|\*{1,2}))+")
TYPE = re.compile(r"[a-z][a-z0-9_]*/(?:msg|srv)/[A-Za-z][A-Za-z0-9]*")
PREFIX = re.compile(r"[A-Za-z0-9_.-]+(?:/[A-Za-z0-9_.-]+)*")
# A liveliness token holds a key and a type as one chunk each, with this for every slash.
SLASH = "§"


class Direction(Enum):
    """Which way a topic goes."""

    OUT = "out"  # from the graph to zenoh
    IN = "in"  # from zenoh to the graph


class Congestion(Enum):
    """What happens to a message when a link is full."""

    DROP = "drop"  # it is lost: the next one is newer
    BLOCK = "block"  # it waits: each one counts


class Reliability(Enum):
    """What zenoh promises on a link that may lose."""

    RELIABLE = "reliable"
    BEST_EFFORT = "best_effort"


class Role(Enum):
    """What a person may do in a lab with keys; a later role may all that an earlier one may."""

    VIEWER = "viewer"  # watch
    OPERATOR = "operator"  # play robots
    INSTRUCTOR = "instructor"  # change the scene

    def may(self, needed: Role) -> bool:
        """Return whether this role includes `needed`."""
        roles = list(Role)
        return roles.index(self) >= roles.index(needed)


@dataclass(frozen=True)
class TopicRule:
    """One line of the allow-list for topics.

    name: a topic name in which `*` stands for one part and `**` for any number of parts.
    type: the only type that is carried, such as sensor_msgs/msg/JointState; empty: any.
    max_rate: Hz; 0: every message. priority: 1 (first) to 7 (last), zenoh's. express: sent at
    once, not batched. depth: messages kept for the bridge before the oldest is lost. history:
    messages of a latched topic kept for late joiners. role: who may send a topic that comes in;
    whoever may connect may receive one that goes out.
    """

    name: str
    about: str = ""
    type: str = ""
    direction: Direction = Direction.OUT
    max_rate: float = 0.0
    priority: int = 5
    reliability: Reliability = Reliability.RELIABLE
    express: bool = False
    congestion: Congestion = Congestion.BLOCK
    depth: int = 10
    history: int = 1
    role: Role = Role.INSTRUCTOR

    def __post_init__(self) -> None:
        _check_name(self.name)
        _check_type(self.name, self.type, "msg")
        _check(self.name, "max_rate", self.max_rate, 0, 100_000, "Hz, 0 for every message")
        _check(self.name, "priority", self.priority, 1, 7, "1 goes first")
        _check(self.name, "depth", self.depth, 1, 10_000, "messages")
        _check(self.name, "history", self.history, 1, 10_000, "messages")
        if self.direction is Direction.OUT and self.role is not Role.INSTRUCTOR:
            raise BadInput(
                f"the rule for {self.name} has a role but goes out; whoever may connect may "
                "receive it, so leave the role out, or set direction: in"
            )

    @cached_property
    def pattern(self) -> re.Pattern[str]:
        return _pattern(self.name)


@dataclass(frozen=True)
class ServiceRule:
    """One line of the allow-list for services.

    timeout: s within which the graph must answer. waiting: calls that may wait for those before
    them; further ones are refused. role: who may call it.
    """

    name: str
    about: str = ""
    type: str = ""
    timeout: float = 5.0
    waiting: int = 64
    role: Role = Role.INSTRUCTOR

    def __post_init__(self) -> None:
        _check_name(self.name)
        _check_type(self.name, self.type, "srv")
        _check(self.name, "timeout", self.timeout, 0.01, 3600, "s")
        _check(self.name, "waiting", self.waiting, 1, 10_000, "calls")

    @cached_property
    def pattern(self) -> re.Pattern[str]:
        return _pattern(self.name)


RuleT = TypeVar("RuleT", TopicRule, ServiceRule)


@dataclass(frozen=True)
class Rules:
    """The allow-list. The first rule that fits a name and its type decides."""

    topics: tuple[TopicRule, ...] = ()
    services: tuple[ServiceRule, ...] = ()

    def topic(self, name: str, type_name: str) -> TopicRule | None:
        return _first(self.topics, name, type_name)

    def service(self, name: str, type_name: str) -> ServiceRule | None:
        return _first(self.services, name, type_name)


def parse(document: object) -> Rules:
    """Read the allow-list from what the YAML file holds; raise BadInput where it is not one."""
    if not isinstance(document, Mapping) or set(document) - {"topics", "services"}:
        found = ", ".join(map(str, document)) if isinstance(document, Mapping) else document
        raise BadInput(
            f"the bridge's allow-list holds {found!r}; expected the lists topics and services, "
            "as in config/bridge.yaml"
        )
    return Rules(
        tuple(_rule(TopicRule, entry) for entry in document.get("topics") or ()),
        tuple(_rule(ServiceRule, entry) for entry in document.get("services") or ()),
    )


def _rule(kind: type[RuleT], entry: object) -> RuleT:
    if not isinstance(entry, Mapping) or not isinstance(entry.get("name"), str):
        raise BadInput(
            f"the bridge's allow-list holds {entry!r}; expected an entry with a name, such as "
            "{name: /robots}"
        )
    name, known = entry["name"], {f.name: f for f in fields(kind)}
    values: dict[str, Any] = {}
    for field, value in entry.items():
        if field not in known:
            raise BadInput(
                f"the rule for {name} has the field {field!r}; expected one of {', '.join(known)}"
            )
        default = known[field].default
        values[field] = value if field == "name" else _value(name, field, value, default)
    return kind(**values)


def _value(name: str, field: str, value: object, default: object) -> object:
    if isinstance(default, Enum):
        choices = [str(member.value) for member in type(default)]
        if value not in choices:
            raise BadInput(
                f"the rule for {name} has {field}: {value!r}; expected {' or '.join(choices)}"
            )
        return type(default)(value)
    if isinstance(default, float) and type(value) is int:
        return float(value)
    if type(value) is not type(default):
        raise BadInput(
            f"the rule for {name} has {field}: {value!r}; expected a value such as {default!r}"
        )
    return value


def _check_name(name: str) -> None:
    if not NAME.fullmatch(name):
        raise BadInput(
            f"the bridge's allow-list names {name!r}; expected a full name such as "
            "/ur5e_1/joint_states, with * for one part and ** for any parts"
        )


def _check_type(name: str, type_name: str, kind: str) -> None:
    if type_name and (not TYPE.fullmatch(type_name) or f"/{kind}/" not in type_name):
        raise BadInput(
            f"the rule for {name} has the type {type_name!r}; expected package/{kind}/Name, or "
            "none for any type"
        )


def _check(name: str, field: str, value: float, low: float, high: float, unit: str) -> None:
    if not (math.isfinite(value) and low <= value <= high):
        raise BadInput(
            f"the rule for {name} has {field}: {value}; expected {low:g} to {high:g} ({unit})"
        )


def _pattern(name: str) -> re.Pattern[str]:
    parts = {"*": "/[^/]+", "**": "(?:/[^/]+)*"}
    return re.compile("".join(parts.get(p, "/" + p) for p in name[1:].split("/")))


def _first(rules: tuple[RuleT, ...], name: str, type_name: str) -> RuleT | None:
    for rule in rules:
        if rule.type in ("", type_name) and rule.pattern.fullmatch(name):
            return rule
    return None


def checked_prefix(prefix: str) -> str:
    """Return `prefix` where keys may begin with it; raise BadInput otherwise."""
    if prefix and not PREFIX.fullmatch(prefix):
        raise BadInput(
            f"the bridge's prefix is {prefix!r}; expected letters, digits, '_', '-' and '.', in "
            "parts divided by '/', such as lab_1, or nothing"
        )
    return prefix


def key_of(name: str, prefix: str = "") -> str:
    """Return the zenoh key of a topic or service name, such as ur5e_1/joint_states."""
    return f"{prefix}{name}" if prefix else name[1:]


@dataclass(frozen=True)
class TopicQos:
    """What a liveliness token says of a topic's quality of service."""

    reliable: bool
    latched: bool
    depth: int
    type_hash: str = ""

    def __str__(self) -> str:
        """Return <keyless>:<reliability>:<durability>:<history>,<depth>[:<user data>]."""
        text = f":{int(self.reliable)}:{int(self.latched)}:0,{self.depth}"
        return f"{text}:typehash={self.type_hash};" if self.type_hash else text


def bridge_token(zid: str) -> str:
    """Return the key of the liveliness token of the bridge itself."""
    return f"@/{zid}/@ros2_lv"


def topic_token(zid: str, direction: Direction, key: str, type_name: str, qos: TopicQos) -> str:
    """Return the key of a topic's liveliness token: MP for a publisher, MS for a subscriber."""
    kind = "MP" if direction is Direction.OUT else "MS"
    return f"{bridge_token(zid)}/{kind}/{_chunk(key)}/{_chunk(type_name)}/{qos}"


def service_token(zid: str, key: str, type_name: str) -> str:
    """Return the key of a service server's liveliness token."""
    return f"{bridge_token(zid)}/SS/{_chunk(key)}/{_chunk(type_name)}"


def _chunk(text: str) -> str:
    return text.replace("/", SLASH)


ValueT = TypeVar("ValueT")


class RateCap(Generic[ValueT]):
    """Lets the newest value through at most `max_rate` times a second (Hz).

    A value that comes too early is kept and replaced by a newer one; `due_ns` says when to ask
    for it. So the last value of a burst always arrives.
    """

    def __init__(self, max_rate: float) -> None:
        self.period_ns = round(SECOND / max_rate)
        self._next_ns: int | None = None
        self._kept: ValueT | None = None

    @property
    def due_ns(self) -> int | None:
        """When the kept value is due, ns; None while nothing is kept."""
        return None if self._kept is None else self._next_ns

    def offer(self, value: ValueT, now_ns: int) -> ValueT | None:
        """Return `value` where it may go at once; keep it in place of an older one otherwise."""
        self._kept = value
        return self.take(now_ns)

    def take(self, now_ns: int) -> ValueT | None:
        """Return the kept value where it is due, and forget it."""
        if self._kept is None or (self._next_ns is not None and now_ns < self._next_ns):
            return None
        value, self._kept = self._kept, None
        # On the grid while values keep coming, so that the mean rate is max_rate itself.
        on_grid = self._next_ns is not None and now_ns - self._next_ns < self.period_ns
        self._next_ns = (self._next_ns if on_grid and self._next_ns else now_ns) + self.period_ns
        return value
