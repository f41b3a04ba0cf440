"""The state of the running lab for `mrlab status`, kept up to date by its graph.

A window on lines that are more than the terminal has, moved with keys.

The facts of `mrlab status`, ready for JSON: SI units, null where nothing is known.
"""

from __future__ import annotations

import math
import operator
import time
from collections.abc import Callable, Iterable, Mapping
from typing import TYPE_CHECKING, Any

from mrlab_ros.core.base.diagnostic import Diagnostic, plain
from mrlab_ros.core.runtime.watch import SILENT_AFTER_S, joined
from mrlab_ros.processes.lab import NODES, PROCESSES
from mrlab_ros.processes.run_file import RunFile
from mrlab_ros.processes.web import gateway_answers

if TYPE_CHECKING:
    from mrlab_ros.client.follow import Follower
    from mrlab_ros.ros.graph import GraphClient, Watch
import os
import select
import termios
import tty
from types import TracebackType
from typing import TYPE_CHECKING

from rich.segment import Segment, Segments
from rich.text import Text

if TYPE_CHECKING:
    from rich.console import Console, ConsoleOptions, RenderableType, RenderResult
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from mrlab_ros.client.follow import Follower


# From where to where, in the order of LatencyHop's constants.
HOPS = (("published", "bridged"), ("bridged", "received"), ("published", "received"))


def robot_facts(robot: Any, follower: Follower) -> dict[str, Any]:
    state, position = follower.state, robot.pose.position
    known = follower.watch.value is not None
    moving = bool(follower.errors)
    return {
        "name": robot.name,
        "model": robot.model,
        "end_effector": robot.end_effector,
        "position": [position.x, position.y, position.z],
        "state": state.label if known else None,
        **said_of(state),
        "trajectory": state.trajectory_id or None,
        "frame": follower.frame,
        "frame_count": state.frame_count,
        "duration": state.duration,
        "rate": state.rate,
        "system": state.system or None,
        "deadline_error": follower.errors[-1] if moving else None,
        "deadline_error_max": follower.error_max if moving else None,
        "frames_lost": follower.frames_lost,
    }


def said_of(state: Any) -> dict[str, Any]:
    """Return what a state says: its text, its code, and the values by name."""
    values = {each.key: each.value for each in state.values}
    return {"message": state.message, "code": state.code, "values": values}


def recorder_facts(state: Any) -> dict[str, Any] | None:
    if state is None:
        return None
    return {
        "state": ("STOPPED", "RECORDING", "REPLAYING", "PAUSED")[state.state],
        "bag": state.bag or None,
        "position": state.position,
        "duration": state.duration,
        "rate": state.rate,
        "messages": state.messages,
        **said_of(state),
    }


def latency_facts(observer: str, report: Any) -> dict[str, Any]:
    return {
        "observer": observer,
        "window": report.window,
        "clock_error": report.clock_error,
        "hops": [
            {
                "from": HOPS[hop.hop][0],
                "to": HOPS[hop.hop][1],
                "topic": hop.topic or None,
                "count": hop.count,
                "p50": hop.p50,
                "p95": hop.p95,
                "max": hop.max,
            }
            for hop in report.hops
            if hop.hop < len(HOPS)
        ],
    }


UP, DOWN, PAGE_UP, PAGE_DOWN = b"\x1b[A", b"\x1b[B", b"\x1b[5~", b"\x1b[6~"
LINES = {UP: -1, b"k": -1, DOWN: 1, b"j": 1, b"\r": 1}
PAGES = {PAGE_UP: -1, b"b": -1, PAGE_DOWN: 1, b" ": 1}


class Scroll:
    """Shows the part of a text that fits. Keys are read from `terminal`, none where it is None."""

    def __init__(self, console: Console, terminal: int | None) -> None:
        self._console = console
        self._terminal = terminal
        self._before: Any = None
        self.whole: RenderableType = ""
        self.top = 0
        self.ended = False

    def __enter__(self) -> Scroll:
        if self._terminal is not None:
            self._before = termios.tcgetattr(self._terminal)
            tty.setcbreak(self._terminal)
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        if self._terminal is not None:
            termios.tcsetattr(self._terminal, termios.TCSADRAIN, self._before)

    def take(self, whole: RenderableType) -> None:
        """Show this from now on, at the same place."""
        self.whole = whole

    def key(self, timeout: float) -> bool:
        """Wait up to `timeout` s for a key and do what it says; return whether there was one."""
        if self._terminal is None:
            time.sleep(timeout)
            return False
        if not select.select([self._terminal], [], [], timeout)[0]:
            return False
        self.press(os.read(self._terminal, 16))
        return True

    def press(self, typed: bytes) -> None:
        """Do what a key says; what the terminal has no lines for is not scrolled past."""
        if typed in (b"q", b"Q"):
            self.ended = True
        self.top += LINES.get(typed, 0) + PAGES.get(typed, 0) * (self._console.height - 2)

    def __rich_console__(self, console: Console, options: ConsoleOptions) -> RenderResult:
        lines = console.render_lines(self.whole, options.update(height=None), pad=False)
        height = console.height
        if len(lines) <= height:
            self.top = 0
            footer, shown = None, lines
        else:
            room = height - 1
            self.top = max(0, min(self.top, len(lines) - room))
            shown = lines[self.top : self.top + room]
            last = self.top + len(shown)
            footer = f"lines {self.top + 1} to {last} of {len(lines)}; arrows scroll, q ends"
        for number, line in enumerate(shown):
            yield Segments(line)
            if footer or number < len(shown) - 1:
                yield Segment.line()
        if footer:
            yield Text(footer[: options.max_width], "reverse", end="")


