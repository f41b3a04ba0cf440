"""Calls a function on files from outside in a process of its own, in the sandbox.

The process starts with none of the caller's memory, descriptors and secrets of the environment. It
imports the function's module, enters the sandbox (`restrictions.py`), and answers with JSON:
whatever the files make of it, the caller sees no more than that.
"""

from __future__ import annotations

import contextlib
import importlib
import json
import os
import signal
import subprocess
import sys
import tempfile
from collections.abc import Callable, Iterable, Mapping
from pathlib import Path
from typing import Any

from mrlab_ros.adapters.diagnostics import READER_FAILED, READER_MEMORY, READER_SLOW
from mrlab_ros.adapters.sandbox import python_process, restrictions
from mrlab_ros.core.base.diagnostic import from_plain, plain
from mrlab_ros.core.base.errors import BadInput, LabError

MiB = 1 << 20
MOST_ANSWERED = 64 * MiB  # bytes
START = 30.0  # s in which it starts on a busy machine
# of the environment, what finds Python's and ROS's packages; nothing that may be secret
KEPT = (
    *("PATH", "LANG", "LC_ALL", "LD_LIBRARY_PATH", "AMENT_PREFIX_PATH", "ROS_DISTRO"),
    *("ROS_VERSION", "ROS_PYTHON_VERSION", "VIRTUAL_ENV", "_ROS_WHEELS_BOOTSTRAP_COMPLETE"),
)


def call(
    function: Callable[..., Any],
    *arguments: Any,
    name: str,
    read: Iterable[Path] = (),
    write: Iterable[Path] = (),
    memory: int = 2048 * MiB,
    seconds: float = 120.0,
    file_size: int = MOST_ANSWERED,
    environment: Mapping[str, str] | None = None,
    folder: Path = Path("/"),
) -> Any:
    """Return what a function of a module answers to arguments, all of them JSON.

    name: the file's, for errors. read, write: folders and files that it reaches besides Python and
    its packages. memory: bytes; seconds: of a processor, and of time; file_size: bytes of a file
    that it writes. environment: what it gets besides KEPT. folder: in which it works. Raises
    BadInput where the function does, and where it needs more than it may.
    """
    words = {
        "module": function.__module__,
        "function": function.__qualname__,
        "arguments": arguments,
        "name": name,
        "read": [str(path) for path in read],
        "write": [str(path) for path in write],
        "memory": memory,
        "seconds": seconds,
        "file_size": file_size,
    }
    kept = {key: os.environ[key] for key in KEPT if key in os.environ} | dict(environment or {})
    kept["PYTHONPATH"] = python_process.search_path()
    kept |= python_process.ONE_THREAD
    with tempfile.TemporaryFile() as answer, tempfile.TemporaryFile() as errors:
        process = subprocess.Popen(
            python_process.command(__name__, str(answer.fileno())),
            pass_fds=[answer.fileno()], stdin=subprocess.PIPE, stdout=subprocess.DEVNULL,
            stderr=errors, env=kept, cwd=folder, start_new_session=True,
        )  # fmt: skip
        try:
            with contextlib.suppress(subprocess.TimeoutExpired):
                process.communicate(json.dumps(words).encode(), timeout=seconds + START)
        finally:
            # what it forked stays in its session: the sandbox lets nobody leave one
            with contextlib.suppress(ProcessLookupError):
                os.killpg(process.pid, signal.SIGKILL)
            status = process.wait()
        answer.seek(0)
        text = answer.read(MOST_ANSWERED)
        errors.seek(0)
        last = errors.read()[-500:].decode(errors="replace").strip().rpartition("\n")[2]
    try:
        found = json.loads(text) if status == 0 else {}
        if "value" in found:
            return found["value"]
        # what the reader of a file says is as much from outside as the file
        problem = from_plain(found["problem"]) if "problem" in found else None
    except (ValueError, TypeError, KeyError, AttributeError):
        problem = None
    if problem is not None:
        raise BadInput(problem)
    if status in (-signal.SIGALRM, -signal.SIGKILL, -signal.SIGXCPU):
        raise BadInput(READER_SLOW(file=name, limit=seconds))
    raise BadInput(READER_FAILED(file=name, status=status, problem=last))


def main() -> None:
    """Answer one call from the standard input, into the file whose descriptor is the argument."""
    words = json.load(sys.stdin)
    with os.fdopen(int(sys.argv[1]), "w", encoding="utf-8") as answer:
        function: Any = importlib.import_module(words["module"])
        for part in words["function"].split("."):
            function = getattr(function, part)
        read, write = ([Path(path) for path in words[key]] for key in ("read", "write"))
        signal.setitimer(signal.ITIMER_REAL, words["seconds"])
        restrictions.confine(
            memory=words["memory"], seconds=words["seconds"], file_size=words["file_size"]
        )
        restrictions.shut(read=[*restrictions.libraries(), *read], write=write, opens=True)
        try:
            found = {"value": function(*words["arguments"])}
        except LabError as error:
            found = {"problem": plain(error)}
        except MemoryError:
            found = {"problem": plain(READER_MEMORY(file=words["name"], limit=words["memory"]))}
        json.dump(found, answer)


if __name__ == "__main__":
    main()
