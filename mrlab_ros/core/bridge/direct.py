"""Streams that their publisher puts on zenoh itself, beside the graph, where the bridge grants it.

The publisher, a client of the bridge's socket, offers a topic by a liveliness token. The bridge
grants it by another one, which holds how zenoh is to treat its messages, and receives the topic no
more from the graph while it grants. Either token ends with its process or their link; the bridge
then forwards the topic as any other. Once a second the publisher reports what it has put.
"""

from __future__ import annotations

import json
from typing import NamedTuple

from mrlab_ros.core.bridge.rules import Congestion, Reliability, TopicRule

# Names below the prefix. A topic's name, with its slash, follows that of an offer, and that of a
# grant with its terms.
OFFERS = "/@mrlab/direct/offer"
GRANTS = "/@mrlab/direct/grant"
REPORTS = "/@mrlab/direct/report"
# Bytes of the largest report: some 5000 delays.
LARGEST_REPORT = 65_536


def grantable(rule: TopicRule) -> bool:
    """Return whether a publisher can do what a rule says: it caps no rate, all may be dropped."""
    return rule.congestion is Congestion.DROP and not rule.max_rate


def grant(name: str, rule: TopicRule) -> str:
    """Return the name of the token that grants a topic by its rule."""
    return f"{GRANTS}/{rule.priority}/{rule.reliability.value}/{int(rule.express)}{name}"


def granted(token: str) -> TopicRule:
    """Return the rule of the topic that a token grants; the inverse of grant()."""
    priority, reliability, express, name = token[len(GRANTS) + 1 :].split("/", 3)
    return TopicRule(
        f"/{name}",
        priority=int(priority),
        reliability=Reliability(reliability),
        express=express == "1",
        congestion=Congestion.DROP,
    )


class Carried(NamedTuple):
    """What a publisher has put of a topic since its last report.

    bytes: of all payloads. delays_ns: of each message, from its publishing in the graph on.
    """

    name: str
    bytes: int
    delays_ns: list[int]


def report(carried: Carried) -> bytes:
    """Return a report."""
    return json.dumps(carried).encode()


def reported(payload: bytes) -> Carried:
    """Read a report; the inverse of report(). Raises TypeError or ValueError where it is none."""
    return Carried(*json.loads(payload))
