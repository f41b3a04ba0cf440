"""The `mrlab` command run in this process: a second or more sooner than a child process."""

from __future__ import annotations

import io
import os
import signal
import subprocess
import sys
from contextlib import redirect_stderr, redirect_stdout
from pathlib import Path

import pytest

from mrlab_ros.cli import main
from mrlab_ros.commands.output import Settings

HANDLED = (signal.SIGINT, signal.SIGTERM, signal.SIGHUP)


def mrlab(*arguments: str | Path) -> subprocess.CompletedProcess[str]:
    """Run a command to its end, as `launched_lab.mrlab` does; leave this process as it was.

    What a process that the command starts prints is not in the answer.
    """
    words = ["mrlab", *map(str, arguments)]
    out, err = (io.TextIOWrapper(io.BytesIO(), encoding="utf-8") for _ in range(2))
    handlers = {number: signal.getsignal(number) for number in HANDLED}
    environment = dict(os.environ)
    code: object = None
    try:
        with pytest.MonkeyPatch.context() as patch, redirect_stdout(out), redirect_stderr(err):
            patch.setattr(sys, "argv", words)
            patch.setattr(Settings, "debug", False)
            main()
    except SystemExit as end:
        code = end.code
    finally:
        for number, handler in handlers.items():
            signal.signal(number, handler)
        for name in set(os.environ) - set(environment):
            del os.environ[name]
        os.environ.update(environment)
    assert code is None or isinstance(code, int), code
    return subprocess.CompletedProcess(words, code or 0, _text(out), _text(err))


def _text(stream: io.TextIOWrapper) -> str:
    stream.seek(0)
    return stream.read()
