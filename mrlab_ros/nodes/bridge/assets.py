"""Answers queries for assets and for the message definitions.

The replies are sent by threads of their own: files are read there, and a client that reads slowly
delays neither the graph nor services.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from functools import cache, cached_property, partial
from pathlib import Path
from threading import Semaphore
from typing import TYPE_CHECKING

from mrlab_ros.adapters import threads
from mrlab_ros.adapters.zenoh.port import Query
from mrlab_ros.core.base.errors import BadInput
from mrlab_ros.core.bridge.assets import (
    ASSETS,
    SCHEMA,
    Span,
    path_of_key,
    span,
)
from mrlab_ros.core.bridge.diagnostics import ASSETS_BUSY
from mrlab_ros.messages.definitions import schema
from mrlab_ros.nodes.bridge.routes import BridgeContext, Count

if TYPE_CHECKING:
    from mrlab_ros.adapters.assets.library import Assets

SCHEMA_DOCUMENT = "schema.json"
KEYS = (f"/{ASSETS}/**", f"/{SCHEMA}")
THREADS = 4
# More queries than these may not wait; the next one is refused.
WAITING = 256


class AssetRoutes:
    """The queryables of assets/** and schema.

    share: the folder with robots/ and config/. types: what the allow-list forwards.
    """

    def __init__(self, bridge: BridgeContext, share: Path, types: Iterable[str]) -> None:
        self._bridge = bridge
        self._share = share
        self._definitions = cache(partial(schema, tuple(types)))
        self._threads = threads.Pool("bridge_assets", THREADS)
        self._free = Semaphore(WAITING)
        self._declared = [
            bridge.session.queryable(key, self._on_query(bridge.count(key, "", "asset")))
            for key in map(bridge.key, KEYS)
        ]

    @cached_property
    def _assets(self) -> Assets:
        # Here: who draws robots from the pages needs no geometry in the bridge's memory.
        from mrlab_ros.adapters.assets.library import Assets
        from mrlab_ros.adapters.robots.library import RobotLibrary

        library = RobotLibrary(self._share / "robots")
        return Assets(self._share, library, {SCHEMA_DOCUMENT: self._definitions})

    def stop(self) -> None:
        """End once the replies that are being sent are sent; drop the rest."""
        for declared in self._declared:
            declared.undeclare()
        self._threads.shutdown(cancel_futures=True)

    def _on_query(self, count: Count) -> Callable[[Query], None]:
        own = (self._bridge.key(f"/{ASSETS}/"), self._bridge.key(f"/{SCHEMA}"))

        def on_query(query: Query) -> None:
            if not query.key.startswith(own):
                # A pattern such as */playback_state, which does not ask for assets.
                query.ignore()
                return
            if not self._free.acquire(blocking=False):
                count.refused += 1
                query.refuse(ASSETS_BUSY(waiting=WAITING))
                return
            try:
                self._threads.send(self._reply, query, count)
            except RuntimeError:  # stopped meanwhile
                self._free.release()

        return on_query

    def _reply(self, query: Query, count: Count) -> None:
        try:
            self._answer(query, count)
        except Exception as error:  # the client may have gone
            self._bridge.warn_of_loss(error)
        finally:
            self._free.release()

    def _answer(self, query: Query, count: Count) -> None:
        try:
            piece = self._assets.read(self._path(query), _part(query))
        except BadInput as error:
            count.refused += 1
            query.refuse(error.diagnostic)
            return
        whole = piece.whole
        query.reply_asset(piece.data, whole.media_type, whole.attachment(piece.offset))
        count.messages += 1
        count.bytes += len(piece.data)

    def _path(self, query: Query) -> str:
        key = query.key.removeprefix(self._bridge.key("/"))
        return SCHEMA_DOCUMENT if key == SCHEMA else path_of_key(key)


def _part(query: Query) -> Span:
    parameters = query.parameters
    return span(parameters.get("offset"), parameters.get("length"))
