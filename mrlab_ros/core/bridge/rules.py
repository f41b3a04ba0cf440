"""The allow-list, the keys and the rate caps of the bridge; without zenoh and ROS.

Keys, payloads and liveliness tokens are those of zenoh-plugin-ros2dds: the key of a topic or a
service is its name without the leading slash, below an optional prefix.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass
from enum import Enum
from functools import cached_property
from typing import Generic, TypeVar

from mrlab_ros.core.base.checks import (
    FLAG,
    TEXT,
    Integer,
    Number,
    Text,
    between,
    checked,
    enum_values,
    shown,
)
from mrlab_ros.core.base.errors import BadInput
from mrlab_ros.core.base.records import Record, every, field, read
from mrlab_ros.core.bridge.diagnostics import RULE_GOES_OUT, RULE_WITHOUT_NAME

SECOND = 1_000_000_000
# Bytes of the largest message that a rule can allow; zenoh refuses larger ones of any client
# (max_message_size in config/zenoh/lab.json5).
LARGEST = 16 * 1024 * 1024
PLACE = "the bridge's allow-list"
FULL_NAME = Text(
    re.compile(r"(?:/(?:[A-Za-z_][A-Za-z0-9_]*|\*{1,2}))+"),
    "a full name such as /ur5e_1/joint_states, with * for one part and ** for any parts",
)
PREFIX = Text(
    re.compile(r"|[A-Za-z0-9_.-]+(?:/[A-Za-z0-9_.-]+)*"),
    "letters, digits, '_', '-' and '.', in parts divided by '/', such as campus/lab_1, or nothing",
)
# In a liveliness token a key and a type are one chunk each; this replaces their slashes.
SLASH = "§"


def _type_check(kind: str) -> Text:
    return Text(
        re.compile(rf"|[a-z][a-z0-9_]*/{kind}/[A-Za-z][A-Za-z0-9]*"),
        f"package/{kind}/Name, or nothing for any type",
    )


class Direction(Enum):
    """The direction in which a topic is forwarded."""

    OUT = "out"  # from the graph to zenoh
    IN = "in"  # from zenoh to the graph


class Congestion(Enum):
    """Treatment of a message on a full link."""

    DROP = "drop"  # it is dropped: the next one is newer
    BLOCK = "block"  # it waits: each one counts


class Reliability(Enum):
    """zenoh's reliability on a link that can lose messages."""

    RELIABLE = "reliable"
    BEST_EFFORT = "best_effort"


class Role(Enum):
    """Roles of people in a lab with keys; a later role includes the earlier ones."""

    DISPLAY = "display"  # watch
    STUDENT = "student"  # upload and publish what is one's own
    OPERATOR = "operator"  # play robots
    INSTRUCTOR = "instructor"  # change the scene, and everybody's things

    def may(self, needed: Role) -> bool:
        """Return whether this role includes `needed`."""
        roles = list(Role)
        return roles.index(self) >= roles.index(needed)


def least(role: Role, own_role: Role, *, own: bool) -> Role:
    """Return the role that is needed; own: for what belongs to the one who asks."""
    return own_role if own and role.may(own_role) else role


