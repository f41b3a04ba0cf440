"""Publishes the state of the supervised processes from within the supervisor.

The supervisor outlives every process that it keeps, and its children die with it: so an end is
published by whoever notices it first, and is there for those that come later.
"""

from __future__ import annotations

import os
import threading
import time
from collections.abc import Sequence
from typing import Any

from mrlab_ros.core.runtime.process_states import ProcessState


class Announcer:
    """A hidden node that publishes /processes; it has no executor, since it receives nothing.

    lab: its id. What is announced before open() is published by that. context: of its node, once
    it is open; others of the supervisor share it, as each would be one more participant.
    """

    def __init__(self, lab: str) -> None:
        self._lab = lab
        self._lock = threading.Lock()
        self._states: Sequence[ProcessState] = ()
        self.context: Any = None
        self._node: Any = None
        self._topic: Any = None

    def open(self) -> None:
        """Join the graph. It imports rclpy, which takes a while: start the processes first."""
        from mrlab_ros.ros import environment

        environment.prepare()
        environment.skip_generator()
        import rclpy
        from mrlab_msgs.msg import LabProcesses
        from rclpy.context import Context
        from rclpy.signals import SignalHandlerOptions

        from mrlab_ros.messages import qos
        from mrlab_ros.ros.node import HiddenNode

        self.context = Context()
        no_signals = SignalHandlerOptions.NO
        rclpy.init(args=[], context=self.context, signal_handler_options=no_signals)
        self._node = HiddenNode(f"_supervisor_{os.getpid()}", self.context, remapped=True)
        with self._lock:
            self._topic = self._node.create_publisher(LabProcesses, "/processes", qos.LATCHED)
        self.announce(self._states)

    def announce(self, states: Sequence[ProcessState]) -> None:
        """Publish the state of all processes."""
        with self._lock:
            self._states = states
            if self._topic is None:
                return
            from mrlab_ros.messages.status import processes_to_message

            self._topic.publish(processes_to_message(time.time_ns(), states, self._lab))

    def close(self) -> None:
        """Leave the graph."""
        with self._lock:
            self._topic = None
        if self._node is not None:
            self._node.destroy_node()
            self.context.try_shutdown()
