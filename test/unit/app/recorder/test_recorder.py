"""The recorder without ROS: every event in every state, deaths, and orders that wait."""

from __future__ import annotations

import shutil
import tempfile
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path

import pytest
from fake_streams import FakeJournal, FakeStreams
from hypothesis import HealthCheck, settings
from hypothesis import strategies as st
from hypothesis.stateful import RuleBasedStateMachine, invariant, precondition, rule
from refusals import refused

from mrlab_ros.adapters.bags.diagnostics import BAG_EXISTS
from mrlab_ros.adapters.bags.reader import Bag
from mrlab_ros.adapters.stop_orders import StopOrders
from mrlab_ros.app.diagnostics import (
    RECORDED,
    RECORDING_ENDED_LATE,
    RECORDING_LOST,
    RECORDING_WITH_GAP,
)
from mrlab_ros.app.recorder.ports import Settings
from mrlab_ros.app.recorder.recorder import Recorder
from mrlab_ros.core.base.diagnostic import Diagnostic
from mrlab_ros.core.base.errors import BadInput, IllegalEvent, LabError
from mrlab_ros.core.recording.diagnostics import NO_RECORDING, RECORDING_GAP
from mrlab_ros.core.recording.recorder import TABLE, RecorderEvent, RecorderState

FAULT: Diagnostic = NO_RECORDING()
S, E = RecorderState, RecorderEvent


class Lab:
    """A recorder that dies and is started again; its folder and journal stay."""

    def __init__(self, folder: Path, lab: str = "lab") -> None:
        self.folder, self.lab = folder, lab
        self.journal = FakeJournal()
        self.orders = StopOrders(str(folder))
        self.log: list[Diagnostic] = []
        self.start_process()

    def start_process(self) -> None:
        self.streams = FakeStreams()
        self.recorder = Recorder(
            self.streams,
            self.journal,
            self.orders,
            lambda: Settings(self.folder / "bags", ("/counted",), 0),
            self.log.append,
            self.lab,
        )
        self.recorder.recover()

    def kill(self) -> None:
        """End the recorder as SIGKILL does, and start it again."""
        if self.recorder.status.state is S.RECORDING:
            self.streams.recording.die()
        self.start_process()

    def terminate(self) -> None:
        """End the recorder as SIGTERM does, and start it again."""
        self.recorder.close()
        self.start_process()

    @property
    def state(self) -> RecorderState:
        return self.recorder.status.state

    def record(self, name: str = "class") -> None:
        self.recorder.start(name, (), 0.0)

    def replay(self) -> None:
        self.recorder.replay("other", 1.0, 0.0, False)

    def fail(self) -> None:
        """Let what runs end by itself."""
        if self.streams.recording is not None:
            self.streams.recording.fail(FAULT)
        elif self.streams.running is not None:
            self.streams.running.on_end(FAULT)

    def end(self) -> None:
        if self.streams.running is not None:
            self.streams.running.on_end(None)


@pytest.fixture
def lab(tmp_path: Path) -> Lab:
    return Lab(tmp_path)


ENTER: dict[RecorderState, Callable[[Lab], None]] = {
    S.STOPPED: lambda lab: None,
    S.RECORDING: Lab.record,
    S.REPLAYING: Lab.replay,
    S.PAUSED: lambda lab: (lab.replay(), lab.recorder.pause()),
}
DO: dict[RecorderEvent, Callable[[Lab], object]] = {
    E.START: lambda lab: lab.record("next"),
    E.SPLIT: lambda lab: lab.recorder.split(),
    E.REPLAY: Lab.replay,
    E.PAUSE: lambda lab: lab.recorder.pause(),
    E.RESUME: lambda lab: lab.recorder.resume(),
    E.SEEK: lambda lab: lab.recorder.seek(1.0),
    E.SET_RATE: lambda lab: lab.recorder.set_rate(2.0),
    E.SET_LOOP: lambda lab: lab.recorder.set_loop(True),
    E.STOP: lambda lab: lab.recorder.stop(),
    E.END: Lab.end,
    E.FAIL: Lab.fail,
    E.CLOSE: lambda lab: lab.recorder.close(),
}
# No replay runs that could end, no recording that could fail.
IMPOSSIBLE = {(S.RECORDING, E.END)}


@pytest.mark.parametrize("event", DO, ids=lambda event: event.name)
@pytest.mark.parametrize("state", ENTER, ids=lambda state: state.name)
def test_every_event_in_every_state_is_what_the_table_says(lab, state, event):
    ENTER[state](lab)
    before = lab.recorder.status
    wanted = TABLE.rows.get((state, event))
    if wanted is None and (state, event) not in IMPOSSIBLE:
        with pytest.raises(IllegalEvent):
            DO[event](lab)
        assert lab.recorder.status == before
    else:
        DO[event](lab)
        # A replay that was prepared begins at once.
        wanted = S.REPLAYING if wanted is S.PREPARING else wanted
        assert lab.state is (wanted or state)


