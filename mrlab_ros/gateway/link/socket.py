"""The WebSocket /link: one client's frames, both ways."""

from __future__ import annotations

import asyncio
import logging
import time
from collections.abc import Callable, Mapping
from contextlib import suppress
from typing import Any

import orjson
from fastapi import APIRouter, WebSocket
from starlette.websockets import WebSocketDisconnect

from mrlab_ros.core.base.diagnostic import Diagnostic
from mrlab_ros.core.base.errors import BadInput, LabError
from mrlab_ros.core.bridge.access import Policy, Verb
from mrlab_ros.core.runtime.freezes import LOOK_PERIOD_S, Freezes
from mrlab_ros.gateway.diagnostics import GATEWAY_WITHOUT_LAB
from mrlab_ros.gateway.errors import SOCKET_REFUSED, NotAllowed, TooMany, close
from mrlab_ros.gateway.lab.connection import (
    CALL_TIMEOUT_S,
    LabConnection,
    NoAnswer,
    TimedOut,
    is_key,
)
from mrlab_ros.gateway.link import diagnostics, frames, presence
from mrlab_ros.gateway.link.clock import LabClock
from mrlab_ros.gateway.link.diagnostics import (
    BAD_NUMBER,
    BAD_OP,
    BAD_SUBSCRIPTIONS,
    CALLS_FULL,
    MAY_NOT_CALL,
    MAY_NOT_PUBLISH,
    NEWER_SOCKET,
    NO_HELLO,
    NO_JSON,
    OTHER_PROTOCOL,
    PAGE_SILENT,
    SENDS_TOO_MUCH,
)
from mrlab_ros.gateway.link.frames import Call, Credit
from mrlab_ros.gateway.link.limits import LinkLimits
from mrlab_ros.gateway.link.session import LinkSession, May, told
from mrlab_ros.gateway.link.sessions import Client, Sessions
from mrlab_ros.gateway.link.visibility import refusal
from mrlab_ros.gateway.people.people import ThePeople
from mrlab_ros.gateway.people.person import CurrentPerson, Person

PROTOCOL = "mrlab.1"
# Codes of a close; a client that gets one of the first three does not come back by itself.
VERSION, SIGN_IN_ENDED, TOO_MANY = 4001, SOCKET_REFUSED, 4029
BROKEN, BEHIND, SILENT = 4400, 4409, 4408
# s for a client's first frame.
HELLO_S = 5.0
# s until a page learns that there are too many.
FULL_S = 2.0
# s without a frame after which a client counts as gone. A page in view sends one every second, but
# stands still while it builds a scene; what waits for it is bounded meanwhile.
SILENCE_S = 15.0
# The same of a hidden page, whose timers a browser slows down to one a minute.
HIDDEN_SILENCE_S = 150.0
HEARTBEAT_S = 1.0
# Displays are told who paused a robot. `success` follows the CDR header.
PAUSE = "/pause"
# A person loads only what that person sees.
LOAD, LOAD_TYPE = "/load", "mrlab_msgs/srv/LoadTrajectory"
SUCCESS = 4

log = logging.getLogger("mrlab.gateway")
router = APIRouter()


WhyNotLoad = Callable[[Person, str], Diagnostic | None]


class LinkPort:
    """State that the sockets of one gateway share."""

    def __init__(
        self,
        sessions: Sessions,
        may: May,
        limits: LinkLimits,
        moves: Callable[[str], bool],
        urgent: Callable[[str], bool],
        why_not_load: WhyNotLoad,
    ) -> None:
        self.sessions = sessions
        self.limits = limits
        self.may = may
        self.moves = moves
        self.urgent = urgent
        self.why_not_load = why_not_load
        self.clock = LabClock(sessions.lab)
        self.freezes = Freezes("web", time.process_time)
        self.calls: set[asyncio.Task[None]] = set()


def link_port(
    lab: LabConnection, policy: Policy, limits: LinkLimits, why_not_load: WhyNotLoad
) -> LinkPort:
    """Return what the sockets of a gateway share.

    why_not_load: says why a person cannot load the trajectory of an id; it may block.
    """

    def may(person: Person, verb: Verb, key: str) -> bool:
        # A call of a pattern would leave the gateway, which has all rights, for every service.
        named = verb is Verb.RECEIVE or is_key(key)
        # The gateway fills in of whom a presence is.
        own = verb is Verb.PUBLISH and key == presence.KEY
        return named and policy.may(person.role, verb, key, own=own)

    sessions = Sessions(lab, policy.rules, may, limits)
    return LinkPort(sessions, may, limits, policy.moves, policy.urgent, why_not_load)


