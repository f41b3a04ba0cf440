"""Output of a demo: progress while it runs, and its verdict."""

from __future__ import annotations

import math
import os
import time
from dataclasses import asdict, dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Any

from mrlab_ros.commands.diagnostics import DEMO_FAULT
from mrlab_ros.commands.up.speaker import COLOURS
from mrlab_ros.commands.up.web import opening_url
from mrlab_ros.core.base.errors import LabError
from mrlab_ros.processes.child_process import SELF

if TYPE_CHECKING:
    from rich.console import Console

    from mrlab_ros.client.follow import Follower
    from mrlab_ros.commands.demo.arrivals import Arrivals
    from mrlab_ros.commands.demo.lab import Stage

PROGRESS_PERIOD_S = 1.0


@dataclass
class RobotSummary:
    """The result of one robot's run; errors in s."""

    robot: str
    trajectory: str
    frames_expected: int
    frames_received: int
    frames_lost: int
    deadline_error_p50: float
    deadline_error_max: float
    zenoh_messages: int
    zenoh_bytes: int
    warnings: list[str] = field(default_factory=list)
    # Faults of frames that did not arrive once each, in order, as the file has them.
    faults: list[str] = field(default_factory=list)


class Display:
    """Shows the robots' progress: live on a terminal, a line now and then elsewhere."""

    def __init__(
        self, console: Console, followers: list[Follower], arrivals: list[Arrivals]
    ) -> None:
        from rich.progress import BarColumn, Progress, TextColumn

        self._console = console
        self._rows = list(zip(followers, arrivals, strict=True))
        self._next = 0.0
        self._live = Progress(
            TextColumn("{task.description}", markup=False),
            BarColumn(),
            TextColumn("{task.fields[words]}", markup=False),
            console=console,
            disable=not console.is_terminal,
        )
        self._tasks = [
            self._live.add_task(follower.robot, words="", total=1) for follower in followers
        ]

    def __enter__(self) -> Display:
        self._live.start()
        return self

    def __exit__(self, *_: object) -> None:
        self._live.stop()

    def show(self, system: str) -> None:
        """Show the present state of every robot, and of the system."""
        from mrlab_ros.client.follow import milliseconds

        lines = []
        for (follower, arrived), task in zip(self._rows, self._tasks, strict=True):
            state = follower.state
            late = milliseconds(follower.errors[-1]) if follower.errors else "-"
            words = (
                f"{state.label:<9} frame {follower.frame:>4} of {state.frame_count}, late {late}, "
                f"{len(arrived.payloads)} over zenoh"
            )
            total = max(state.frame_count - 1, 1)
            self._live.update(task, completed=follower.frame, total=total, words=words)
            lines.append(f"{follower.robot}: {words}")
        if not self._console.is_terminal and time.monotonic() >= self._next:
            self._next = time.monotonic() + PROGRESS_PERIOD_S
            for line in lines:
                self._console.print(f"{system.lower():<8} {line}", soft_wrap=True)

    def finish(self) -> None:
        """Show every robot at its last frame: READY, which follows, counts from the first."""
        for (follower, arrived), task in zip(self._rows, self._tasks, strict=True):
            words = f"COMPLETE, {len(arrived.payloads)} messages over zenoh"
            count = follower.state.frame_count
            self._live.update(task, completed=count, total=count, words=words)


def judge(summaries: list[RobotSummary]) -> None:
    """Raise LabError where a frame did not arrive as it should."""
    for s in summaries:
        if s.faults:
            raise LabError(
                DEMO_FAULT(
                    robot=s.robot,
                    received=s.frames_received,
                    expected=s.frames_expected,
                    lost=s.frames_lost,
                    fault=s.faults[0],
                )
            )


def facts(stage: Stage, summaries: list[RobotSummary]) -> dict[str, Any]:
    """Return the verdict, ready for JSON."""
    robots = [asdict(s) for s in summaries]
    for robot in robots:
        for key, value in robot.items():
            if isinstance(value, float) and math.isnan(value):
                robot[key] = None
    return {
        "success": not any(s.faults for s in summaries),
        "domain": stage.domain,
        "zenoh": stage.endpoint,
        "robots": robots,
        "complaints": stage.log.trouble,
    }


def print_summary(console: Console, summaries: list[RobotSummary]) -> None:
    """Print what became of every robot's run, and its warnings."""
    from rich.table import Table

    from mrlab_ros.client.follow import milliseconds

    table = Table(box=None, padding=(0, 2, 0, 0), pad_edge=False)
    table.add_column("robot", no_wrap=True)
    for column in ("frames", "late p50", "max", "messages", "bytes", "warnings"):
        table.add_column(column, justify="right")
    for s in summaries:
        table.add_row(
            s.robot,
            f"{s.frames_received}/{s.frames_expected}",
            milliseconds(s.deadline_error_p50),
            milliseconds(s.deadline_error_max),
            f"{s.zenoh_messages:,}",
            f"{s.zenoh_bytes:,}",
            str(len(s.warnings)),
        )
    console.print()
    console.print(table)
    console.print()
    for s in summaries:
        for warning in s.warnings:
            console.print(f"{s.robot}: {warning}", style=COLOURS[SELF])


def print_next_steps(console: Console, stage: Stage, summaries: list[RobotSummary]) -> None:
    """Print what to try while the lab stays up."""
    environment = ""
    script = Path(os.environ.get("VIRTUAL_ENV", "/nowhere")) / "mrlab.sh"
    if script.is_file():
        environment = f". {os.path.relpath(script)}; "
    first = summaries[0]
    client = "examples/clients/python/mrlab_client.py"
    watch = (
        f"python {client} watch {first.robot}/joint_states sensor_msgs/msg/JointState "
        f"--connect {stage.endpoint}"
    )
    lines = [
        "",
        "See it move in the browser (this address is good once; mrlab open makes another):",
        f"  {opening_url(stage.web, stage.users, '/lab')}",
        "The lab stays up until Ctrl-C. In another terminal:",
        f"  {environment}export ROS_DOMAIN_ID={stage.domain}",
        "  mrlab status",
        f"  mrlab play {first.robot} YOUR.mat",
        "What a headset or your own program receives, with nothing of the lab but zenoh:",
        f"  {watch}",
        "Where ROS itself is installed:",
        f"  ros2 topic echo /{first.robot}/joint_states",
        "",
    ]
    for line in lines:
        console.print(line, soft_wrap=True)
