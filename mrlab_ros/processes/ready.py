"""Wait until a lab is complete and say so: `python -m mrlab_ros.processes.ready ROBOTS NODE...`.

The launch file runs it beside the lab's processes; what it starts after them waits for its end.
"""

from __future__ import annotations

import signal
import sys
import threading
import time

# The lab is waited for this often, for readiness.READY_TIMEOUT_S each time.
MOST_WAITS = 15


def main() -> None:
    """Exit with 0 once the nodes and so many robots are there, with 1 where they do not come."""
    signal.signal(signal.SIGINT, signal.SIG_DFL)
    began = time.monotonic()
    robots, names = int(sys.argv[1]), sys.argv[2:]
    from mrlab_ros.processes.lab import NODES
    from mrlab_ros.processes.readiness import wait_until_complete

    nodes = [NODES[name] for name in names]
    for _ in range(MOST_WAITS):
        missing = wait_until_complete(threading.Event(), nodes, robots)
        if not missing:
            break
        said = f"{missing} is missing after {time.monotonic() - began:.0f} s"
        print(f"the lab is not ready: {said}; the lines above say why", flush=True)
    else:
        sys.exit("nobody waits for the lab any longer")
    print(f"the lab is ready after {time.monotonic() - began:.1f} s", flush=True)


if __name__ == "__main__":
    main()
