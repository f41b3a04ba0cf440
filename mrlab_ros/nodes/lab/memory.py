"""What the lab's own nodes forget while they stand aside for a replay, and how it comes back.

Robots, objects and trajectories heal from the state folder. What each robot had loaded, and the
systems, are known to nobody after that: this keeps them.
"""

from __future__ import annotations

import threading
import time
from collections.abc import Callable
from functools import partial
from typing import Any

from mrlab_msgs import msg, srv
from std_srvs.srv import SetBool

from mrlab_ros.core.errors import LabError
from mrlab_ros.messages import qos
from mrlab_ros.ros.calls import call
from mrlab_ros.ros.spinning import Caller

# How long latched state may take to arrive, and the lab to be back, s.
HEAR_TIMEOUT = 3.0
BACK_TIMEOUT = 20.0
LOAD_TIMEOUT = 15.0


class LabRestore:
    """Keeps what robots have loaded, and the systems, from remember() to restore()."""

    def __init__(self, caller: Caller, warn_once: Callable[[str], None]) -> None:
        self._caller = caller
        self._complain = warn_once
        self._states: dict[str, Any] = {}
        self._systems: list[Any] = []
        self._thread: threading.Thread | None = None
        self._closed = threading.Event()

    def close(self) -> None:
        """Give up what restore() began. Its calls may wait for answers that never come."""
        self._closed.set()

    def remember(self) -> None:
        """Hear how things are. Nothing to remember where no lab tells its robots."""
        self.wait()
        self._states.clear()
        self._systems.clear()
        node = self._caller.node
        if not node.count_publishers("/robots"):
            return
        robots = self._hear([(msg.Robots, "/robots")])
        names = [robot.name for message in robots for robot in message.robots]
        topics = [(msg.PlaybackState, f"/{name}/playback_state") for name in names]
        for state in self._hear(topics):
            if state.trajectory_id:
                self._states[state.header.frame_id] = state
        for message in self._hear([(msg.RobotSystems, "/systems")]):
            self._systems = list(message.systems)

    def restore(self) -> None:
        """Bring it back, in a thread of its own: the lab takes a moment to be there again."""
        if self._states or self._systems:
            self._thread = threading.Thread(target=self._restore, name="restore", daemon=True)
            self._thread.start()

    def wait(self) -> None:
        """Wait until what restore() began is done."""
        if self._thread is not None:
            self._thread.join()
            self._thread = None

    def _hear(self, topics: list[tuple[Any, str]]) -> list[Any]:
        """Return the newest message of each latched topic that somebody tells."""
        heard: dict[str, Any] = {}
        node = self._caller.node
        told = [(kind, topic) for kind, topic in topics if node.count_publishers(topic)]
        subscriptions = [
            node.create_subscription(kind, topic, partial(heard.__setitem__, topic), qos.LATCHED)
            for kind, topic in told
        ]
        deadline = time.monotonic() + HEAR_TIMEOUT
        while len(heard) < len(told) and time.monotonic() < deadline:
            time.sleep(0.02)
        for subscription in subscriptions:
            node.destroy_subscription(subscription)
        return list(heard.values())

    def _restore(self) -> None:
        driven = {member.robot for system in self._systems for member in system.members}
        for robot, state in self._states.items():
            if robot not in driven:
                self._guarded(robot, partial(self._load, robot, state))
        for system in self._systems:
            self._guarded(system.name, partial(self._create, system))

    def _guarded(self, what: str, work: Callable[[], None]) -> None:
        if self._over():
            return
        try:
            work()
        except Exception as error:
            # What fails because the recorder ends beneath it is no trouble.
            if not self._over():
                why = str(error) if isinstance(error, LabError) else repr(error)
                self._complain(f"{what} is not as it was before the replay: {why}")

    def _over(self) -> bool:
        return self._closed.is_set() or not self._caller.node.context.ok()

    def _hear_again(self, kind: Any, topic: str) -> Any:
        """Return the newest message of a latched topic, once the lab is there to tell it."""
        deadline = time.monotonic() + BACK_TIMEOUT
        while not (heard := self._hear([(kind, topic)])):
            if self._closed.wait(0.05) or time.monotonic() > deadline:
                raise LabError(f"nobody tells {topic}; mrlab status shows what runs")
        return heard[0]

    def _load(self, robot: str, state: Any) -> None:
        now = self._hear_again(msg.PlaybackState, f"/{robot}/playback_state")
        if now.state != msg.PlaybackState.IDLE:
            # It never stood aside.
            return
        request = srv.LoadTrajectory.Request(id=state.trajectory_id)
        self._order(srv.LoadTrajectory, f"/{robot}/load", request)
        if state.rate != 1.0:
            self._order(srv.SetRate, f"/{robot}/set_rate", srv.SetRate.Request(rate=state.rate))
        if state.loop:
            self._order(SetBool, f"/{robot}/set_loop", SetBool.Request(data=True))
        if state.clock.position:
            place = min(max(state.clock.position, 0.0), state.duration)
            self._order(srv.Seek, f"/{robot}/seek", srv.Seek.Request(position=place))

    def _create(self, system: Any) -> None:
        now = self._hear_again(msg.RobotSystems, "/systems")
        if system.name in {present.name for present in now.systems}:
            return
        request = srv.CreateSystem.Request(
            name=system.name,
            members=system.members,
            mode=system.mode,
            policy=system.policy,
            loop=system.loop,
        )
        self._order(srv.CreateSystem, "/coordinator/create_system", request)

    def _order(self, kind: Any, service: str, request: Any) -> None:
        client = self._caller.node.create_client(kind, service)
        try:
            client.wait_for_service(timeout_sec=BACK_TIMEOUT)
            answer = call(client, request, LOAD_TIMEOUT)
        finally:
            self._caller.node.destroy_client(client)
        if not answer.success:
            raise LabError(answer.message)
