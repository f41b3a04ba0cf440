"""A recording of a running lab, and the order to end one that outlives its recorder."""

from __future__ import annotations

from pathlib import Path
from types import TracebackType

from mrlab_msgs.srv import Trigger

from mrlab_ros.adapters.stop_orders import StopOrders
from mrlab_ros.core.recording.diagnostics import STOP_LEFT
from mrlab_ros.processes.run_file import RunFile
from mrlab_ros.ros.calls import NoAnswer
from mrlab_ros.ros.graph import GraphClient

STOP_RECORDING_TIMEOUT_S = 30.0


def leave_stop(domain: int, bag: str) -> bool:
    """Leave the order to end the recording into `bag` with the lab; return whether it waits."""
    facts = RunFile(domain).read() or {}
    return StopOrders(facts.get("state_dir", "")).leave(bag)


class Recording:
    """A recording that runs. bag: its folder."""

    def __init__(self, graph: GraphClient, bag: str) -> None:
        self._graph = graph
        self.bag = Path(bag)

    def stop(self) -> str:
        """End it; return what the recorder says of the bag.

        Where no recorder answers, the next one ends it: then that is returned.
        """
        try:
            answer = self._graph.order(
                Trigger, "/recorder/stop", Trigger.Request(), STOP_RECORDING_TIMEOUT_S
            )
        except NoAnswer:
            if not leave_stop(self._graph.domain, str(self.bag)):
                raise
            return str(STOP_LEFT(bag=str(self.bag)))
        return str(answer.message)

    def __enter__(self) -> Recording:
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        self.stop()
