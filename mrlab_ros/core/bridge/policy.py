"""Who may do what with which key: one policy for the gateway's pages and socket and for zenoh.

It is read from the allow-list (config/bridge.yaml). `access.py` writes the same rules as zenoh's
access control; a test holds both against each other.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from enum import Enum

from mrlab_ros.core.bridge.rules import Direction, Role, Rules, RuleT

# What clients draw the lab from; offered beside the graph, to everybody who may connect.
OFFERED = ("assets", "schema")


class Verb(Enum):
    """What somebody does with a key."""

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
            return _strictest(rule.role for rule in topics)
        if topics or key.partition("/")[0] in OFFERED:
            return Role.DISPLAY
        return None

    def moves(self, key: str) -> bool:
        """Return whether a call of a service may move or change something."""
        rules = list(_fitting(self.rules.services, f"/{key}"))
        return not rules or any(rule.moves for rule in rules)


def _fitting(rules: Iterable[RuleT], name: str) -> Iterator[RuleT]:
    """Return the rules of which one decides about `name`, whatever its type is."""
    for rule in rules:
        if rule.pattern.fullmatch(name):
            yield rule
            if not rule.type:
                return


def _strictest(roles: Iterable[Role]) -> Role | None:
    return max(roles, key=list(Role).index, default=None)
