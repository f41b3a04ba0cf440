"""A lab ends where a process refuses its configuration at its first start, and only then."""

import threading

from refusals import refused

from mrlab_ros.commands.diagnostics import PROCESSES_REFUSE
from mrlab_ros.commands.up.refusals import Refusals
from mrlab_ros.core.base.errors import BadInput
from mrlab_ros.core.runtime.process_states import Phase, ProcessState


def state(name, phase, restarts=0):
    return ProcessState(name, phase.value, None, restarts, 0.0, "")


def test_a_first_start_that_is_refused_ends_the_lab_whenever_it_is_noticed():
    stop = threading.Event()
    refusals = Refusals(stop)
    refusals.check([state("bridge", Phase.STARTING), state("lab", Phase.RUNNING)])
    refusals.raise_any()
    refusals.check([state("bridge", Phase.REFUSED), state("lab", Phase.RUNNING)])
    assert stop.is_set()
    with refused(PROCESSES_REFUSE, BadInput, processes=["bridge"]):
        refusals.raise_any()


def test_a_restart_that_is_refused_leaves_the_lab():
    stop = threading.Event()
    refusals = Refusals(stop)
    refusals.check([state("bridge", Phase.REFUSED, restarts=1)])
    refusals.raise_any()
    assert not stop.is_set()
