"""Signs of life, delays of the bridge and states of the recorder as messages."""

from __future__ import annotations

import time
from collections.abc import Iterable, Mapping, Sequence
from typing import TYPE_CHECKING

from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus, KeyValue
from mrlab_msgs import msg
from mrlab_msgs.msg import Latency, LatencyHop

from mrlab_ros.core.base.clock import SECOND
from mrlab_ros.core.base.diagnostic import Diagnostic, Severity, to_texts
from mrlab_ros.core.bridge.latency import Delays
from mrlab_ros.core.runtime.process_states import Phase, ProcessState
from mrlab_ros.core.runtime.watch import Sign, silence
from mrlab_ros.messages.texts import told, values_to_message
from mrlab_ros.messages.time import make_header, time_from_message, time_to_message

if TYPE_CHECKING:
    # Commands that read messages do without numpy.
    from mrlab_ros.core.recording.stops import Stop

# Prefix of the names of the lab's processes on /diagnostics.
PREFIX = "mrlab: "
# Values that a process reports of itself alone.
RESTARTS = "restarts"
# That it says itself how it ended, and what was lost: for a minute after its restart.
RESTARTED = "restarted"
# The code of what is amiss; the values of its text by name stand beside it.
CODE = "code"
# The instant of a stop of a replay, s of the session.
INSTANT = "session_time"
LEVELS = {
    Severity.INFO: DiagnosticStatus.OK,
    Severity.WARNING: DiagnosticStatus.WARN,
    Severity.ERROR: DiagnosticStatus.ERROR,
}


def signs_to_message(
    now_ns: int, own: Sign, age: float, silent: Mapping[str, float]
) -> DiagnosticArray:
    """Return a process's own sign of life, and which others are silent, by process in s.

    age: how long it runs, s.
    """
    facts = {RESTARTS: str(own.restarts), "last_exit": own.last_exit}
    if own.restarted(age):
        facts[RESTARTED] = "true"
    statuses = [_status(own.process, own.trouble(age), facts, failed=bool(own.failed))]
    statuses += [
        _status(process, silence(seconds), {}, failed=True) for process, seconds in silent.items()
    ]
    return DiagnosticArray(header=make_header(now_ns), status=statuses)


def _status(
    process: str, trouble: Diagnostic | None, facts: Mapping[str, str], *, failed: bool
) -> DiagnosticStatus:
    level = DiagnosticStatus.ERROR if failed else DiagnosticStatus.WARN
    if trouble is not None:
        facts = {**to_texts(trouble.values), **facts, CODE: trouble.code}
    return DiagnosticStatus(
        level=level if trouble is not None else DiagnosticStatus.OK,
        name=f"{PREFIX}{process}",
        message="runs" if trouble is None else str(trouble),
        hardware_id="mrlab",
        values=[KeyValue(key=key, value=value) for key, value in facts.items()],
    )


def living_in(message: DiagnosticArray) -> list[str]:
    """Return the processes that give a sign of life in a message."""
    return [
        status.name.removeprefix(PREFIX)
        for status in message.status
        if status.name.startswith(PREFIX) and any(v.key == RESTARTS for v in status.values)
    ]


def restarted_in(message: DiagnosticArray) -> set[str]:
    """Return the processes that say themselves that they were restarted lately."""
    return {
        status.name.removeprefix(PREFIX)
        for status in message.status
        if status.name.startswith(PREFIX) and any(v.key == RESTARTED for v in status.values)
    }


def troubles_in(message: DiagnosticArray) -> dict[str, Diagnostic | None]:
    """Return for each process in a message what is amiss with it; None: nothing."""
    return {
        status.name.removeprefix(PREFIX): (
            None if status.level == DiagnosticStatus.OK else _trouble(status)
        )
        for status in message.status
        if status.name.startswith(PREFIX)
    }


def _trouble(status: DiagnosticStatus) -> Diagnostic:
    values = {each.key: each.value for each in status.values}
    code = values.pop(CODE, "")
    failed = status.level == DiagnosticStatus.ERROR
    severity = Severity.ERROR if failed else Severity.WARNING
    return Diagnostic(code, severity, status.message, values=values)


