"""Wait until a lab is complete and say so: `... ready LAB ROBOTS NODE,NODE,... SERVICE...`.

The launch file runs it as `python -m mrlab_ros.processes.ready` beside the lab's processes. What
it starts after them, which calls the services, waits for its end.
"""

from __future__ import annotations

import functools
import signal
import sys
import threading
import time

# The lab is waited for this often, for readiness.READY_TIMEOUT_S each time.
MOST_WAITS = 15


def main() -> None:
    """Exit with 0 once the nodes and so many robots of the lab with the id LAB are there.

    Exits with 1 where they do not come, or where another lab on the domain would carry out a call
    of one of the services, too.
    """
    signal.signal(signal.SIGINT, signal.SIG_DFL)
    began = time.monotonic()
    lab, robots, names, services = sys.argv[1], int(sys.argv[2]), sys.argv[3], sys.argv[4:]
    from mrlab_ros.core.runtime.identity import Identity
    from mrlab_ros.processes.lab import NODES
    from mrlab_ros.processes.readiness import Readiness
    from mrlab_ros.ros.graph_node import Graph

    nodes = [NODES[name] for name in names.split(",")]
    identity = Identity(lab, functools.partial(print, flush=True))
    with Graph() as graph:
        readiness = Readiness(graph, nodes, robots, identity)
        for _ in range(MOST_WAITS):
            missing = readiness.wait(threading.Event())
            if not missing:
                break
            said = f"{missing} is missing after {time.monotonic() - began:.0f} s"
            print(f"the lab is not ready: {said}; the lines above say why", flush=True)
        else:
            sys.exit("nobody waits for the lab any longer")
        print(f"the lab is ready after {time.monotonic() - began:.1f} s", flush=True)
        if refused := [why for service in services if (why := readiness.why_not(service))]:
            sys.exit("\n".join(map(str, refused)))


if __name__ == "__main__":
    main()
