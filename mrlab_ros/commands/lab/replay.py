"""`mrlab replay`: a recorded session in the running lab's graph, with keys to walk about in it."""

from __future__ import annotations

import json
import os
import re
import select
import sys
import termios
import time
import tty
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from mrlab_ros.commands import output
from mrlab_ros.commands.diagnostics import RECORDER_SILENT, ROBOT_WITHOUT_PATH
from mrlab_ros.commands.lab.record import SILENCE
from mrlab_ros.commands.output import say
from mrlab_ros.core.base.diagnostic import Fix, heard
from mrlab_ros.core.base.errors import LabError, Misuse, WrongUsage
from mrlab_ros.core.recording.diagnostics import REPLAY_OVER
from mrlab_ros.core.recording.recorder import RecorderState
from mrlab_ros.messages.time import time_from_message

if TYPE_CHECKING:
    from mrlab_ros.ros.graph import GraphClient, Watch

REFRESH = 0.1
# Keys typed faster than they are served come at once: an arrow is three bytes.
KEY = re.compile(rb"\x1b[\[O][A-Z]|[^\x1b]")
LEFT, RIGHT = b"D", b"C"
# Seek of an arrow key, s, and the rates that + and - go through.
STEP = 5.0
RATES = (0.1, 0.2, 0.5, 1.0, 2.0, 4.0, 10.0)
KEYS = "space pauses, left and right seek 5 s, n and p go to stops, + and - set the rate, q ends"
STOPS = {b"n": "next_stop", b"p": "previous_stop"}
# The lab's own nodes leave first.
BEGIN_TIMEOUT_S = 40.0
BEGUN_TIMEOUT_S = 3.0
STOP_TIMEOUT_S = 15.0


def replay(
    bag: Annotated[str, typer.Argument(help="Folder of a bag, or its name among the recorder's.")],
    rate: Annotated[float, typer.Option(help="Speed, 0.1 to 10; 1 is as recorded.")] = 1.0,
    start: Annotated[float, typer.Option(help="Where to begin, s into the bag.")] = 0.0,
    loop: Annotated[bool, typer.Option("--loop", help="Begin again at the end.")] = False,
    robots: Annotated[
        list[str] | None,
        typer.Option(
            "--robot",
            help="Model that the joint states of a foreign bag move, such as ur5e; repeatable.",
        ),
    ] = None,
    as_json: Annotated[
        bool, typer.Option("--json", help="Print one JSON object a line, and take no keys.")
    ] = False,
) -> None:
    """Replay a bag in the running lab: headset, RViz and Foxglove see the session again.

    The lab's own robots stand aside meanwhile, and come back afterwards. Keys, on a terminal:
    space pauses, arrows seek, n and p go to the next and the previous event, + and - set the
    rate, q ends. Ends with 0 at the bag's end.
    """
    path = Path(bag).expanduser()
    if path.exists():
        from mrlab_ros.commands.foreign import imported_for_now, is_foreign

        if robots or is_foreign(path):
            with imported_for_now(path, robots or []) as found:
                say(
                    found.said(path.name),
                    as_json=as_json,
                    robots=found.robots,
                    skipped=found.skipped,
                )
                _replay(str(found.folder), rate, start, loop, as_json=as_json)
            return
    elif robots:
        raise WrongUsage(ROBOT_WITHOUT_PATH(path=str(path)))
    _replay(str(path.absolute()) if path.exists() else bag, rate, start, loop, as_json=as_json)


def _replay(bag: str, rate: float, start: float, loop: bool, *, as_json: bool) -> None:
    from mrlab_msgs import msg, srv
    from rich.live import Live

    from mrlab_ros.client.connect import open_graph

    console = output.console()
    request = srv.Replay.Request(bag=bag, rate=rate, start=start, loop=loop)
    with open_graph() as graph:
        watch = graph.watch(msg.RecorderState, "/recorder/state")
        try:
            answer = graph.order(srv.Replay, "/recorder/replay", request, BEGIN_TIMEOUT_S)
            if as_json:
                say(heard(answer), as_json=True, bag=bag)
                _follow(watch, None, _print_states())
                say(REPLAY_OVER(), as_json=True)
                return
            console.print(str(heard(answer)), soft_wrap=True)
            keyboard = Keyboard(graph, watch) if sys.stdin.isatty() else None
            if keyboard is not None:
                console.print(KEYS)
            with (
                raw_keys(keyboard is not None),
                Live(console=console, auto_refresh=False, transient=True) as live,
            ):
                _follow(
                    watch,
                    keyboard,
                    lambda state: live.update(_line(state, keyboard), refresh=True),
                )
        except KeyboardInterrupt:
            # The recorder answers a stop once the replay has begun.
            _end(graph, BEGIN_TIMEOUT_S)
            raise typer.Exit(130) from None
    console.print(str(REPLAY_OVER()))


