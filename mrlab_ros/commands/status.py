"""`mrlab status`: the graph at a glance."""

from __future__ import annotations

import json
import math
import operator
import sys
import time
from collections.abc import Callable, Iterable, Mapping
from typing import TYPE_CHECKING, Annotated, Any

import typer

from mrlab_ros.core.watch import SILENT_AFTER_S
from mrlab_ros.processes.lab import NODES, PROCESSES
from mrlab_ros.processes.run_file import RunFile
from mrlab_ros.processes.web import gateway_answers

if TYPE_CHECKING:
    from rich.console import RenderableType

    from mrlab_ros.commands.follow import Follower
    from mrlab_ros.ros.graph import Graph, Watch

REFRESH_RATE_HZ = 4.0
# What a robot that was just found has to say is there by then, s.
SETTLE_TIMEOUT_S = 6.0
# A node that nobody has seen for this long is missing, s: discovery takes up to 3.5 s. With --once
# that is the longest wait.
ONCE_TIMEOUT_S = 4.0
MISSING_AFTER_S = 5.0
# Once the lab's robots are known the publishers of all topics are, after this time at most, s.
DISCOVERY_S = 1.5
# Who measures reports once a second; one that has been silent for longer has gone, s.
LATENCY_AGE_S = 5.0
# How often the gateway is asked whether it is there, s.
WEB_PERIOD_S = 1.0
# From where to where, in the order of LatencyHop's constants.
HOPS = (("published", "bridged"), ("bridged", "received"), ("published", "received"))


