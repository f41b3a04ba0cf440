"""Checks one motion after another, and keeps what came of each.

Runs each check in a process of its own, which is ended when it takes too long.

What the routes about checks take and answer.
"""

from __future__ import annotations

import asyncio
import contextlib
import json
import logging
import pickle
from asyncio.subprocess import PIPE
from collections import OrderedDict
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import Annotated, Any, Literal, Protocol

from pydantic import BaseModel, Field

from mrlab_ros.adapters.sandbox import python_process
from mrlab_ros.app.check.in_lab import LabScene, Task, changed
from mrlab_ros.core.base.diagnostic import Diagnostic, from_plain, plain
from mrlab_ros.core.base.errors import BadInput, LabError, Unavailable
from mrlab_ros.gateway.checks.diagnostics import (
    CHECK_ENDED_EARLY,
    CHECK_FAILED,
    CHECK_TOO_SLOW,
    TOO_MANY_CHECKS,
)
from mrlab_ros.gateway.errors import TooMany
from mrlab_ros.gateway.store.answers import Finding, Strict

# It gives way to others, so a busy machine takes long.
PATIENCE_S = 300.0
LAST_LINES = 3


class CheckProcess:
    """Checks by `mrlab_ros.app.check.in_lab`."""

    async def check(self, task: Task) -> Mapping[str, Any]:
        command = python_process.command("mrlab_ros.app.check.in_lab")
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


MOST_WAITING = 12
MOST_KEPT = 100
# Delay before another try, s, while too many requests wait.
AGAIN_S = 10.0
log = logging.getLogger("mrlab.gateway")

Key = tuple[str, str]


class Checker(Protocol):
    """Checks a motion somewhere else than in the gateway's own process."""

    async def check(self, task: Task) -> Mapping[str, Any]:
        """Return the report, as JSON has it; raise LabError. Being cancelled ends the work."""
        ...


@dataclass(eq=False)
class Entry:
    """One check: of which file, in which scene, and what came of it."""

    key: Key
    file: str
    scene: LabScene
    state: str = "waiting"
    report: Mapping[str, Any] = field(default_factory=dict)
    problem: Diagnostic | None = None
    work: asyncio.Task[None] | None = None

    @property
    def active(self) -> bool:
        return self.state in ("waiting", "running")


class CheckDesk:
    """The checks of one gateway, by robot and trajectory; belongs to one event loop.

    One runs at a time. What is asked again and has not changed is answered from what is known;
    another motion for the same robot ends the check that runs for it.
    """

    def __init__(self, checker: Checker) -> None:
        self._checker = checker
        self._one = asyncio.Semaphore(1)
        self._entries: OrderedDict[Key, Entry] = OrderedDict()

    def ask(self, key: Key, task: Callable[[], Task], scene: LabScene, file: str) -> Entry:
        """Begin a check, or return the one that runs or still holds.

        key: robot and trajectory with its version. task: makes what is checked. file: identity of
        the frames. Raises TooMany where too many wait.
        """
        known = self._entries.get(key)
        if known is not None and known.file == file:
            same = not changed(known.scene, scene, key[0])
            if same and (known.active or known.state == "done"):
                return known
        active = [e for e in self._entries.values() if e.active]
        superseded = [e for e in active if e.key[0] == key[0]]
        if len(active) - len(superseded) >= MOST_WAITING:
            raise TooMany(TOO_MANY_CHECKS(count=len(active), seconds=AGAIN_S), AGAIN_S)
        for each in superseded:
            self._end(each)
        entry = self._entries[key] = Entry(key, file, scene)
        self._entries.move_to_end(key)
        entry.work = asyncio.create_task(self._run(entry, task()))
        while len(self._entries) > MOST_KEPT:
            self._end(self._entries.popitem(last=False)[1])
        return entry

    def find(self, key: Key) -> Entry | None:
        return self._entries.get(key)

    def cancel(self, key: Key) -> None:
        """End a check that waits or runs."""
        entry = self._entries.get(key)
        if entry is not None and entry.active:
            self._end(entry)

    async def close(self) -> None:
        """End all checks."""
        works = [e.work for e in self._entries.values() if e.work is not None]
        for entry in list(self._entries.values()):
            self._end(entry)
        await asyncio.gather(*works, return_exceptions=True)

    def _end(self, entry: Entry) -> None:
        if entry.active:
            # nobody asks for it any more, so it is as if nobody had
            self._entries.pop(entry.key, None)
            entry.state = "none"
        if entry.work is not None:
            entry.work.cancel()

    async def _run(self, entry: Entry, task: Task) -> None:
        async with self._one:
            entry.state = "running"
            try:
                entry.report = await self._checker.check(task)
                entry.state = "done"
            except LabError as error:
                entry.problem, entry.state = error.diagnostic, "failed"
            except Exception:
                log.exception("the check of %s failed", entry.key)
                entry.problem, entry.state = CHECK_FAILED(), "failed"


def answer(key: Key, entry: Entry | None, now: LabScene | None) -> Check:
    """Return what is known of a check. now: the lab's scene; None: it is not known."""
    robot, trajectory = key
    if entry is None or entry.state == "none":
        return Check(state="none", robot=robot, trajectory=trajectory)
    report = entry.report
    own: Mapping[str, Any] = next((r for r in report.get("robots", ()) if r["name"] == robot), {})
    stale = changed(entry.scene, now, robot) if report and now is not None else None
    return Check.model_validate(
        {
            "state": entry.state,
            "robot": robot,
            "trajectory": trajectory,
            "problem": entry.problem and plain(entry.problem),
            "stale": stale and plain(stale),
            **{k: report.get(k, "") for k in ("verdict", "hash")},
            **{k: report.get(k) for k in ("summary", "claim")},
            "duration": report.get("duration"),
            "findings": report.get("findings", ()),
            "conditions": own.get("hardware", ()),
        }
    )


Robot = Annotated[str, Field(min_length=1, max_length=100)]
TrajectoryId = Annotated[str, Field(min_length=1, max_length=600)]


class CheckWanted(Strict):
    """Which robot of the lab shall play which trajectory, such as quintic@3."""

    robot: Robot
    trajectory: TrajectoryId


class CheckFinding(Finding):
    """A finding of a check. time, end: s from the first frame; null: it has no instant.

    kind, other: what the robot meets, such as object or robot, and its name; empty: nothing.
    """

    robot: str = ""
    link: str = ""
    time: float | None = None
    end: float | None = None
    kind: str = ""
    other: str = ""


class CheckCondition(BaseModel):
    """One condition of a real controller. state: ok, not or unknown. found: the figure against
    its limit, or why it is not known."""

    condition: CheckFinding
    state: str
    found: CheckFinding


class Check(BaseModel):
    """A check of a robot's motion in the lab.

    state: none where nobody asked. stale: what has changed in the lab since; null: nothing.
    problem: why it failed. verdict, summary, claim, hash: of the report, mrlab.check.1.
    """

    state: Literal["none", "waiting", "running", "done", "failed"]
    robot: str
    trajectory: str
    stale: CheckFinding | None = None
    problem: CheckFinding | None = None
    verdict: str = ""
    summary: CheckFinding | None = None
    claim: CheckFinding | None = None
    hash: str = ""
    duration: float | None = None
    findings: list[CheckFinding] = []
    conditions: list[CheckCondition] = []