# First messages of a robot that was just found arrive within this time, s.
SETTLE_TIMEOUT_S = 6.0
# A node that nobody has seen for this long is missing, s: discovery takes up to 3.5 s. With --once
# that is the longest wait.
ONCE_TIMEOUT_S = 4.0
MISSING_AFTER_S = 5.0
# Once the lab's robots are known the publishers of all topics are, after this time at most, s.
DISCOVERY_S = 1.5
# Measuring clients report once a second; a client silent for longer has gone, s.
LATENCY_AGE_S = 5.0
# How often the gateway is asked whether it is there, s.
WEB_PERIOD_S = 1.0


def expected_nodes(supervisor: Mapping[str, Any] | None, *, in_replay: bool) -> tuple[str, ...]:
    """Return the names of the nodes that this lab is made of.

    supervisor: the run file of `mrlab up`, which lists the processes it started; without one all
    nodes are expected. in_replay: a bag is replayed, and most nodes have left the graph for it.
    """
    kept = None if supervisor is None else {p["name"] for p in supervisor["processes"]}
    entries = [
        NODES[node]
        for process in PROCESSES
        if not kept or process.name in kept
        for node in process.nodes
    ]
    return tuple(entry.graph_name for entry in entries if entry.in_replay or not in_replay)


class Presence:
    """Which nodes are in the graph; one that was just started or discovered is not missing yet.

    names: returns the names of the nodes that the graph knows now.
    """

    def __init__(
        self, names: Callable[[], Iterable[str]], clock: Callable[[], float] = time.monotonic
    ) -> None:
        self._names = names
        self._clock = clock
        self._begun = clock()
        self._seen: dict[str, float] = {}

    def present(self, expected: Iterable[str], patience: float) -> dict[str, bool]:
        """Return for each node whether it was in the graph within the last `patience` s."""
        now = self._clock()
        self._seen |= dict.fromkeys(self._names(), now)
        return {name: now - self._seen.get(name, self._begun) <= patience for name in expected}

    def wait(
        self, expected: Callable[[], Iterable[str]], timeout: float = ONCE_TIMEOUT_S
    ) -> dict[str, bool]:
        """Return which nodes are there as soon as all are, or `timeout` s after the start."""
        while True:
            names = set(self._names())
            found = {name: name in names for name in expected()}
            if all(found.values()) or self._clock() - self._begun > timeout:
                return found
            time.sleep(0.05)