# The phases in the order of the constants of LabProcess.msg.
PHASES = tuple(phase.value for phase in Phase)


def processes_to_message(
    now_ns: int, states: Sequence[ProcessState], lab: str
) -> msg.LabProcesses:
    """Return the processes of the lab with the id `lab`."""
    return msg.LabProcesses(
        header=make_header(now_ns), processes=list(map(_process, states)), lab=lab
    )


def _process(state: ProcessState) -> msg.LabProcess:
    return msg.LabProcess(
        name=state.name,
        nodes=list(state.nodes),
        state=PHASES.index(state.phase),
        since=time_to_message(round(state.since * SECOND)),
        restarts=state.restarts,
        exit_code=state.exit_code,
        last_exit=state.last_exit,
        down=time_to_message(round(state.down * SECOND)),
        down_steady_ns=state.down_steady_ns,
        restart_in=state.restart_in,
    )


def _down_here(one: msg.LabProcess, elsewhere: bool) -> int:
    """Return when a process ended or froze last, ns of this machine's steady clock; 0: never."""
    down_ns = time_from_message(one.down)
    if not (elsewhere and down_ns):
        return int(one.down_steady_ns)
    return down_ns - time.time_ns() + time.monotonic_ns()


def processes_from_message(message: msg.LabProcesses) -> list[ProcessState]:
    """Return the processes; one in an unknown state is left out. Their ids are not known."""
    # A lab on several machines has no id; their steady clocks have nothing in common.
    elsewhere = not message.lab
    return [
        ProcessState(
            one.name,
            PHASES[one.state],
            None,
            one.restarts,
            time_from_message(one.since) / SECOND,
            one.last_exit,
            one.exit_code,
            tuple(one.nodes),
            time_from_message(one.down) / SECOND,
            _down_here(one, elsewhere),
            one.restart_in,
        )
        for one in message.processes
        if one.state < len(PHASES)
    ]


def latency_to_message(
    now_ns: int, observer: str, window: float, delays: Iterable[Delays]
) -> Latency:
    """Return a report of the way from publishing in the graph to zenoh. window: s."""
    return Latency(
        header=make_header(now_ns),
        observer=observer,
        window=window,
        hops=[
            LatencyHop(
                hop=LatencyHop.PUBLISHED_TO_BRIDGED,
                topic=delay.topic,
                count=delay.count,
                p50=delay.p50,
                p95=delay.p95,
                max=delay.max,
            )
            for delay in delays
        ],
    )


def recorder_state_to_message(
    now_ns: int,
    state: int,
    said: Diagnostic | None,
    *,
    bag: str = "",
    position: float = 0.0,
    duration: float = 0.0,
    rate: float = 1.0,
    messages: int = 0,
    size: int = 0,
) -> msg.RecorderState:
    """state: a value of RecorderState.msg. said: the trouble. position, duration: s.

    size: bytes of the bag.
    """
    return msg.RecorderState(
        header=make_header(now_ns),
        state=state,
        **told(said),
        bag=bag,
        position=position,
        duration=duration,
        rate=rate,
        messages=messages,
        bytes=size,
    )


def stops_to_message(now_ns: int, stops: Iterable[Stop]) -> DiagnosticArray:
    """Return the stops of a replay: as name the code of what is said, its values, and INSTANT."""
    return DiagnosticArray(
        header=make_header(now_ns),
        status=[
            DiagnosticStatus(
                level=LEVELS[stop.severity],
                name=stop.said.code,
                message=str(stop.said),
                hardware_id="mrlab",
                values=[
                    KeyValue(key=INSTANT, value=f"{stop.time:.3f}"),
                    *values_to_message(stop.said.values),
                ],
            )
            for stop in stops
        ],
    )


def unknown_state() -> msg.PlaybackState:
    """Return what stands for the state of a playback that has not published one."""
    return msg.PlaybackState(label="?")
