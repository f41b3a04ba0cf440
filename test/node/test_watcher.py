"""Signs of life on /diagnostics: who died, and what a restarted process says."""

from __future__ import annotations

import time

import pytest
from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus
from graph import Graph, wait_for

from mrlab_ros.messages import qos
from mrlab_ros.messages.diagnostics import troubles_in
from mrlab_ros.processes.watcher import Watcher


def test_a_process_that_falls_silent_is_reported_by_another(
    graph: Graph, monkeypatch: pytest.MonkeyPatch
):
    said: dict[str, str] = {}
    graph.client.create_subscription(
        DiagnosticArray,
        "/diagnostics",
        lambda message: said.update(troubles_in(message)),
        qos.LATCHED_EVENTS,
    )
    lab = Watcher("lab", context=graph.context)
    playback = Watcher("playback", context=graph.context)
    try:
        wait_for(lambda: said == {"lab": "", "playback": ""}, "signs of life")
        playback.close()
        wait_for(lambda: "no sign of life for" in said["playback"], "the report")
        playback = Watcher("playback", restarts=1, last_exit="SIGKILL", context=graph.context)
        playback.lost = ["ur5e_1 has lost wave"]
        wait_for(lambda: "died (SIGKILL)" in said["playback"], "the restart")
        wait_for(lambda: "lost: ur5e_1 has lost wave" in said["playback"], "what was lost")
        assert said["lab"] == ""
        # The middleware names the nodes again when an end is made.
        made: list[str] = []
        make = lab._node.create_publisher
        monkeypatch.setattr(
            lab._node, "create_publisher", lambda *args: made.append(args[1]) or make(*args)
        )
        # As if it had not run since.
        lab._watch.look(time.monotonic() - 5.0)
        wait_for(lambda: "did not run for about" in said["lab"], "the freeze")
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
