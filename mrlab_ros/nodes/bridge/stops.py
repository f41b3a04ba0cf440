"""Leaves the orders to end a recording that no recorder can take, for the one that runs next.

Pages and clients call the recorder over zenoh. A recording goes on when its recorder is started
again; an order to end it that came meanwhile is journalled, and carried out by that recorder.
"""

from __future__ import annotations

import time
from collections.abc import Callable

from mrlab_msgs import msg
from rclpy.node import Node

from mrlab_ros.adapters.stop_orders import StopOrders
from mrlab_ros.core.base.diagnostic import Diagnostic
from mrlab_ros.core.recording.diagnostics import STOP_LEFT
from mrlab_ros.core.recording.recorder import RecorderState
from mrlab_ros.core.runtime.identity import Identity
from mrlab_ros.core.runtime.process_states import Deaths
from mrlab_ros.messages import qos
from mrlab_ros.messages.status import processes_from_message
from mrlab_ros.ros.decoding import subscribe

RECORDER = "/recorder"
STOP = f"{RECORDER}/stop"


class StopsLeft:
    """The stops of the recording of one lab.

    node: its executor calls `down` where the recorder ended or froze. lab: its id; empty: any.
    """

    def __init__(
        self, node: Node, state_dir: str, lab: str, down: Callable[[str], object]
    ) -> None:
        self._orders = StopOrders(state_dir)
        self._identity = Identity(lab, lambda _: None)
        self._deaths = Deaths(time.monotonic_ns())
        self._announce = down
        self._bag = ""
        # From the recorder's end or freeze until it says again what it does: DDS lets a client
        # call a server that is dead for seconds more.
        self.down = False
        subscribe(node, msg.RecorderState, f"{RECORDER}/state", self._on_state, qos.LATCHED)
        subscribe(node, msg.LabProcesses, "/processes", self._on_processes, qos.LATCHED)

    def leave(self) -> Diagnostic | None:
        """Leave the order to end the recording that runs; return what is said of it.

        None: no recording runs, as far as is known, or nothing can be kept.
        """
        bag = self._bag
        return STOP_LEFT(bag=bag) if bag and self._orders.leave(bag) else None

    def _on_state(self, message: msg.RecorderState) -> None:
        self.down = False
        self._bag = message.bag if message.state == RecorderState.RECORDING.value else ""

    def _on_processes(self, message: msg.LabProcesses) -> None:
        if not self._identity.accepts(message.lab):
            return
        states = [s for s in processes_from_message(message) if s.holds(RECORDER)]
        if self._deaths.new(states):
            self.down = True
            self._announce(STOP)
