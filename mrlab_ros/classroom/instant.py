"""Checks one handed-in file after another, for the student who waits: no mark that counts.

`InstantChecks` stands in the gateway. Its process has read the rubric and checked the solution,
and ends when nobody has handed in anything for a while.
"""

from __future__ import annotations

import asyncio
import contextlib
import json
import os
import select
import signal
import sys
from asyncio.subprocess import DEVNULL, PIPE
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import orjson

from mrlab_ros.adapters.sandbox import python_process
from mrlab_ros.adapters.workspaces.content import cause
from mrlab_ros.classroom import job
from mrlab_ros.classroom.diagnostics import CLASS_RUN_ENDED
from mrlab_ros.classroom.folder import HELD, SOURCES
from mrlab_ros.core.base.diagnostic import plain
from mrlab_ros.core.base.errors import LabError

IDLE_S = 600.0
LONGEST_LINE = 16 << 20


def sources_of(folder: Path) -> Path:
    """Return the folder of the rubric by which students are checked: the one that holds."""
    held = folder / HELD
    return held if (held / job.RUBRIC).exists() else folder / SOURCES


class InstantChecks:
    """The process that checks, of one class; its calls belong to one event loop."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        self._turn = asyncio.Lock()
        self._process: asyncio.subprocess.Process | None = None
        self._read: object = None

    async def check(self, file: Path, shown: str) -> Mapping[str, Any]:
        """Return {"result": as `Result.plain` has it} of a file, or {"problem": why not}.

        shown: what the motion is called.
        """
        async with self._turn:
            identity = await asyncio.to_thread(self._identity)
            if self._process is not None and identity != self._read:
                await self.close()
            for attempt in (1, 2):
                if self._process is None or self._process.returncode is not None:
                    self._process, self._read = await self._started(), identity
                process = self._process
                assert process.stdin is not None
                assert process.stdout is not None
                with contextlib.suppress(ConnectionError):
                    process.stdin.write(orjson.dumps({"file": str(file), "shown": shown}) + b"\n")
                    await process.stdin.drain()
                    if line := await process.stdout.readline():
                        found: Mapping[str, Any] = orjson.loads(line)
                        return found
                status = await process.wait()  # it was idle for too long, or killed: once more
                if attempt == 2:
                    break
            return {"problem": plain(CLASS_RUN_ENDED(why=cause(status or 1)))}

    async def close(self) -> None:
        """End the process."""
        process, self._process = self._process, None
        if process is not None and process.returncode is None:
            with contextlib.suppress(ProcessLookupError):
                os.killpg(process.pid, signal.SIGTERM)
            await process.wait()

    async def _started(self) -> asyncio.subprocess.Process:
        command = python_process.command(__name__, str(self.folder.absolute()))
        environment = {**os.environ, "PYTHONPATH": python_process.search_path()}
        return await asyncio.create_subprocess_exec(
            *command, stdin=PIPE, stdout=PIPE, stderr=DEVNULL, env=environment,
            start_new_session=True, limit=LONGEST_LINE,
        )  # fmt: skip

    def _identity(self) -> object:
        """Return by what another rubric or solution is known."""
        with contextlib.suppress(FileNotFoundError):
            files = sorted(sources_of(self.folder).iterdir())
            found = [(f, f.stat()) for f in files if f.name not in (job.EXPORT, job.SHEET)]
            return [(str(f), s.st_mtime_ns, s.st_size, s.st_ino) for f, s in found]
        return []


def serve(folder: Path) -> None:
    """Answer lines of standard input until it ends, or nothing comes for a while."""
    from mrlab_ros.classroom.grader import Grader
    from mrlab_ros.classroom.setup import Task

    grader: Grader | None = None
    try:
        while select.select([sys.stdin], [], [], IDLE_S)[0] and (line := sys.stdin.readline()):
            asked = json.loads(line)
            try:
                if grader is None:
                    grader = Grader(job.setup_of(sources_of(folder), pages=False))
                file = Path(asked["file"])
                task = Task(asked["shown"], asked["shown"], ((file.name, file.read_bytes()),))
                found = grader.check(task)["result.json"]
                said: Any = {"result": orjson.loads(found)}
            except LabError as error:
                said = {"problem": plain(error.diagnostic)}
            except OSError as error:  # another file is there by now
                said = {"problem": plain(CLASS_RUN_ENDED(why=str(error)))}
            print(json.dumps(said), flush=True)
    finally:
        if grader is not None:
            grader.close()


if __name__ == "__main__":
    signal.signal(signal.SIGTERM, lambda *_: sys.exit(0))
    serve(Path(sys.argv[1]))
