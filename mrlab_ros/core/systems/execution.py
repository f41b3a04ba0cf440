"""The execution of a robot system: its state, its clock, and the orders that move its members.

`RobotSystem` takes commands and reports; here is what they have the members do, and what time
makes due.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterable, Iterator, Sequence
from contextlib import contextmanager

from mrlab_ros.core.base.clock import SECOND, PlaybackClock
from mrlab_ros.core.base.diagnostic import Diagnostic
from mrlab_ros.core.base.errors import LabError, Unreached
from mrlab_ros.core.base.state_machine import Machine
from mrlab_ros.core.playback import diagnostics as playback
from mrlab_ros.core.playback.states import MOVING, State
from mrlab_ros.core.systems import diagnostics as say
from mrlab_ros.core.systems.claims import Claims
from mrlab_ros.core.systems.line import Line
from mrlab_ros.core.systems.members import Command, Fleet, Order
from mrlab_ros.core.systems.orders import RETRY_TIMEOUT_S, Orders
from mrlab_ros.core.systems.states import ACTIVE, TABLE, Policy, SystemEvent, SystemState, reason
from mrlab_ros.core.systems.timeline import Member, Mode, Timeline

# A common start lies this far ahead, so that every member has its order in time, s.
START_LEAD_S = 0.1
# A member receives its PLAY order this long before its start, s: until then the start can still
# change.
ORDER_HORIZON_S = 0.3
# A staging that takes this much longer than planned has failed, s.
STAGING_TIMEOUT_S = 5.0
# Positions that differ by less are one, s.
SAME_PLACE = 1e-12


class SystemExecution:
    """Moves the members of a system along one timeline.

    message: why the system is in its state; None: nothing is to say.
    clock: the position on the timeline at any time. rate: the speed it plays at, negative: from
    the end of the timeline to its start, with no member waiting for anything.
    loop: whether it starts over after its end.
    """

    def __init__(
        self,
        name: str,
        members: Iterable[Member],
        fleet: Fleet,
        mode: Mode = Mode.PARALLEL,
        policy: Policy = Policy.HALT_ALL,
        loop: bool = False,
        announce: Callable[[], None] = lambda: None,
    ) -> None:
        """Make a system whose members prepare() claims.

        announce: called when state, message or waits have changed by a report or by time; what a
        command changes is announced by its caller.
        """
        self.name = name
        self.policy = policy
        self.loop = loop
        self.message: Diagnostic | None = None
        self.clock = PlaybackClock()
        self.rate = 1.0
        self._timeline = Timeline(members, mode)
        self._claims = Claims(fleet, self._timeline)
        self._announce = announce
        self._machine = Machine(TABLE, reason)
        self._orders = Orders(fleet, self._timeline, self._fail)
        self._line = Line(self._timeline)
        self._staged_by_ns = 0
        # Robots that were lost last, and those whose process ended or froze and is not back.
        self._silent: list[str] = []
        self._down: list[str] = []

    # what it is -----------------------------------------------------------------------------

    @property
    def state(self) -> SystemState:
        """The state of the system."""
        return self._machine.state

    @property
    def active(self) -> bool:
        """Return whether members move, so that time makes something due: call poll() often."""
        return self.state in ACTIVE

    @property
    def members(self) -> dict[str, Member]:
        """The members by robot, in order of their turns."""
        return self._timeline.members

    @property
    def mode(self) -> Mode:
        """How the members share the timeline."""
        return self._timeline.mode

    @property
    def duration(self) -> float:
        """The length of the timeline, s."""
        return self._timeline.duration

    # inside: states -------------------------------------------------------------------------

    @contextmanager
    def _announcing(self) -> Iterator[None]:
        """Announce, at the end of the block, what has changed in it."""
        before = self._announced()
        try:
            yield
        finally:
            if self._announced() != before:
                self._announce()

    def _announced(self) -> tuple[object, ...]:
        waits = [wait.text if (wait := m.waiting_for) else "" for m in self._timeline]
        return self.state, self.message, waits

    def _stage(self, now_ns: int, event: SystemEvent) -> float:
        """Start the staging with `event`; return how long it takes, s."""
        self._machine.check(event)
        self._claims.revive()
        if self.state is not SystemState.PAUSED:
            self._rewind(now_ns)
        self._line_up(now_ns)
        self._machine.fire(event)
        self.message = say.STAGES()
        orders = [
            Order(m.robot, Command.STAGE, position=self._line.place(m, self.clock.position))
            for m in self._timeline
            if not m.done
        ]
        replies = self._orders.drive(now_ns, orders)
        longest = max((reply.duration for reply in replies), default=0.0)
        self.message = say.STAGES(duration=longest or None)
        # Members that were loaded first got their orders later than now.
        ordered_ns = max([now_ns, *(reply.stamp_ns for reply in replies)])
        self._staged_by_ns = ordered_ns + round((longest + STAGING_TIMEOUT_S) * SECOND)
        self._start_when_staged(now_ns)
        return longest

    def _start_when_staged(self, now_ns: int) -> None:
        """Start the clock once every member is in place, where the system waits for that."""
        in_place = all(m.done or m.playback_state is State.PAUSED for m in self._timeline)
        if not in_place or self._machine.ignores(SystemEvent.STAGED):
            return
        self._machine.fire(SystemEvent.STAGED)
        self._start(now_ns)

    def _start(self, now_ns: int) -> None:
        self.message = None
        self._line.leave()
        start_ns = now_ns + round(START_LEAD_S * SECOND)
        self.clock = PlaybackClock(start_ns, self.clock.position, self.rate)
        self._order_due(now_ns)

    def _clear(self) -> None:
        """Leave a halt once no member is halted any more."""
        halted = any(m.playback_state is State.COLLISION_HALT for m in self._timeline)
        if halted or self._machine.ignores(SystemEvent.CLEAR):
            return
        self._machine.fire(SystemEvent.CLEAR)
        self.message = playback.CLEAR_AGAIN()

    def _fail(self, now_ns: int, orders: Sequence[Order], error: LabError) -> None:
        """Let all stand in place where a member did not answer; where one refused, end the run.

        Members that did not answer are lost until they report themselves.
        """
        if not isinstance(error, Unreached) or self._machine.ignores(SystemEvent.LOSE):
            self._come_to_rest(now_ns, SystemEvent.ABORT, error.diagnostic)
            return
        self._machine.fire(SystemEvent.LOSE)
        setting_out = {o.robot for o in orders if o.command in (Command.STAGE, Command.PLAY)}
        lost = self._stand(now_ns, None, setting_out, RETRY_TIMEOUT_S)
        self._silent = [m.robot for m in lost]
        self.message = say.MEMBERS_SILENT(robots=self._silent)

    def _stand(
        self,
        now_ns: int,
        at_ns: int | None = None,
        setting_out: Collection[str] = (),
        timeout: float | None = None,
    ) -> list[Member]:
        """Let the timeline and all members that move stand in place; return those lost.

        at_ns: as they were then; None: now. setting_out: robots that may move as well. timeout: as
        Fleet.reach() takes it.
        """
        self._stop_clock(now_ns, now_ns if at_ns is None else at_ns)
        moving = [
            m for m in self._timeline if m.playback_state in MOVING or m.robot in setting_out
        ]
        lost = self._orders.pause(moving, timeout)
        self._line_up(now_ns)
        self._clear()
        return lost

    def _stop_clock(self, now_ns: int, at_ns: int) -> None:
        """Let the timeline stand where it was at `at_ns`, at the last joint states before that."""
        position = self._position(at_ns)
        if self.clock.rate:
            self._line.stand(position, self.clock.rate)
        for member in self._timeline:
            member.ordered = False
        self.clock = PlaybackClock(now_ns, position, 0.0)

    def _line_up(self, now_ns: int) -> None:
        """Let the timeline stand where the member furthest behind stands."""
        if self.state is SystemState.STAGING:
            return
        position = self._line.position(self.clock.position)
        if abs(position - self.clock.position) > SAME_PLACE:
            self.clock = PlaybackClock(now_ns, position, 0.0)

    def _come_to_rest(self, now_ns: int, event: SystemEvent, why: Diagnostic) -> None:
        """Stop every member after something failed; the next play begins at the start."""
        self._machine.fire(event)
        self.message = why
        # A member that did not answer has had its time already.
        self._stop_members(now_ns, list(self._timeline), RETRY_TIMEOUT_S)
        self._rewind(now_ns)

    def _stop_members(
        self, now_ns: int, members: Sequence[Member], timeout: float | None = None
    ) -> None:
        """Stop all members; STOPPING until each has answered."""
        stranded = self._orders.stop(now_ns, members, timeout)
        if stranded:
            # In a collision halt the system waits for its members anyway.
            if self._machine.can(SystemEvent.STRAND):
                self._machine.fire(SystemEvent.STRAND)
            names = [m.robot for m in stranded]
            self.message = say.MAY_STILL_MOVE(why=self.message, robots=names)
        elif not self._machine.ignores(SystemEvent.REST):
            self._machine.fire(SystemEvent.REST)

    def _finish(self, now_ns: int) -> None:
        """End the run: READY, or the next round where it loops."""
        self.clock = PlaybackClock(now_ns, self._timeline.last, 0.0)
        self._machine.fire(SystemEvent.FINISH)
        self.message = playback.PLAYED_BACK() if self.rate < 0 else playback.PLAYED_TO_END()
        # COMPLETE lasts no longer than its announcement.
        self._announce()
        if not self.loop:
            self._machine.fire(SystemEvent.REARM)
            self._rewind(now_ns)
            return
        try:
            self._stage(now_ns, SystemEvent.REPEAT)
        except LabError as error:
            if self.state is SystemState.COMPLETE:
                # No member was reached; otherwise all were brought to rest already.
                self._come_to_rest(now_ns, SystemEvent.ABORT, error.diagnostic)
            raise

    # inside: members ------------------------------------------------------------------------

    def _rewind(self, now_ns: int) -> None:
        self._timeline.rewind()
        self._line.leave()
        self.clock = PlaybackClock(now_ns, self._timeline.first, 0.0)

    def _position(self, now_ns: int) -> float:
        """Return the position on the timeline, s; never past its ends."""
        return min(max(self.clock.at(now_ns), 0.0), self.duration)

    def _freeze(self, now_ns: int) -> None:
        """Let the timeline and every moving member stand."""
        self._stop_clock(now_ns, now_ns)
        moving = [m for m in self._timeline if m.playback_state in MOVING]
        self._orders.drive(now_ns, [Order(m.robot, Command.PAUSE) for m in moving])
        self._line_up(now_ns)

    def _split_ordered(self, position: float) -> tuple[list[Member], list[Member]]:
        """Return the ordered members that have begun by `position` (s), and the others."""
        ordered = self._timeline.ordered
        begun = [
            (m.start + m.position - position) * (-1 if self._timeline.backwards else 1)
            <= SAME_PLACE
            for m in ordered
        ]
        running = [m for m, here in zip(ordered, begun, strict=True) if here]
        return running, [m for m, here in zip(ordered, begun, strict=True) if not here]

    # inside: time ---------------------------------------------------------------------------

    def _poll(self, now_ns: int) -> None:
        if self.state is SystemState.STOPPING:
            if self._orders.retry(now_ns):
                self._machine.fire(SystemEvent.REST)
                self.message = say.ALL_STAND()
            return
        if self.state is SystemState.STAGING and now_ns > self._staged_by_ns:
            late = [m.robot for m in self._timeline if m.playback_state is State.ADJUSTING]
            self._come_to_rest(now_ns, SystemEvent.ABORT, say.LATE_AT_START(robots=late))
        if self.state is not SystemState.PLAYING:
            return
        changed = self._timeline.meet_waits(self.clock.at(now_ns))
        self._orders.drive(now_ns, [Order(m.robot, Command.HOLD, until=m.until) for m in changed])
        self._order_due(now_ns)
        if self._timeline.complete:
            self._finish(now_ns)

    def _order_due(self, now_ns: int) -> None:
        """Send PLAY to those members whose start lies within the horizon."""
        if self.state is not SystemState.PLAYING:
            return
        orders = []
        horizon_ns = now_ns + round(ORDER_HORIZON_S * SECOND)
        for member in self._timeline.known_starts():
            due_ns = self.clock.due(member.start + member.position)
            if member.ordered or due_ns > horizon_ns:
                continue
            if due_ns < now_ns:
                # It was held: its share begins later than it was laid out.
                due_ns = now_ns + round(START_LEAD_S * SECOND)
                self._timeline.shift(member, self.clock.at(due_ns) - member.position)
            member.ordered = True
            orders.append(
                Order(member.robot, Command.PLAY, due_ns, member.position, self.rate, member.until)
            )
        self._orders.drive(now_ns, orders)
