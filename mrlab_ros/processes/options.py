"""Options of a lab."""

from __future__ import annotations

import getpass
import os
import platform
import time
from dataclasses import dataclass
from pathlib import Path


@dataclass(frozen=True)
class WebOptions:
    """Options of a lab's gateway beside the lab's own.

    host, port: where it listens. certificate, certificate_key: for HTTPS in place of those of the
    keys folder. public_url: the address of a reverse proxy before it. oidc: YAML file of an OpenID
    Connect provider. limits: YAML file of what pages may take. classroom: a folder that `mrlab
    class` made. lti: YAML file of the learning platform whose course the class is.
    """

    host: str
    port: int
    certificate: Path | None = None
    certificate_key: Path | None = None
    public_url: str = ""
    oidc: Path | None = None
    limits: Path | None = None
    classroom: Path | None = None
    lti: Path | None = None


@dataclass(frozen=True)
class LabOptions:
    """Options of a lab.

    config: a ROS parameter file. state_dir: the folder for scene and trajectories. robots:
    models to begin with. frames: publish /tf and markers. listen: where zenoh clients connect;
    empty: the bridge's default. connect: a router that clients connect to in place of the
    bridge. keys: a keys folder. insecure: listen beyond this machine without keys. store: URL
    or folder of uploads and trajectories; empty: in state_dir. socket: on which this user's
    commands connect; empty: none. web: the gateway; None: no pages. sim_time: the topic /clock
    gives the time. only: names of the processes that this machine runs; empty: all. lab_id:
    distinguishes this lab from others on the same ROS domain; empty:
    nothing is ignored, as in a lab on several machines, which agree on none.
    """

    config: Path
    state_dir: Path
    robots: tuple[str, ...] = ()
    physics: bool = True
    frames: bool = True
    bridge: bool = True
    listen: str = ""
    connect: str = ""
    keys: Path | None = None
    insecure: bool = False
    store: str = ""
    socket: str = ""
    web: WebOptions | None = None
    sim_time: bool = False
    only: frozenset[str] = frozenset()
    lab_id: str = ""


def new_lab_id() -> str:
    """Return an id that no other lab has, and that says whose lab it is, where, and since when."""
    try:
        user = getpass.getuser()
    except (KeyError, OSError):
        user = str(os.getuid())
    since = time.strftime("%Y-%m-%d %H:%M")
    return f"{os.urandom(4).hex()} ({user}@{platform.node()}, since {since})"