@router.websocket("/link")
async def link(websocket: WebSocket, person: CurrentPerson, people: ThePeople) -> None:
    """Carry the lab's topics and services; docs/link.md describes the frames."""
    offered = websocket.scope.get("subprotocols", [])
    if PROTOCOL not in offered:
        # Accepted first: a browser shows a page no reason for a refused handshake.
        await websocket.accept(subprotocol=offered[0] if offered else None)
        theirs = ", ".join(offered)[:40]
        await _close(websocket, VERSION, OTHER_PROTOCOL(ours=PROTOCOL, theirs=theirs))
        return
    await websocket.accept(subprotocol=PROTOCOL)
    port: LinkPort | None = websocket.app.state.link
    if port is None:
        await _close(websocket, 1011, GATEWAY_WITHOUT_LAB())
        return
    with people.sign_ins.ending(person) as ended:
        try:
            hello = await asyncio.wait_for(websocket.receive_text(), HELLO_S)
            token, received, wanted, hidden = _hello(hello)
            client, resumed = port.sessions.open(person, token, websocket, time.monotonic())
        except (asyncio.TimeoutError, WebSocketDisconnect, KeyError):
            await _close(websocket, BROKEN, NO_HELLO(wait=HELLO_S))
        except BadInput as error:
            await _close(websocket, BROKEN, error.diagnostic)
        except TooMany as error:
            # Whoever tries again and again costs the others a handshake each time.
            await asyncio.sleep(FULL_S)
            await _close(websocket, TOO_MANY, error.diagnostic)
        else:
            socket = _Socket(websocket, port, client, hidden)
            await socket.serve(resumed, received if resumed else 0, wanted, ended)


