"""A thread that waits for changes of the graph: new and lost nodes, topics and services.

rcl triggers a guard condition at each, which rclpy does not offer. Asking for all names instead
takes 20 ms with the 130 services of thirteen robots.
"""

from __future__ import annotations

import ctypes
from collections.abc import Callable
from contextlib import ExitStack, suppress
from typing import Any

from rclpy.guard_condition import GuardCondition
from rclpy.impl.implementation_singleton import rclpy_implementation
from rclpy.node import Node

from mrlab_ros.adapters import threads

# The longest wait before the thread checks that the context still lives, s.
MAX_WAIT_S = 0.2

_rcl = ctypes.CDLL("librcl.so")
_rcl.rcl_node_get_graph_guard_condition.argtypes = [ctypes.c_void_p]
_rcl.rcl_node_get_graph_guard_condition.restype = ctypes.c_void_p
_rcl.rcl_wait_set_add_guard_condition.argtypes = [ctypes.c_void_p] * 3


class GraphChanges:
    """Calls `turn` at once, after each change of the graph, after wake(), and from time to time.

    turn: gets whether the graph has changed; returns how long the next wait may be, s, of which
    MAX_WAIT_S at most are waited. The thread ends with close(), before `node` is destroyed.
    """

    def __init__(self, node: Node, name: str, turn: Callable[[bool], float]) -> None:
        self._node = node
        self._turn = turn
        self._stopped = False
        self._guard = GuardCondition(None, None, context=node.context)
        self._thread = threads.loop(name, self._run, node.context.ok)
        self._thread.start()

    def wake(self) -> None:
        """Have `turn` called soon; any thread may ask for it."""
        with suppress(rclpy_implementation.RCLError):  # the context is shut down at this instant
            if self._node.context.ok():
                self._guard.trigger()

    def close(self) -> None:
        """End the thread and wait for it."""
        self._stopped = True
        self.wake()
        self._thread.join()
        self._guard.destroy()

    def _run(self) -> None:
        node: Any = self._node.handle
        context: Any = self._node.context.handle
        with ExitStack() as stack:
            for each in (context, node, self._guard.handle):
                stack.enter_context(each)
            graph = _rcl.rcl_node_get_graph_guard_condition(node.pointer)
            waits = rclpy_implementation.WaitSet(0, 2, 0, 0, 0, 0, context)
            changed = False
            while not self._stopped and self._node.context.ok():
                left = self._turn(changed)
                waits.clear_entities()
                waits.add_guard_condition(self._guard.handle)
                _rcl.rcl_wait_set_add_guard_condition(waits.pointer, graph, None)
                waits.wait(round(min(left, MAX_WAIT_S) * 1e9))
                changed = waits.is_ready("guard_condition", 1)
