"""Bounds what the people of a lab with keys may take: sessions and bytes of each certificate.

Pure: times are arguments, s, monotonic. zenoh bounds sessions of all people together only, and
messages of each kind; here each person has a share of their own, whatever it is used for.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field

from mrlab_ros.core.bridge.access import Person
from mrlab_ros.core.bridge.rules import Role
from mrlab_ros.core.runtime.bucket import Bucket

# s for which somebody stays out who has sent too much.
OUT_S = 30.0
# s after which the same is logged again of the same person.
QUIET_S = 60.0
# Sessions beside those of the people: of links that are being closed.
SPARE = 50


@dataclass(frozen=True)
class Share:
    """The share of one person: sessions, bytes a second, and bytes at once."""

    sessions: int
    rate: float
    burst: float


@dataclass(frozen=True)
class Link:
    """A connection: both addresses, such as tls/10.0.0.5:51234, and its certificate's name."""

    local: str
    remote: str
    common_name: str

    @property
    def host(self) -> str:
        return self.remote.partition("/")[2].rpartition(":")[0]


@dataclass(frozen=True)
class Cut:
    """Links to close, and why; words: empty where the log has them already."""

    links: tuple[Link, ...]
    words: str


@dataclass
class _Guest:
    """A person as the bridge sees them. bucket: None where bytes are not limited."""

    name: str
    bucket: Bucket | None
    links: dict[Link, int] = field(default_factory=dict)
    out_until: float = float("-inf")
    # When each kind of refusal was logged last.
    logged: dict[str, float] = field(default_factory=dict)


class Guests:
    """Connected people, and links that must be closed.

    people: who may connect. by_certificate: a link without the certificate of one of them is
    closed; otherwise people are told apart by their addresses, and their bytes are not limited.
    """

    def __init__(self, people: Iterable[Person], share: Share, *, by_certificate: bool) -> None:
        self._people = {person.common_name: person for person in people}
        self._share = share
        self._by_certificate = by_certificate
        self._guests: dict[str, _Guest] = {}

    @property
    def room(self) -> int:
        """Sessions that all people may have together: nobody's share is taken by others."""
        return self._share.sessions * len(self._people) + SPARE

    def opened(self, link: Link, now: float) -> Cut | None:
        """Note a new link; return it to be closed where it must not stay."""
        person = self._people.get(link.common_name)
        if self._by_certificate and person is None:
            words = (
                f"a client at {link.host} has the certificate {link.common_name or 'of nobody'}, "
                "which is not, or no longer, of a person of this lab; it was disconnected"
            )
            return Cut((link,), self._once(self._guest(link, None), "person", words, now))
        guest = self._guest(link, person)
        if now < guest.out_until:
            return Cut((link,), "")
        if len(guest.links) >= self._share.sessions:
            words = (
                f"{guest.name} has {len(guest.links)} sessions and may have no more; close some, "
                "or raise the bridge's parameter sessions_each"
            )
            return Cut((link,), self._once(guest, "sessions", words, now))
        guest.links[link] = 0
        return None

    def closed(self, link: Link) -> None:
        """Forget a link; one that is not known is nothing new."""
        identity = link.common_name or link.host
        guest = self._guests.get(identity)
        if guest is None:
            return
        guest.links.pop(link, None)
        if not (guest.links or self._by_certificate):
            del self._guests[identity]  # addresses are without number

    @property
    def links(self) -> list[Link]:
        """The links whose bytes count."""
        return [
            link for guest in self._guests.values() if guest.bucket for link in tuple(guest.links)
        ]

    def received(self, totals: Mapping[Link, int], now: float) -> list[Cut]:
        """Count the bytes that links have sent since they opened; return what is to be closed."""
        found = []
        for guest in self._guests.values():
            if guest.bucket is None:
                continue
            sent = 0
            for link, before in guest.links.items():
                total = totals.get(link, before)
                guest.links[link] = total
                sent += total - before
            if guest.links and not guest.bucket.take(sent, now):
                words = (
                    f"{guest.name} sent {sent / 1e6:.3g} MB in a moment and may send "
                    f"{self._share.rate / 1e3:.3g} kB a second; disconnected for {OUT_S:g} s"
                )
                found.append(Cut(tuple(guest.links), self._once(guest, "bytes", words, now)))
                guest.links.clear()
                guest.out_until = now + OUT_S
        return found

    def _guest(self, link: Link, person: Person | None) -> _Guest:
        identity = link.common_name or link.host
        guest = self._guests.get(identity)
        if guest is None:
            limited = person is not None and not person.role.may(Role.INSTRUCTOR)
            bucket = Bucket(self._share.rate, self._share.burst) if limited else None
            name = f"the client at {link.host}" if person is None else person.name
            guest = self._guests[identity] = _Guest(name, bucket)
        return guest

    @staticmethod
    def _once(guest: _Guest, kind: str, words: str, now: float) -> str:
        if now - guest.logged.get(kind, float("-inf")) < QUIET_S:
            return ""
        guest.logged[kind] = now
        return words
