"""Spins an executor whose nodes come and go while it waits."""

from __future__ import annotations

import traceback

from rclpy.executors import Executor, ExternalShutdownException
from rclpy.impl.implementation_singleton import rclpy_implementation


def spin(executor: Executor) -> None:
    """Spin until the context is shut down or the executor is.

    A node or client that another thread destroys may still be in the wait set; rclpy then raises
    InvalidHandle, and the next round no longer has it. Whatever else a callback raises is
    printed: one node's mistake must not take the other nodes of the process down.
    """
    while executor.context.ok():
        try:
            executor.spin()
            return
        except (KeyboardInterrupt, ExternalShutdownException):
            return
        except rclpy_implementation.InvalidHandle:
            continue
        except Exception:
            traceback.print_exc()