@dataclass(frozen=True)
class TopicRule:
    """One line of the allow-list for topics.

    A topic that goes out may be received by everybody who may connect, so it has no role.
    """

    name: str = field(
        FULL_NAME, "Topic name; `*` stands for one part, `**` for any number of parts."
    )
    about: str = field(TEXT, "What the topic is for.", "")
    type: str = field(_type_check("msg"), "The only type that is carried; empty: any.", "")
    direction: Direction = field(
        enum_values(Direction),
        "From the graph to zenoh, or from zenoh to the graph.",
        Direction.OUT,
    )
    max_rate: float = field(
        Number(between(0, 100_000), "Hz"),
        "Largest rate; 0: every message. Of a topic that comes in: from one session, and of all "
        "together.",
        0.0,
    )
    max_size: int = field(
        Integer(between(1, LARGEST), "bytes"),
        "Largest message of a topic that comes in.",
        65_536,
    )
    priority: int = field(Integer(between(1, 7)), "zenoh's priority; 1 goes first.", 5)
    reliability: Reliability = field(
        enum_values(Reliability), "zenoh's reliability.", Reliability.RELIABLE
    )
    express: bool = field(FLAG, "Send each message at once instead of in batches.", False)
    congestion: Congestion = field(
        enum_values(Congestion), "What happens to a message on a full link.", Congestion.BLOCK
    )
    depth: int = field(
        Integer(between(1, 10_000), "messages"), "Queue of the bridge's subscription.", 10
    )
    history: int = field(
        Integer(between(0, 10_000), "messages"),
        "Messages of a latched topic that late joiners get; 0: none.",
        1,
    )
    role: Role = field(
        enum_values(Role), "Who may publish a topic that comes in.", Role.INSTRUCTOR
    )
    own: Role = field(
        enum_values(Role),
        "Who may publish it in the browser, where the gateway fills in who that is.",
        Role.INSTRUCTOR,
    )

    def __post_init__(self) -> None:
        instructor = self.role is self.own is Role.INSTRUCTOR
        if self.direction is Direction.OUT and not instructor:
            raise BadInput(RULE_GOES_OUT(topic=self.name))

    def needed(self, *, own: bool) -> Role:
        """Return who may publish the topic; own: in the name of the one who does."""
        return least(self.role, self.own, own=own)

    @cached_property
    def pattern(self) -> re.Pattern[str]:
        return _pattern(self.name)


@dataclass(frozen=True)
class ServiceRule:
    """One line of the allow-list for services."""

    name: str = field(
        FULL_NAME, "Service name; `*` stands for one part, `**` for any number of parts."
    )
    about: str = field(TEXT, "What the service is for.", "")
    type: str = field(_type_check("srv"), "The only type that is carried; empty: any.", "")
    timeout: float = field(
        Number(between(0.01, 3600), "s"), "Time within which the server must respond.", 5.0
    )
    waiting: int = field(
        Integer(between(1, 10_000), "calls"),
        "Calls that may wait for the ones before them; more are refused.",
        64,
    )
    max_size: int = field(
        Integer(between(1, LARGEST), "bytes"), "Largest request; a larger one is refused.", 262_144
    )
    role: Role = field(enum_values(Role), "Who may call the service.", Role.INSTRUCTOR)
    own: Role = field(
        enum_values(Role),
        "Who may call it in the browser for what is their own.",
        Role.INSTRUCTOR,
    )
    moves: bool = field(
        FLAG,
        "Whether a call moves or changes something; false: it stops what moves or changes "
        "nothing, and is carried out however late it comes.",
        True,
    )

    local: str = field(
        TEXT,
        "Field of a request that may name a file of the lab's machine. In a lab with keys a call "
        "over zenoh leaves it empty, or gives a name without a folder.",
        "",
    )
    urgent: bool = field(
        FLAG,
        "Whether a call stops something: in the gateway it has limits of its own, which no other "
        "call uses up.",
        False,
    )

    def needed(self, *, own: bool) -> Role:
        """Return who may call the service; own: for what belongs to the one who calls."""
        return least(self.role, self.own, own=own)

    def names_a_path(self, request: object) -> str:
        """Return the path that a request names in the field `local`; empty: it names none."""
        found = str(getattr(request, self.local, "")) if self.local else ""
        plain = found not in (".", "..") and not set(found) & set("/\\~")
        return "" if plain else found

    @cached_property
    def pattern(self) -> re.Pattern[str]:
        return _pattern(self.name)


RuleT = TypeVar("RuleT", TopicRule, ServiceRule)


