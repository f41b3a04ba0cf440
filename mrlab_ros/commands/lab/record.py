"""`mrlab record`: the session of the running lab into a bag, until Ctrl-C."""

from __future__ import annotations

import json
import time
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from mrlab_ros.app.diagnostics import RECORDING_ENDED_LATE
from mrlab_ros.commands import output
from mrlab_ros.commands.diagnostics import (
    BAG_CLOSED,
    ENDED_BY_ANOTHER,
    LAB_SILENT,
    NOT_A_BAG_NAME,
    RECORDER_AWAITED,
    RECORDER_BACK,
    RECORDER_FROZEN,
    RECORDER_SILENT,
    RECORDING_CONTINUES,
    RECORDING_GONE,
    STOP_NOT_AWAITED,
    STOP_UNKNOWN,
    STOP_WAITS,
    STOP_WITH_BAG,
)
from mrlab_ros.commands.output import say
from mrlab_ros.core.base.diagnostic import Diagnostic, Fix, heard
from mrlab_ros.core.base.errors import LabError, Misuse, WrongUsage
from mrlab_ros.core.base.foreign_text import for_shell
from mrlab_ros.core.recording.diagnostics import ENDING, NO_RECORDING, STOP_LEFT
from mrlab_ros.core.recording.recorder import RecorderState

if TYPE_CHECKING:
    from mrlab_ros.ros.graph import GraphClient, Watch

REFRESH = 0.25
# A working recorder publishes its state once a second; without one for this long it has gone, s.
SILENCE = 5.0
# A recorder that died is back by then: the supervisor starts it again, s.
RETURN = 20.0
# A bag of such a name is a command that was meant otherwise.
COMMANDS = {"stop": "mrlab record --stop", "start": "mrlab record"}
# A recorder answers by then, but where it closes a bag of hours or is frozen, s.
ANSWER_S = 3.5
# A process gives a sign of life once a second; one without any for this long is frozen, s.
FROZEN_S = 2.5
# A bag of hours is closed by then, s.
STOP_TIMEOUT_S = 30.0
# A recorder that died has carried out by then what was left for it, s; a frozen one has not.
ORDER_S = 8.0
TO_END = (*ENDING, Fix(command="mrlab status"))


def record(
    bag: Annotated[
        Path | None,
        typer.Argument(help="Folder to make; not given: one named by date and time."),
    ] = None,
    topics: Annotated[
        str, typer.Option(help="Topics, such as /robots,/*/joint_states; all of the lab's.")
    ] = "",
    split: Annotated[
        float, typer.Option(help="Seconds after which a new file begins; 0: never.")
    ] = 0.0,
    stop: Annotated[
        bool, typer.Option("--stop", help="End the recording that runs, whoever started it.")
    ] = False,
    as_json: Annotated[bool, typer.Option("--json", help="Print one JSON object a line.")] = False,
) -> None:
    """Record the running lab into a bag until Ctrl-C.

    The bag is one of rosbag2 (MCAP), complete in itself: robots, meshes, trajectories, scene and
    parameters are in it. Ends with 0 once the bag is closed, 1 when the disk refused.
    """
    from mrlab_msgs import srv

    from mrlab_ros.client.connect import open_graph

    if stop:
        _end(bag, as_json=as_json)
        return
    if bag is not None and (meant := COMMANDS.get(str(bag))) is not None:
        raise WrongUsage(NOT_A_BAG_NAME(bag=str(bag), fixes=(Fix(command=meant),)))
    request = srv.StartRecording.Request(
        bag=str(bag.absolute()) if bag else time.strftime("session_%Y-%m-%d_%H-%M-%S"),
        topics=[topic.strip() for topic in topics.split(",") if topic.strip()],
        split_duration=split,
    )
    with open_graph() as graph:
        begun = ""
        try:
            # First: what happens until then is not recorded.
            begun = _start(graph, request)
            _show(graph, begun, as_json=as_json)
        except KeyboardInterrupt:
            _interrupted(graph, begun, as_json=as_json)


def _start(graph: GraphClient, request: Any) -> str:
    """Start a recording; return its bag, which also tells it from those of others.

    Where a recorder dies before it answers, the one that comes after it is asked again.
    """
    from mrlab_msgs import msg, srv

    from mrlab_ros.ros.calls import NoAnswer

    state = graph.watch(msg.RecorderState, "/recorder/state")
    deadline, asked_before = time.monotonic() + RETURN, False
    while True:
        try:
            return str(graph.order(srv.StartRecording, "/recorder/start", request).bag)
        except NoAnswer:
            if time.monotonic() > deadline:
                raise
            asked_before = True
        except Misuse:
            # The recorder that died had begun it, and the one after it continues it.
            now: Any = state.value
            if not asked_before or not _records(now, request.bag):
                raise
            return str(now.bag)


