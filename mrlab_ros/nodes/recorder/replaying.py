"""A running replay: publishes a bag's messages unchanged, at their times.

Answers for the converter while a bag is replayed: the bag's own trajectories.
"""

from __future__ import annotations

import math
import threading
import time
from collections import deque
from collections.abc import Callable
from concurrent.futures import Future
from typing import Any

from mrlab_msgs import srv
from rclpy.duration import Duration
from rclpy.node import Node
from rclpy.publisher import Publisher
from rclpy.serialization import deserialize_message, serialize_message

from mrlab_ros.adapters import threads
from mrlab_ros.adapters.bags.mcap_file import Message
from mrlab_ros.adapters.bags.migration import Convert, migration
from mrlab_ros.adapters.bags.reader import Bag
from mrlab_ros.adapters.trajectories.formats import parse
from mrlab_ros.core.base.clock import SECOND, checked_position
from mrlab_ros.core.base.diagnostic import Diagnostic, Fix
from mrlab_ros.core.base.errors import BadInput, LabError, Misuse
from mrlab_ros.core.base.foreign_text import for_shell
from mrlab_ros.core.recording.diagnostics import LEFT_OUT, NOTHING_TO_REPLAY
from mrlab_ros.core.recording.metadata import Topic
from mrlab_ros.core.recording.recorder import ReplayTimeline, is_state
from mrlab_ros.core.recording.topics import OF_THE_PRESENT, Topics
from mrlab_ros.messages import trajectories
from mrlab_ros.messages.definitions import definition
from mrlab_ros.messages.qos import message_class, profile
from mrlab_ros.nodes.recorder.attachments import trajectory_name
from mrlab_ros.nodes.recorder.diagnostics import BAG_TRAJECTORY, OTHERS_PUBLISH, REPLAY_BROKE
from mrlab_ros.ros.services import answered, create_service

# Messages kept for a subscriber that is slow; of a latched topic, for one that comes late.
DEPTH, LATCHED_DEPTH = 1000, 10
# Batches of messages that are read ahead.
AHEAD = 4
# Messages that are published before a command has its turn.
BURST = 200
# How long a replay waits for the lab's own nodes to leave and for subscribers to be found, s.
LEAVE_TIMEOUT_S = 12.0
MATCH_TIMEOUT_S = 2.0
POLL_PERIOD_S = 0.02
# Subscribers that wait for a topic, such as the bridge, have matched after this time, s.
SETTLE_TIME_S = 0.5
# How long the end of a replay waits for subscribers to have its last messages, s.
ARRIVAL_TIMEOUT_S = 1.0


class Feed:
    """Reads a bag ahead of the replay, in a thread of its own."""

    def __init__(self, bag: Bag, start_ns: int, topics: frozenset[str]) -> None:
        self._batches = bag.batches(start_ns, topics)
        self._reader = threads.Pool("replay_feed", 1)
        self._ahead = deque(self._read() for _ in range(AHEAD))

    def next(self) -> list[Message] | None:
        """Return the messages that follow, None at the end; raise what reading raised."""
        self._ahead.append(self._read())
        return self._ahead.popleft().result()

    def stop(self) -> None:
        """End the thread and wait for it."""
        self._reader.shutdown(cancel_futures=True)

    def _read(self) -> Future[list[Message] | None]:
        return self._reader.submit(next, self._batches, None)


