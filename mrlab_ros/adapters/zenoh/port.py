"""zenoh as the bridge needs it: publishers, subscribers, queryables, liveliness tokens."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Protocol

from mrlab_ros.core.base.diagnostic import Diagnostic
from mrlab_ros.core.bridge.guests import Link
from mrlab_ros.core.bridge.rules import TopicRule


class Declared(Protocol):
    """Something declared on a session."""

    def undeclare(self) -> None: ...


class Publisher(Declared, Protocol):
    """A key to publish on."""

    def put(self, payload: bytes, attachment: bytes) -> None: ...

    def has_subscriber(self) -> bool:
        """Return whether the key has a subscriber."""
        ...


class Query(Protocol):
    """A query that waits for its one reply; `payload` is None where it has none.

    key: the queried key expression, perhaps a pattern such as `*/play`. parameters: what stands
    behind the `?` of its selector.
    """

    @property
    def key(self) -> str: ...

    @property
    def parameters(self) -> Mapping[str, str]: ...

    @property
    def size(self) -> int:
        """Bytes of the payload, which is not copied for it."""
        ...

    @property
    def payload(self) -> bytes | None: ...

    def reply(self, payload: bytes) -> None: ...

    def reply_asset(self, payload: bytes, media_type: str, attachment: bytes) -> None:
        """Reply on the queried key, which must not be a pattern."""
        ...

    def refuse(self, reason: Diagnostic) -> None: ...

    def ignore(self) -> None:
        """End the caller's wait without a reply."""
        ...


class Session(Protocol):
    """zenoh as the bridge needs it. Callbacks run in the session's threads."""

    @property
    def zid(self) -> str: ...

    def publisher(
        self, key: str, rule: TopicRule, cache: int, on_match: Callable[[], None] | None = None
    ) -> Publisher:
        """Declare a publisher that keeps the newest `cache` messages for late joiners.

        on_match: called whenever `has_subscriber` of a publisher without a cache has changed.
        """
        ...

    def subscriber(
        self,
        key: str,
        admit: Callable[[int], bool],
        on_payload: Callable[[bytes], None],
        late: bool,
    ) -> Declared:
        """Declare a subscriber to other sessions; `late`: it also gets their cached messages.

        admit: gets a message's size, bytes, and says whether it is to be read at all.
        """
        ...

    def queryable(
        self, key: str, on_query: Callable[[Query], None], quick: bool = False
    ) -> Declared:
        """Declare a queryable, with a thread of its own unless `on_query` is `quick`.

        A quick one leaves replies, which wait for slow clients, to other threads.
        """
        ...

    def token(self, key: str) -> Declared:
        """Declare a liveliness token."""
        ...

    def follow_tokens(self, key: str, on_token: Callable[[str, bool], None]) -> Declared:
        """Call `on_token` with the key of every token of `key` that comes (True) or goes (False).

        `on_token` must not wait.
        """
        ...

    def follow_links(self, on_link: Callable[[Link, bool], None]) -> Declared:
        """Call `on_link` with every link that is opened (True) or closed (False)."""
        ...

    def close(self) -> None: ...
