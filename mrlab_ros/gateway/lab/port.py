"""What the gateway needs of a lab."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, Protocol


class LabConnection(Protocol):
    """A connection to a lab; it is opened when the gateway starts, and heals by itself."""

    async def open(self) -> None: ...

    async def close(self) -> None: ...

    async def call(self, service: str, type_name: str, request: Mapping[str, Any]) -> Any:
        """Call a service, such as `ur5e_1/play`; raises a LabError where it gives no answer."""
        ...

    @property
    def connected(self) -> bool:
        """Whether the lab is there now."""
        ...
