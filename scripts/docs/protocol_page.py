"""Makes docs/protocol.md from the allow-list and the .msg and .srv files."""

from __future__ import annotations

from pathlib import Path

import yaml

from mrlab_ros.core.bridge.rules import (
    Congestion,
    Direction,
    Rules,
    ServiceRule,
    TopicRule,
    parse,
)

HEAD = """\
# The protocol

Every key that the bridge carries, from `config/bridge.yaml`, and every type of the lab, from
`msg_schemas/`. A payload is CDR with its 4-byte header. `*` stands for the name of a robot or of a
robot system. How latched topics, services and liveliness work: [the bridge](bridge.md). Role: who
may send a topic that comes in or call a service, where the lab has [keys](security.md). This page
is generated; `make docs` writes it anew.
"""

ASSETS = """
## Assets and definitions

Queryables beside the graph, for everybody who may connect. Their payloads are no CDR; the encoding
of a reply is its media type, and its attachment is JSON with `size`, `sha256`, `media_type` and
`offset`. [Details](bridge.md#assets).

| key | parameters | reply |
|---|---|---|
| `assets/<package>/<path>` | `offset`, `length`: bytes, 1 MiB at most | a mesh, a picture |
| `assets/robots/<model>[+<end effector>].urdf` | the same | the composed URDF |
| `assets/robots.json` | the same | all models and end effectors |
| `assets/objects.json` | the same | all types of objects |
| `schema` | the same | all definitions: `messages`, `services`, `hashes` |
| `@mrlab/bridge/clock` | none | 16 bytes, see [stamps](#stamps) |
| `@mrlab/bridge/statistics` | none | JSON: traffic by key |
"""

STAMPS = """
## Stamps

Every message that goes out has an attachment of 24 bytes; later versions may add more behind.

| bytes | type | what it is |
|---|---|---|
| 0-7 | int64, little-endian | sequence number: 1 for the key's first message |
| 8-15 | int64, little-endian | when it was published in the graph, ns since 1970 |
| 16-23 | int64, little-endian | when the bridge put it, ns since 1970 |

A gap in the numbers: messages were lost on the link. A smaller number: the bridge, or what puts
the key, was started again. The publishing time is by the clock of the publisher's machine, the
other by that of the bridge's. A `get` on `@mrlab/bridge/clock` answers 16 bytes, two int64: when
the question came and when it was answered, by the bridge's clock. With its own times t0 (asked)
and t3 (answered) a client has the offset ((t1 - t0) + (t2 - t3)) / 2, wrong by at most half of the
round trip. What it then measures it puts on `latency/clients` as a `mrlab_msgs/msg/Latency`.
"""


def page(rules: Rules, schemas: Path) -> str:
    """Return the page for an allow-list and a folder with msg/ and srv/."""
    return "\n".join(
        [
            HEAD,
            "## Topics\n",
            "| key | type | way | role | what it is | rate, Hz | priority | when a link is full |",
            "|---|---|---|---|---|---|---|---|",
            *map(_topic, rules.topics),
            "\n## Services\n",
            "| key | type | role | what it does | time-out, s |",
            "|---|---|---|---|---|",
            *map(_service, rules.services),
            ASSETS,
            STAMPS,
            "## Messages",
            *(_definition(file, "msg") for file in sorted(schemas.glob("msg/*.msg"))),
            "\n## Requests and responses",
            *(_definition(file, "srv") for file in sorted(schemas.glob("srv/*.srv"))),
        ]
    )


def _topic(rule: TopicRule) -> str:
    rate = f"at most {rule.max_rate:g}" if rule.max_rate else "every message"
    full = "dropped" if rule.congestion is Congestion.DROP else "waits"
    kind = f"`{rule.type}`" if rule.type else "any"
    role = rule.role.value if rule.direction is Direction.IN else ""
    return (
        f"| `{rule.name[1:]}` | {kind} | {rule.direction.value} | {role} | {rule.about} | "
        f"{rate} | {rule.priority} | {full} |"
    )


def _service(rule: ServiceRule) -> str:
    kind = f"`{rule.type}`" if rule.type else "any"
    name, role = rule.name[1:], rule.role.value
    return f"| `{name}` | {kind} | {role} | {rule.about} | {rule.timeout:g} |"


def _definition(file: Path, folder: str) -> str:
    return f"\n### mrlab_msgs/{folder}/{file.stem}\n\n```\n{file.read_text().rstrip()}\n```"


def current(root: Path) -> str:
    """Return the page for the source tree at `root`."""
    rules = parse(yaml.safe_load((root / "config" / "bridge.yaml").read_text()))
    return page(rules, root / "msg_schemas") + "\n"