def _records(state: Any, name: str) -> bool:
    """Return whether the recorder records into a bag of that name."""
    return (
        state is not None
        and state.state == RecorderState.RECORDING.value
        and Path(state.bag).name == Path(name).name
    )


def _show(graph: GraphClient, bag: str, *, as_json: bool) -> None:
    """Show the progress until another client ends it; raise LabError where it failed."""
    from mrlab_msgs import msg

    if as_json:
        print(json.dumps({"bag": bag}), flush=True)
        watch = graph.watch(msg.RecorderState, "/recorder/state")
        _follow(
            watch,
            _print_state,
            lambda said: say(said, as_json=True),
            bag,
            lambda: size_of(bag),
        )
        return
    print(f"records into {bag}; Ctrl-C ends it, or mrlab record --stop", flush=True)

    from rich.live import Live

    console = output.console()
    watch = graph.watch(msg.RecorderState, "/recorder/state")
    with Live(console=console, auto_refresh=False, transient=True) as live:
        _follow(
            watch,
            lambda *states: live.update(_line(*states), refresh=True),
            lambda said: console.print(output.with_fixes(said), soft_wrap=True),
            bag,
            lambda: size_of(bag),
        )


def _interrupted(graph: GraphClient, begun: str, *, as_json: bool) -> None:
    """End the recording at Ctrl-C or SIGTERM; a second one does not wait for that.

    begun: the bag; empty where no recording was begun, as far as is known.
    """
    try:
        said = _stop(graph, begun)
    except KeyboardInterrupt:
        waits = bool(begun) and _leave(graph.domain, begun)
        say((STOP_NOT_AWAITED if waits else STOP_UNKNOWN)(bag=begun), as_json=as_json)
        raise typer.Exit(130) from None
    except LabError:
        if begun:
            raise
        raise typer.Exit(130) from None
    if not begun:
        # It had begun all the same.
        raise typer.Exit(130)
    say(said, as_json=as_json)


def _end(bag: Path | None, *, as_json: bool) -> None:
    """End the recording that runs; raise Misuse where none does."""
    from mrlab_msgs import msg

    from mrlab_ros.client.connect import open_graph

    if bag is not None:
        raise Misuse(STOP_WITH_BAG(bag=str(bag)))
    with open_graph() as graph:
        state = graph.watch(msg.RecorderState, "/recorder/state").wait(lambda _: True, SILENCE)
        if state.state != msg.RecorderState.RECORDING:
            raise Misuse(NO_RECORDING(fixes=(Fix(command="mrlab record"),)))
        said = _stop(graph, state.bag)
    say(said, as_json=as_json, bag=state.bag)


def _follow(
    watch: Watch[Any],
    show: Any,
    say: Callable[[Diagnostic], None],
    bag: str,
    size: Callable[[], int],
) -> None:
    """Show the progress until another client ends the recording; raise LabError where it failed.

    A recorder that was killed and restarted goes on in the same bag: it is waited for. One whose
    bag grows records, whatever is between it and here. say: takes what is said of that;
    size: returns the bytes of the bag.
    """
    last: Any = None
    said: Diagnostic | None = None
    received_at, began, waiting = time.monotonic(), False, False
    grown_at, known = received_at, 0
    looking = (Fix(command=f"mrlab bag info {for_shell([bag])}"),)
    while True:
        state = watch.value
        if state is not None and state is not last:
            gap = time.monotonic() - received_at
            before, last, received_at = last, state, time.monotonic()
            grown_at, known = received_at, 0
            # A message latched before this recording says nothing of it.
            trouble = heard(state) if state.message else None
            if state.state == RecorderState.RECORDING.value and state.bag == bag:
                show(state, before if began else None)
                if trouble is not None and trouble != said:
                    say(RECORDING_CONTINUES(why=trouble, bag=bag))
                elif waiting:
                    say(RECORDER_BACK(bag=bag))
                began, waiting, said = True, False, trouble
            elif began and _was_ended(trouble, gap):
                say(ENDED_BY_ANOTHER(bag=bag, fixes=looking))
                return
            elif began:
                raise LabError(trouble or RECORDING_GONE(bag=bag, fixes=looking))
        silent = time.monotonic() - received_at
        if silent > SILENCE and not began and state is not None and state.message:
            raise LabError(heard(state))
        if silent > SILENCE / 2 and (now := size()) != known:
            # The first look says nothing of growth.
            grown_at, known = time.monotonic() if known else grown_at, now
        if min(silent, time.monotonic() - grown_at) > RETURN:
            raise LabError(RECORDER_SILENT(silent=RETURN, bag=bag, fixes=TO_END))
        if silent > SILENCE and not waiting:
            waiting = True
            if grown_at > received_at:
                say(LAB_SILENT(silent=SILENCE, bag=bag))
            else:
                say(RECORDER_AWAITED(silent=SILENCE))
        time.sleep(REFRESH)


