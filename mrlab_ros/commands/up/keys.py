"""Keys of `mrlab up`: where the bridge may listen, and changes of the keys."""

from __future__ import annotations

import socket
import threading
from collections.abc import Callable
from pathlib import Path
from typing import NamedTuple

from mrlab_ros.commands.diagnostics import (
    BRIDGE_PORT_TAKEN,
    KEYS_EXPIRE,
    KEYS_OR_INSECURE,
    ROUTER_WITHOUT_KEYS,
)
from mrlab_ros.commands.output import with_fixes
from mrlab_ros.core.base.diagnostic import Fix
from mrlab_ros.core.base.errors import BadInput
from mrlab_ros.processes.child_process import SELF

LISTEN = "tcp/127.0.0.1:7447"
# Period at which a lab checks whether its keys have changed, s.
KEYS_PERIOD_S = 1.0
# A lab whose certificate expires earlier says so when it starts, days.
EXPIRES_SOON = 30


def checked_listen(chosen: str, keys: Path | None, insecure: bool) -> str:
    """Return where the bridge listens; raise BadInput where it may not, or keys are unusable."""
    from mrlab_ros.adapters.keys.folder import Keys, now
    from mrlab_ros.core.bridge.links import EVERYWHERE, check_endpoints

    if insecure and keys is not None:
        raise BadInput(KEYS_OR_INSECURE())
    listen = chosen or (LISTEN if keys is None else EVERYWHERE[0])
    check_endpoints((listen,), insecure, keys is not None)
    if keys is not None:
        Keys(keys).check(now())
    return listen


def asks_for_passwords(keys: Path | None) -> bool:
    """Return whether nobody gets in without a password, not even through the lab's socket."""
    from mrlab_ros.adapters.keys.folder import Keys

    return keys is not None and Keys(keys).login.by_password


def free_endpoint(endpoint: str, option: str = "--zenoh-listen ") -> str:
    """Return a zenoh endpoint with a free port in place of 0, so that others can be told of it.

    Raises BadInput where nobody can listen there. option: what chooses another one.
    """
    host, _, port = endpoint.partition("/")[2].rpartition(":")
    if not port.isdigit():
        return endpoint
    host = host.strip("[]")
    with socket.socket(socket.AF_INET6 if ":" in host else socket.AF_INET) as probe:
        # As a server does: what a closed connection left behind is no hindrance.
        probe.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        try:
            probe.bind((host, int(port)))
        except OSError as error:
            why = error.strerror or str(error)
            taken = BRIDGE_PORT_TAKEN(endpoint=endpoint, why=why, option=option)
            raise BadInput(taken) from error
        return f"{endpoint.removesuffix(f':{port}')}:{probe.getsockname()[1]}"


def checked_router(router: str, listen: str, keys: Path | None, insecure: bool) -> str:
    """Return the router to connect to; raise BadInput where the lab may not, or has no key."""
    from mrlab_ros.adapters.keys.folder import Keys, now
    from mrlab_ros.core.bridge.links import check_router

    if keys is None or listen or insecure:
        raise BadInput(ROUTER_WITHOUT_KEYS(router=router))
    check_router("client", (), (router,))
    folder = Keys(keys)
    folder.check(now())
    folder.lab_settings(now())
    return router


def tell_when_keys_expire(
    folder: Path, say: Callable[[str, str], None], *, router: bool = False
) -> None:
    """Say so where the lab's certificate expires soon: nobody could connect from then on."""
    from mrlab_ros.adapters.keys.folder import Keys, now

    keys = Keys(folder)
    left = (keys.server_expires(router=router) - now()).days
    if left < EXPIRES_SOON:
        commands = ("renew", *(("router",) if router else ()))
        fixes = tuple(Fix(command=keys.command(each)) for each in commands)
        say(SELF, with_fixes(KEYS_EXPIRE(days=left, fixes=fixes)))


class KeyChanges(NamedTuple):
    """When each file of a keys folder was changed last, ns: of the bridge, and of the pages."""

    bridge: tuple[int, ...]
    web: tuple[int, ...]


def keys_changed_at(folder: Path) -> KeyChanges:
    """Return when the keys of a lab were changed last."""
    from mrlab_ros.adapters.keys.folder import Keys

    return KeyChanges(Keys(folder).changed_at(), web_keys_changed_at(folder))


def web_keys_changed_at(folder: Path) -> tuple[int, ...]:
    """Return when the files of the gateway were changed last, ns."""
    from mrlab_ros.adapters.keys import people

    names = ("server.pem", "server.key", "gateway.json5")
    return tuple(people.changed_at(folder.expanduser() / name) for name in names)


def follow_keys(
    folder: Path,
    seen: KeyChanges,
    stop: threading.Event,
    say: Callable[[str, str], None],
    restart: Callable[[str], None],
) -> None:
    """Restart the bridge whenever the keys change, until `stop`: it reads them at its start.

    The pages start again where their own certificate or key has changed.

    seen: the changes before both were started.
    """
    from mrlab_ros.adapters.keys.folder import Keys, now

    reported = ""
    while not stop.wait(KEYS_PERIOD_S):
        try:
            with Keys.while_unchanged(folder) as keys:
                # A command that changes the keys right now has not written all files yet.
                if keys is None or (changed := keys.changed_at()) == seen.bridge:
                    continue
                keys.check(now())
            say(SELF, "the keys have changed; the bridge starts again with them")
            restart("bridge")
            if (web := web_keys_changed_at(folder)) != seen.web:
                restart("web")
            seen = KeyChanges(changed, web)
            reported = ""
        except BadInput as error:
            if str(error) != reported:
                reported = str(error)
                say(SELF, f"the keys have changed and cannot be used: {reported}")
