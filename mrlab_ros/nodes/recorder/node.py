"""The recorder node: writes the session as a bag, and replays one."""

from __future__ import annotations

import threading
import time
from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING, Any

from mrlab_msgs import msg, srv
from mrlab_msgs.srv import ListBags, SetLoop, Trigger

from mrlab_ros.adapters.bags.other import open_bag
from mrlab_ros.adapters.bags.reader import Bag, bags_in, default_folder, remove_empty
from mrlab_ros.adapters.bags.writer import BagWriter
from mrlab_ros.adapters.journal_file import Journal
from mrlab_ros.core.base.diagnostic import Diagnostic
from mrlab_ros.core.base.errors import LabError
from mrlab_ros.core.base.state_machine import Machine
from mrlab_ros.core.recording import recorder as entries
from mrlab_ros.core.recording.diagnostics import REPLAY_OVER
from mrlab_ros.core.recording.metadata import GAP, Gap
from mrlab_ros.core.recording.recorder import (
    TABLE,
    RecorderEvent,
    RecorderState,
    ReplayTimeline,
    reason,
)
from mrlab_ros.core.recording.topics import Split, Topics
from mrlab_ros.core.runtime.watch import RESTART_SHOWN_S
from mrlab_ros.messages import qos
from mrlab_ros.messages.definitions import definition
from mrlab_ros.messages.status import recorder_state_to_message
from mrlab_ros.nodes import parameters
from mrlab_ros.nodes.parameters import RecorderParameters
from mrlab_ros.nodes.recorder.attachments import SessionContent, versions
from mrlab_ros.nodes.recorder.diagnostics import (
    RECORDED,
    RECORDER_RESTARTED,
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
from mrlab_ros.nodes.recorder.recording import Recording
from mrlab_ros.nodes.recorder.replaying import ReplayedTrajectories, Replaying
from mrlab_ros.ros.clock import every
from mrlab_ros.ros.parameters import NodeArguments, ParameterNode
from mrlab_ros.ros.services import answered, create_service
from mrlab_ros.ros.spinning import Caller

if TYPE_CHECKING:
    from typing_extensions import Unpack

MEGABYTE = 1_000_000


class RecorderNode(
    ParameterNode[RecorderParameters],
    name="recorder",
    kind=RecorderParameters,
    others=parameters.ALL,
):
    """Records or replays, one at a time, and publishes its state on ~/state."""

    def __init__(self, **ros: Unpack[NodeArguments]) -> None:
        super().__init__(**ros)
        # The raw topics are on a node that no executor spins.
        self._streams = self.hidden_node("streams")
        self._caller = Caller(self)
        # Guards the machine and what its state is about; nothing slow is done under it.
        self._lock = threading.RLock()
        self._machine = Machine(TABLE, self._reason)
        self._recording: Recording | None = None
        self._content: SessionContent | None = None
        self._replaying: Replaying | None = None
        self._trajectories: ReplayedTrajectories | None = None
        # A bag that is replayed once the live nodes have left; its state is published before.
        self._preparing: Bag | None = None
        self._trouble: Diagnostic | None = None
        self._made_at = time.monotonic()
        # Diagnostics of messages that a restart kept from the recording.
        self.lost: list[Diagnostic] = []
        # Why the newest recording ended by itself; empty again once another one begins.
        self.failed: list[Diagnostic] = []
        self._state = self.create_publisher(msg.RecorderState, "~/state", qos.LATCHED)
        for kind, name, callback in (
            (srv.StartRecording, "start", self._start),
            (Trigger, "stop", self._stop),
            (Trigger, "split", self._split),
            (srv.Replay, "replay", self._replay),
            (ListBags, "list_bags", self._list_bags),
            (Trigger, "pause", self._pause),
            (Trigger, "resume", self._resume),
            (srv.Seek, "seek", self._seek),
            (srv.SetRate, "set_rate", self._set_rate),
            (SetLoop, "set_loop", self._set_loop),
        ):
            create_service(self, kind, f"~/{name}", callback)
        every(self, 1.0, self._publish_while_working)
        every(self, 0.25, self._discover)
        self._journal = Journal.of(
            self.parameters.state_dir, self.get_name(), self.get_logger().error
        )
        self._go_on()
        self._publish_state()

    @property
    def _folder(self) -> Path:
        chosen = self.parameters.bag_dir
        return Path(chosen).expanduser() if chosen else default_folder()

    def destroy_node(self) -> None:
        """Close what is written, end what is replayed."""
        try:
            self._end(RecorderEvent.CLOSE)
        except LabError as error:
            self.get_logger().error(str(error))
        self._journal.close()
        self._caller.close()
        self._streams.destroy_node()
        super().destroy_node()

    # recording ------------------------------------------------------------------------------

    @answered
    def _start(self, request: Any, response: Any) -> Diagnostic:
        self._check(RecorderEvent.START)
        split = Split(request.split_duration, self.parameters.split_size * MEGABYTE)
        topics = Topics(list(request.topics) or list(self.parameters.topics))
        name = request.bag or time.strftime("session_%Y-%m-%d_%H-%M-%S")
        folder = self._folder / Path(name).expanduser()
        remove_empty(folder)
        writer = BagWriter(folder, definition, versions())
        writer.note("mrlab", writer.facts.custom)
        # They are about earlier bags. While the restart is reported, its loss is.
        self.failed = []
        if time.monotonic() - self._made_at > RESTART_SHOWN_S:
            self.lost = []
        self._record(writer, topics, split, None)
        self._journal.save(entries.plain(writer.folder, topics.patterns, request.split_duration))
        response.bag = str(writer.folder)
        said = RECORDS(folder=str(writer.folder))
        self.get_logger().info(str(said))
        return said

    def _record(
        self, writer: BagWriter, topics: Topics, split: Split, gap: Diagnostic | None
    ) -> None:
        """Start a recording. gap: what the state says of it."""
        recording = Recording(
            self._streams,
            writer,
            topics,
            split,
            self._observe,
            self._on_disk_trouble,
            self._warn,
        )
        content = SessionContent(self._caller, recording.attach, self._warn)
        with self._lock:
            self._machine.fire(RecorderEvent.START)
            self._trouble = gap
            self._recording, self._content = recording, content
        recording.start()
        self._publish_state()

    def _warn(self, said: Diagnostic) -> None:
        self.get_logger().warning(str(said))

    def _go_on(self) -> None:
        """Go on with the recording of a recorder that was killed, in a new file of its bag."""
        entry = entries.read(self._journal.load())
        if entry is None:
            return
        try:
            bag = Bag(entry.folder)
            facts = bag.facts()
            gap = Gap(facts.end_ns, max(time.time_ns(), facts.end_ns))
            writer = BagWriter(entry.folder, definition, after=facts)
            writer.note(GAP, gap.note())
            split = Split(entry.split_duration, self.parameters.split_size * MEGABYTE)
            said = gap.said(facts.start_ns) if facts.messages else RECORDER_RESTARTED()
            self._record(writer, Topics(entry.topics), split, said)
        except LabError as error:
            lost = RECORDING_LOST(folder=str(entry.folder), why=error)
            with self._lock:
                self._trouble = lost
            self.get_logger().error(str(lost))
            self.lost.append(lost)
            self._journal.save({})
            return
        lost = RECORDING_WITH_GAP(folder=str(entry.folder), gap=said)
        self.lost.append(lost)
        self.get_logger().warning(str(lost))

    @answered
    def _split(self, request: Any, response: Any) -> Diagnostic:
        self._check(RecorderEvent.SPLIT)
        recording = self._recording
        if recording is not None:
            recording.split()
        with self._lock:
            # Raises where the recording has ended meanwhile.
            self._machine.fire(RecorderEvent.SPLIT)
        return RECORDING_SPLIT()

    @answered
    def _stop(self, request: Any, response: Any) -> Diagnostic | None:
        return self._end(RecorderEvent.STOP)

    def _discover(self) -> None:
        recording = self._recording
        if recording is not None:
            recording.discover()

    def _observe(self, message: Any, kind: str) -> None:
        content = self._content
        if content is not None:
            content.observe(message, kind)

    def _on_disk_trouble(self, error: LabError) -> None:
        self.get_logger().error(str(error))
        with self._lock:
            self._machine.fire(RecorderEvent.FAIL)
            self._trouble, self.failed = error.diagnostic, [error.diagnostic]
            self._recording = None
            content, self._content = self._content, None
        self._journal.save({})
        self._publish_state()
        if content is not None:
            content.close()

    # replaying ------------------------------------------------------------------------------

    @answered
    def _list_bags(self, _request: Any, response: Any) -> None:
        response.bags = bags_in(self._folder)

    @answered
    def _replay(self, request: Any, response: Any) -> Diagnostic:
        self._check(RecorderEvent.REPLAY)
        path = Path(request.bag).expanduser()
        path = path if path.is_absolute() or path.exists() else self._folder / path
        bag = open_bag(path, definition)
        timeline = ReplayTimeline(bag.duration, request.rate, request.start, request.loop)
        replaying = Replaying(self._streams, bag, timeline, self._on_replay_end)
        with self._lock:
            self._machine.fire(RecorderEvent.REPLAY)
            self._preparing, self._trouble = bag, None
        # The lab's own nodes leave the graph as soon as they receive this.
        self._publish_state()
        try:
            replaying.wait_until_alone()
            self._trajectories = ReplayedTrajectories(self, bag)
            # Before it starts: a short one may be over at once.
            with self._lock:
                self._machine.fire(RecorderEvent.BEGIN)
                self._replaying, self._preparing = replaying, None
            replaying.start()
        except Exception:
            with self._lock:
                self._machine.fire(RecorderEvent.FAIL)
                self._replaying = self._preparing = None
            self._close(replaying)
            raise
        finally:
            self._publish_state()
        self.get_logger().info(f"replays {bag.path}")
        return REPLAYS(
            duration=bag.duration, messages=bag.message_count, left_out=replaying.left_out
        )

    def _on_replay_end(self, trouble: Diagnostic | None) -> None:
        if trouble is not None:
            self.get_logger().error(str(trouble))
        replaying = self._replaying
        if replaying is None:
            # Somebody ended it in the same moment.
            return
        self._close(replaying)
        with self._lock:
            if self._replaying is not replaying:
                return
            self._machine.fire(RecorderEvent.END if trouble is None else RecorderEvent.FAIL)
            self._replaying, self._trouble = None, trouble
        self.get_logger().info(f"the replay of {replaying.bag.path} is over")
        self._publish_state()

    def _close(self, replaying: Replaying) -> None:
        """Remove the bag's topics from the graph before the live nodes return."""
        trajectories, self._trajectories = self._trajectories, None
        if trajectories is not None:
            trajectories.close()
        replaying.close()

    @answered
    def _pause(self, request: Any, response: Any) -> Diagnostic:
        replaying = self._command(RecorderEvent.PAUSE, Replaying.pause)
        return REPLAY_PAUSED(position=replaying.position)

    @answered
    def _resume(self, request: Any, response: Any) -> Diagnostic:
        self._command(RecorderEvent.RESUME, Replaying.resume)
        return REPLAY_RESUMED()

    @answered
    def _seek(self, request: Any, response: Any) -> Diagnostic:
        self._command(RecorderEvent.SEEK, lambda replaying: replaying.seek(request.position))
        return REPLAY_AT(position=request.position)

    @answered
    def _set_rate(self, request: Any, response: Any) -> Diagnostic:
        self._command(RecorderEvent.SET_RATE, lambda replaying: replaying.set_rate(request.rate))
        return REPLAY_RATE(rate=request.rate)

    @answered
    def _set_loop(self, request: Any, response: Any) -> Diagnostic:
        self._command(RecorderEvent.SET_LOOP, lambda replaying: replaying.set_loop(request.loop))
        return REPLAY_LOOPS() if request.loop else REPLAY_ONCE()

    def _command(self, event: RecorderEvent, act: Callable[[Replaying], None]) -> Replaying:
        """Do with the replay what `event` asks for; raise Misuse where there is none."""
        with self._lock:
            self._machine.check(event)
            replaying = self._replaying
        assert replaying is not None
        act(replaying)
        with self._lock:
            # Raises where the replay has ended meanwhile.
            self._machine.fire(event)
        self._publish_state()
        return replaying

    # both -----------------------------------------------------------------------------------

    def _check(self, event: RecorderEvent) -> None:
        """Raise Misuse where the present state does not allow `event`."""
        with self._lock:
            self._machine.check(event)

    def _reason(self, state: RecorderState, event: RecorderEvent) -> Diagnostic:
        bag = ""
        if self._recording is not None:
            bag = self._recording.folder
        elif self._replaying is not None:
            bag = str(self._replaying.bag.path)
        elif self._preparing is not None:
            bag = str(self._preparing.path)
        return reason(state, event, bag)

    def _end(self, event: RecorderEvent) -> Diagnostic | None:
        with self._lock:
            self._machine.fire(event)
            self._trouble = None
            recording, self._recording = self._recording, None
            content, self._content = self._content, None
            replaying, self._replaying = self._replaying, None
            self._preparing = None
        self._journal.save({})
        try:
            if content is not None:
                content.close()
            if recording is not None:
                recording.close()
            if replaying is not None:
                self._close(replaying)
        except LabError as error:
            with self._lock:
                self._trouble, self.failed = error.diagnostic, [error.diagnostic]
            raise
        finally:
            if self.context.ok():
                self._publish_state()
        if recording is not None:
            said = RECORDED(folder=recording.folder, messages=recording.messages)
            if self.context.ok():
                self.get_logger().info(str(said))
            return said
        return REPLAY_OVER() if replaying is not None else None

    def _publish_while_working(self) -> None:
        if self._recording is not None or self._replaying is not None:
            self._publish_state()

    def _publish_state(self) -> None:
        with self._lock:
            state = recorder_state_to_message(
                time.time_ns(), self._machine.state.announced.value, self._trouble, **self._facts()
            )
            try:
                self._state.publish(state)
            except Exception:
                # A replay may end while the lab is shutting down.
                if self.context.ok():
                    raise

    def _facts(self) -> dict[str, Any]:
        """Return what the state says of the bag at hand; the lock must be held."""
        recording, replaying = self._recording, self._replaying
        if recording is not None:
            return {
                "bag": recording.folder,
                "position": recording.position,
                "messages": recording.messages,
                "size": recording.size,
            }
        bag = replaying.bag if replaying is not None else self._preparing
        if bag is None:
            return {}
        facts = {"bag": str(bag.path), "duration": bag.duration, "size": bag.size}
        if replaying is None:
            return facts
        return facts | {
            "position": replaying.position,
            "rate": replaying.rate,
            "messages": replaying.messages,
        }
