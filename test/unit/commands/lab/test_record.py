"""What a person may mean by a word after `mrlab record`, and how the command follows."""

from __future__ import annotations

import json
from collections.abc import Callable
from contextlib import suppress
from pathlib import Path
from types import SimpleNamespace

import pytest
import typer
from refusals import refused

from mrlab_ros.adapters.stop_orders import StopOrders
from mrlab_ros.app.diagnostics import RECORDING_ENDED_LATE
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
)
from mrlab_ros.commands.lab import record as command
from mrlab_ros.commands.lab.record import record
from mrlab_ros.core.base.diagnostic import Diagnostic
from mrlab_ros.core.base.errors import LabError, Misuse
from mrlab_ros.core.recording.diagnostics import RECORDING_GAP, RECORDING_RUNS
from mrlab_ros.core.recording.recorder import RecorderState
from mrlab_ros.core.runtime.watch import Sign
from mrlab_ros.messages.status import signs_to_message
from mrlab_ros.processes import run_file
from mrlab_ros.ros.calls import NoAnswer
from mrlab_ros.ros.graph import Watch


@pytest.mark.parametrize(
    ("word", "meant"), [("stop", "mrlab record --stop"), ("start", "mrlab record")]
)
def test_a_command_is_no_bag(word, meant):
    with refused(NOT_A_BAG_NAME, Misuse, bag=word) as caught:
        record(Path(word))
    assert [fix.command for fix in caught.value.diagnostic.fixes] == [meant]


BAG = "/bags/class"


class Recorder:
    """What the recorder publishes, by the second; time goes on while the command sleeps."""

    def __init__(self, monkeypatch: pytest.MonkeyPatch, states: dict[float, SimpleNamespace]):
        self.now, self.states = 0.0, states
        monkeypatch.setattr(
            command, "time", SimpleNamespace(monotonic=lambda: self.now, sleep=self.sleep)
        )

    def sleep(self, seconds: float) -> None:
        self.now += seconds
        if self.now > 100.0:
            raise KeyboardInterrupt

    @property
    def value(self) -> SimpleNamespace | None:
        return next((s for at, s in reversed(self.states.items()) if at <= self.now), None)


def state(which: RecorderState, said: Diagnostic | None = None) -> SimpleNamespace:
    code = "" if said is None else said.code
    return SimpleNamespace(
        state=which.value, bag=BAG, message=str(said or ""), code=code, values=[]
    )


def follow(recorder: Recorder, until: float = 0.0) -> list[Diagnostic]:
    """Follow a recording. until: s, when its bag ceases to grow."""
    said: list[Diagnostic] = []
    with suppress(KeyboardInterrupt):
        command._follow(
            recorder,
            lambda *_: None,
            said.append,
            BAG,
            lambda: 1000 + int(100 * min(recorder.now, until)),
        )
    return said


def recording(*said: Diagnostic, until: float = 101.0, since: float = 0.0) -> dict:
    return {since + k: state(RecorderState.RECORDING, *said) for k in range(int(until - since))}


def test_a_recorder_that_returns_after_seven_seconds_is_followed_again(monkeypatch):
    gap = RECORDING_GAP(time=4.0, missing=6.4)
    states = recording(until=4.0) | recording(gap, since=10.0)
    awaited, back = follow(Recorder(monkeypatch, states))
    assert awaited == RECORDER_AWAITED(silent=5.0)
    assert (back.code, back.values["why"].code) == (RECORDING_CONTINUES.code, gap.code)


def test_a_recorder_that_does_not_return_is_given_up_with_the_way_to_end_it(monkeypatch):
    recorder = Recorder(monkeypatch, recording(until=4.0))
    with refused(RECORDER_SILENT, LabError, silent=20.0, bag=BAG) as caught:
        follow(recorder)
    assert caught.value.diagnostic.fixes == command.TO_END
    assert 23.0 < recorder.now < 25.0


def test_a_recording_whose_bag_grows_is_watched_on_also_where_the_bridge_is_frozen(monkeypatch):
    states = recording(until=4.0) | recording(since=60.0)
    assert follow(Recorder(monkeypatch, states), until=60.0) == [
        LAB_SILENT(silent=5.0, bag=BAG),
        RECORDER_BACK(bag=BAG),
    ]
    recorder = Recorder(monkeypatch, recording(until=4.0))
    with refused(RECORDER_SILENT, LabError, silent=20.0):
        follow(recorder, until=30.0)
    assert 49.0 < recorder.now < 51.0


def test_a_recorder_that_returns_without_the_recording_ends_the_command(monkeypatch):
    states = recording(until=4.0) | {8.0: state(RecorderState.STOPPED)}
    with refused(RECORDING_GONE, LabError, bag=BAG):
        follow(Recorder(monkeypatch, states))


def test_a_recording_that_another_client_ends_has_ended_well(monkeypatch):
    states = recording(until=4.0) | {4.0: state(RecorderState.STOPPED)}
    (ended,) = follow(Recorder(monkeypatch, states))
    assert (ended.code, ended.fixes[0].command) == (ENDED_BY_ANOTHER.code, f"mrlab bag info {BAG}")


def test_a_recording_that_was_ended_while_its_recorder_was_dead_has_ended_well(monkeypatch):
    late = RECORDING_ENDED_LATE(folder=BAG, messages=7)
    states = recording(until=4.0) | {10.0: state(RecorderState.STOPPED, late)}
    said = follow(Recorder(monkeypatch, states))
    assert [each.code for each in said] == [RECORDER_AWAITED.code, ENDED_BY_ANOTHER.code]