@dataclass(frozen=True)
class Rules:
    """The allow-list; the first rule that fits a name and its type decides."""

    topics: tuple[TopicRule, ...] = ()
    services: tuple[ServiceRule, ...] = ()

    @property
    def types(self) -> tuple[str, ...]:
        """Return the types that the rules name, sorted."""
        named = {*(rule.type for rule in self.topics), *(rule.type for rule in self.services)}
        return tuple(sorted(named - {""}))

    def topic(self, name: str, type_name: str) -> TopicRule | None:
        return _first(self.topics, name, type_name)

    def service(self, name: str, type_name: str) -> ServiceRule | None:
        return _first(self.services, name, type_name)


class LiveRules(Generic[RuleT]):
    """Finds the rules of the names in the graph, and remembers those of the names it has now.

    find: returns the rule of a name and a type; matching them with all patterns takes 20 us.
    """

    def __init__(self, find: Callable[[str, str], RuleT | None]) -> None:
        self._find: Callable[[str, str], RuleT | None] = find
        self._known: dict[tuple[str, str], RuleT | None] = {}

    def of(self, graph: Iterable[tuple[str, Iterable[str]]]) -> Iterator[tuple[str, str, RuleT]]:
        """Return each name and type with a rule. graph: names with their types."""
        earlier, self._known = self._known, {}
        for name, types in graph:
            for type_name in types:
                key = name, type_name
                rule = earlier[key] if key in earlier else self._find(name, type_name)
                self._known[key] = rule
                if rule is not None:
                    yield name, type_name, rule


def parse(document: object) -> Rules:
    """Read the allow-list from the content of its YAML file.

    Raises BadInput that names all mistakes.
    """
    record = Record(document, PLACE, ("topics", "services"))
    kinds = {"topics": TopicRule, "services": ServiceRule}
    entries = [(kind, entry) for key, kind in kinds.items() for entry in record.entries(key)]
    rules = every(lambda entry: _rule(*entry), entries, PLACE)
    return Rules(
        tuple(rule for rule in rules if isinstance(rule, TopicRule)),
        tuple(rule for rule in rules if isinstance(rule, ServiceRule)),
    )


def _rule(kind: type[TopicRule | ServiceRule], entry: object) -> TopicRule | ServiceRule:
    name = entry.get("name") if isinstance(entry, Mapping) else None
    if not isinstance(name, str):
        example = "{name: /robots}"
        raise BadInput(RULE_WITHOUT_NAME(place=PLACE, found=shown(entry), example=example))
    return read(kind, entry, f"the rule for {name}")


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
    return checked("the bridge's prefix", prefix, PREFIX)


@dataclass(frozen=True)
class TopicQos:
    """The QoS of a topic as its liveliness token holds it."""

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
    """Passes the newest value at most `max_rate` times a second (Hz).

    A value that comes too early is stored, and replaced by a newer one, until `due_ns`. So the
    last value of a burst always arrives.
    """

    def __init__(self, max_rate: float) -> None:
        self.period_ns = round(SECOND / max_rate)
        self._next_ns: int | None = None
        self._kept: ValueT | None = None

    @property
    def due_ns(self) -> int | None:
        """When the stored value is due, ns; None while there is none."""
        return None if self._kept is None else self._next_ns

    def offer(self, value: ValueT, now_ns: int) -> ValueT | None:
        """Return `value` where it may pass at once; otherwise store it and return None."""
        self._kept = value
        return self.take(now_ns)

    def take(self, now_ns: int) -> ValueT | None:
        """Return the stored value where it is due, and drop it."""
        if self._kept is None or (self._next_ns is not None and now_ns < self._next_ns):
            return None
        value, self._kept = self._kept, None
        # Stay on the grid while values keep coming: the mean rate is then max_rate.
        on_grid = self._next_ns is not None and now_ns - self._next_ns < self.period_ns
        self._next_ns = (self._next_ns if on_grid and self._next_ns else now_ns) + self.period_ns
        return value
