"""Records the lab into a bag, or replays one: the commands, and the ends that nobody asked for."""

from __future__ import annotations

import threading
import time
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

from mrlab_ros.adapters.bags.reader import Bag, bags_in, list_in, remove_empty
from mrlab_ros.adapters.bags.writer import write_metadata
from mrlab_ros.adapters.stop_orders import StopOrders
from mrlab_ros.app.diagnostics import (
    RECORDED,
    RECORDER_RESTARTED,
    RECORDING_ENDED_LATE,
    RECORDING_LOST,
    RECORDING_SPLIT,
    RECORDING_WITH_GAP,
    RECORDS,
    REPLAY_AT,
    REPLAY_LOOPS,
    REPLAY_ONCE,
    REPLAY_PAUSED,
    REPLAY_RATE,
    REPLAY_RESUMED,
    REPLAYS,
)
from mrlab_ros.app.recorder.ports import (
    Journal,
    RunningRecording,
    RunningReplay,
    Settings,
    Status,
    Streams,
)
from mrlab_ros.app.recorder.stops import ReplayStops
from mrlab_ros.core.base.diagnostic import Diagnostic
from mrlab_ros.core.base.errors import LabError
from mrlab_ros.core.base.state_machine import Machine
from mrlab_ros.core.recording import recorder as entries
from mrlab_ros.core.recording.diagnostics import REPLAY_OVER, TO_END, TO_STOP
from mrlab_ros.core.recording.metadata import Gap
from mrlab_ros.core.recording.recorder import (
    TABLE,
    Entry,
    RecorderEvent,
    RecorderState,
    reason,
)
from mrlab_ros.core.recording.stops import Stop, next_stop, stop_before
from mrlab_ros.core.recording.topics import Split, Topics
from mrlab_ros.core.runtime.watch import RESTART_SHOWN_S


