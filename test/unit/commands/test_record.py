"""What a person may mean by a word after `mrlab record`, and how the command follows."""

from __future__ import annotations

from contextlib import suppress
from pathlib import Path
from types import SimpleNamespace

import pytest

from mrlab_ros.commands import record as command
from mrlab_ros.commands.record import record
from mrlab_ros.core.errors import LabError, Misuse
from mrlab_ros.core.recording.states import RecorderState


@pytest.mark.parametrize(
    ("word", "meant"), [("stop", "use mrlab record --stop"), ("start", "use mrlab record,")]
)
def test_a_command_is_no_bag(word, meant):
    with pytest.raises(Misuse, match=meant):
        record(Path(word))


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


def state(which: RecorderState, message: str = "") -> SimpleNamespace:
    return SimpleNamespace(state=which.value, bag=BAG, message=message)


def follow(recorder: Recorder) -> list[str]:
    said: list[str] = []
    with suppress(KeyboardInterrupt):
        command._follow(recorder, lambda *_: None, said.append, BAG)
    return said


def recording(*messages: str, until: float = 101.0, since: float = 0.0) -> dict:
    return {
        since + k: state(RecorderState.RECORDING, *messages) for k in range(int(until - since))
    }


def test_a_recorder_that_returns_after_seven_seconds_is_followed_again(monkeypatch):
    gap = "the recorder was restarted: 6.4 s are missing"
    states = recording(until=4.0) | recording(gap, since=10.0)
    assert follow(Recorder(monkeypatch, states)) == [
        "the recorder has been silent for 5 s; waits for it to be restarted",
        f"{gap}; the recording goes on in {BAG}",
    ]


def test_a_recorder_that_does_not_return_is_given_up_with_the_way_to_end_it(monkeypatch):
    recorder = Recorder(monkeypatch, recording(until=4.0))
    with pytest.raises(LabError, match=r"silent for 20 s.*goes on in that bag: .*record --stop"):
        follow(recorder)
    assert 23.0 < recorder.now < 25.0


def test_a_recorder_that_returns_without_the_recording_ends_the_command(monkeypatch):
    states = recording(until=4.0) | {8.0: state(RecorderState.STOPPED)}
    with pytest.raises(LabError, match="the recorder was restarted; mrlab bag info"):
        follow(Recorder(monkeypatch, states))


def test_a_recording_that_another_client_ends_has_ended_well(monkeypatch):
    states = recording(until=4.0) | {4.0: state(RecorderState.STOPPED)}
    assert follow(Recorder(monkeypatch, states)) == [
        f"another client ended the recording; mrlab bag info {BAG} says what it holds"
    ]
