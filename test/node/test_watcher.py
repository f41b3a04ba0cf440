"""Signs of life on /diagnostics: who died, and what a restarted process says."""

from __future__ import annotations

import json
import time

import pytest
from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus
from graph import Graph, wait_for

from mrlab_ros.core.base.diagnostic import Diagnostic
from mrlab_ros.core.playback.diagnostics import GOAL_LOST
from mrlab_ros.messages import qos
from mrlab_ros.messages.status import troubles_in
from mrlab_ros.processes.watcher import Watcher


def test_a_process_that_falls_silent_is_reported_by_another(
    graph: Graph, monkeypatch: pytest.MonkeyPatch
):
    said: dict[str, Diagnostic | None] = {}
    graph.client.create_subscription(
        DiagnosticArray,
        "/diagnostics",
        lambda message: said.update(troubles_in(message)),
        qos.LATCHED_EVENTS,
    )

    def code(process: str) -> str:
        return "" if said[process] is None else said[process].code

    lab = Watcher("lab", context=graph.context)
    playback = Watcher("playback", context=graph.context)
    try:
        wait_for(lambda: said == {"lab": None, "playback": None}, "signs of life")
        playback.close()
        wait_for(lambda: code("playback") == "process_silent", "the report")
        playback = Watcher("playback", restarts=1, last_exit="SIGKILL", context=graph.context)
        playback.lost = [GOAL_LOST(robot="ur5e_1")]
        wait_for(lambda: code("playback") == "died_and_lost", "what was lost")
        values = said["playback"].values
        assert values["last_exit"] == "SIGKILL"
        assert json.loads(values["lost"])["code"] == "goal_lost"
        assert said["lab"] is None
        # The middleware names the nodes again when an end is made.
        made: list[str] = []
        make = lab._node.create_publisher
        monkeypatch.setattr(
            lab._node, "create_publisher", lambda *args: made.append(args[1]) or make(*args)
        )
        # As if it had not run since.
        lab._watch.look(time.monotonic() - 5.0)
        wait_for(lambda: code("lab") == "did_not_run", "the freeze")
        assert made
    finally:
        for watcher in (lab, playback):
            watcher.close()


def test_a_status_is_one_that_standard_tools_understand(graph: Graph):
    inbox = graph.listen(DiagnosticArray, "/diagnostics", qos.EVENTS)
    watcher = Watcher("physics", context=graph.context)
    try:
        wait_for(lambda: inbox, "a sign of life")
        (status,) = inbox[0].status
        assert (status.name, status.level) == ("mrlab: physics", DiagnosticStatus.OK)
        assert status.hardware_id == "mrlab"
    finally:
        watcher.close()