@pytest.mark.parametrize("event", DO, ids=lambda event: event.name)
def test_every_event_while_a_replay_is_prepared_is_what_the_table_says(lab, event):
    found: list[RecorderState] = []

    def do() -> None:
        assert lab.state is S.PREPARING
        if event is E.FAIL:
            raise LabError(FAULT)
        try:
            DO[event](lab)
        finally:
            found.append(lab.state)

    lab.streams.preparing = do
    wanted = TABLE.rows.get((S.PREPARING, event))
    if event is E.END:
        return  # a replay that is prepared does not run
    with pytest.raises(LabError):
        lab.replay()
    assert found in ([wanted or S.PREPARING], [])
    assert lab.state is S.STOPPED
    assert lab.streams.running.calls[-1] == "close"


def test_a_replay_begins_once_it_is_prepared(lab):
    lab.replay()
    assert [status.state for status in lab.streams.published][-2:] == [S.PREPARING, S.REPLAYING]
    assert lab.streams.running.calls == ["start"]


def test_a_recording_that_is_stopped_says_what_it_holds(lab):
    lab.record()
    lab.streams.recording.receive()
    said = lab.recorder.stop()
    assert (said.code, said.values["messages"]) == (RECORDED.code, 1)
    lab.kill()
    assert (lab.state, lab.recorder.lost) == (S.STOPPED, [])


def test_a_start_that_is_refused_leaves_nothing_to_continue(lab):
    (lab.folder / "bags" / "class").mkdir(parents=True)
    (lab.folder / "bags" / "class" / "notes.txt").write_text("words")
    with refused(BAG_EXISTS, BadInput):
        lab.record()
    lab.kill()
    assert (lab.state, lab.recorder.lost) == (S.STOPPED, [])


@pytest.mark.parametrize("end", [Lab.kill, Lab.terminate])
def test_a_recording_continues_whichever_signal_ended_its_recorder(lab, end):
    lab.record()
    lab.streams.recording.receive()
    end(lab)
    status = lab.recorder.status
    assert (status.state, status.trouble.code) == (S.RECORDING, RECORDING_GAP.code)
    assert [lost.code for lost in lab.recorder.lost] == [RECORDING_WITH_GAP.code]
    lab.streams.recording.receive()
    assert lab.recorder.stop().values["messages"] == 2
    assert len(Bag(lab.folder / "bags" / "class").gaps()) == 1


def test_a_recording_ends_with_its_lab_but_continues_where_all_of_it_was_killed(lab):
    lab.record()
    lab.recorder.close()
    lab.lab = "another"
    lab.start_process()
    assert (lab.state, lab.recorder.lost, lab.journal.content) == (S.STOPPED, [], {})
    lab.record("next")
    lab.streams.recording.die()
    lab.lab = "a third"
    lab.start_process()
    assert lab.state is S.RECORDING


@pytest.mark.parametrize("end", [Lab.kill, Lab.terminate])
@pytest.mark.parametrize("named", [True, False])
def test_a_stop_that_was_left_for_a_dead_recorder_is_carried_out(lab, end, named):
    lab.record()
    lab.streams.recording.receive()
    assert lab.orders.leave(str(lab.folder / "bags" / "class") if named else "")
    end(lab)
    assert (lab.state, lab.orders.waiting()) == (S.STOPPED, [])
    status = lab.recorder.status
    assert (status.trouble.code, status.trouble.values["messages"]) == (
        RECORDING_ENDED_LATE.code,
        1,
    )
    assert lab.recorder.lost == [status.trouble]
    assert lab.streams.published[-1] == status
    lab.kill()
    assert (lab.state, lab.recorder.lost) == (S.STOPPED, [])


def test_a_stop_that_was_left_for_a_frozen_recorder_is_carried_out_once(lab):
    lab.record()
    lab.orders.leave(str(lab.folder / "bags" / "class"))
    lab.recorder.carry_out_orders()
    assert (lab.state, lab.orders.waiting()) == (S.STOPPED, [])
    lab.record("next")
    lab.recorder.carry_out_orders()
    assert lab.state is S.RECORDING


def test_a_stop_of_another_recording_ends_nothing(lab):
    lab.record()
    lab.orders.leave("/bags/another")
    lab.kill()
    assert (lab.state, lab.orders.waiting()) == (S.RECORDING, [])