class Lab:
    """A graph whose recorder does not answer in time.

    living: whether it gives signs of life; state_dir: of the lab; empty: no order can be left.
    """

    domain = 7

    def __init__(
        self, monkeypatch: pytest.MonkeyPatch, *, living: bool = False, state_dir: str = ""
    ):
        self.now, self.living, self.calls = 0.0, living, 0
        self.interrupted = 0
        self.ended: Watch[SimpleNamespace] = Watch("/recorder/state")
        monkeypatch.setattr(command, "time", SimpleNamespace(monotonic=lambda: self.now))
        monkeypatch.setattr(command, "size_of", self.size_of)
        monkeypatch.setattr(command, "ORDER_S", 0.1)
        monkeypatch.setattr(run_file.RunFile, "read", lambda _: {"state_dir": state_dir})
        self.grows = False

    def size_of(self, bag: str) -> int:
        return int(self.now * 1000) if self.grows else 1000

    def subscribe(self, kind: object, topic: str, callback: Callable, quality: object) -> None:
        self.hear = callback

    def call(self, *_: object, find_timeout: float) -> None:
        self.calls += 1
        if self.interrupted:
            raise KeyboardInterrupt
        self.now += command.ANSWER_S
        if self.living:
            self.hear(signs_to_message(0, Sign("recorder"), 1.0, {}))
        else:
            self.hear(signs_to_message(0, Sign("physics"), 1.0, {"recorder": 3.0}))
        raise NoAnswer("Timeout")

    def watch(self, kind: object, topic: str) -> Watch[SimpleNamespace]:
        return self.ended


def waiting(folder: Path) -> list[str]:
    return [order.bag for order in StopOrders(str(folder)).waiting()]


def test_a_stop_waits_for_a_recorder_that_does_not_run(monkeypatch, tmp_path):
    lab = Lab(monkeypatch, state_dir=str(tmp_path))
    with refused(STOP_WAITS, NoAnswer, bag=BAG):
        command._stop(lab, BAG)
    assert (lab.calls, lab.now < 5.0, waiting(tmp_path)) == (1, True, [BAG])


@pytest.mark.parametrize("living", [True, False])
def test_a_stop_that_the_recorder_carried_out_later_is_a_success(monkeypatch, tmp_path, living):
    lab = Lab(monkeypatch, state_dir=str(tmp_path), living=living)
    late = RECORDING_ENDED_LATE(folder=BAG, messages=7)
    lab.ended.set(state(RecorderState.STOPPED, late))
    assert command._stop(lab, BAG).code == late.code


def test_a_recording_that_failed_before_its_stop_says_why(monkeypatch, tmp_path):
    lab = Lab(monkeypatch, state_dir=str(tmp_path))
    lab.ended.set(state(RecorderState.STOPPED, RECORDING_GAP(time=4.0, missing=6.4)))
    with pytest.raises(LabError) as error:
        command._stop(lab, BAG)
    assert error.value.diagnostic.code == RECORDING_GAP.code


def test_a_frozen_recorder_without_a_folder_is_given_up_with_both_ends(monkeypatch):
    lab = Lab(monkeypatch)
    with refused(RECORDER_FROZEN, NoAnswer):
        command._stop(lab, BAG)
    assert lab.calls == 2


def test_a_recorder_behind_a_frozen_bridge_is_asked_elsewhere(monkeypatch):
    lab = Lab(monkeypatch)
    lab.grows = True
    monkeypatch.setattr(command, "_stop_elsewhere", lambda: "elsewhere")
    assert command._stop(lab, BAG) == "elsewhere"


def test_a_recorder_that_lives_may_take_its_time_to_close_a_bag(monkeypatch):
    lab = Lab(monkeypatch, living=True)
    lab.ended.set(state(RecorderState.STOPPED))
    assert command._stop(lab, BAG) == BAG_CLOSED()
    assert lab.calls == 1


@pytest.mark.parametrize("kept", [True, False])
def test_a_second_interrupt_waits_for_nothing(monkeypatch, capsys, tmp_path, kept):
    lab = Lab(monkeypatch, state_dir=str(tmp_path) if kept else "")
    lab.interrupted = True
    with pytest.raises(typer.Exit) as ended:
        command._interrupted(lab, BAG, as_json=True)
    assert ended.value.exit_code == 130
    said = json.loads(capsys.readouterr().out)
    assert said["code"] == (STOP_NOT_AWAITED if kept else STOP_UNKNOWN).code
    assert waiting(tmp_path) == ([BAG] if kept else [])


class Starting:
    """A graph whose first recorder dies before it answers a start."""

    def __init__(self, *answers: object):
        self.answers = list(answers)
        self.state: Watch[SimpleNamespace] = Watch("/recorder/state")

    def watch(self, kind: object, topic: str) -> Watch[SimpleNamespace]:
        return self.state

    def order(self, *_: object) -> SimpleNamespace:
        answer = self.answers.pop(0)
        if isinstance(answer, Exception):
            raise answer
        return answer


def test_a_start_is_asked_of_the_recorder_that_comes_after_a_dead_one():
    lab = Starting(NoAnswer("Timeout"), SimpleNamespace(bag=BAG))
    assert command._start(lab, SimpleNamespace(bag="class")) == BAG


def test_a_start_that_a_dead_recorder_began_is_followed_and_that_of_another_refused():
    runs = Misuse(RECORDING_RUNS(bag=BAG))
    lab = Starting(NoAnswer("Timeout"), runs)
    lab.state.set(state(RecorderState.RECORDING))
    assert command._start(lab, SimpleNamespace(bag="class")) == BAG
    for lab in (Starting(runs), Starting(NoAnswer("Timeout"), runs)):
        lab.state.set(state(RecorderState.RECORDING))
        with refused(RECORDING_RUNS, Misuse):
            command._start(lab, SimpleNamespace(bag="mine"))
