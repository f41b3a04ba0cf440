"""`python -m mrlab_ros.processes.router FILE`: a zenoh router, as `zenohd -c FILE` runs one.

zenoh's Python package is the same engine, so that a machine with this package needs no other
program. FILE: one of `mrlab keys router`, or any zenoh configuration in which mode is router.
"""

from __future__ import annotations

import argparse
import json
import signal
import sys
from pathlib import Path

from mrlab_ros.adapters.zenoh.configuration import configuration, log_logins
from mrlab_ros.adapters.zenoh.session import ZenohSession
from mrlab_ros.core.base.errors import BadInput, LabError
from mrlab_ros.processes.diagnostics import NOT_A_ROUTER

STOPS = (signal.SIGINT, signal.SIGTERM)


def main() -> None:
    """Route until SIGINT or SIGTERM; what is wrong with the file is one sentence, exit code 1."""
    parser = argparse.ArgumentParser(prog="python -m mrlab_ros.processes.router")
    parser.add_argument("file", type=Path, metavar="FILE", help="zenoh's configuration (json5)")
    file = parser.parse_args().file
    # zenoh's threads inherit the mask: a signal waits for this one.
    signal.pthread_sigmask(signal.SIG_BLOCK, STOPS)
    log_logins(passwords=False)
    try:
        config = configuration(file)
        if (mode := json.loads(config.get_json("mode"))) != "router":
            raise BadInput(NOT_A_ROUTER(path=str(file), mode=mode or "peer"))
        session = ZenohSession(config)
    except LabError as error:
        sys.exit(f"router: {error}")
    print(f"router: zenoh {session.zid} routes as {file} says; Ctrl-C stops it", flush=True)
    signal.sigwait(STOPS)
    session.close()


if __name__ == "__main__":
    main()
