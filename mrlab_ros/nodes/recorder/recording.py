"""A running recording: subscribes to the graph's topics and writes their messages to a bag."""

from __future__ import annotations

import threading
import time
from collections.abc import Callable
from pathlib import Path

from rclpy.node import Node
from rclpy.subscription import Subscription

from mrlab_ros.adapters.bags.writer import BagWriter
from mrlab_ros.core.base.clock import SECOND
from mrlab_ros.core.base.diagnostic import Diagnostic
from mrlab_ros.core.base.errors import LabError
from mrlab_ros.core.recording.metadata import Topic
from mrlab_ros.core.recording.topics import Split, Topics
from mrlab_ros.messages.qos import STREAM, message_class, profile, topic_of
from mrlab_ros.nodes.recorder.attachments import SessionContent
from mrlab_ros.nodes.recorder.diagnostics import (
    NOT_RECORDED,
    RECORDER_FAULT,
    RECORDING_FAILED,
    SEVERAL_TYPES,
)
from mrlab_ros.ros.raw_streams import Received, TopicPoll
from mrlab_ros.ros.spinning import Caller

# Period at which subscriptions are polled, s.
POLL_PERIOD_S = 0.04
# Every so many discoveries the publishers of known topics are checked, too.
PUBLISHER_CHECK_EVERY = 8
# A killed recorder loses the messages of this time at most, ns.
FLUSH_NS = 400_000_000
# How often metadata.yaml is brought up to date while recording, ns.
METADATA_NS = 10 * SECOND
# A topic that has had no publisher for so long is not followed any more, ns: one that is restarted
# is back by then, and each subscription holds memory.
GONE_NS = 30 * SECOND
# Latched messages of a topic arrive within this time after it is followed, ns.
PRESENT_NS = SECOND // 2
# A stamp that is so far in the future is of before the clock was set back, ns.
AHEAD_NS = SECOND // 10
# What displays send comes into the graph only while somebody subscribes to it.
ASKED_FOR = {
    "/look_here": "mrlab_msgs/msg/LookHere",
    "/presence": "mrlab_msgs/msg/Presence",
}
# Messages kept for the recorder while a disk or the machine stalls: 10 s at 100 Hz.
DEPTH = 1000


class Followed:
    """A topic that is recorded."""

    def __init__(self, subscription: Subscription, topic: Topic, publishers: int) -> None:
        self.subscription = subscription
        self.topic = topic
        self.publishers = publishers
        self.since_ns = time.time_ns()
        # When its last publisher was found to have gone, monotonic; 0: it has one.
        self._alone_ns = 0
        # By this time of the clock that nobody sets, what was published before has arrived.
        self._present_ns = time.monotonic_ns() + PRESENT_NS
        # The newest of what was published before: a latched topic keeps several values, and the
        # older ones are no events of this recording.
        self.before: Received | None = None

    def is_gone(self, publishers: int) -> bool:
        """Return whether it has had no publisher for GONE_NS. publishers: that it has now."""
        now_ns = time.monotonic_ns()
        self._alone_ns = 0 if publishers else self._alone_ns or now_ns
        return not publishers and now_ns - self._alone_ns >= GONE_NS

    def takes(self, message: Received) -> bool:
        """Return whether to write `message` now; keep back what was published before.

        A stamp of the future is of before the clock was set back.
        """
        alone = self.topic.latched and self.publishers == 1
        if not alone or time.monotonic_ns() >= self._present_ns:
            return True
        if self.since_ns <= message.published_ns <= time.time_ns() + AHEAD_NS:
            return True
        self.before = message
        return False

    def take_before(self, *, at_once: bool = False) -> Received | None:
        """Return the value from before once it is certain to be the newest."""
        if self.before is None or not (at_once or time.monotonic_ns() >= self._present_ns):
            return None
        taken, self.before = self.before, None
        return taken


