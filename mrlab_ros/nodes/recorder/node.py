"""The recorder node: offers the recorder to the graph, and the graph's topics to the recorder."""

from __future__ import annotations

import time
from collections.abc import Callable, Sequence
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any

from diagnostic_msgs.msg import DiagnosticArray
from mrlab_msgs import msg, srv
from mrlab_msgs.srv import ListBags, SetLoop, Trigger

from mrlab_ros.adapters.bags.reader import default_folder
from mrlab_ros.adapters.bags.writer import BagWriter
from mrlab_ros.adapters.journal_file import Journal
from mrlab_ros.adapters.stop_orders import StopOrders
from mrlab_ros.app.recorder.ports import Settings, Status
from mrlab_ros.app.recorder.recorder import Recorder
from mrlab_ros.core.base.diagnostic import Diagnostic, Severity
from mrlab_ros.core.base.errors import LabError
from mrlab_ros.core.recording.metadata import GAP, BagFacts, Gap
from mrlab_ros.core.recording.recorder import ReplayTimeline
from mrlab_ros.core.recording.stops import Stop
from mrlab_ros.core.recording.topics import Split, Topics
from mrlab_ros.messages import qos
from mrlab_ros.messages.definitions import definition
from mrlab_ros.messages.status import recorder_state_to_message, stops_to_message
from mrlab_ros.nodes import parameters
from mrlab_ros.nodes.parameters import RecorderParameters
from mrlab_ros.nodes.recorder.attachments import versions
from mrlab_ros.nodes.recorder.recording import Recording
from mrlab_ros.nodes.recorder.replaying import Replaying
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
        self._state = self.create_publisher(msg.RecorderState, "~/state", qos.LATCHED)
        self._stops = self.create_publisher(DiagnosticArray, "~/stops", qos.LATCHED)
        state_dir = self.parameters.state_dir
        self._journal = Journal.of(state_dir, self.get_name(), self.get_logger().error)
        self.recorder = Recorder(
            self,
            self._journal,
            StopOrders(state_dir),
            self._settings,
            self._log,
            self.parameters.lab_id,
        )
        self._offer_services()
        every(self, 1.0, self.recorder.carry_out_orders)
        every(self, 0.25, self.recorder.discover)
        self.recorder.recover()

    @property
    def lost(self) -> list[Diagnostic]:
        return self.recorder.lost

    @property
    def failed(self) -> list[Diagnostic]:
        return self.recorder.failed

    def destroy_node(self) -> None:
        """Close what is written, end what is replayed."""
        try:
            self.recorder.close()
        except LabError as error:
            self.get_logger().error(str(error))
        self._journal.close()
        self._caller.close()
        self._streams.destroy_node()
        super().destroy_node()

    def _settings(self) -> Settings:
        chosen = self.parameters.bag_dir
        folder = Path(chosen).expanduser() if chosen else default_folder()
        return Settings(folder, self.parameters.topics, self.parameters.split_size * MEGABYTE)

    def _log(self, said: Diagnostic) -> None:
        if self.context.ok():
            # rclpy ties a level to the line of a call.
            if said.severity is Severity.INFO:
                self.get_logger().info(str(said))
            elif said.severity is Severity.WARNING:
                self.get_logger().warning(str(said))
            else:
                self.get_logger().error(str(said))

    # what the recorder offers -----------------------------------------------------------------

    def _offer_services(self) -> None:
        recorder = self.recorder
        acts: dict[str, tuple[Any, Callable[[Any, Any], Diagnostic | None]]] = {
            "start": (srv.StartRecording, self._start),
            "stop": (Trigger, lambda *_: recorder.stop()),
            "split": (Trigger, lambda *_: recorder.split()),
            "list_bags": (ListBags, self._list_bags),
            "replay": (srv.Replay, lambda r, _: recorder.replay(r.bag, r.rate, r.start, r.loop)),
            "pause": (Trigger, lambda *_: recorder.pause()),
            "resume": (Trigger, lambda *_: recorder.resume()),
            "next_stop": (Trigger, lambda *_: recorder.next_stop()),
            "previous_stop": (Trigger, lambda *_: recorder.previous_stop()),
            "seek": (srv.Seek, lambda request, _: recorder.seek(request.position)),
            "set_rate": (srv.SetRate, lambda request, _: recorder.set_rate(request.rate)),
            "set_loop": (SetLoop, lambda request, _: recorder.set_loop(request.loop)),
        }
        for name, (kind, act) in acts.items():
            self._offer(kind, name, act)

    def _offer(self, kind: Any, name: str, act: Callable[[Any, Any], Diagnostic | None]) -> None:
        """Create a service; act(request, response) returns what its answer says."""

        def answer(_: RecorderNode, request: Any, response: Any) -> Diagnostic | None:
            return act(request, response)

        answer.__name__ = name
        create_service(self, kind, f"~/{name}", partial(answered(answer), self))

    def _start(
        self, request: srv.StartRecording.Request, response: srv.StartRecording.Response
    ) -> Diagnostic:
        said = self.recorder.start(request.bag, tuple(request.topics), request.split_duration)
        response.bag = str(said.values["folder"])
        return said

    def _list_bags(self, request: ListBags.Request, response: ListBags.Response) -> None:
        response.bags = self.recorder.bags()

    # what the recorder needs ------------------------------------------------------------------

    def record(
        self,
        folder: Path,
        topics: Topics,
        split: Split,
        on_trouble: Callable[[LabError], None],
        after: BagFacts | None = None,
        gap: Gap | None = None,
    ) -> Recording:
        """Make a bag, or continue one: app.recorder.Streams."""
        writer = BagWriter(folder, definition, versions(), after=after)
        if gap is None:
            writer.note("mrlab", writer.facts.custom)
        else:
            writer.note(GAP, gap.note())
        return Recording(self._streams, self._caller, writer, topics, split, on_trouble, self._log)

    def replay(
        self,
        path: Path,
        rate: float,
        start: float,
        loop: bool,
        on_end: Callable[[Diagnostic | None], None],
    ) -> Replaying:
        """Open a bag: app.recorder.Streams."""
        from mrlab_ros.adapters.bags.other import open_bag  # 4 MB that a recording does not need

        bag = open_bag(path, definition)
        timeline = ReplayTimeline(bag.duration, rate, start, loop)
        return Replaying(self, self._streams, bag, timeline, on_end, lab=self.parameters.lab_id)

    def publish(self, status: Status) -> None:
        """Publish what the recorder does: app.recorder.Streams."""
        facts = {**vars(status)}
        state, trouble = facts.pop("state"), facts.pop("trouble")
        message = recorder_state_to_message(
            time.time_ns(), state.announced.value, trouble, **facts
        )
        self._send(self._state, message)

    def publish_stops(self, stops: Sequence[Stop]) -> None:
        """Publish the stops of what is replayed: app.recorder.Streams."""
        self._send(self._stops, stops_to_message(time.time_ns(), stops))

    def _send(self, publisher: Any, message: Any) -> None:
        try:
            publisher.publish(message)
        except Exception:
            # A replay may end while the lab is shutting down.
            if self.context.ok():
                raise