class _Socket:
    """Serves a client until its socket or its sign-in ends."""

    def __init__(self, websocket: WebSocket, port: LinkPort, client: Client, hidden: bool) -> None:
        self._websocket = websocket
        self._port = port
        self._client = client
        self._session: LinkSession = client.session
        self._hidden = hidden
        self._woken = asyncio.Event()
        self._heard = time.monotonic()
        self._waiting = 0
        self._limits = port.limits
        self._frames = port.limits.frames
        self._bytes = port.limits.bytes
        self._calls = port.limits.calls
        self._close: tuple[int, Diagnostic | None] = (1000, None)

    async def serve(
        self, resumed: bool, received: int, wanted: Mapping[int, str], ended: asyncio.Event
    ) -> None:
        """Serve until one side ends it."""
        session = self._session
        session.wake = self._woken.set
        await session.attach(received, wanted)
        self._heard = time.monotonic()
        welcome = {
            "op": "welcome",
            "token": session.token,
            "resumed": resumed,
            "heartbeat": HEARTBEAT_S,
            "silence": SILENCE_S,
        }
        tasks = [
            asyncio.create_task(each)
            for each in (
                self._send(orjson.dumps(welcome).decode()),
                self._receive(),
                self._watch(),
                self._sign_in(ended),
            )
        ]
        session.show_lab(self._port.sessions.lab_state())
        try:
            await asyncio.wait(tasks, return_when=asyncio.FIRST_COMPLETED)
        finally:
            for task in tasks:
                task.cancel()
            results = await asyncio.gather(*tasks, return_exceptions=True)
            for result in results:
                if isinstance(result, Exception) and not isinstance(result, WebSocketDisconnect):
                    log.error("a socket of %s failed", session.person.name, exc_info=result)
            self._leave()
            await _close(self._websocket, *self._close)

    def _leave(self) -> None:
        sessions, client = self._port.sessions, self._client
        if client.socket is self._websocket:
            self._session.wake = _nothing
        sessions.leave(client, self._websocket, time.monotonic())
        if self._close[0] == SIGN_IN_ENDED:
            sessions.end(client)
        sessions.expire(time.monotonic())

    async def _send(self, welcome: str) -> None:
        session, websocket, woken = self._session, self._websocket, self._woken
        await websocket.send_text(welcome)
        while True:
            await woken.wait()
            woken.clear()
            if session.failed is not None:
                self._close = BEHIND, session.failed
                return
            if self._client.socket is not websocket:
                self._close = 1000, NEWER_SOCKET()
                return
            while (frame := session.next_frame()) is not None:
                if isinstance(frame, str):
                    await websocket.send_text(frame)
                else:
                    await websocket.send_bytes(frame)

    async def _receive(self) -> None:
        websocket = self._websocket
        while True:
            message = await websocket.receive()
            if message["type"] == "websocket.disconnect":
                return
            now = self._heard = time.monotonic()
            data = message.get("bytes")
            text = message.get("text")
            size = len(data or text or "")
            fits = size <= self._limits.largest_frame
            if not (fits and self._frames.take(1, now) and self._bytes.take(size, now)):
                self._close = TOO_MANY, SENDS_TOO_MUCH()
                return
            try:
                if data is not None:
                    self._binary(data, now)
                else:
                    self._text(text or "")
            except BadInput as error:
                self._close = BROKEN, error.diagnostic
                return
            if wait := self._session.budget.wait(size, now):
                await asyncio.sleep(wait)

    def _binary(self, data: bytes, now: float) -> None:
        frame = frames.from_client(data)
        if isinstance(frame, Credit):
            self._session.grant(frame.batch)
        elif isinstance(frame, Call):
            if frame.put:
                self._put(frame, now)
            else:
                self._call(frame, now)
        else:
            self._session.acknowledge(frame.fragment)

    def _text(self, text: str) -> None:
        came = self._port.clock.now()
        message = _mapping(text)
        op = message.get("op")
        if op == "ping":
            answer = {"op": "pong", "asked": message.get("asked"), "came": came}
            self._session.text({**answer, "answered": self._port.clock.now()})
        elif op == "subscribe":
            self._session.subscribe(_number(message, "id"), str(message.get("key", "")))
        elif op == "unsubscribe":
            self._session.unsubscribe(_number(message, "id"))
        elif op in ("hidden", "visible"):
            self._hidden = op == "hidden"
        else:
            raise BadInput(BAD_OP(op=str(op)[:40], protocol=PROTOCOL))

    def _put(self, frame: Call, now: float) -> None:
        session, sessions = self._session, self._port.sessions
        try:
            if not self._port.may(session.person, Verb.PUBLISH, frame.key):
                role = session.person.role.value
                raise NotAllowed(MAY_NOT_PUBLISH(role=role, key=frame.key))
            if frame.key == presence.KEY:
                sessions.say_where(session, frame.payload, now)
            elif frame.key == presence.LOOK:
                definitions = sessions.lab.definitions
                found = presence.signed(definitions, session.person, frame.payload)
                sessions.lab.put(frame.key, found)
            elif frame.key == presence.MOVES:
                # What waited while the gateway was frozen is where a hand was, not where it is.
                if self._port.freezes.why_doubtful(now) is None:
                    sessions.move(session, frame.payload)
            else:
                sessions.lab.put(frame.key, frame.payload)
        except NotAllowed as error:
            why = told("not_allowed", error.diagnostic)
            session.text({"op": "refused", "key": frame.key, **why})

    def _call(self, frame: Call, now: float) -> None:
        session = self._session
        if not session.is_new(frame.request):
            return
        if not self._port.may(session.person, Verb.CALL, frame.key):
            may_not = MAY_NOT_CALL(role=session.person.role.value, key=frame.key)
            session.fail(frame.request, "not_allowed", may_not)
        elif self._port.moves(frame.key) and (why := self._port.freezes.why_doubtful(now)):
            session.fail(frame.request, "refused", why)
        elif not self._may_call(frame.key, now):
            session.fail(frame.request, "too_many", CALLS_FULL())
        else:
            self._waiting += 1
            task = asyncio.create_task(self._ask(frame))
            # It goes on where the socket ends: the answer waits for the next one.
            self._port.calls.add(task)
            task.add_done_callback(self._port.calls.discard)

    def _may_call(self, key: str, now: float) -> bool:
        if self._port.urgent(key):
            return self._session.budget.may_stop(now)
        full = self._waiting >= self._limits.calls_waiting
        return not full and self._calls.take(1, now) and self._session.budget.may_call(now)

    async def _ask(self, frame: Call) -> None:
        session, sessions = self._session, self._port.sessions
        timeout = min(frame.timeout_s or CALL_TIMEOUT_S, CALL_TIMEOUT_S)
        try:
            payload = await self._refusal(frame)
            if payload is None:
                payload = await sessions.lab.query(frame.key, frame.payload or None, timeout)
            session.respond(
                frame.request, sessions.visibility.response(session.person, frame.key, payload)
            )
            done = payload[SUCCESS : SUCCESS + 1] == b"\x01"
            if done and frame.key.endswith(PAUSE):
                sessions.tell_of(session, frame.key)
            elif done and frame.key == presence.SERVICE:
                sessions.hands.note(session.token, frame.payload)
            elif done and frame.key == presence.MEASURED:
                sessions.measurers.note(session.token, frame.payload)
        except TimedOut as error:
            session.fail(frame.request, "timeout", error.diagnostic)
        except NoAnswer as error:
            session.fail(frame.request, "no_service", error.diagnostic)
        except LabError as error:
            session.fail(frame.request, "refused", error.diagnostic)
        finally:
            self._waiting -= 1

    async def _refusal(self, frame: Call) -> bytes | None:
        """Return the answer to a call that the lab is not to get; None: it gets it."""
        if not frame.key.endswith(LOAD):
            return None
        definitions = self._port.sessions.lab.definitions
        wanted = definitions.decode(f"{LOAD_TYPE}_Request", frame.payload).id
        why_not = wanted and await asyncio.to_thread(
            self._port.why_not_load, self._session.person, wanted
        )
        return definitions.encode(f"{LOAD_TYPE}_Response", refusal(why_not)) if why_not else None

    async def _watch(self) -> None:
        freezes = self._port.freezes
        freezes.begin()
        try:
            while True:
                now = time.monotonic()
                freezes.look(now)
                # A client that does not read keeps `_send` from seeing this.
                if self._session.failed is not None:
                    self._close = BEHIND, self._session.failed
                    return
                longest = HIDDEN_SILENCE_S if self._hidden else SILENCE_S
                left = self._heard + longest - now
                if left <= 0:
                    self._close = SILENT, PAGE_SILENT(wait=longest)
                    return
                await asyncio.sleep(min(left, LOOK_PERIOD_S) + 0.01)
        finally:
            freezes.end()

    async def _sign_in(self, ended: asyncio.Event) -> None:
        await ended.wait()
        self._close = SIGN_IN_ENDED, diagnostics.SIGN_IN_ENDED()