def _was_ended(trouble: Diagnostic | None, gap: float) -> bool:
    """Return whether another client ended a recording. gap: s without a state before that."""
    if trouble is None:
        return gap < SILENCE / 2
    return trouble.code == RECORDING_ENDED_LATE.code


def _print_state(state: Any, _: Any) -> None:
    facts = {"position": state.position, "messages": state.messages, "bytes": state.bytes}
    print(json.dumps(facts), flush=True)


def _line(state: Any, before: Any) -> str:
    rate = ""
    if before is not None and state.position > before.position:
        seconds = state.position - before.position
        rate = f"  {max(state.messages - before.messages, 0) / seconds:.0f} messages/s"
    return f"{state.position:.0f} s  {state.messages} messages  {megabytes(state.bytes)}{rate}"


def _stop(graph: GraphClient, bag: str) -> Diagnostic:
    """End the recording into `bag`; raise LabError where the recorder does not answer.

    The order is then left for whoever is the recorder when it runs. Empty: a recording that may
    have begun. A bag that grows has a recorder that can be asked elsewhere.
    """
    from diagnostic_msgs.msg import DiagnosticArray
    from mrlab_msgs.srv import Trigger

    from mrlab_ros.messages import qos
    from mrlab_ros.messages.status import living_in
    from mrlab_ros.ros.calls import NoAnswer

    signs = Signs(time.monotonic())

    def hear(message: Any) -> None:
        if "recorder" in living_in(message):
            signs.last = time.monotonic()

    graph.subscribe(DiagnosticArray, "/diagnostics", hear, qos.LATCHED)
    before = size_of(bag)

    def ask(find_timeout: float) -> Any:
        request = Trigger.Request()
        return graph.call(Trigger, "/recorder/stop", request, ANSWER_S, find_timeout=find_timeout)

    try:
        said = _said(ask(ANSWER_S))
        if said.code != STOP_LEFT.code:
            return said
        waits = True
    except NoAnswer:
        waits = bool(bag) and _leave(graph.domain, bag)
    silent = time.monotonic() - signs.last
    if silent <= FROZEN_S:
        return _closed(graph, STOP_TIMEOUT_S)
    if size_of(bag) > before:
        return _stop_elsewhere()
    try:
        return _closed(graph, ORDER_S) if waits else _said(ask(RETURN))
    except NoAnswer:
        if waits:
            raise NoAnswer(STOP_WAITS(silent=silent + ORDER_S, bag=bag)) from None
        raise NoAnswer(RECORDER_FROZEN(silent=silent, fixes=TO_END)) from None


def _closed(graph: GraphClient, timeout: float) -> Diagnostic:
    """Wait until no recording runs; raise NoAnswer after `timeout` s, LabError where it failed."""
    from mrlab_msgs import msg

    state = graph.watch(msg.RecorderState, "/recorder/state")
    ended = state.wait(lambda now: now.state != msg.RecorderState.RECORDING, timeout)
    if not ended.message:
        return BAG_CLOSED()
    said = heard(ended)
    if said.code != RECORDING_ENDED_LATE.code:
        raise LabError(said)
    return said


def _leave(domain: int, bag: str) -> bool:
    from mrlab_ros.client.recording import leave_stop

    return leave_stop(domain, bag)


def _stop_elsewhere() -> Diagnostic:
    """End the recording of a recorder that works, through a client that is opened anew."""
    from mrlab_msgs.srv import Trigger

    from mrlab_ros.client.connect import open_graph

    with open_graph() as graph:
        timeout = STOP_TIMEOUT_S
        answer = graph.call(
            Trigger, "/recorder/stop", Trigger.Request(), timeout, find_timeout=RETURN
        )
    return _said(answer)


def _said(answer: Any) -> Diagnostic:
    """Return what the recorder answered; raise Misuse where it refused."""
    said = heard(answer)
    if not answer.success:
        raise Misuse(said)
    return said


def size_of(bag: str) -> int:
    """Return the bytes of a bag's files on this machine; 0: none can be seen."""
    if not bag:
        return 0
    try:
        return sum(file.stat().st_size for file in Path(bag).glob("*.mcap"))
    except OSError:
        return 0


@dataclass
class Signs:
    """When the recorder's process last gave a sign of life, s of the steady clock."""

    last: float


def megabytes(size: int) -> str:
    return f"{size / 1e6:.1f} MB"
