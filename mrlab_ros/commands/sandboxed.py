"""Prints what a function prints that reads a file from outside, in a process in the sandbox."""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterable
from pathlib import Path
from typing import Any

from mrlab_ros.adapters.sandbox import printed


def run(
    function: Callable[..., Any],
    *arguments: Any,
    name: str,
    read: Iterable[Path],
    write: Iterable[Path] = (),
) -> Any:
    """Print the output of `adapters.sandbox.printed.call`, and return its value."""
    called = printed.call(function, *arguments, name=name, read=read, write=write)
    sys.stdout.write(called.out)
    sys.stderr.write(called.err)
    return called.value
