"""The clients of a gateway: who is connected, and who may come back."""

from __future__ import annotations

import asyncio
import logging
import secrets
from dataclasses import dataclass, field
from weakref import WeakValueDictionary

import orjson

from mrlab_ros.core.base.errors import LabError
from mrlab_ros.core.bridge.rules import Role, Rules
from mrlab_ros.gateway.errors import TooMany
from mrlab_ros.gateway.lab.connection import LabConnection, Phase
from mrlab_ros.gateway.link import presence
from mrlab_ros.gateway.link.diagnostics import PAGES_FULL
from mrlab_ros.gateway.link.hub import Hub
from mrlab_ros.gateway.link.limits import Budget, LinkLimits
from mrlab_ros.gateway.link.session import LinkSession, May
from mrlab_ros.gateway.link.visibility import Visibility
from mrlab_ros.gateway.people.person import Person

# s for which a client that lost its socket is waited for.
RESUME_S = 30.0
# s after which its hands let go: a network that stutters makes nobody drop a thing.
LET_GO_S = 2.0

log = logging.getLogger("mrlab.gateway")


@dataclass(eq=False)
class Client:
    """A session and the socket that serves it now. socket: None while there is none."""

    session: LinkSession
    socket: object | None = None
    # When its last socket ended, s, monotonic.
    left_at: float = field(default=0.0)


class Sessions:
    """All sessions; times are s, monotonic."""

    def __init__(self, lab: LabConnection, rules: Rules, may: May, limits: LinkLimits) -> None:
        self.lab = lab
        self.hub = Hub(lab, rules)
        self.visibility = Visibility(lab.definitions)
        self.displays = presence.Displays(lab.definitions)
        self.hands = presence.Hands(lab.definitions)
        self.measurers = presence.Measurers(lab.definitions)
        self._letting_go: set[asyncio.Task[None]] = set()
        self._may = may
        self._limits = limits
        self._clients: dict[str, Client] = {}
        # By the id of a person; each lives as long as a client of that person.
        self._budgets: WeakValueDictionary[str, Budget] = WeakValueDictionary()
        self._stop = lab.on_change(self._on_change)

    def close(self) -> None:
        """End all sessions."""
        self._stop()
        for task in self._letting_go:
            task.cancel()
        for client in list(self._clients.values()):
            self.end(client)
        self.hub.close()

    def open(self, person: Person, token: str, socket: object, now: float) -> tuple[Client, bool]:
        """Return a client for a new socket, and whether it is the one that `token` names.

        Only the same person and role may come back. The client's former socket loses it. Raises
        TooMany.
        """
        self.expire(now)
        client = self._clients.get(token)
        if client is not None and client.session.person == person:
            client.socket = socket
            return client, True
        own = sum(each.session.person.id == person.id for each in self._clients.values())
        # Nobody can keep an instructor out by taking all places.
        full = len(self._clients) >= self._limits.pages and not person.role.may(Role.INSTRUCTOR)
        if own >= self._limits.pages_each or full:
            found = PAGES_FULL(own=own, person=person.name, all=len(self._clients))
            raise TooMany(found, RESUME_S)
        budget = self._budgets.setdefault(person.id, Budget(self._limits))
        session = LinkSession(
            secrets.token_urlsafe(18), person, self.hub, self.visibility, self._may, budget
        )
        client = self._clients[session.token] = Client(session, socket)
        return client, False

    def leave(self, client: Client, socket: object, now: float) -> None:
        """Let a client be without a socket; nothing happens where it has another one already."""
        if client.socket is socket:
            client.socket = None
            client.left_at = now
            self._see_off(client.session)
            task = asyncio.ensure_future(self._forget(client, now))
            self._letting_go.add(task)
            task.add_done_callback(self._letting_go.discard)

    def end(self, client: Client) -> None:
        """Forget a client."""
        session = client.session
        if self._clients.pop(session.token, None) is not None:
            self._see_off(session)
            session.close()

    def say_where(self, session: LinkSession, payload: bytes, now: float) -> None:
        """Give the lab a client's Presence. Raises BadInput or NotAllowed."""
        found = self.displays.admit(session.token, session.person, payload, now)
        if found is not None:
            self.lab.put(presence.KEY, found)

    def move(self, session: LinkSession, payload: bytes) -> None:
        """Give the lab a client's Move, where its hand has what it carries. Raises BadInput."""
        if self.hands.follow(session.token, payload):
            self.lab.put(presence.MOVES, payload)

    def tell_of(self, actor: LinkSession, service: str) -> None:
        """Tell all other clients who called a service."""
        deed = {"op": "did", "who": actor.person.name, "service": service}
        for client in self._clients.values():
            if client.session is not actor and client.socket is not None:
                client.session.text(deed)

    def _see_off(self, session: LinkSession) -> None:
        gone = self.displays.leave(session.token, session.person)
        if gone is not None:
            self.lab.put(presence.KEY, gone)

    async def _forget(self, client: Client, left_at: float) -> None:
        """Let go what a client held that does not come back at once; end it after RESUME_S.

        A call that was under way when it left may take a thing still, and the lab may be away:
        both are looked at again every LET_GO_S.
        """
        failed: dict[str, LabError] = {}
        for _ in range(round(RESUME_S / LET_GO_S)):
            await asyncio.sleep(LET_GO_S)
            if client.socket is not None or client.left_at != left_at:
                return
            failed = await self._let_go(client.session)
        for name, error in failed.items():
            said = "%s, which %s held, stays in the air: %s"
            log.warning(said, name, client.session.person.name, error)
            self.hands.forget(client.session.token, name)
        # A page that crashed took nothing with it: others would go on around its furniture.
        for call in self.measurers.leave(client.session.token):
            try:
                await self.lab.query(presence.MEASURED, call)
            except LabError as error:
                said = "surfaces that %s measured stay in the room: %s"
                log.warning(said, client.session.person.name, error)
        self.end(client)

    async def _let_go(self, session: LinkSession) -> dict[str, LabError]:
        """Let go what a client held; return by object why that failed."""
        failed = {}
        for name, call in self.hands.held_by(session.token).items():
            try:
                await self.lab.query(presence.SERVICE, call)
            except LabError as error:
                failed[name] = error
            else:
                self.hands.forget(session.token, name)
        return failed

    def expire(self, now: float) -> None:
        """Forget clients that did not come back."""
        for client in list(self._clients.values()):
            gone = client.socket is None and now - client.left_at > RESUME_S
            if gone or (client.session.failed and client.socket is None):
                self.end(client)

    def lab_state(self) -> bytes:
        """Return how the lab is, as the text frame of its clients."""
        keys = self.lab.keys
        return orjson.dumps(
            {
                "op": "lab",
                "phase": self.lab.phase.value,
                "topics": dict(keys.topics),
                "services": dict(keys.services),
                "latched": sorted(keys.latched),
            }
        )

    @property
    def connected(self) -> bool:
        return self.lab.phase is Phase.OPEN

    def _on_change(self) -> None:
        state = self.lab_state()
        for client in self._clients.values():
            client.session.show_lab(state)
