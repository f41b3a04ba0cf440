"""Runs one or several of the lab's nodes in this process until it is asked to stop."""

from __future__ import annotations

import gc
import importlib
import os
import signal
import sys
import time
from collections.abc import Callable

import rclpy
import rclpy.utilities
from rclpy.node import Node

from mrlab_ros.core.base.errors import BadInput, LabError, Unavailable
from mrlab_ros.processes.child_process import RESTARTS, WRONG_CONFIGURATION
from mrlab_ros.processes.lab import NODES, PROCESSES
from mrlab_ros.processes.stand_aside import StandAside
from mrlab_ros.processes.watcher import Watcher
from mrlab_ros.ros import clock
from mrlab_ros.ros.diagnostics import SEVERAL_NODES_REFUSE
from mrlab_ros.ros.environment import postpone_numpy
from mrlab_ros.ros.parameters import WrongParameters
from mrlab_ros.ros.spinning import SpunNode, shut_down, start_up

# How often a process checks whether it was asked to stop, s.
POLL_PERIOD_S = 0.2
# A restarted process must not join the graph during a replay: it waits up to this long for the
# recorder to be discovered, s. Discovery takes up to 3 s.
FIND_TIMEOUT_S = 3.0


def maker(name: str) -> Callable[[], Node]:
    """Import the node called `name`; what is returned builds it in the default context."""
    entry = NODES[name]
    made: Callable[[], Node] = getattr(importlib.import_module(entry.module), entry.kind)
    return made


def _nothing() -> None:
    """Prepare nothing in a node's thread."""


def _spin(node: Node) -> SpunNode:
    """Spin a node; where a signal has shut the context down meanwhile, destroy it and raise."""
    try:
        return SpunNode(node, getattr(node, "prepare_thread", _nothing))
    except Exception:
        # Its threads must not outlive the interpreter.
        node.destroy_node()
        raise


def process_of(names: list[str]) -> str:
    """Return the name of the lab's process that runs these nodes."""
    known = (process.name for process in PROCESSES if process.nodes == tuple(names))
    return next(known, "_".join(names))


def run(names: list[str]) -> int:
    """Spin the nodes until SIGINT or SIGTERM; return the process's exit code.

    That is 0 after a signal, WRONG_CONFIGURATION where a node refuses its parameters or files,
    1 after any other error. SIGINT must have its default action when this is called: rclpy's
    handlers then treat both signals alike, shut the context down and raise nothing. While a bag
    is replayed, the nodes that would publish the same topics are closed; afterwards they are made
    again and recover as after a restart.
    """
    try:
        start_up()
    except BadInput as error:
        print(error, file=sys.stderr, flush=True)
        return WRONG_CONFIGURATION
    if not any(NODES[name].numpy for name in names):
        postpone_numpy()
    running = rclpy.utilities.get_default_context().ok
    aside: StandAside | None = None
    watcher: Watcher | None = None
    spun: dict[str, SpunNode] = {}
    name = ""
    settled = False
    try:
        if not all(NODES[name].in_replay for name in names):
            aside = StandAside()
        process = process_of(names)
        clock.PROCESS.process = process
        watcher = Watcher(process)
        makers = {name: maker(name) for name in names}
        if aside is not None:
            aside.wait_for_recorder(
                FIND_TIMEOUT_S if os.environ.get(RESTARTS, "0") != "0" else 0.0
            )
        while running():
            replay = aside is not None and aside.wanted
            wanted = [name for name in names if NODES[name].in_replay or not replay]
            for name in [name for name in reversed(spun) if name not in wanted]:
                spun.pop(name).close()
            # The mistakes of all nodes are named at once.
            mistakes = []
            for name in wanted:
                if name not in spun:
                    try:
                        spun[name] = _spin(makers[name]())
                    except WrongParameters as error:
                        mistakes.append(error)
            if len(mistakes) > 1:
                several = SEVERAL_NODES_REFUSE(count=len(mistakes), mistakes=mistakes)
                raise WrongParameters(several)
            if mistakes:
                raise mistakes[0]
            if not settled:
                # Imported modules stay. Searching them for garbage takes 20 ms, in which no
                # thread moves anything.
                settled = True
                gc.collect()
                gc.freeze()
            # Diagnostics of state that its nodes could not bring back after a restart.
            watcher.lost = [
                said for node in spun.values() for said in getattr(node.node, "lost", ())
            ]
            watcher.failed = [
                said for node in spun.values() for said in getattr(node.node, "failed", ())
            ]
            time.sleep(POLL_PERIOD_S)
        return 0
    except WrongParameters as error:
        print(error, file=sys.stderr, flush=True)
        return WRONG_CONFIGURATION
    except Exception as error:
        if not running():
            # A signal shut the context down while a node was made, which then failed.
            return 0
        if not isinstance(error, LabError):
            raise
        print(f"{name}: {error}", file=sys.stderr, flush=True)
        lasting = isinstance(error, BadInput) and not isinstance(error, Unavailable)
        return WRONG_CONFIGURATION if lasting else 1
    finally:
        # A second Ctrl-C must not interrupt the clean-up: the supervisor sets its deadline.
        signal.signal(signal.SIGINT, signal.SIG_IGN)
        shut_down()
        for node in reversed(spun.values()):
            node.close()
        if aside is not None:
            aside.close()
        if watcher is not None:
            watcher.close()
        sys.stdout.flush()
        sys.stderr.flush()
