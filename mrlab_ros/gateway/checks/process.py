"""Runs each check in a process of its own, which is ended when it takes too long."""

from __future__ import annotations

import asyncio
import contextlib
import json
import logging
import pickle
from asyncio.subprocess import PIPE
from collections.abc import Mapping
from typing import Any

from mrlab_ros.adapters import python_process
from mrlab_ros.adapters.checking.in_lab import Task
from mrlab_ros.core.base.diagnostic import from_plain
from mrlab_ros.core.base.errors import BadInput, Unavailable
from mrlab_ros.gateway.checks.diagnostics import CHECK_ENDED_EARLY, CHECK_TOO_SLOW

# It gives way to others, so a busy machine takes long.
PATIENCE_S = 300.0
LAST_LINES = 3
log = logging.getLogger("mrlab.gateway")


class CheckProcess:
    """Checks by `mrlab_ros.adapters.checking.in_lab`."""

    async def check(self, task: Task) -> Mapping[str, Any]:
        command = python_process.command("mrlab_ros.adapters.checking.in_lab")
        process = await asyncio.create_subprocess_exec(
            *command, stdin=PIPE, stdout=PIPE, stderr=PIPE, start_new_session=True
        )
        try:
            said, problems = await asyncio.wait_for(
                process.communicate(pickle.dumps(task)), PATIENCE_S
            )
        except asyncio.TimeoutError:
            raise Unavailable(CHECK_TOO_SLOW(limit=PATIENCE_S)) from None
        finally:
            if process.returncode is None:
                with contextlib.suppress(ProcessLookupError):
                    process.kill()
                await process.wait()
        try:
            told = json.loads(said)
        except ValueError:
            lines = problems.decode(errors="replace").strip().splitlines()[-LAST_LINES:]
            log.warning("a check ended with %s: %s", process.returncode, " | ".join(lines))
            raise Unavailable(CHECK_ENDED_EARLY(status=process.returncode)) from None
        if "problem" in told:
            raise BadInput(from_plain(told["problem"]))
        report: Mapping[str, Any] = told["report"]
        return report
