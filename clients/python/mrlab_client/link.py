"""The lab's topics and services over its WebSocket; docs/link.md has every byte of it."""

from __future__ import annotations

import json
import struct
import threading
import time
import traceback
from collections.abc import Callable, Mapping
from fnmatch import fnmatchcase
from typing import Any

from websockets.exceptions import ConnectionClosed
from websockets.sync.client import connect
from websockets.typing import Subprotocol

from mrlab_client.errors import LabError, NoAnswer, of_plain
from mrlab_client.http import Gateway
from mrlab_client.messages import Messages

PING_PERIOD_S = 1.0
# Batches that may be under way; see "Credit".
AHEAD = 2
NEWEST_TIMEOUT_S = 5.0
NEWEST, FRAGMENT, CALL, CREDIT, RECEIVED = 1, 2, 1, 3, 4
RESPONSE, ERROR = 3, 4
MESSAGE = struct.Struct("<IIdI")
HEAD = struct.Struct("<BBHI")


class Link:
    """One connection; its thread calls the callbacks."""

    def __init__(self, gateway: Gateway) -> None:
        self.messages = Messages(gateway.get("/api/schema"))
        self.services: dict[str, str] = {}
        self._topics: dict[int, tuple[str, str]] = {}
        self._callbacks: dict[int, tuple[str, Callable[[str, Any], None]]] = {}
        self._answers: dict[int, tuple[int, bytes]] = {}
        self._changed = threading.Condition()
        self._closed: LabError | None = None
        self._number = 0
        self._record = bytearray()
        address = "ws" + gateway.url.removeprefix("http") + "/link"
        secure = gateway.context if address.startswith("wss") else None
        headers = {"Authorization": f"Bearer {gateway.token}"} if gateway.token else {}
        try:
            self._socket = connect(
                address,
                subprotocols=[Subprotocol("mrlab.1")],
                additional_headers=headers,
                ssl=secure,
                max_size=None,
                ping_interval=None,
            )
        except Exception as error:
            raise NoAnswer(f"The lab's socket does not answer at {address}: {error}") from None
        self._say(op="hello", token="", received=0, subscriptions={}, hidden=False)
        self._thread = threading.Thread(target=self._read, daemon=True, name="mrlab link")
        self._thread.start()
        self._wait(lambda: bool(self.services), 10.0, "the lab")

    def close(self) -> None:
        """End the connection, and with it every subscription."""
        self._socket.close()
        if threading.current_thread() is not self._thread:
            self._thread.join()

    def subscribe(self, key: str, callback: Callable[[str, Any], None]) -> None:
        """Call `callback` with the key and each message of the topics that fit `key`.

        Of a stream only the newest comes where they come faster than they are taken. A latched
        topic gives its newest message at once. What `callback` raises is printed.
        """
        with self._changed:
            self._number += 1
            number = self._number
            self._callbacks[number] = key, callback
        self._say(op="subscribe", id=number, key=key)

    def call(
        self, service: str, values: Mapping[str, Any] | None = None, timeout: float = 60.0
    ) -> Any:
        """Call a service, such as ur5e_1/play; return its answer. Raises LabError, NoAnswer."""
        kind = self.services.get(service)
        if kind is None:
            raise NoAnswer(f"Nobody offers {service}: the robot is not there.", "no_service")
        payload = self.messages.encode(f"{kind}_Request", values or {})
        with self._changed:
            self._number += 1
            number = self._number
        key = service.encode()
        head = struct.pack("<BBHII", CALL, 0, len(key), number, round(timeout * 1000))
        self._send(head + key + payload)
        self._wait(lambda: number in self._answers, timeout + 10.0, service)
        kind_of_record, data = self._answers.pop(number)
        if kind_of_record == ERROR:
            raise of_plain(json.loads(data)["diagnostic"])
        answer = self.messages.decode(f"{kind}_Response", data)
        if not getattr(answer, "success", True):
            values = {each.key: each.value for each in getattr(answer, "values", ())}
            raise LabError(answer.message, getattr(answer, "code", ""), values)
        return answer

    def _wait(self, true: Callable[[], bool], timeout: float, what: str) -> None:
        with self._changed:
            found = self._changed.wait_for(lambda: true() or self._closed is not None, timeout)
            if self._closed is not None and not true():
                raise self._closed
        if not found:
            raise NoAnswer(f"No answer from {what} within {timeout:g} s.")

    def _say(self, **fields: Any) -> None:
        self._send(json.dumps(fields))

    def _send(self, frame: str | bytes) -> None:
        try:
            self._socket.send(frame)
        except (ConnectionClosed, OSError):
            raise self._closed or NoAnswer("The connection to the lab is closed.") from None

    # the thread ------------------------------------------------------------------------------

    def _read(self) -> None:
        pinged = 0.0
        try:
            while True:
                if time.monotonic() - pinged > PING_PERIOD_S:
                    pinged = time.monotonic()
                    self._say(op="ping", asked=pinged)
                try:
                    frame = self._socket.recv(timeout=PING_PERIOD_S)
                except TimeoutError:
                    continue
                self._take(json.loads(frame)) if isinstance(frame, str) else self._unpack(frame)
        except (ConnectionClosed, LabError):
            pass
        finally:
            with self._changed:
                self._closed = self._closed or NoAnswer("The connection to the lab is closed.")
                self._changed.notify_all()

    def _take(self, text: dict[str, Any]) -> None:
        with self._changed:
            if text["op"] == "welcome":
                self._send(HEAD.pack(CREDIT, 0, 0, AHEAD))
            elif text["op"] == "lab":
                self.services = dict(text["services"])
            elif text["op"] == "topic":
                self._topics[text["id"]] = text["key"], text["type"]
            elif text["op"] == "closing":
                self._closed = of_plain(text["diagnostic"])
            elif text["op"] == "refused" and "id" in text:
                self._callbacks.pop(text["id"], None)
                print(text["message"])
            self._changed.notify_all()

    def _unpack(self, frame: bytes) -> None:
        kind, last, count, number = HEAD.unpack_from(frame)
        if kind == NEWEST:
            place = HEAD.size
            for _ in range(count):
                topic, length, _, _ = MESSAGE.unpack_from(frame, place)
                place += MESSAGE.size
                self._deliver(topic, frame[place : place + length])
                place += length
                place += -place % 8
            self._send(HEAD.pack(CREDIT, 0, 0, number + AHEAD))
        elif kind == FRAGMENT:
            self._record += frame[HEAD.size :]
            self._send(HEAD.pack(RECEIVED, 0, 0, number))
            if last & 1:
                record, self._record = bytes(self._record), bytearray()
                self._complete(record)

    def _complete(self, record: bytes) -> None:
        number, length, _, kind = MESSAGE.unpack_from(record)
        data = record[MESSAGE.size : MESSAGE.size + length]
        if kind not in (RESPONSE, ERROR):
            self._deliver(number, data)
            return
        with self._changed:
            self._answers[number] = kind, data
            self._changed.notify_all()

    def _deliver(self, topic: int, payload: bytes) -> None:
        key, kind = self._topics.get(topic, ("", ""))
        wanted = [call for pattern, call in tuple(self._callbacks.values()) if _fits(key, pattern)]
        if not wanted:
            return
        message = self.messages.decode(kind, payload)
        for each in wanted:
            try:
                each(key, message)
            except Exception:
                traceback.print_exc()


class Newest:
    """The newest message of a latched topic."""

    def __init__(self, link: Link, key: str) -> None:
        self._key, self._message = key, None
        self._there = threading.Event()
        link.subscribe(key, self._take)

    def _take(self, _: str, message: Any) -> None:
        self._message = message
        self._there.set()

    def newest(self) -> Any:
        """Return it; raise NoAnswer where there is none."""
        if not self._there.wait(NEWEST_TIMEOUT_S):
            raise NoAnswer(f"The lab says nothing on {self._key}.")
        return self._message


def _fits(key: str, pattern: str) -> bool:
    return key.count("/") == pattern.count("/") and fnmatchcase(key, pattern)
