"""The end of a process with the launcher that started it."""

from __future__ import annotations

import os
import select
import signal
from pathlib import Path

# The environment variable with the id of the process that starts others and may end before them.
LAUNCHER = "MRLAB_LAUNCHER"
PR_SET_PDEATHSIG = 1


def end_with_launcher() -> None:
    """End as for SIGTERM when the launcher ends, where one named itself and started this process.

    `ros2 launch` leaves its processes behind when it is ended by SIGTERM.
    """
    named = os.environ.get(LAUNCHER, "")
    if named == str(os.getppid()):
        _end_with_parent(named)
    elif named.isdigit():
        # A launch prefix that stays, such as strace or a terminal, is between them.
        _end_with_ancestor(int(named))


def _end_with_parent(parent: str) -> None:
    """Have the kernel send SIGTERM when `parent` ends."""
    import ctypes  # seldom needed

    ctypes.CDLL(None).prctl(PR_SET_PDEATHSIG, signal.SIGTERM)
    if parent != str(os.getppid()):
        os.kill(os.getpid(), signal.SIGTERM)


def _end_with_ancestor(launcher: int) -> None:
    """Send SIGTERM to this process when `launcher` ends, where it is an ancestor of this one."""
    try:
        ended = os.pidfd_open(launcher)
    except ProcessLookupError:
        # It ended while this process was starting.
        os.kill(os.getpid(), signal.SIGTERM)
        return
    if not _is_ancestor(launcher):
        # A prefix that detaches what it starts wants it to go on.
        os.close(ended)
        return

    from mrlab_ros.adapters import threads  # seldom needed

    def wait() -> None:
        select.select([ended], [], [])
        os.kill(os.getpid(), signal.SIGTERM)

    threads.loop("launcher", wait).start()


def _is_ancestor(process: int) -> bool:
    """Return whether `process` is a parent of this process's parent, or further up."""
    parent = os.getppid()
    while parent not in (0, process):
        try:
            # The fourth field; the second, a name in parentheses, may have spaces.
            stat = Path(f"/proc/{parent}/stat").read_text(encoding="utf-8", errors="replace")
        except OSError:
            return False
        parent = int(stat.rpartition(")")[2].split()[1])
    return parent == process