def _hello(text: str) -> tuple[str, int, dict[int, str], bool]:
    """Return token, number of the last fragment, subscriptions, and whether the page is hidden."""
    message = _mapping(text)
    if message.get("op") != "hello":
        raise BadInput(NO_HELLO(wait=HELLO_S))
    wanted = message.get("subscriptions", {})
    if not isinstance(wanted, dict) or not all(_is_number(key) for key in wanted):
        raise BadInput(BAD_SUBSCRIPTIONS())
    received = _number(message, "received") if "received" in message else 0
    return (
        str(message.get("token") or ""),
        received,
        {int(number): str(key) for number, key in wanted.items()},
        bool(message.get("hidden")),
    )


def _is_number(text: str) -> bool:
    return text.isascii() and text.isdecimal() and len(text) <= 10


def _mapping(text: str) -> dict[str, Any]:
    try:
        message = orjson.loads(text)
    except orjson.JSONDecodeError as error:
        raise BadInput(NO_JSON(why=str(error))) from error
    if not isinstance(message, dict):
        raise BadInput(NO_JSON())
    return message


def _number(message: Mapping[str, Any], name: str) -> int:
    value = message.get(name)
    if not isinstance(value, int) or not 0 <= value < 1 << 32:
        raise BadInput(BAD_NUMBER(field=name, found=str(value)[:40]))
    return value


async def _close(websocket: WebSocket, code: int, why: Diagnostic | None) -> None:
    """Close a socket; why: said before in a text frame."""
    # The other side may have closed already.
    with suppress(RuntimeError, WebSocketDisconnect):
        await close(websocket, code, why)


def _nothing() -> None:
    """Do nothing."""
