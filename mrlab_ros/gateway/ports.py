"""The outside worlds of a gateway; tests put fakes in their place."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from fastapi.requests import HTTPConnection

if TYPE_CHECKING:
    from mrlab_ros.adapters.store.port import ObjectStore
    from mrlab_ros.gateway.checks.desk import Checker
    from mrlab_ros.gateway.lab.connection import LabConnection
    from mrlab_ros.gateway.people.oidc import Oidc
    from mrlab_ros.gateway.people.people import People
    from mrlab_ros.gateway.settings import Settings


@dataclass
class Ports:
    """The outside worlds of a gateway; what is None is not there, and its routes say so.

    people, store, oidc: None for those of the settings. checker: None: a process a check.
    """

    lab: LabConnection | None = None
    people: People | None = None
    store: ObjectStore | None = None
    oidc: Oidc | None = None
    checker: Checker | None = None


def real_ports(settings: Settings) -> Ports:
    """Return the ports that `settings` name; nothing is opened yet."""
    from mrlab_ros.gateway.lab.zenoh_lab import lab_at

    return Ports(lab_at(settings.zenoh, settings.zenoh_config, settings.prefix))


def ports(connection: HTTPConnection) -> Ports:
    """Return the ports, as a dependency of routes and sockets."""
    found: Ports = connection.app.state.ports
    return found
