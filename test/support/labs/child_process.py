"""Start a process that ends with the tests, however they end."""

from __future__ import annotations

import subprocess
import sys
from typing import Any

from mrlab_ros.processes.child_process import guarded
from mrlab_ros.processes.lab import HOST_MODULE

HOST = (sys.executable, "-m", HOST_MODULE)


def start_child(*argv: str, **options: Any) -> subprocess.Popen[Any]:
    """Start `argv` as subprocess.Popen does; the kernel kills it when pytest's process ends.

    Call it in pytest's own thread: the process ends with the thread that started it.
    """
    return subprocess.Popen(guarded(argv), **options)
