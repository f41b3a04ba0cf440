"""A graph without ROS for the recorder: bags are real, what is received and replayed is not."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from pathlib import Path
from types import SimpleNamespace
from typing import Any

from mrlab_ros.adapters.bags.writer import BagWriter
from mrlab_ros.app.recorder.ports import Status
from mrlab_ros.core.base.diagnostic import Diagnostic
from mrlab_ros.core.base.errors import LabError
from mrlab_ros.core.recording.metadata import GAP, BagFacts, Gap, Topic
from mrlab_ros.core.recording.stops import Stop
from mrlab_ros.core.recording.topics import Split, Topics

TOPIC = "/counted"
START_NS = 1_700_000_000_000_000_000


class FakeRecording:
    """Writes a message with each receive()."""

    def __init__(self, writer: BagWriter, on_trouble: Callable[[LabError], None]) -> None:
        self._writer, self._on_trouble = writer, on_trouble
        self.bag = writer.folder
        self.discoveries = 0
        self.position = 0.0
        writer.add_topic(Topic(TOPIC, "std_msgs/msg/String"))

    @property
    def messages(self) -> int:
        return self._writer.facts.messages

    @property
    def size(self) -> int:
        return self._writer.size

    def start(self) -> None:
        self._writer.flush()

    def discover(self) -> None:
        self.discoveries += 1

    def split(self) -> None:
        self._writer.split()

    def receive(self) -> None:
        now_ns = START_NS + self.messages
        self._writer.write(TOPIC, now_ns, b"\0\1\0\0", now_ns)
        self._writer.flush()

    def fail(self, why: Diagnostic) -> None:
        self._writer.close()
        self._on_trouble(LabError(why))

    def die(self) -> None:
        """End as with the process: the bag is not closed."""
        self._writer._give_up_reserve()
        self._writer._file.close()

    def close(self) -> None:
        self._writer.close()


class FakeReplay:
    """A replay of nothing. calls: what was asked of it; preparing: is called in prepare()."""

    def __init__(
        self,
        path: Path,
        rate: float,
        on_end: Callable[[Diagnostic | None], None],
        preparing: Callable[[], None],
    ) -> None:
        self.bag: Any = SimpleNamespace(path=path, duration=2.0, size=9, message_count=3)
        self.rate, self.on_end, self._preparing = rate, on_end, preparing
        self.position, self.messages = 0.0, 0
        self.left_out: list[Diagnostic] = []
        self.calls: list[str] = []

    def prepare(self) -> None:
        self._preparing()

    def seek(self, position: float) -> None:
        self.position = position

    def set_rate(self, rate: float) -> None:
        self.rate = rate

    def set_loop(self, loop: bool) -> None:
        self.calls.append("loop" if loop else "once")

    def start(self) -> None:
        self.calls.append("start")

    def pause(self) -> None:
        self.calls.append("pause")

    def resume(self) -> None:
        self.calls.append("resume")

    def close(self) -> None:
        self.calls.append("close")


class FakeStreams:
    """The port Streams. preparing: is called while a replay is prepared."""

    def __init__(self) -> None:
        self.published: list[Status] = []
        self.stops: list[Stop] = []
        self.recording: FakeRecording | None = None
        self.running: FakeReplay | None = None
        self.preparing: Callable[[], None] = lambda: None

    def record(
        self,
        folder: Path,
        topics: Topics,
        split: Split,
        on_trouble: Callable[[LabError], None],
        after: BagFacts | None = None,
        gap: Gap | None = None,
    ) -> FakeRecording:
        writer = BagWriter(folder, lambda kind: "string data\n", after=after)
        if gap is not None:
            writer.note(GAP, gap.note())
        self.recording = FakeRecording(writer, on_trouble)
        return self.recording

    def replay(
        self,
        path: Path,
        rate: float,
        start: float,
        loop: bool,
        on_end: Callable[[Diagnostic | None], None],
    ) -> FakeReplay:
        self.running = FakeReplay(path, rate, on_end, lambda: self.preparing())
        return self.running

    def publish(self, status: Status) -> None:
        self.published.append(status)

    def publish_stops(self, stops: Sequence[Stop]) -> None:
        self.stops = list(stops)


class FakeJournal:
    """A journal in memory, which outlives the recorder."""

    def __init__(self) -> None:
        self.content: dict[str, Any] = {}

    def load(self) -> dict[str, Any]:
        return self.content

    def save(self, content: Any) -> bool:
        self.content = dict(content)
        return True
