"""Which services move or change something, as config/bridge.yaml declares beside their roles."""

from __future__ import annotations

from functools import cache
from typing import Any

import yaml

from mrlab_ros.adapters import share
from mrlab_ros.core.bridge.rules import Rules, parse


@cache
def _rules() -> Rules:
    loader = getattr(yaml, "CSafeLoader", yaml.SafeLoader)
    document = (share.directory() / "config" / "bridge.yaml").read_text()
    return parse(yaml.load(document, Loader=loader))


def moves(service: str, kind: Any) -> bool:
    """Return whether a call of `service`, a full name, moves or changes something.

    kind: its type. A service that the file does not name counts as one that moves.
    """
    rule = _rules().service(service, f"{kind.__module__.partition('.')[0]}/srv/{kind.__name__}")
    return rule is None or rule.moves
