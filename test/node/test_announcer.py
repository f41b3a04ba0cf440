"""A death is on /processes before the process is started again, also for those that come later."""

from __future__ import annotations

import os
import signal
import sys

from graph import Graph, wait_for
from mrlab_msgs.msg import LabProcess, LabProcesses

from mrlab_ros.messages import qos
from mrlab_ros.processes.announcer import Announcer
from mrlab_ros.processes.child_process import ProcessSpec, RestartPolicy
from mrlab_ros.processes.supervisor import Supervisor

SLEEP = (sys.executable, "-S", "-c", "import time; time.sleep(600)")


def test_each_end_and_each_freeze_is_published_at_once_and_latched(graph: Graph) -> None:
    announcer = Announcer("ours")
    heard = graph.listen(LabProcesses, "/processes", qos.LATCHED_EVENTS)
    spec = ProcessSpec("playback", SLEEP, nodes=("playback_host",))
    policy = RestartPolicy(first=0.5)
    supervisor = Supervisor([spec], print, announcer.announce, lambda: policy)
    try:
        with supervisor:
            wait_for(lambda: supervisor.states[0].pid, "the start")
            announcer.open()
            wait_for(lambda: heard, "the state at the opening")
            pid = supervisor.states[0].pid or 0
            os.kill(pid, signal.SIGSTOP)
            wait_for(lambda: heard[-1].processes[0].state == LabProcess.FROZEN, "the freeze")
            os.kill(pid, signal.SIGCONT)
            wait_for(lambda: heard[-1].processes[0].state == LabProcess.RUNNING, "the thaw")
            frozen_ns = heard[-1].processes[0].down_steady_ns
            os.kill(pid, signal.SIGKILL)
            wait_for(lambda: heard[-1].processes[0].restarts == 1, "the restart")
            dead, back = (message.processes[0] for message in list(heard)[-2:])
            assert (dead.state, back.state) == (LabProcess.WAITING, LabProcess.RUNNING)
            assert (dead.last_exit, dead.exit_code) == ("SIGKILL", -9)
            assert (list(dead.nodes), dead.restart_in) == (["playback_host"], 0.5)
            assert frozen_ns < dead.down_steady_ns == back.down_steady_ns
            assert heard[-1].lab == "ours"
            late = graph.listen(LabProcesses, "/processes", qos.LATCHED)
            wait_for(lambda: late, "the latched state")
            assert late[0].processes[0].last_exit == "SIGKILL"
    finally:
        announcer.close()
