"""Gives the thread that asks for it precedence over the machine's other work.

SCHED_RR comes first: such a thread runs as soon as it is ready. The kernel grants it to root, to
CAP_SYS_NICE and where `ulimit -r` says so (`@GROUP - rtprio 20` in /etc/security/limits.conf).
Where it does not, a nice level below 0 is asked for, which `ulimit -e` grants.
"""

from __future__ import annotations

import contextlib
import os
import threading

# Above ordinary work, below the kernel's own threads and audio servers.
REALTIME = 10
NICE = -10


def take_precedence(realtime: int = REALTIME) -> str:
    """Raise the calling thread's priority as far as permitted; return in words what it has.

    What the thread starts has ordinary priority again.
    """
    with contextlib.suppress(OSError, AttributeError):
        os.sched_setscheduler(0, os.SCHED_RR | os.SCHED_RESET_ON_FORK, os.sched_param(realtime))
        return f"SCHED_RR {realtime}"
    with contextlib.suppress(OSError):
        os.setpriority(os.PRIO_PROCESS, threading.get_native_id(), NICE)
        return f"nice {NICE}"
    return (
        "ordinary priority: neither SCHED_RR (ulimit -r) nor a nice level (ulimit -e) is permitted"
    )