def status(
    once: Annotated[bool, typer.Option("--once", help="Print the table once and end.")] = False,
    as_json: Annotated[
        bool, typer.Option("--json", help="Print one JSON object and end.")
    ] = False,
) -> None:
    """Show robots, trajectories, systems and processes of the running lab.

    Ends with 0 where a lab answers, 1 where none does.
    """
    from rich.console import Console
    from rich.live import Live

    from mrlab_ros.ros.graph import Graph

    console = Console()
    with Graph() as graph:
        presence = Presence(graph.node.get_node_names)
        graph.robots()
        view = View(graph)
        view.settle()
        if as_json:
            nodes = presence.wait(view.expected_nodes)
            sys.stdout.write(json.dumps({**view.facts(), "nodes": nodes}, indent=2) + "\n")
        elif once or not console.is_terminal:
            console.print(view.table(presence.wait(view.expected_nodes)))
        else:

            def table() -> RenderableType:
                return view.table(presence.present(view.expected_nodes(), MISSING_AFTER_S))

            with Live(table(), console=console, auto_refresh=False) as live:
                try:
                    while True:
                        time.sleep(1 / REFRESH_RATE_HZ)
                        live.update(table(), refresh=True)
                except KeyboardInterrupt:
                    return


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

    def __init__(self, graph: Graph) -> None:
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
        # By process when it was heard last, and what is amiss with it; empty: nothing.
        self._troubles: dict[str, tuple[float, str]] = {}
        graph.subscribe(DiagnosticArray, "/diagnostics", self._on_diagnostics, qos.LATCHED_EVENTS)
        graph.subscribe(msg.Latency, "/latency", self._on_latency, qos.LATCHED)
        graph.subscribe(msg.Latency, "/latency/clients", self._on_client, qos.LATCHED_EVENTS)

    def settle(self) -> None:
        """Wait until every latched message has arrived, or SETTLE_TIMEOUT_S is over.

        Latched messages come oldest first, one soon after the other: the newest is there once no
        more come.
        """
        from mrlab_ros.ros.graph import LATCHED_BURST_S

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
            measured = self._latencies or "bridge" not in self._graph.node.get_node_names()
            # What nobody publishes once discovery is over will not come.
            discovered = now - begun > DISCOVERY_S
            awaited = [w for w in watched if w.value is None]
            if discovered:
                awaited = [w for w in awaited if self._graph.node.count_publishers(w.topic)]
            if not same or awaited or not measured:
                since = now
            elif now - since > LATCHED_BURST_S:
                return
            time.sleep(0.02)

    def _on_diagnostics(self, message: Any) -> None:
        from mrlab_ros.messages.diagnostics import troubles_in

        now = time.monotonic()
        self._troubles |= {name: (now, text) for name, text in troubles_in(message).items()}

    def troubles(self) -> dict[str, str]:
        """Return what is amiss with processes, by process."""
        now = time.monotonic()
        return {
            name: text
            for name, (heard, text) in sorted(self._troubles.items())
            if text and now - heard < SILENT_AFTER_S
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
        recorder = _recorder_facts(self._recorder.value)
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
        from mrlab_ros.commands.follow import Follower

        robots = self._robots.value.robots if self._robots.value else []
        for robot in robots:
            if robot.name not in self._followers:
                self._followers[robot.name] = Follower(self._graph, robot.name)
        return [(robot, self._followers[robot.name]) for robot in robots]

    def facts(self) -> dict[str, Any]:
        """Return what is known, ready for JSON: SI units, null where nothing is known."""
        supervisor = self._run_file.read()
        return {
            "domain": self._graph.domain,
            "supervisor": supervisor,
            "web": self._web(supervisor),
            "robots": [_robot_facts(robot, follower) for robot, follower in self.robots()],
            "trajectories": [
                {
                    "id": t.id,
                    "robot_model": t.robot_model,
                    "frame_rate": t.frame_rate,
                    "frame_count": t.frame_count,
                    "duration": t.duration,
                    "warnings": [w.message for w in t.warnings],
                }
                for t in (self._catalogue.value.trajectories if self._catalogue.value else ())
            ],
            "systems": [
                {
                    "name": s.name,
                    "state": s.label,
                    "message": s.message,
                    "members": [m.robot for m in s.members],
                    "duration": s.duration,
                }
                for s in (self._systems.value.systems if self._systems.value else ())
            ],
            "latency": [_latency_facts(name, report) for name, report in self.latencies()],
            "recorder": _recorder_facts(self._recorder.value),
            "trouble": self.troubles(),
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

    def table(self, nodes: Mapping[str, bool] | None = None) -> RenderableType:
        """Return the facts as tables. nodes: name -> whether that node is in the graph."""
        from rich.console import Group
        from rich.text import Text

        facts = self.facts()
        supervisor = facts["supervisor"]
        kept = f"kept by process {supervisor['pid']}" if supervisor else "not kept by mrlab"
        parts: list[RenderableType] = [Text(f"Lab on ROS domain {facts['domain']}, {kept}")]
        if absent := [name for name, present in (nodes or {}).items() if not present]:
            parts.append(Text(f"Not in the graph: {', '.join(absent)}"))
        if web := facts["web"]:
            how = "" if web["answers"] else ", which do not answer"
            parts.append(Text(f"Pages at {web['address']}{how}; open them with: mrlab open"))
        parts += [Text(f"{name}: {text}") for name, text in facts["trouble"].items()]
        if recorder := _recorder_line(facts["recorder"]):
            parts.append(Text(recorder))
        sections: tuple[tuple[str, tuple[str, ...], list[tuple[str, ...]]], ...] = (
            ("Robots", ROBOT_COLUMNS, [_robot_row(r) for r in facts["robots"]]),
            (
                "Trajectories",
                ("id", "for", "frames", "Hz", "duration", "warnings"),
                [
                    (
                        t["id"],
                        t["robot_model"],
                        str(t["frame_count"]),
                        f"{t['frame_rate']:g}",
                        f"{t['duration']:.2f} s",
                        str(len(t["warnings"])),
                    )
                    for t in facts["trajectories"]
                ],
            ),
            (
                "Systems",
                ("name", "state", "members", "duration", "message"),
                [
                    (
                        s["name"],
                        s["state"],
                        ", ".join(s["members"]),
                        f"{s['duration']:.2f} s",
                        s["message"],
                    )
                    for s in facts["systems"]
                ],
            ),
            (
                "Latency",
                ("observer", "way", "count", "p50", "p95", "max", "clock"),
                [row for report in facts["latency"] for row in _latency_rows(report)],
            ),
            (
                "Processes",
                ("name", "state", "process", "for", "restarts", "last end"),
                [_process_row(p) for p in (supervisor or {}).get("processes", ())],
            ),
        )
        for title, columns, rows in sections:
            if rows or title == "Robots":
                parts += ["", _table(title, columns, rows)]
        return Group(*parts)


ROBOT_COLUMNS = ("robot", "at x, y", "state", "trajectory", "time", "late", "max")


def _robot_facts(robot: Any, follower: Follower) -> dict[str, Any]:
    state, position = follower.state, robot.pose.position
    known = follower.watch.value is not None
    moving = bool(follower.errors)
    return {
        "name": robot.name,
        "model": robot.model,
        "end_effector": robot.end_effector,
        "position": [position.x, position.y, position.z],
        "state": state.label if known else None,
        "message": state.message,
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


def _recorder_facts(state: Any) -> dict[str, Any] | None:
    if state is None:
        return None
    return {
        "state": ("STOPPED", "RECORDING", "REPLAYING", "PAUSED")[state.state],
        "bag": state.bag or None,
        "position": state.position,
        "duration": state.duration,
        "rate": state.rate,
        "messages": state.messages,
        "message": state.message,
    }


def _recorder_line(recorder: dict[str, Any] | None) -> str:
    """Say what the recorder does, or why it ended by itself; nothing while it rests."""
    if recorder is None or recorder["state"] == "STOPPED":
        return recorder["message"] if recorder else ""
    if recorder["state"] == "RECORDING":
        return (
            f"Records into {recorder['bag']}: {recorder['position']:.0f} s, "
            f"{recorder['messages']} messages"
        )
    how = "paused" if recorder["state"] == "PAUSED" else f"x {recorder['rate']:g}"
    return (
        f"Replays {recorder['bag']}: {recorder['position']:.1f} of {recorder['duration']:.1f} s, "
        f"{how}; the lab's own robots stand aside until it ends"
    )


def _latency_facts(observer: str, report: Any) -> dict[str, Any]:
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


def _latency_rows(report: dict[str, Any]) -> list[tuple[str, ...]]:
    """Return a row for each hop of all topics together."""
    from mrlab_ros.commands.follow import milliseconds

    error = f"±{milliseconds(report['clock_error'])}" if report["clock_error"] else "same"
    return [
        (
            report["observer"],
            f"{hop['from']} to {hop['to']}",
            str(hop["count"]),
            *(milliseconds(hop[level]) for level in ("p50", "p95", "max")),
            error,
        )
        for hop in report["hops"]
        if hop["topic"] is None
    ]


def _robot_row(robot: dict[str, Any]) -> tuple[str, ...]:
    from mrlab_ros.commands.follow import milliseconds

    position = robot["frame"] * robot["duration"] / max(robot["frame_count"] - 1, 1)
    errors = (robot["deadline_error"], robot["deadline_error_max"])
    return (
        robot["name"],
        "{:g}, {:g}".format(*robot["position"][:2]),
        robot["state"] or "no playback",
        robot["trajectory"] or "-",
        f"{position:.2f} of {robot['duration']:.2f} s" if robot["frame_count"] else "-",
        *(milliseconds(math.nan if error is None else error) for error in errors),
    )


def _process_row(process: dict[str, Any]) -> tuple[str, ...]:
    return (
        process["name"],
        process["phase"],
        str(process["pid"] or "-"),
        f"{time.time() - process['since']:.0f} s",
        str(process["restarts"]),
        process["last_exit"] or "-",
    )


def _table(title: str, columns: tuple[str, ...], rows: list[tuple[str, ...]]) -> RenderableType:
    from rich import box
    from rich.table import Table
    from rich.text import Text

    table = Table(title=title, title_justify="left", title_style="bold", box=box.SIMPLE_HEAD)
    for index, column in enumerate(columns):
        table.add_column(column, no_wrap=index == 0, overflow="fold")
    for row in rows:
        table.add_row(*map(Text, row))
    if not rows:
        table.add_row(Text("none yet"), *[""] * (len(columns) - 1))
    return table