def test_a_recording_whose_bag_is_gone_is_lost_and_named(lab):
    lab.record()
    lab.streams.recording.die()
    shutil.rmtree(lab.folder / "bags" / "class")
    lab.start_process()
    assert (lab.state, lab.journal.content) == (S.STOPPED, {})
    assert [lost.code for lost in lab.recorder.lost] == [RECORDING_LOST.code]


def test_new_topics_are_looked_for_while_a_recording_runs(lab):
    lab.recorder.discover()
    lab.record()
    lab.recorder.discover()
    assert lab.streams.recording.discoveries == 1


# random walks ---------------------------------------------------------------------------------


@contextmanager
def expected(model: Walk, event: RecorderEvent) -> Iterator[None]:
    """Do what the table says of `event` in the model's state, or see it refused."""
    target = TABLE.rows.get((model.state, event))
    if target is None:
        with pytest.raises(IllegalEvent):
            yield
        return
    yield
    model.state = target


class Walk(RuleBasedStateMachine):
    """Commands, ends, deaths and orders in any order, compared with the table and a count."""

    def __init__(self) -> None:
        super().__init__()
        self.folder = Path(tempfile.mkdtemp())
        self.lab = Lab(self.folder)
        self.state = S.STOPPED
        self.names = 0
        # Messages of the recording that runs, and of the ones that have ended by their bag.
        self.received = 0
        self.ended: dict[Path, int] = {}
        self.asked = False

    def teardown(self) -> None:
        if self.state is S.RECORDING:
            self.lab.streams.recording.die()
        shutil.rmtree(self.folder)

    @property
    def bag(self) -> Path:
        return self.folder / "bags" / f"bag{self.names}"

    def _over(self) -> None:
        """Note the end of what runs."""
        if self.state is S.RECORDING:
            self.ended[self.bag] = self.received
        self.asked = False

    @rule(event=st.sampled_from([E.SPLIT, E.PAUSE, E.RESUME, E.SEEK, E.SET_RATE, E.SET_LOOP]))
    def command(self, event: RecorderEvent) -> None:
        with expected(self, event):
            DO[event](self.lab)

    @rule()
    def record(self) -> None:
        if self.state is S.STOPPED:
            self.names, self.received = self.names + 1, 0
        with expected(self, E.START):
            self.lab.record(f"bag{self.names}")

    @rule()
    def replay(self) -> None:
        with expected(self, E.REPLAY):
            self.lab.replay()
        if self.state is S.PREPARING:
            self.state = S.REPLAYING

    @rule(event=st.sampled_from([E.STOP, E.END, E.FAIL]))
    def end(self, event: RecorderEvent) -> None:
        if (self.state, event) in IMPOSSIBLE or (event is not E.STOP and self.state is S.STOPPED):
            return
        if self.state is S.RECORDING:
            self._over()
        with expected(self, event):
            DO[event](self.lab)

    @precondition(lambda self: self.state is S.RECORDING)
    @rule()
    def receive(self) -> None:
        self.lab.streams.recording.receive()
        self.received += 1

    @precondition(lambda self: self.state is S.RECORDING)
    @rule()
    def leave_a_stop(self) -> None:
        self.asked = self.lab.orders.leave(str(self.bag))

    @precondition(lambda self: self.names > 1)
    @rule()
    def leave_a_stop_of_an_earlier_recording(self) -> None:
        self.lab.orders.leave(str(self.folder / "bags" / f"bag{self.names - 1}"))

    @rule()
    def carry_out(self) -> None:
        asked = self.asked
        if asked:
            self._over()
            self.state = S.STOPPED
        self.lab.recorder.carry_out_orders()

    @rule(killed=st.booleans())
    def die(self, killed: bool) -> None:
        recorded, asked = self.state is S.RECORDING, self.asked
        if asked or not recorded:
            self._over()
        self.lab.kill() if killed else self.lab.terminate()
        self.state = S.RECORDING if recorded and not asked else S.STOPPED

    @invariant()
    def the_state_is_that_of_the_table(self) -> None:
        status = self.lab.recorder.status
        assert status.state is self.state
        if self.state is S.RECORDING:
            assert (status.bag, status.messages) == (str(self.bag), self.received)
        assert bool(self.lab.journal.content) is (self.state is S.RECORDING)

    @invariant()
    def no_message_is_lost(self) -> None:
        for bag, messages in list(self.ended.items()):
            assert Bag(bag).message_count == messages
            del self.ended[bag]


TestWalk = Walk.TestCase
TestWalk.settings = settings(
    max_examples=200,
    stateful_step_count=30,
    deadline=None,
    suppress_health_check=list(HealthCheck),
)
