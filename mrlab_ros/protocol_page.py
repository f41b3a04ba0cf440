"""Writes docs/protocol.md from the allow-list and the .msg and .srv files."""

from __future__ import annotations

from pathlib import Path

import yaml

from mrlab_ros.core.bridge_rules import Congestion, Rules, ServiceRule, TopicRule, parse

HEAD = """\
# The protocol

Every key that the bridge carries, from `config/bridge.yaml`, and every type of the lab, from
`msg_schemas/`. A payload is CDR with its 4-byte header. `*` stands for the name of a robot or of a
robot system. How latched topics, services and liveliness work: [the bridge](bridge.md). This page
is generated; `python -m mrlab_ros.protocol_page` writes it anew.
"""


def page(rules: Rules, schemas: Path) -> str:
    """Return the page for an allow-list and a folder with msg/ and srv/."""
    return "\n".join(
        [
            HEAD,
            "## Topics\n",
            "| key | type | way | what it is | rate, Hz | priority | when a link is full |",
            "|---|---|---|---|---|---|---|",
            *map(_topic, rules.topics),
            "\n## Services\n",
            "| key | type | what it does | time-out, s |",
            "|---|---|---|---|",
            *map(_service, rules.services),
            "\n## Messages",
            *(_definition(file, "msg") for file in sorted(schemas.glob("msg/*.msg"))),
            "\n## Requests and responses",
            *(_definition(file, "srv") for file in sorted(schemas.glob("srv/*.srv"))),
        ]
    )


def _topic(rule: TopicRule) -> str:
    rate = f"at most {rule.max_rate:g}" if rule.max_rate else "every message"
    full = "dropped" if rule.congestion is Congestion.DROP else "waits"
    kind = f"`{rule.type}`" if rule.type else "any"
    return (
        f"| `{rule.name[1:]}` | {kind} | {rule.direction.value} | {rule.about} | {rate} | "
        f"{rule.priority} | {full} |"
    )


def _service(rule: ServiceRule) -> str:
    kind = f"`{rule.type}`" if rule.type else "any"
    return f"| `{rule.name[1:]}` | {kind} | {rule.about} | {rule.timeout:g} |"


def _definition(file: Path, folder: str) -> str:
    return f"\n### mrlab_msgs/{folder}/{file.stem}\n\n```\n{file.read_text().rstrip()}\n```"


def current(root: Path) -> str:
    """Return the page for the source tree at `root`."""
    rules = parse(yaml.safe_load((root / "config" / "bridge.yaml").read_text()))
    return page(rules, root / "msg_schemas") + "\n"


def main() -> None:
    """Write docs/protocol.md in the source tree."""
    root = Path(__file__).resolve().parent.parent
    (root / "docs" / "protocol.md").write_text(current(root))


if __name__ == "__main__":
    main()
