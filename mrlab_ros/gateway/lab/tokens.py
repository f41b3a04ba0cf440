"""The bridge's liveliness tokens, read back into what the lab offers."""

from __future__ import annotations

from types import MappingProxyType

from mrlab_ros.core.bridge.rules import SLASH
from mrlab_ros.gateway.lab.connection import LabKeys


class TokenTable:
    """The tokens that live now. prefix: what every key of the lab begins with."""

    def __init__(self, prefix: str) -> None:
        self._prefix = f"{prefix}/" if prefix else ""
        self._tokens: dict[str, None] = {}

    def add(self, token: str) -> None:
        self._tokens[token] = None

    def remove(self, token: str) -> None:
        self._tokens.pop(token, None)

    def clear(self) -> None:
        self._tokens.clear()

    @property
    def has_bridge(self) -> bool:
        """Return whether a bridge of this lab is there.

        A bridge with a prefix shows itself by the prefix of its keys: its own token has none.
        """
        if not self._prefix:
            return bool(self._tokens)
        keys = self.keys()
        return bool(keys.topics or keys.services)

    def keys(self) -> LabKeys:
        """Return the topics that come out and the services, below the prefix."""
        topics: dict[str, str] = {}
        services: dict[str, str] = {}
        latched: set[str] = set()
        for token in self._tokens:
            # @/<zenoh id>/@ros2_lv/<kind>/<key>/<type>[/<qos>]
            parts = token.split("/")
            if len(parts) < 6:
                continue
            kind, key, type_name = parts[3], _name(parts[4]), _name(parts[5])
            if not key.startswith(self._prefix):
                continue
            key = key[len(self._prefix) :]
            if kind == "MP":
                topics[key] = type_name
                # <keyless>:<reliability>:<durability>:<history>,<depth>
                if len(parts) > 6 and parts[6].split(":")[2:3] == ["1"]:
                    latched.add(key)
            elif kind == "SS":
                services[key] = type_name
        return LabKeys(MappingProxyType(topics), MappingProxyType(services), frozenset(latched))


def _name(chunk: str) -> str:
    return chunk.replace(SLASH, "/")