class Replaying:
    """Publishes `bag` through `streams`, a node that no executor spins, in a thread of its own.

    `node` offers the trajectories of the bag meanwhile. `on_end` is called in that thread at the
    end, with what ended the replay, or None. `lab`: the id of the lab, which messages of a bag of
    another one get in place of its own: the bridge forwards nothing of other labs.
    """

    def __init__(
        self,
        node: Node,
        streams: Node,
        bag: Bag,
        timeline: ReplayTimeline,
        on_end: Callable[[Diagnostic | None], None],
        lab: str = "",
        now_ns: Callable[[], int] = time.monotonic_ns,
    ) -> None:
        self._node = node
        self._streams = streams
        self._trajectories: ReplayedTrajectories | None = None
        self._bag = bag
        self._timeline = timeline
        self._on_end = on_end
        self._lab = lab
        self._now_ns = now_ns
        present = Topics(OF_THE_PRESENT)
        # Diagnostics of topics that are not replayed.
        self.left_out: list[Diagnostic] = []
        self._kinds: dict[str, Any] = {}
        self._converts: dict[str, Convert] = {}
        definitions = bag.definitions()
        for topic in bag.topics.values():
            if topic.name not in present:
                self._take(topic, definitions.get(topic.type, ""))
        self._topics = [topic for topic in bag.topics.values() if topic.name in self._kinds]
        if not self._topics:
            raise BadInput(NOTHING_TO_REPLAY(path=str(bag.path), left_out=self.left_out))
        self._names = frozenset(self._kinds)
        self._state_names = frozenset(topic.name for topic in self._topics if is_state(topic))
        self._publishers: dict[str, Publisher] = {}
        self._changed = threading.Condition()
        self._ready: deque[Message] = deque()
        self._feed: Feed | None = None
        self._stopped = False
        # Called at the place up to which it plays, and once that is reached.
        self._at_stop: Callable[[], None] | None = None
        self._arrived: Callable[[], None] | None = None
        self._thread = threads.task("replay", self._run)
        self.messages = 0

    def _take(self, topic: Topic, recorded: str) -> None:
        """Prepare to publish a topic, or note why not; recorded: its definition in the bag."""
        try:
            kind = message_class(topic.type)
            convert = migration(topic.type, recorded, definition(topic.type)) if recorded else None
        except BadInput as error:
            self.left_out.append(LEFT_OUT(topic=topic.name, why=error))
            return
        self._kinds[topic.name] = kind
        if self._lab and "lab" in kind.get_fields_and_field_types():
            convert = _of_lab(self._lab, kind, convert)
        if convert is not None:
            self._converts[topic.name] = convert

    # what can be asked of it ----------------------------------------------------------------

    @property
    def bag(self) -> Bag:
        return self._bag

    @property
    def rate(self) -> float:
        return self._timeline.rate

    @property
    def position(self) -> float:
        with self._changed:
            return self._timeline.position(self._now_ns())

    def prepare(self) -> None:
        """Wait until nobody else publishes the bag's topics; raise Misuse that names who does.

        From then on the bag's trajectories can be fetched.
        """
        deadline = time.monotonic() + LEAVE_TIMEOUT_S
        while others := self._others():
            if time.monotonic() > deadline:
                topics = list(dict.fromkeys(others.values()))
                raise Misuse(OTHERS_PUBLISH(nodes=list(others), topics=topics))
            time.sleep(POLL_PERIOD_S)
        self._trajectories = ReplayedTrajectories(self._node, self._bag)

    def start(self) -> None:
        """Offer the topics, then begin; subscribers that are there miss nothing."""
        for topic in self._topics:
            depth = LATCHED_DEPTH if topic.latched else DEPTH
            self._publishers[topic.name] = self._streams.create_publisher(
                self._kinds[topic.name], topic.name, profile(topic, depth)
            )
        time.sleep(SETTLE_TIME_S)
        deadline = time.monotonic() + MATCH_TIMEOUT_S
        while not self._matched() and time.monotonic() < deadline:
            time.sleep(POLL_PERIOD_S)
        with self._changed:
            self._jump(self._timeline.position(self._now_ns()))
            self._timeline.play(self._now_ns())
        self._thread.start()

    def pause(self) -> None:
        """Pause: nothing is published any more when this returns."""
        with self._changed:
            self._timeline.pause(self._now_ns())
            self._changed.notify()

    @property
    def standing(self) -> bool:
        with self._changed:
            return self._timeline.standing

    def resume(self, until: float = math.inf, arrived: Callable[[], None] | None = None) -> None:
        """Play on; pause at `until`, s, and call `arrived` in the replay's thread."""
        with self._changed:
            self._timeline.play(self._now_ns(), until)
            self._at_stop = arrived
            self._changed.notify()

    def seek(self, position: float) -> None:
        """Go to `position`, s; raise BadInput where it is outside."""
        with self._changed:
            self._jump(checked_position(position, self._timeline.duration))
            # After the jump: the time that it takes is no part of the session.
            self._timeline.seek(self._now_ns(), position)
            self._changed.notify()

    def set_rate(self, rate: float) -> None:
        with self._changed:
            self._timeline.set_rate(self._now_ns(), rate)
            self._changed.notify()

    def set_loop(self, loop: bool) -> None:
        with self._changed:
            self._timeline.loop = loop

    def close(self) -> None:
        """End, and take the topics out of the graph."""
        trajectories, self._trajectories = self._trajectories, None
        if trajectories is not None:
            trajectories.close()
        with self._changed:
            self._stopped = True
            self._changed.notify()
        if self._thread.is_alive() and self._thread is not threading.current_thread():
            self._thread.join()
        if self._feed is not None:
            self._feed.stop()
        deadline = time.monotonic() + ARRIVAL_TIMEOUT_S
        for publisher in self._publishers.values():
            # Messages that a publisher has not handed over are lost with it.
            left_s = max(deadline - time.monotonic(), 0.0)
            publisher.wait_for_all_acked(Duration(seconds=left_s))
            self._streams.destroy_publisher(publisher)
        self._publishers.clear()

    # its thread -----------------------------------------------------------------------------

    def _others(self) -> dict[str, str]:
        """Return a topic of the bag that each other node publishes."""
        own = self._streams.get_name()
        found: dict[str, set[str]] = {}
        for name in self._names:
            if self._streams.count_publishers(name):
                for end in self._streams.get_publishers_info_by_topic(name):
                    if end.node_name != own:
                        who = f"{end.node_namespace.rstrip('/')}/{end.node_name}"
                        found.setdefault(who, set()).add(name)
        return {who: min(names) for who, names in sorted(found.items())}

    def _matched(self) -> bool:
        return all(
            publisher.get_subscription_count() >= self._streams.count_subscribers(name)
            for name, publisher in self._publishers.items()
        )

    def _jump(self, position: float) -> None:
        """Publish the latched state at `position`, s, and continue from there."""
        place_ns = self._bag.start_ns + round(position * SECOND)
        # Read first: where a damaged bag cannot be read, the replay continues where it is.
        present = self._bag.newest_before(place_ns, self._state_names)
        if self._feed is not None:
            self._feed.stop()
        self._ready.clear()
        for message in present:
            self._publish(message)
        self._feed = Feed(self._bag, place_ns, self._names)

    def _run(self) -> None:
        trouble = None
        try:
            going = True
            while going:
                with self._changed:
                    while self._arrived is None and (going := not self._stopped and self._step()):
                        pass
                    arrived, self._arrived = self._arrived, None
                if arrived is not None:
                    arrived()
        except Exception as error:
            path = str(self._bag.path)
            looking = (Fix(command=f"mrlab bag info {for_shell([path])}"),)
            trouble = (
                error.diagnostic
                if isinstance(error, LabError)
                else REPLAY_BROKE(path=path, problem=repr(error), fixes=looking)
            )
        if not self._stopped:
            self._on_end(trouble)

    def _step(self) -> bool:
        """Publish what is due or wait for it; return False once the end is reached."""
        timeline = self._timeline
        if timeline.standing:
            self._changed.wait()
            return True
        if not self._ready:
            assert self._feed is not None
            batch = self._feed.next()
            if batch is None:
                return self._reach_end()
            self._ready.extend(batch)
        now_ns, due_ns = self._now_ns(), self._due_ns(self._ready[0])
        stop_ns = timeline.stop_ns
        if stop_ns is not None:
            now_ns = min(now_ns, stop_ns)
            if now_ns == stop_ns < due_ns:
                timeline.pause(now_ns)
                self._arrived = self._at_stop
                return True
            due_ns = min(due_ns, stop_ns)
        if due_ns > now_ns:
            self._changed.wait((due_ns - now_ns) / SECOND)
            return True
        for _ in range(min(BURST, len(self._ready))):
            if self._due_ns(self._ready[0]) > now_ns:
                break
            self._publish(self._ready.popleft())
        # Lets a waiting command run.
        self._changed.wait(0)
        return True

    def _reach_end(self) -> bool:
        # A bag without duration would loop without end in one moment.
        if not self._timeline.loop or self._timeline.duration == 0:
            return False
        self._jump(0.0)
        self._timeline.seek(self._now_ns(), 0.0)
        return True

    def _due_ns(self, message: Message) -> int:
        return self._timeline.due_ns((message.log_time_ns - self._bag.start_ns) / SECOND)

    def _publish(self, message: Message) -> None:
        convert = self._converts.get(message.topic)
        data = message.data if convert is None else convert(message.data)
        self._publishers[message.topic].publish(data)
        self.messages += 1


