"""/api/live: the motion that a person's program shows now; it replaces the one before.

An array comes as a workspace file and is converted at once into a draft, which the person's pages
show. Nothing is queued: of the motions that wait for a conversion the newest is converted.
"""

from __future__ import annotations

import asyncio
import contextlib
import time
from collections import OrderedDict, deque
from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Annotated, Any, BinaryIO, Literal

from fastapi import APIRouter, Depends, Header, Path, Query, Request
from fastapi.concurrency import run_in_threadpool
from fastapi.responses import StreamingResponse
from pydantic import BaseModel

from mrlab_ros.adapters.store import keys
from mrlab_ros.core.base.errors import Misuse
from mrlab_ros.gateway.people.person import CurrentPerson, Limit, Person, RateLimit
from mrlab_ros.gateway.store import downloads
from mrlab_ros.gateway.store.answers import Identifier
from mrlab_ros.gateway.uploads import motions
from mrlab_ros.gateway.uploads.diagnostics import NEWER_IS_SHOWN
from mrlab_ros.gateway.uploads.routes import (
    FILE_BODY,
    ConversionOptions,
    Converted,
    TheDesk,
    ThePorts,
    TheShelf,
    Upload,
    converted,
    received,
)

# A script that is run again and again; a loop that never waits is slowed down.
LIVE = Limit("live", burst=60, period=0.05)
# s that a page waits for the next motion at most: proxies end what is silent for a minute.
LONGEST_WAIT_S = 25.0
# Programs, and people, that are remembered at once.
MOST = 1000

router = APIRouter(prefix="/api/live", tags=["uploads"])


class LiveOptions(ConversionOptions):
    """Options of the conversion. shown: False: only answered, no page shows it."""

    shown: bool = True


class Live(BaseModel):
    """A motion that was shown. live: names it; no other motion ever has that number."""

    live: Identifier
    upload: Upload
    options: ConversionOptions
    conversion: Converted


class LiveNow(BaseModel):
    """The motion that a person's programs showed last; null: none since the gateway runs."""

    now: Live | None


@dataclass(eq=False)
class Slot:
    """The place of one motion: of a program, shown or not. kept: what lies in the store for it."""

    lock: asyncio.Lock = field(default_factory=asyncio.Lock)
    newest: int = 0
    kept: deque[list[str]] = field(default_factory=deque)

    def replaced(self, made: list[str]) -> Sequence[str]:
        """Keep `made`; return what to delete. A page may still read the motion before."""
        self.kept.append(made)
        return self.kept.popleft() if len(self.kept) > 2 else ()


class LiveDesk:
    """The motions that programs show through one gateway; belongs to one event loop."""

    def __init__(self) -> None:
        self.limit = RateLimit(LIVE)
        self._slots: OrderedDict[tuple[str, str, bool], Slot] = OrderedDict()
        self._now: OrderedDict[str, Live] = OrderedDict()
        self._changed = asyncio.Condition()

    def slot(self, person: Person, *, shown: bool) -> Slot:
        """Return the place of a program's motion; two programs of a person have one each."""
        place = person.id, person.sign_in, shown
        found = self._slots.setdefault(place, Slot())
        _newest_last(self._slots, place)
        return found

    async def show(self, user: str, live: Live) -> None:
        """Let the pages of a person have a motion."""
        self._now[user] = live
        _newest_last(self._now, user)
        async with self._changed:
            self._changed.notify_all()

    def now(self, user: str) -> Live | None:
        return self._now.get(user)

    async def other_than(self, user: str, known: str) -> None:
        """Wait until the motion of a person is another one than `known`, or LONGEST_WAIT_S."""

        def other() -> bool:
            now = self._now.get(user)
            return now is not None and now.live != known

        with contextlib.suppress(asyncio.TimeoutError):
            async with self._changed:
                await asyncio.wait_for(self._changed.wait_for(other), LONGEST_WAIT_S)


def _newest_last(found: OrderedDict[Any, Any], key: object) -> None:
    found.move_to_end(key)
    while len(found) > MOST:
        found.popitem(last=False)


def live_of(request: Request) -> LiveDesk:
    """Return the live motions of a gateway, as a dependency."""
    found: LiveDesk = request.app.state.live
    return found


TheLive = Annotated[LiveDesk, Depends(live_of)]


@router.put("/{file_name}", status_code=201, openapi_extra=FILE_BODY)
async def show(
    request: Request,
    person: CurrentPerson,
    shelf: TheShelf,
    there: ThePorts,
    desk: TheDesk,
    live: TheLive,
    file_name: Annotated[str, Path(description="such as script_line_12.mat")],
    options: Annotated[LiveOptions, Query()],
    content_length: Annotated[int | None, Header(ge=0, include_in_schema=False)] = None,
) -> Live:
    """Receive a file, convert it, and show the motion on the person's pages.

    A refused file is shown with its findings. The file and draft before last of the same program
    are deleted.
    """
    live.limit.check(person.id, time.monotonic())
    user = shelf.user(person)
    upload = await received(request, user, desk, file_name, content_length)
    made = [keys.upload(user, upload.upload, upload.file_name)]
    slot = live.slot(person, shown=options.shown)
    slot.newest = number = slot.newest + 1
    try:
        async with slot.lock:
            if number != slot.newest:
                raise Misuse(NEWER_IS_SHOWN(file=file_name))
            found = await converted(shelf, there, user, upload.upload, options)
    except BaseException:
        await run_in_threadpool(shelf.store.delete, made)
        raise
    if found.draft is not None:
        made.append(keys.draft(user, found.draft))
    if found.motion is not None:
        made.append(keys.motion(user, found.motion.rsplit("/", 1)[1]))
    chosen = ConversionOptions(**options.model_dump(exclude={"shown"}))
    answer = Live(live=keys.unique(), upload=upload, options=chosen, conversion=found)
    if options.shown:
        await live.show(user, answer)
    await run_in_threadpool(shelf.store.delete, slot.replaced(made))
    return answer


@router.get("")
async def now(
    person: CurrentPerson,
    shelf: TheShelf,
    live: TheLive,
    after: Annotated[str | None, Query(max_length=32)] = None,
) -> LiveNow:
    """Return the newest motion; with `after`, wait some seconds for another one than that."""
    user = shelf.user(person)
    if after is not None:
        await live.other_than(user, after)
    return LiveNow(now=live.now(user))


@router.get("/{draft}/file", response_class=StreamingResponse)
async def file(
    person: CurrentPerson,
    shelf: TheShelf,
    draft: Annotated[str, Path(pattern="^[0-9a-f]{32}$")],
    format: Annotated[Literal["json", "mat", "csv"], Query()] = "mat",
) -> StreamingResponse:
    """Return a draft of one's own as a file, exact to the last bit in JSON and MATLAB's format."""

    def made() -> tuple[BinaryIO, int, str]:
        loaded = motions.of_draft(shelf, shelf.user(person), draft)
        return *downloads.written(loaded, loaded.id, format, shelf.work), loaded.id

    return downloads.sent(*await run_in_threadpool(made), format)