class Recorder:
    """Records or replays, one at a time.

    Orders outlive the process: a recording is in the journal from the order to start it until the
    order to stop it, and stops that were left for a recorder that did not run are carried out.

    lab: the id of the lab; empty: it has none. log: takes what happened. Safe from several
    threads.
    """

    def __init__(
        self,
        streams: Streams,
        journal: Journal,
        orders: StopOrders,
        settings: Callable[[], Settings],
        log: Callable[[Diagnostic], None],
        lab: str = "",
    ) -> None:
        self._streams = streams
        self._journal = journal
        self._orders = orders
        self._settings = settings
        self._log = log
        self._lab = lab
        # Guards the machine and what its state is about; nothing slow is done under it.
        self._lock = threading.RLock()
        self._machine = Machine(TABLE, self._reason)
        self._recording: RunningRecording | None = None
        self._replay: RunningReplay | None = None
        self._entry: Entry | None = None
        # Of what is at hand: what is wrong with it, or the stop at which its replay stands.
        self._trouble: Diagnostic | None = None
        self._stops = ReplayStops(streams.publish_stops)
        self._made_at = time.monotonic()
        # Diagnostics of messages that a restart kept from the recording.
        self.lost: list[Diagnostic] = []
        # Why the newest recording ended by itself; empty again once another one begins.
        self.failed: list[Diagnostic] = []

    @property
    def status(self) -> Status:
        with self._lock:
            state, recording, running = self._machine.state, self._recording, self._replay
            if recording is not None:
                return Status(
                    state,
                    self._trouble,
                    str(recording.bag),
                    position=recording.position,
                    messages=recording.messages,
                    size=recording.size,
                )
            if running is None:
                return Status(state, self._trouble)
            bag = running.bag
            status = Status(
                state, self._trouble, str(bag.path), duration=bag.duration, size=bag.size
            )
            if state is RecorderState.PREPARING:
                return status
            return replace(
                status, position=running.position, rate=running.rate, messages=running.messages
            )

    def recover(self) -> None:
        """Continue the recording of a recorder that died, or end it where that was asked for."""
        entry = entries.read(self._journal.load())
        if entry is not None:
            try:
                self._continue(entry)
            except LabError as error:
                self._report_loss(RECORDING_LOST(folder=str(entry.folder), why=error))
            if self._recording is None:
                self._journal.save({})
        self.carry_out_orders()
        self._publish()

    def carry_out_orders(self) -> None:
        """End the recording where an order to do so was left; publish the progress."""
        for order in self._orders.waiting():
            recording = self._recording
            if recording is not None and order.concerns(recording.bag):
                try:
                    self.stop()
                except LabError as error:
                    self._log(error.diagnostic)
            self._orders.remove(order)
        if self._recording is not None or self._replay is not None:
            self._publish()

    def discover(self) -> None:
        """Record the topics that are new in the graph."""
        recording = self._recording
        if recording is not None:
            recording.discover()

    def close(self) -> None:
        """Close what is written, end what is replayed; a recording continues after a restart."""
        self._stops.close()
        self._end(RecorderEvent.CLOSE)

    # recording ------------------------------------------------------------------------------

    def start(self, bag: str, topics: tuple[str, ...], split_duration: float) -> Diagnostic:
        """Record into `bag`; empty: into one named by date and time. topics: empty: the usual.

        split_duration: s after which a new file begins; 0: never.
        """
        self._check(RecorderEvent.START)
        settings = self._settings()
        name = bag or time.strftime("session_%Y-%m-%d_%H-%M-%S")
        folder = settings.folder / Path(name).expanduser()
        entry = Entry(folder, topics or settings.topics, split_duration, lab=self._lab)
        split, wanted = self._wanted(entry)
        remove_empty(folder)
        recording = self._streams.record(folder, wanted, split, self._on_trouble)
        # They are about earlier bags. While the restart is reported, its loss is.
        self.failed = []
        if time.monotonic() - self._made_at > RESTART_SHOWN_S:
            self.lost = []
        self._begin(recording, entry, None)
        list_in(settings.folder, folder.absolute())
        said = RECORDS(folder=str(folder))
        self._log(said)
        return said

    def stop(self) -> Diagnostic:
        """End the recording or the replay."""
        return self._end(RecorderEvent.STOP) or REPLAY_OVER()

    def split(self) -> Diagnostic:
        """Continue the recording in a new file."""
        self._check(RecorderEvent.SPLIT)
        recording = self._recording
        if recording is not None:
            recording.split()
        with self._lock:
            # Raises where the recording has ended meanwhile.
            self._machine.fire(RecorderEvent.SPLIT)
        return RECORDING_SPLIT()

    def _wanted(self, entry: Entry) -> tuple[Split, Topics]:
        return Split(entry.split_duration, self._settings().split_size), Topics(entry.topics)

    def _begin(self, recording: RunningRecording, entry: Entry, gap: Diagnostic | None) -> None:
        """Start a recording. gap: what the state says of it."""
        with self._lock:
            self._machine.fire(RecorderEvent.START)
            self._trouble = gap
            self._recording, self._entry = recording, entry
        # First: a recorder that dies now continues it.
        self._journal.save(entries.plain(entry))
        recording.start()
        self._publish()

    def _continue(self, entry: Entry) -> None:
        """Continue a recording in a new file of its bag, unless it ended or was to end."""
        if not entry.continues_in(self._lab):
            return
        facts = Bag(entry.folder).facts()
        if any(order.concerns(entry.folder) for order in self._orders.waiting()):
            write_metadata(entry.folder, facts)
            self._report_loss(
                RECORDING_ENDED_LATE(folder=str(entry.folder), messages=facts.messages)
            )
            return
        gap = Gap(facts.end_ns, max(time.time_ns(), facts.end_ns))
        said = gap.said(facts.start_ns) if facts.messages else RECORDER_RESTARTED()
        split, topics = self._wanted(entry)
        recording = self._streams.record(entry.folder, topics, split, self._on_trouble, facts, gap)
        self._begin(recording, replace(entry, lab=self._lab, closed=False), said)
        lost = RECORDING_WITH_GAP(folder=str(entry.folder), gap=said)
        self.lost.append(lost)
        self._log(lost)

    def _report_loss(self, lost: Diagnostic) -> None:
        with self._lock:
            self._trouble = lost
        self.lost.append(lost)
        self._log(lost)

    def _on_trouble(self, error: LabError) -> None:
        self._log(error.diagnostic)
        with self._lock:
            self._machine.fire(RecorderEvent.FAIL)
            self._trouble, self.failed = error.diagnostic, [error.diagnostic]
            self._recording = None
        self._journal.save({})
        self._publish()

    # replaying ------------------------------------------------------------------------------

    def bags(self) -> list[str]:
        """Return the names of the bags that can be replayed by name, newest first."""
        return bags_in(self._settings().folder)

    def replay(self, bag: str, rate: float, start: float, loop: bool) -> Diagnostic:
        """Replay `bag` from `start`, s."""
        self._check(RecorderEvent.REPLAY)
        path = Path(bag).expanduser()
        path = path if path.is_absolute() or path.exists() else self._settings().folder / path
        running = self._streams.replay(path, rate, start, loop, self._on_replay_end)
        with self._lock:
            self._machine.fire(RecorderEvent.REPLAY)
            self._replay, self._trouble = running, None
        # The lab's own nodes leave the graph as soon as they receive this.
        self._publish()
        try:
            self._stops.read(running.bag)
            running.prepare()
            # Before it starts: a short one may be over at once.
            with self._lock:
                self._machine.fire(RecorderEvent.BEGIN)
            running.start()
        except Exception:
            with self._lock:
                self._machine.fire(RecorderEvent.FAIL)
                self._replay = None
            self._stops.forget()
            running.close()
            raise
        finally:
            self._publish()
        return REPLAYS(
            duration=running.bag.duration,
            messages=running.bag.message_count,
            left_out=running.left_out,
        )

    def pause(self) -> Diagnostic:
        running = self._command(RecorderEvent.PAUSE, lambda running: running.pause())
        return REPLAY_PAUSED(position=running.position)

    def resume(self) -> Diagnostic:
        self._command(RecorderEvent.RESUME, lambda running: running.resume())
        return REPLAY_RESUMED()

    def next_stop(self) -> Diagnostic:
        """Play on to the next thing that happened in the session, and pause there."""
        stops, position = self._stops_here()
        stop = next_stop(stops, position)
        if stop is None:
            self.resume()
            return TO_END()

        def go(running: RunningReplay) -> None:
            running.resume(stop.time, lambda: self._arrive(running, stop))

        self._command(RecorderEvent.RESUME, go)
        return TO_STOP(at=stop.time)

    def previous_stop(self) -> Diagnostic:
        """Go back to the thing that happened before, and pause there."""
        stop = stop_before(*self._stops_here())

        def go(running: RunningReplay) -> None:
            running.pause()
            running.seek(stop.time)

        self._command(RecorderEvent.PAUSE, go, stop.said)
        return stop.said

    def _stops_here(self) -> tuple[list[Stop], float]:
        """Return the stops of what is replayed, and the place of the replay, s."""
        with self._lock:
            self._machine.check(RecorderEvent.SEEK)
            running = self._replay
        assert running is not None
        return self._stops.known(running.bag), running.position

    def _arrive(self, running: RunningReplay, stop: Stop) -> None:
        with self._lock:
            # A command may have come first.
            if self._replay is not running or not running.standing:
                return
            self._machine.fire(RecorderEvent.PAUSE)
            self._trouble = stop.said
        self._publish()

    def seek(self, position: float) -> Diagnostic:
        self._command(RecorderEvent.SEEK, lambda running: running.seek(position))
        return REPLAY_AT(position=position)

    def set_rate(self, rate: float) -> Diagnostic:
        self._command(RecorderEvent.SET_RATE, lambda running: running.set_rate(rate))
        return REPLAY_RATE(rate=rate)

    def set_loop(self, loop: bool) -> Diagnostic:
        self._command(RecorderEvent.SET_LOOP, lambda running: running.set_loop(loop))
        return REPLAY_LOOPS() if loop else REPLAY_ONCE()

    def _command(
        self,
        event: RecorderEvent,
        act: Callable[[RunningReplay], None],
        stands_at: Diagnostic | None = None,
    ) -> RunningReplay:
        """Do with the replay what `event` asks for; raise Misuse where there is none.

        stands_at: the stop at which the replay is then.
        """
        with self._lock:
            self._machine.check(event)
            running = self._replay
        assert running is not None
        act(running)
        with self._lock:
            # Raises where the replay has ended meanwhile.
            self._machine.fire(event)
            if event not in (RecorderEvent.SET_RATE, RecorderEvent.SET_LOOP) or stands_at:
                self._trouble = stands_at
        self._publish()
        return running

    def _on_replay_end(self, trouble: Diagnostic | None) -> None:
        if trouble is not None:
            self._log(trouble)
        running = self._replay
        if running is None:
            # Another thread ended it in the same moment.
            return
        self._stops.forget()
        # Its topics leave the graph before the live nodes return.
        running.close()
        with self._lock:
            if self._replay is not running:
                return
            self._machine.fire(RecorderEvent.END if trouble is None else RecorderEvent.FAIL)
            self._replay, self._trouble = None, trouble
        self._publish()

    # both -----------------------------------------------------------------------------------

    def _check(self, event: RecorderEvent) -> None:
        """Raise Misuse where the present state does not allow `event`."""
        with self._lock:
            self._machine.check(event)

    def _reason(self, state: RecorderState, event: RecorderEvent) -> Diagnostic:
        return reason(state, event, self.status.bag)

    def _end(self, event: RecorderEvent) -> Diagnostic | None:
        """End what runs; return what is said of a bag that was written."""
        with self._lock:
            self._machine.fire(event)
            recording, self._recording = self._recording, None
            running, self._replay = self._replay, None
            if recording is not None or running is not None:
                self._trouble = None
            kept = {}
            if event is RecorderEvent.CLOSE and recording is not None and self._entry is not None:
                kept = entries.plain(replace(self._entry, closed=True))
        self._journal.save(kept)
        try:
            if recording is not None:
                recording.close()
            if running is not None:
                self._stops.forget()
                running.close()
        except LabError as error:
            with self._lock:
                self._trouble, self.failed = error.diagnostic, [error.diagnostic]
            raise
        finally:
            self._publish()
        if recording is None:
            return None
        said = RECORDED(folder=str(recording.bag), messages=recording.messages)
        self._log(said)
        return said

    def _publish(self) -> None:
        with self._lock:
            self._streams.publish(self.status)