class View:
    """Everything `mrlab status` shows, kept up to date by the graph."""

    def __init__(self, graph: GraphClient) -> None:
        from diagnostic_msgs.msg import DiagnosticArray
        from mrlab_msgs import msg

        from mrlab_ros.messages import qos

        self._graph = graph
        self._run_file = RunFile(graph.domain)
        self._robots: Watch[Any] = graph.watch(msg.Robots, "/robots")
        self._catalogue: Watch[Any] = graph.watch(msg.TrajectoryCatalogue, "/trajectories")
        self._systems: Watch[Any] = graph.watch(msg.RobotSystems, "/systems")
        self._recorder: Watch[Any] = graph.watch(msg.RecorderState, "/recorder/state")
        self._followers: dict[str, Follower] = {}
        # The newest report of each observer, by what it is called here.
        self._latencies: dict[str, Any] = {}
        self._answers, self._asked = False, -math.inf
        # By process when it was heard last, and what is amiss with it; None: nothing.
        self._troubles: dict[str, tuple[float, Diagnostic | None]] = {}
        self._restarted: set[str] = set()
        graph.subscribe(msg.Latency, "/latency", self._on_latency, qos.LATCHED)
        if graph.prompt:
            return
        graph.subscribe(DiagnosticArray, "/diagnostics", self._on_diagnostics, qos.LATCHED_EVENTS)
        graph.subscribe(msg.Latency, "/latency/clients", self._on_client, qos.LATCHED_EVENTS)

    def settle(self) -> None:
        """Wait until every latched message has arrived, or SETTLE_TIMEOUT_S is over.

        Latched messages come oldest first, one soon after the other: the newest is there once no
        more come.
        """
        from mrlab_ros.ros.graph import LATCHED_BURST_S

        if self._graph.prompt:
            self.robots()
            return
        begun = time.monotonic()
        deadline = begun + SETTLE_TIMEOUT_S
        watches = (self._robots, self._catalogue, self._systems)
        received: list[Any] = []
        since = time.monotonic()
        while (now := time.monotonic()) < deadline:
            followers = [follower for _, follower in self.robots()]
            before = received
            watched = (*watches, *(f.watch for f in followers))
            received = [w.value for w in watched]
            same = len(received) == len(before) and all(map(operator.is_, received, before))
            measured = self._latencies or "bridge" not in self._graph.node_names()
            # A topic without a publisher after discovery will not come.
            discovered = now - begun > DISCOVERY_S
            awaited = [w for w in watched if w.value is None]
            if discovered:
                awaited = [w for w in awaited if self._graph.is_published(w.topic)]
            if not same or awaited or not measured:
                since = now
            elif now - since > LATCHED_BURST_S:
                return
            time.sleep(0.02)

    def _ask_bridge(self) -> None:
        """Take what the bridge keeps of topics that zenoh does not carry."""
        from diagnostic_msgs.msg import DiagnosticArray
        from mrlab_msgs import msg

        for age, message in self._graph.kept(DiagnosticArray, "/diagnostics"):
            self._on_diagnostics(message, age)
        for _, report in self._graph.kept(msg.Latency, "/latency/clients"):
            self._on_client(report)

    def _on_diagnostics(self, message: Any, age: float = 0.0) -> None:
        from mrlab_ros.messages.status import restarted_in, troubles_in

        now = time.monotonic() - age
        found = troubles_in(message)
        self._troubles |= {name: (now, said) for name, said in found.items()}
        self._restarted = (self._restarted - found.keys()) | restarted_in(message)

    def troubles(self) -> dict[str, Diagnostic]:
        """Return what is amiss with processes, by process, and what this one cannot decode."""
        from mrlab_ros.ros.decoding import undecoded

        now = time.monotonic()
        own = joined(undecoded())
        return ({} if own is None else {"status": own}) | {
            name: said
            for name, (heard, said) in sorted(self._troubles.items())
            if said is not None and now - heard < SILENT_AFTER_S
        }

    def _on_latency(self, report: Any) -> None:
        self._latencies[report.observer] = report

    def _on_client(self, report: Any) -> None:
        # Any client may publish these: a name must neither pass for the bridge's nor contain
        # control characters of the terminal.
        name = "".join(c if c.isprintable() else "?" for c in report.observer)
        self._latencies[f"client {name}"] = report

    def expected_nodes(self) -> tuple[str, ...]:
        """Return the names of the nodes that this lab is made of now."""
        recorder = recorder_facts(self._recorder.value)
        in_replay = recorder is not None and recorder["state"] in ("REPLAYING", "PAUSED")
        return expected_nodes(self._run_file.read(), in_replay=in_replay)

    def latencies(self) -> list[tuple[str, Any]]:
        """Return whose reports there are and the reports, the bridge's own first; no old ones."""
        for name, report in list(self._latencies.items()):
            stamp = report.header.stamp
            if abs(time.time() - stamp.sec - 1e-9 * stamp.nanosec) > LATENCY_AGE_S:
                self._latencies.pop(name, None)
        return sorted(self._latencies.items(), key=lambda entry: entry[0])

    def robots(self) -> list[tuple[Any, Follower]]:
        """Return the robots of the scene, each with what is known of its playback."""
        from mrlab_ros.client.follow import Follower

        robots = self._robots.value.robots if self._robots.value else []
        for robot in robots:
            if robot.name not in self._followers:
                self._followers[robot.name] = Follower(self._graph, robot.name)
        return [(robot, self._followers[robot.name]) for robot in robots]

    def facts(self) -> dict[str, Any]:
        """Return what is known, ready for JSON: SI units, null where nothing is known."""
        if self._graph.prompt:
            self._ask_bridge()
        supervisor = self._run_file.read()
        return {
            "domain": self._graph.domain,
            "supervisor": supervisor,
            "web": self._web(supervisor),
            "robots": [robot_facts(robot, follower) for robot, follower in self.robots()],
            "trajectories": [
                {
                    "id": t.id,
                    "robot_model": t.robot_model,
                    "frame_rate": t.frame_rate,
                    "frame_count": t.frame_count,
                    "duration": t.duration,
                }
                for t in (self._catalogue.value.trajectories if self._catalogue.value else ())
            ],
            "systems": [
                {
                    "name": s.name,
                    "state": s.label,
                    **said_of(s),
                    "members": [m.robot for m in s.members],
                    "duration": s.duration,
                }
                for s in (self._systems.value.systems if self._systems.value else ())
            ],
            "latency": [latency_facts(name, report) for name, report in self.latencies()],
            "recorder": recorder_facts(self._recorder.value),
            "trouble": {name: plain(said) for name, said in self.troubles().items()},
            "restarted": sorted(self._restarted & self.troubles().keys()),
        }

    def _web(self, supervisor: Mapping[str, Any] | None) -> dict[str, Any] | None:
        """Return where the pages are and whether they answer, asked once a second at most."""
        web = (supervisor or {}).get("web")
        if web is None:
            return None
        if time.monotonic() - self._asked > WEB_PERIOD_S:
            self._answers = gateway_answers(web["here"])()
            self._asked = time.monotonic()
        return {"address": web["address"], "answers": self._answers}
