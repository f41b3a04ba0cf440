"""The orders of a robot system to its members, with retries to those that do not answer."""

from __future__ import annotations

from collections.abc import Callable, Sequence

from mrlab_ros.core.base.clock import SECOND
from mrlab_ros.core.base.errors import LabError
from mrlab_ros.core.playback.states import State
from mrlab_ros.core.systems.members import Command, Fleet, Order, Reply
from mrlab_ros.core.systems.timeline import Member, Timeline

# A member that was not reached is asked again this often, and given this time to answer, s.
RETRY_PERIOD_S = 1.0
RETRY_TIMEOUT_S = 0.5


class Orders:
    """Sends orders to the members of a timeline and takes their replies.

    failed: called with the time, the orders and the error where a member refuses an order of
    drive() or does not answer; the error is raised afterwards.
    stranded: members that did not answer when they were to stop; they may still move.
    """

    def __init__(
        self,
        fleet: Fleet,
        timeline: Timeline,
        failed: Callable[[int, Sequence[Order], LabError], None],
    ) -> None:
        self._fleet = fleet
        self._timeline = timeline
        self._failed = failed
        self.stranded: list[Member] = []
        self._retry_ns = 0

    def drive(self, now_ns: int, orders: Sequence[Order]) -> list[Reply]:
        """Send the orders; raise the error of the first that fails."""
        if not orders:
            return []
        try:
            replies = self._fleet.drive(orders)
        except LabError as error:
            self._failed(now_ns, orders, error)
            raise
        for order, reply in zip(orders, replies, strict=True):
            _take(reply, self._timeline.members[order.robot])
        return replies

    def withdraw(self, now_ns: int, members: Sequence[Member]) -> None:
        """Take back the PLAY orders of members whose start lies ahead."""
        self.drive(now_ns, [Order(m.robot, Command.PAUSE) for m in members])
        for member in members:
            member.ordered = False

    def pause(self, members: Sequence[Member], timeout: float | None = None) -> list[Member]:
        """Pause each member by itself; return those that did not answer: they are lost."""
        return self._reach(members, Command.PAUSE, timeout)

    def stop(
        self, now_ns: int, members: Sequence[Member], timeout: float | None = None
    ) -> list[Member]:
        """Stop all members within one time-out; return the stranded, which retry() asks again."""
        for member in members:
            member.ordered = False
        self.stranded = self._reach(members, Command.STOP, timeout)
        self._retry_ns = now_ns + round(RETRY_PERIOD_S * SECOND)
        return self.stranded

    def forget(self, members: Sequence[Member]) -> None:
        """Stop asking stranded members whose process has ended: they stand."""
        self.stranded = [m for m in self.stranded if all(m is not one for one in members)]

    def leave(self, members: Sequence[Member]) -> None:
        """Leave each frozen member the order to pause; it is carried out when it runs again."""
        self._fleet.leave([Order(m.robot, Command.PAUSE) for m in members])

    def retry(self, now_ns: int) -> bool:
        """Ask the stranded again where that is due; return whether none is left."""
        if now_ns >= self._retry_ns:
            self.stop(now_ns, self.stranded, RETRY_TIMEOUT_S)
        return not self.stranded

    def _reach(
        self, members: Sequence[Member], command: Command, timeout: float | None
    ) -> list[Member]:
        """Order each member by itself; one that does not answer is IDLE until it reports itself.

        Returns those that did not answer.
        """
        replies = self._fleet.reach([Order(m.robot, command) for m in members], timeout)
        silent = []
        for member, reply in zip(members, replies, strict=True):
            if reply is None:
                member.playback_state = State.IDLE
                silent.append(member)
            else:
                _take(reply, member)
        return silent


def _take(reply: Reply, member: Member) -> None:
    member.playback_state, member.position = reply.state, reply.position
    member.replied_ns = reply.stamp_ns