def _of_lab(lab: str, kind: Any, convert: Convert | None) -> Convert:
    """Return what gives a message of type `kind` the id of a lab, where it has another's."""

    def change(data: bytes) -> bytes:
        data = data if convert is None else convert(data)
        message = deserialize_message(data, kind)
        if message.lab in ("", lab):
            return data
        message.lab = lab
        changed: bytes = serialize_message(message)
        return changed

    return change


class ReplayedTrajectories:
    """Offers /converter/get on `node`, from the attachments of `bag`, until close()."""

    def __init__(self, node: Node, bag: Bag) -> None:
        self._node = node
        self._bag = bag
        self._service = create_service(node, srv.GetTrajectory, "/converter/get", self._get)

    def close(self) -> None:
        self._node.destroy_service(self._service)

    def get_logger(self) -> Any:
        return self._node.get_logger()

    @answered
    def _get(
        self, request: srv.GetTrajectory.Request, response: srv.GetTrajectory.Response
    ) -> Diagnostic:
        name = trajectory_name(request.id)
        try:
            found = self._bag.attachment(name)
        except BadInput:
            # the only version that was recorded has the id alone for a name
            whole, at, _ = request.id.rpartition("@")
            if not at:
                raise
            found = self._bag.attachment(trajectory_name(whole))
        trajectory = parse(found.data, name)
        response.trajectory = trajectories.trajectory_to_message(
            trajectory, request.begin, request.count
        )
        return BAG_TRAJECTORY(trajectory=request.id, bag=self._bag.path.name)
