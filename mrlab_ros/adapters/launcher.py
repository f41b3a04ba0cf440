"""The end of a process with the launcher that started it."""

from __future__ import annotations

import os
import signal

# The environment variable with the id of the process that starts others and may end before them.
LAUNCHER = "MRLAB_LAUNCHER"
PR_SET_PDEATHSIG = 1


def end_with_launcher() -> None:
    """Have the kernel send SIGTERM when the launcher ends, where one named itself as the parent.

    `ros2 launch` leaves its processes behind when it is ended by SIGTERM.
    """
    named = os.environ.get(LAUNCHER)
    # Something else may be between them, such as the terminal of a launch prefix.
    if named != str(os.getppid()):
        return
    import ctypes  # seldom needed

    ctypes.CDLL(None).prctl(PR_SET_PDEATHSIG, signal.SIGTERM)
    if named != str(os.getppid()):
        os.kill(os.getpid(), signal.SIGTERM)
