"""`mrlab record`: the session of the running lab into a bag, until Ctrl-C."""

from __future__ import annotations

import json
import time
from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from mrlab_ros.core.errors import LabError, Misuse
from mrlab_ros.core.recording.states import RecorderState

if TYPE_CHECKING:
    from mrlab_ros.ros.graph import GraphClient, Watch

REFRESH = 0.25
# A working recorder publishes its state once a second; without one for this long it has gone, s.
SILENCE = 5.0
# A recorder that died is back by then: the supervisor starts it again, s.
RETURN = 20.0
# A bag of such a name is a command that was meant otherwise.
COMMANDS = {"stop": "mrlab record --stop", "start": "mrlab record"}
# A bag of hours is closed by then, s.
STOP_TIMEOUT_S = 30.0


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
    from mrlab_msgs import msg, srv
    from rich.console import Console
    from rich.live import Live
    from std_srvs.srv import Trigger

    from mrlab_ros.client.connect import open_graph

    if stop:
        _end(bag, as_json=as_json)
        return
    if bag is not None and (meant := COMMANDS.get(str(bag))) is not None:
        raise Misuse(f"'{bag}' is no name for a bag; use {meant}, or the whole path of the bag")
    console = Console(highlight=False)
    request = srv.StartRecording.Request(
        bag=str(bag.absolute()) if bag else "",
        topics=[topic.strip() for topic in topics.split(",") if topic.strip()],
        split_duration=split,
    )
    with open_graph() as graph:
        watch = graph.watch(msg.RecorderState, "/recorder/state")
        begun = False
        try:
            answer = graph.order(srv.StartRecording, "/recorder/start", request)
            begun = True
            if as_json:
                print(json.dumps({"bag": answer.bag}), flush=True)
                _follow(watch, _print_state, _print_message, answer.bag)
                return
            console.print(
                f"records into {answer.bag}; Ctrl-C ends it, or mrlab record --stop",
                soft_wrap=True,
            )
            with Live(console=console, auto_refresh=False, transient=True) as live:
                _follow(
                    watch,
                    lambda *states: live.update(_line(*states), refresh=True),
                    lambda said: console.print(said, soft_wrap=True),
                    answer.bag,
                )
        except KeyboardInterrupt:
            if not begun:
                # It may have begun all the same.
                graph.call(Trigger, "/recorder/stop", Trigger.Request())
                raise typer.Exit(130) from None
            said = _stop(graph)
            if as_json:
                _print_message(said)
            else:
                console.print(said, soft_wrap=True)


def _end(bag: Path | None, *, as_json: bool) -> None:
    """End the recording that runs; raise Misuse where none does."""
    from mrlab_msgs import msg

    from mrlab_ros.client.connect import open_graph

    if bag is not None:
        raise Misuse(f"--stop ends the recording that runs; leave '{bag}' out")
    with open_graph() as graph:
        state = graph.watch(msg.RecorderState, "/recorder/state").wait(
            lambda _: True, SILENCE, "the recorder"
        )
        if state.state != msg.RecorderState.RECORDING:
            raise Misuse("nothing is recorded; mrlab record begins a recording")
        said = _stop(graph)
    print(json.dumps({"bag": state.bag, "message": said}) if as_json else said)


def _follow(watch: Watch[Any], show: Any, say: Callable[[str], None], bag: str) -> None:
    """Show the progress until another client ends the recording; raise LabError where it failed.

    A recorder that was killed and restarted goes on in the same bag: it is waited for. say: takes
    a sentence where that happens.
    """
    last, received_at, began = None, time.monotonic(), False
    waiting, said = False, ""
    while True:
        state = watch.value
        if state is not last:
            gap = time.monotonic() - received_at
            before, last, received_at = last, state, time.monotonic()
            # What is latched from before this recording says nothing of it.
            if state.state == RecorderState.RECORDING.value and state.bag == bag:
                show(state, before if began else None)
                if state.message and state.message != said:
                    say(f"{state.message}; the recording goes on in {bag}")
                elif waiting:
                    say(f"the recorder is back; the recording goes on in {bag}")
                began, waiting, said = True, False, state.message
            elif began and not state.message and gap < SILENCE / 2:
                say(f"another client ended the recording; mrlab bag info {bag} says what it holds")
                return
            elif began:
                raise LabError(
                    state.message
                    or f"the recording into {bag} has ended: the recorder was restarted; "
                    f"mrlab bag info {bag} shows what it holds"
                )
        silent = time.monotonic() - received_at
        if silent > SILENCE and not began and state is not None and state.message:
            raise LabError(state.message)
        if silent > RETURN:
            raise LabError(
                f"the recorder has been silent for {RETURN:g} s; what it wrote into {bag} stays "
                "readable; a restarted recorder goes on in that bag: mrlab record --stop ends it; "
                "mrlab status shows what runs"
            )
        if silent > SILENCE and not waiting:
            waiting = True
            say(f"the recorder has been silent for {SILENCE:g} s; waits for it to be restarted")
        time.sleep(REFRESH)


def _print_message(said: str) -> None:
    print(json.dumps({"message": said}), flush=True)


def _print_state(state: Any, _: Any) -> None:
    facts = {"position": state.position, "messages": state.messages, "bytes": state.bytes}
    print(json.dumps(facts), flush=True)


def _line(state: Any, before: Any) -> str:
    rate = ""
    if before is not None and state.position > before.position:
        seconds = state.position - before.position
        rate = f"  {max(state.messages - before.messages, 0) / seconds:.0f} messages/s"
    return f"{state.position:.0f} s  {state.messages} messages  {megabytes(state.bytes)}{rate}"


def _stop(graph: GraphClient) -> str:
    """End the recording; raise LabError where the recorder does not answer."""
    from std_srvs.srv import Trigger

    from mrlab_ros.ros.calls import NoAnswer

    try:
        answer = graph.call(
            Trigger, "/recorder/stop", Trigger.Request(), STOP_TIMEOUT_S, find_timeout=RETURN
        )
    except NoAnswer as error:
        raise NoAnswer(
            f"{error}; a restarted recorder goes on in its bag: mrlab record --stop ends it"
        ) from None
    if not answer.success:
        raise Misuse(answer.message)
    return str(answer.message)


def megabytes(size: int) -> str:
    return f"{size / 1e6:.1f} MB"
