"""A recording of a running lab, and the order to end one that outlives its recorder."""

from __future__ import annotations

import asyncio
from pathlib import Path
from types import TracebackType
from typing import Any

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

    def to_dataframe(self) -> Any:
        """Return a pandas.DataFrame of the joint states that the bag holds so far.

        A column ROBOT/JOINT, rad or m, by the lab's time, s; NaN where a row is another robot's.
        Raises BadInput where the bag cannot be read here, Misuse without pandas.
        """
        from mrlab_ros.adapters.bags.motion import read_motion  # it loads numpy
        from mrlab_ros.adapters.bags.reader import Bag
        from mrlab_ros.adapters.data_frame import data_frame

        bag, rows = Bag(self.bag), []
        for name, robot in read_motion(bag).robots.items():
            columns = [f"{name}/{joint}" for joint in robot.joints]
            for time, values in zip(robot.track.times, robot.track.values, strict=True):
                rows.append((bag.start_ns * 1e-9 + time, dict(zip(columns, values, strict=True))))
        rows.sort(key=lambda row: row[0])
        return data_frame([values for _, values in rows], [time for time, _ in rows])

    async def __aenter__(self) -> Recording:
        return self

    async def __aexit__(self, *_: object) -> None:
        await asyncio.to_thread(self.stop)

    def __enter__(self) -> Recording:
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        self.stop()
