"""Gives a process's sign of life on /diagnostics, and reports processes that give none."""

from __future__ import annotations

import os
import time
from collections.abc import Iterable
from dataclasses import replace

from diagnostic_msgs.msg import DiagnosticArray
from rclpy.context import Context

from mrlab_ros.core.base.diagnostic import Diagnostic
from mrlab_ros.core.runtime.watch import PERIOD_S, Sign, Watch
from mrlab_ros.messages import qos
from mrlab_ros.messages.status import living_in, signs_to_message
from mrlab_ros.processes.child_process import LAST_EXIT, RESTARTS
from mrlab_ros.ros.clock import every
from mrlab_ros.ros.decoding import subscribe, undecoded
from mrlab_ros.ros.node import HiddenNode
from mrlab_ros.ros.spinning import SpunNode

TOPIC = "/diagnostics"
# Others find a process again, that they had given up while it did not run, within this time, s:
# it announces itself every 3 s.
RENEWED_FOR_S = 10.0


class Watcher:
    """A hidden node with a thread of its own: a busy node is no dead process.

    lost: what could not be brought back after a restart; None: not known yet.
    failed: what went wrong since, newest first.
    """

    def __init__(
        self,
        process: str,
        *,
        restarts: int | None = None,
        last_exit: str | None = None,
        context: Context | None = None,
    ) -> None:
        """restarts, last_exit: as the supervisor says in the environment."""
        environment = os.environ
        self._sign = Sign(
            process,
            int(environment.get(RESTARTS, "0")) if restarts is None else restarts,
            environment.get(LAST_EXIT, "") if last_exit is None else last_exit,
        )
        self.lost: Iterable[Diagnostic] | None = None
        self.failed: Iterable[Diagnostic] = ()
        self._watch = Watch(process)
        self._began = time.monotonic()
        self._node = HiddenNode(f"_watcher_{process}_{os.getpid()}", context)
        self._topic = self._node.create_publisher(DiagnosticArray, TOPIC, qos.LATCHED)
        # Not latched: diagnostics of other robots seldom are, and rclpy would warn of each.
        subscribe(self._node, DiagnosticArray, TOPIC, self._hear, qos.EVENTS)
        every(self._node, PERIOD_S, self._give_sign)
        self._spun = SpunNode(self._node)

    def close(self) -> None:
        self._spun.close()

    def _hear(self, message: DiagnosticArray) -> None:
        now = time.monotonic()
        for process in living_in(message):
            self._watch.hear(process, now)

    def _give_sign(self) -> None:
        now = time.monotonic()
        self._watch.look(now)
        freeze = self._watch.freeze(now)
        if freeze is not None and freeze.ago < RENEWED_FOR_S:
            self._renew_names()
        lost = self.lost
        sign = replace(
            self._sign,
            lost=None if lost is None else tuple(lost),
            failed=tuple(self.failed),
            noticed=tuple(undecoded()),
            freeze=freeze,
        )
        message = signs_to_message(
            time.time_ns(), sign, now - self._began, self._watch.silent(now)
        )
        self._topic.publish(message)

    def _renew_names(self) -> None:
        """Name the nodes of this process to others again.

        The middleware names them when one of its ends is made or ends, and to who is new. Others
        that gave the process up while it did not run count as neither.
        """
        self._node.destroy_publisher(
            self._node.create_publisher(DiagnosticArray, TOPIC, qos.LATCHED)
        )