class Recording:
    """Writes the topics of the graph that `topics` names into `writer`.

    `streams` is a node that no executor spins; `caller` calls what is attached to the bag.
    `on_trouble` gets, in another thread, the error that ended the recording,
    of the disk or of the recorder itself; the bag is closed by then.
    """

    def __init__(
        self,
        streams: Node,
        caller: Caller,
        writer: BagWriter,
        topics: Topics,
        split: Split,
        on_trouble: Callable[[LabError], None],
        warn: Callable[[Diagnostic], None],
    ) -> None:
        self._streams = streams
        self._writer = writer
        self._topics = topics
        self._split = split
        self._on_trouble = on_trouble
        self._complain = warn
        self._followed: dict[str, Followed] = {}
        self._asking: list[Subscription] = []
        # type of each topic that was ever followed
        self._kinds: dict[str, str] = {}
        # Topics that are not wanted, or cannot be recorded.
        self._refused: set[str] = set()
        self._discoveries = 0
        self._lock = threading.Lock()
        # Of the clock that never goes back: the other one may be set while a recording runs.
        self._began_ns = self._part_ns = self._flushed_ns = self._noted_ns = time.monotonic_ns()
        # How long ago a recorder that was killed began this bag, s.
        facts = writer.facts
        self._earlier = max(time.time_ns() - facts.start_ns, 0) / SECOND if facts.messages else 0.0
        # After a clock that was set back without a recorder, messages follow the earlier ones.
        self._later_ns = max(facts.end_ns - time.time_ns(), 0) if facts.messages else 0
        self._closed = False
        # Why the recording ended by itself.
        self._trouble: LabError | None = None
        self._poll = TopicPoll("recorder", POLL_PERIOD_S, self._take, self._fail)
        self._content = SessionContent(caller, self._attach, warn)

    def start(self) -> None:
        """Follow the topics that there are; raise DiskTrouble where the disk refuses."""
        if self._guarded(self._writer.flush):
            for name, kind in ASKED_FOR.items():
                if name in self._topics:
                    self._asking.append(
                        self._streams.create_subscription(
                            message_class(kind), name, lambda _: None, STREAM, raw=True
                        )
                    )
            self.discover()
        self._check_trouble()
        if not self._closed:
            self._poll.start()

    @property
    def bag(self) -> Path:
        return self._writer.folder

    @property
    def position(self) -> float:
        """Time since the recording began, s, of which a killed recorder may have missed some."""
        return self._earlier + (time.monotonic_ns() - self._began_ns) / SECOND

    @property
    def messages(self) -> int:
        """Messages of the bag, also those of a recorder that was killed."""
        return self._writer.facts.messages

    @property
    def size(self) -> int:
        """Bytes of the bag."""
        return self._writer.size

    def discover(self) -> None:
        """Subscribe to new topics of the graph; from time to time check for new publishers."""
        if self._closed:
            return
        changed = False
        self._discoveries += 1
        again = self._discoveries % PUBLISHER_CHECK_EVERY == 0
        for name, _ in self._streams.get_topic_names_and_types():
            if name in self._refused or (name in self._followed and not again):
                continue
            if name not in self._topics:
                self._refused.add(name)
                continue
            known = self._followed.get(name)
            publishers = self._streams.count_publishers(name)
            if known is not None and known.is_gone(publishers):
                self._unfollow(name)
            elif publishers and (known is None or known.publishers != publishers):
                try:
                    changed |= self._follow(name, publishers)
                except Exception as error:
                    self._refuse(name, _named(error).diagnostic)
        if changed:
            self._guarded(lambda: self._written(self._writer.write_metadata))

    def split(self) -> None:
        """Go on in a new file of the bag; raise DiskTrouble where the disk refuses.

        The recording has then ended, or is about to end, by itself.
        """
        self._guarded(self._split_now)
        self._check_trouble()

    def close(self) -> None:
        """Write what was received, then index and metadata; raise LabError where that fails."""
        self._content.close()
        self._poll.stop()
        with self._lock:
            self._check_trouble()
            for message in self._present([], last=True):
                self._write(message)
            self._closed = True
        self._leave()
        try:
            self._writer.close()
        except Exception as error:
            raise _named(error) from error

    def _follow(self, name: str, publishers: int) -> bool:
        ends = self._streams.get_publishers_info_by_topic(name)
        kinds = {end.topic_type for end in ends}
        if len(kinds) != 1:
            if kinds:
                self._refuse(name, SEVERAL_TYPES(topic=name, types=sorted(kinds)))
            return False
        topic = topic_of(name, ends)
        known = self._followed.get(name)
        if known is not None:
            known.publishers = publishers
            if (known.topic.latched, known.topic.reliable) == (topic.latched, topic.reliable):
                return False
            self._unfollow(name)
        kind = message_class(topic.type)
        with self._lock:
            self._writer.add_topic(topic)
        subscription = self._streams.create_subscription(
            kind, name, lambda _: None, profile(topic, DEPTH), raw=True
        )
        self._kinds[name] = topic.type
        self._followed[name] = Followed(subscription, topic, publishers)
        self._poll.add(subscription, name)
        return True

    def _unfollow(self, name: str) -> None:
        subscription = self._followed.pop(name).subscription
        self._poll.remove(subscription)
        self._streams.destroy_subscription(subscription)

    def _attach(self, name: str, media_type: str, data: bytes) -> None:
        """Put a file into the bag, unless it is closed."""
        with self._lock:
            if not self._closed:
                self._writer.attach(name, media_type, data, time.time_ns())

    def _refuse(self, name: str, why: Diagnostic) -> None:
        self._refused.add(name)
        self._complain(NOT_RECORDED(why=why))

    def _take(self, messages: list[Received]) -> bool:
        with self._lock:
            if self._closed:
                return False
            messages = self._present(messages, last=False)
            for message in messages:
                self._write(message)
        for message in messages:
            self._content.observe(message, self._kinds[message.topic])
        return self._guarded(self._do_due)

    def _write(self, message: Received) -> None:
        received_ns, topic, data, published_ns, sequence = message
        received_ns += self._later_ns
        self._writer.write(topic, received_ns, data, published_ns, sequence & 0xFFFFFFFF)

    def _present(self, messages: list[Received], *, last: bool) -> list[Received]:
        """Return what to write: of what latched topics said before, the newest alone."""
        wanted: list[Received] = []
        for message in messages:
            followed = self._followed.get(message.topic)
            if followed is not None:
                if not followed.takes(message):
                    continue
                if (before := followed.take_before(at_once=True)) is not None:
                    wanted.append(before)
            wanted.append(message)
        for followed in list(self._followed.values()):
            if (before := followed.take_before(at_once=last)) is not None:
                wanted.append(before)
        return wanted

    def _do_due(self) -> None:
        now_ns = time.monotonic_ns()
        if self._split.due(self._part_ns, now_ns, self._writer.part_size):
            self._split_now()
        if now_ns - self._flushed_ns >= FLUSH_NS:
            self._flushed_ns = now_ns
            self._written(self._writer.flush)
        if now_ns - self._noted_ns >= METADATA_NS:
            self._noted_ns = now_ns
            self._written(self._writer.write_metadata)

    def _split_now(self) -> None:
        self._part_ns = time.monotonic_ns()
        self._written(self._writer.split)

    def _written(self, write: Callable[[], None]) -> None:
        """Use the writer under the lock, unless the bag is closed."""
        with self._lock:
            if not self._closed:
                write()

    def _guarded(self, work: Callable[[], None]) -> bool:
        """Do `work`; on an error end the recording and return False."""
        try:
            work()
        except Exception as error:
            self._fail(error)
            return False
        return True

    def _fail(self, error: Exception) -> None:
        """End the recording because of an error, unless it has ended."""
        why = _named(error)
        with self._lock:
            if self._closed:
                return
            self._closed, self._trouble = True, why
        try:
            self._writer.close()
        except Exception as second:
            self._complain(_named(second).diagnostic)
        else:
            self._trouble = type(why)(RECORDING_FAILED(why=why, messages=self.messages))
        self._leave()
        self._on_trouble(self._trouble)
        self._content.close()

    def _check_trouble(self) -> None:
        if self._trouble is not None:
            raise self._trouble

    def _leave(self) -> None:
        for each in [*self._asking, *(each.subscription for each in self._followed.values())]:
            self._streams.destroy_subscription(each)
        self._asking.clear()
        self._followed.clear()


def _named(error: Exception) -> LabError:
    """Return `error` as one with a diagnostic: any but a LabError is a fault of the recorder."""
    return error if isinstance(error, LabError) else LabError(RECORDER_FAULT(error=repr(error)))