def _print_states() -> Callable[[Any], None]:
    """Return what prints each state that it has not seen as a line of JSON."""
    shown: list[Any] = [None]

    def show(state: Any) -> None:
        if state is not shown[0]:
            shown[0] = state
            facts = {"position": state.position, "duration": state.duration, "rate": state.rate}
            paused = state.state == RecorderState.PAUSED.value
            print(json.dumps({**facts, "paused": paused}), flush=True)

    return show


def _follow(watch: Watch[Any], keyboard: Keyboard | None, show: Callable[[Any], None]) -> None:
    from mrlab_msgs import msg

    from mrlab_ros.ros.calls import NoAnswer

    working = (msg.RecorderState.REPLAYING, msg.RecorderState.PAUSED)
    # A short one may be over already; what is latched from before says nothing of it.
    with suppress(NoAnswer):
        watch.wait(lambda s: s.state in working, BEGUN_TIMEOUT_S)
    last, received_at = None, time.monotonic()
    while (state := watch.value) is not None and state.state in working:
        if state is not last:
            last, received_at = state, time.monotonic()
        elif time.monotonic() - received_at > SILENCE:
            raise LabError(RECORDER_SILENT(silent=SILENCE, fixes=(Fix(command="mrlab status"),)))
        show(state)
        if keyboard is None:
            time.sleep(REFRESH)
        else:
            keyboard.serve(state)
    if state is not None and state.message:
        raise LabError(heard(state))


def _line(state: Any, keyboard: Keyboard | None) -> str:
    from mrlab_msgs import msg

    position = position_now(state)
    what = "paused" if state.state == msg.RecorderState.PAUSED else f"x {state.rate:g}"
    words = f"{position:.1f} of {state.duration:.1f} s  {what}  {state.messages} messages"
    if keyboard is not None:
        words += f"  {keyboard.said or heard(state)}"
    return words


def position_now(state: Any) -> float:
    """Return where the replay is by now: its state comes once a second."""
    from mrlab_msgs import msg

    if state.state != msg.RecorderState.REPLAYING:
        return float(state.position)
    age = max(time.time() - time_from_message(state.header.stamp) / 1e9, 0.0)
    return float(min(state.position + state.rate * age, state.duration))


class Keyboard:
    """Actions of the keys."""

    def __init__(self, graph: GraphClient, watch: Watch[Any]) -> None:
        self._graph = graph
        self._watch = watch
        self.said = ""

    def serve(self, state: Any) -> None:
        """Wait a moment for a key and do what it says."""
        if not select.select([sys.stdin], [], [], REFRESH)[0]:
            return
        # Python's own buffer would hold the bytes of an arrow apart.
        typed = os.read(sys.stdin.fileno(), 64)
        try:
            self.press(typed, state)
            self.said = ""
        except Misuse as error:
            self.said = str(error)

    def press(self, typed: bytes, state: Any) -> None:
        """Do what the keys say; raise Misuse where the recorder refuses."""
        from mrlab_msgs import msg, srv

        keys = KEY.findall(typed)
        arrows = [key[-1:] for key in keys if len(key) > 1]
        # One seek for all of them: where the replay is comes once a second.
        if steps := arrows.count(RIGHT) - arrows.count(LEFT):
            place = min(max(position_now(state) + steps * STEP, 0.0), state.duration)
            self._graph.order(srv.Seek, "/recorder/seek", srv.Seek.Request(position=place))
        for key in keys:
            if key == b" ":
                paused = state.state == msg.RecorderState.PAUSED
                self._trigger("resume" if paused else "pause")
            elif key in (b"+", b"-"):
                request = srv.SetRate.Request(rate=next_rate(state.rate, key == b"+"))
                self._graph.order(srv.SetRate, "/recorder/set_rate", request)
            elif key in STOPS:
                self._trigger(STOPS[key])
            elif key in (b"q", b"Q"):
                _end(self._graph)

    def _trigger(self, service: str) -> None:
        from mrlab_msgs.srv import Trigger

        self._graph.order(Trigger, f"/recorder/{service}", Trigger.Request())


def next_rate(rate: float, faster: bool) -> float:
    """Return the next of RATES above or below `rate`; the last one stays."""
    if faster:
        return next((r for r in RATES if r > rate), RATES[-1])
    return next((r for r in reversed(RATES) if r < rate), RATES[0])


def _end(graph: GraphClient, timeout: float = STOP_TIMEOUT_S) -> None:
    from mrlab_msgs.srv import Trigger

    graph.call(Trigger, "/recorder/stop", Trigger.Request(), timeout)


@contextmanager
def raw_keys(wanted: bool) -> Iterator[None]:
    """Let keys come at once and unseen; the terminal is as before afterwards."""
    if not wanted:
        yield
        return
    before = termios.tcgetattr(sys.stdin)
    tty.setcbreak(sys.stdin)
    try:
        yield
    finally:
        termios.tcsetattr(sys.stdin, termios.TCSADRAIN, before)
