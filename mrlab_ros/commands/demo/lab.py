"""The lab that a demo starts for itself: a free ROS domain, a free zenoh port, a quiet log."""

from __future__ import annotations

import os
import random
import socket
import time
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

from mrlab_ros.adapters import threads
from mrlab_ros.commands.diagnostics import NO_DOMAIN_LEFT, NO_PORT_LEFT
from mrlab_ros.commands.up.speaker import Speaker
from mrlab_ros.commands.up.surroundings import folder_for_state, stay_on_this_machine
from mrlab_ros.commands.up.web import open_in_browser, opening_url, run_facts
from mrlab_ros.core.base.errors import LabError, Misuse
from mrlab_ros.processes.lab import lab_processes, parameter_file
from mrlab_ros.processes.options import LabOptions, WebOptions, new_lab_id
from mrlab_ros.processes.run_file import RunFile
from mrlab_ros.processes.supervisor import Supervisor
from mrlab_ros.processes.web import gateway_answers
from mrlab_ros.ros.environment import domain_id

if TYPE_CHECKING:
    from rich.console import Console

ZENOH_PORT = 7447
HTTP_PORT = 8080
# How often the pages are asked whether they are there before they are shown, and for how long, s.
SHOW_PERIOD_S = 0.2
SHOW_ATTEMPTS = 150
# Domains above need ports that Linux hands out to anybody.
DOMAINS = range(102)


@dataclass
class Stage:
    """The lab that the demo has started; web: address of its pages, users: their sign-ins."""

    options: LabOptions
    domain: int
    endpoint: str
    web: str
    users: Path
    log: Log
    begin: float

    def show(self, console: Console) -> None:
        """Open the pages once they answer, where there is a display; in a thread of its own."""

        def show() -> None:
            answers = gateway_answers(self.web)
            for _ in range(SHOW_ATTEMPTS):
                if answers():
                    if open_in_browser(opening_url(self.web, self.users, "/lab")):
                        console.print(f"The lab is shown in the browser: {self.web}/lab")
                    return
                time.sleep(SHOW_PERIOD_S)

        threads.task("show", show).start()


class Log:
    """Gets every line of the nodes; prints warnings and errors at once, all lines with `speak`."""

    def __init__(self, console: Console) -> None:
        self._say = Speaker(console)
        self.speak = False
        # Messages of processes about their own end are expected.
        self.stopping = False
        self.trouble: list[str] = []

    def __call__(self, name: str, line: str) -> None:
        known = line.startswith(("[INFO]", "[DEBUG]")) or not line.strip()
        quiet = known or self.stopping
        if not quiet:
            self.trouble.append(f"{name}: {line}")
        if self.speak or not quiet:
            self._say(name, line)


@contextmanager
def running_lab(console: Console, config: Path | None) -> Iterator[Stage]:
    """Run a lab on a free ROS domain and zenoh port."""
    begin = time.monotonic()
    stay_on_this_machine()
    with folder_for_state(None) as folder:
        endpoint = f"tcp/127.0.0.1:{free_port(ZENOH_PORT)}"
        options = LabOptions(
            lab_id=new_lab_id(),
            config=parameter_file(config),
            state_dir=folder,
            physics=False,
            listen=endpoint,
            web=WebOptions("127.0.0.1", free_port(HTTP_PORT)),
        )
        web = run_facts(options)
        run_file, domain = claim_free_domain(
            state_dir=str(folder),
            zenoh=endpoint,
            web=web,
        )
        os.environ["ROS_DOMAIN_ID"] = str(domain)
        log = Log(console)
        try:
            specs = [process.spec(options) for process in lab_processes(options)]
            with Supervisor(specs, log, run_file.write):
                console.print(f"Lab on ROS domain {domain}, zenoh at {endpoint}", style="bold")
                try:
                    yield Stage(
                        options, domain, endpoint, web["here"], Path(web["users"]), log, begin
                    )
                finally:
                    log.stopping = True
        finally:
            run_file.release()


def free_port(preferred: int) -> int:
    """Return a TCP port of the loopback that nobody listens on, `preferred` where it is free."""
    for port in (preferred, 0):
        with socket.socket() as probe:
            # As a server does: what a closed connection left behind is no hindrance.
            probe.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
            try:
                probe.bind(("127.0.0.1", port))
            except OSError:
                continue
            return int(probe.getsockname()[1])
    raise LabError(NO_PORT_LEFT())


def domain_is_free(domain: int) -> bool:
    """Return whether none of the first ten participants that DDS allows in `domain` exists."""
    for participant in range(10):
        with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as probe:
            try:
                probe.bind(("", 7400 + 250 * domain + 10 + 2 * participant))
            except OSError:
                return False
    return True


def claim_free_domain(**facts: object) -> tuple[RunFile, int]:
    """Take a ROS domain that nobody uses: ROS_DOMAIN_ID's where that is free."""
    wanted = [domain_id()] if os.environ.get("ROS_DOMAIN_ID") else []
    others = random.sample(DOMAINS, len(DOMAINS))
    for domain in wanted + others:
        if not domain_is_free(domain):
            continue
        run_file = RunFile(domain)
        try:
            run_file.claim(**facts)
        except Misuse:
            continue
        return run_file, domain
    raise LabError(NO_DOMAIN_LEFT())
