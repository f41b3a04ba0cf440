"""Spins each node of the lab in a thread of its own, with rclpy's events executor.

The events executor dispatches an event without building a wait set of every entity: with fifty
robots that takes 0.03 ms an event instead of several. Two of its properties shape this module. It
does not wake from a wait without a time-out, so each wait has one. And a callback that waits for
a response must not run in the thread that receives it, so a node that calls services does that
through a `Caller`.
"""

from __future__ import annotations

import threading
from collections.abc import Callable
from contextlib import suppress

import rclpy
import rclpy.utilities
from rclpy.context import Context
from rclpy.executors import Executor, ExternalShutdownException
from rclpy.experimental.events_executor import EventsExecutor
from rclpy.impl.implementation_singleton import rclpy_implementation
from rclpy.node import Node
from rclpy.task import Future

from mrlab_ros.adapters import threads
from mrlab_ros.core.base.errors import BadInput
from mrlab_ros.core.runtime.freezes import LOOK_PERIOD_S
from mrlab_ros.ros import clock, environment
from mrlab_ros.ros.diagnostics import BAD_ROS_ARGUMENTS
from mrlab_ros.ros.environment import skip_generator
from mrlab_ros.ros.node import HiddenNode

# The longest the executor waits at a time, s; what arrives is handed on at once all the same. So
# often a process says that it runs.
WAIT_S = LOOK_PERIOD_S


def make_executor(context: Context) -> Executor:
    """Return the executor that spin() is for."""
    return EventsExecutor(context=context)


def spin(executor: Executor, context: Context, stop: threading.Event | None = None) -> None:
    """Spin until the context is shut down, SIGINT arrives, or `stop` is set.

    What a callback raises is named in the log: one robot's trouble must not stop the others. A
    callback of something that another thread has just destroyed raises InvalidHandle and is
    forgotten.
    """
    never = Future()
    with clock.watching():
        while context.ok() and not (stop is not None and stop.is_set()):
            clock.look()
            try:
                executor.spin_until_future_complete(never, timeout_sec=WAIT_S)
            except (KeyboardInterrupt, ExternalShutdownException):
                return
            except rclpy_implementation.InvalidHandle:
                continue
            except Exception as error:
                # A failure after the shutdown of the context is no mistake.
                if context.ok():
                    threads.name_error(threading.current_thread().name, error)


def start_up() -> None:
    """Initialise the default context; raise BadInput where rcl refuses the command line."""
    environment.prepare()
    skip_generator()
    try:
        rclpy.init()
    except (rclpy_implementation.RCLError, rclpy_implementation.UnknownROSArgsError) as error:
        environment.check_log_folder()
        # After the reason rcl names lines of its own sources.
        reason = str(error).split(", at /")[0].removeprefix("failed to initialize rcl: ")
        raise BadInput(BAD_ROS_ARGUMENTS(why=reason)) from error


def shut_down() -> None:
    """Shut the default context down, unless rclpy's signal handler did so a moment before.

    The handler does it in a thread of its own, so that both may try at once.
    """
    with suppress(rclpy_implementation.RCLError):
        rclpy.utilities.try_shutdown()


class SpunNode:
    """A node with an executor and a thread of its own.

    executor: may spin further nodes beside it. prepare: called first in the thread.
    """

    def __init__(self, node: Node, prepare: Callable[[], object] = lambda: None) -> None:
        self.node = node
        self.executor = make_executor(node.context)
        self.executor.add_node(node)
        self._prepare = prepare
        self._stop = threading.Event()
        self._thread = threads.loop(node.get_name(), self._run, node.context.ok)
        self._thread.start()

    def _run(self) -> None:
        self._prepare()
        spin(self.executor, self.node.context, self._stop)

    def close(self) -> None:
        """Stop spinning, then destroy the node."""
        self._stop.set()
        self.executor.wake()
        self._thread.join()
        self.node.destroy_node()
        self.executor.shutdown()


class Caller(SpunNode):
    """A hidden node beside `owner` through which it calls services and subscribes to topics."""

    def __init__(self, owner: Node) -> None:
        super().__init__(HiddenNode(f"_{owner.get_name()}_caller", owner.context, remapped=True))
