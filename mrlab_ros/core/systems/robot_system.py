"""Robots that play as one: the commands of a system and the coordination of its members.

A system commands its members through a `Fleet` and takes time as an argument. The timeline is
one clock; each member has a share of it, and the clock pair a member plays by always lies on the
system's line, so members stay together through pauses, seeks and changes of rate.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterable, Iterator, Sequence
from contextlib import contextmanager
from enum import Enum

from mrlab_ros.core.base.clock import SECOND, PlaybackClock, checked_position, checked_rate
from mrlab_ros.core.base.diagnostic import Diagnostic
from mrlab_ros.core.base.errors import LabError, Misuse, Unreached
from mrlab_ros.core.base.state_machine import Machine
from mrlab_ros.core.playback import diagnostics as playback
from mrlab_ros.core.playback.states import MOVING, State
from mrlab_ros.core.systems import diagnostics as say
from mrlab_ros.core.systems.claims import Claims
from mrlab_ros.core.systems.line import Line
from mrlab_ros.core.systems.members import Command, Fleet, Order
from mrlab_ros.core.systems.orders import RETRY_TIMEOUT_S, Orders
from mrlab_ros.core.systems.states import ACTIVE, TABLE, SystemEvent, SystemState, reason
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


class Policy(Enum):
    """Which members a collision of one member halts."""

    HALT_ALL = 0
    HALT_MEMBER = 1


COLLISIONS = {
    Policy.HALT_ALL: SystemEvent.COLLIDE,
    Policy.HALT_MEMBER: SystemEvent.COLLIDE_ALONE,
}


class RobotSystem:
    """A robot system. A refused command raises Misuse or BadInput and changes nothing.

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

    # commands -------------------------------------------------------------------------------

    def check(self) -> None:
        """Raise BadInput where the waits cannot be; the lengths of the members are known."""
        self._timeline.check_waits()

    def prepare(self) -> None:
        """Claim and load every member.

        Raises LabError where one cannot be had; every robot is then as it was before.
        """
        self._claims.prepare()
        self._timeline.lay_out()

    def come_back(self, now_ns: int, position: float, rate: float) -> None:
        """Stand PAUSED at `position` (s) after a restart of the coordinator.

        The members have their shares, trajectories and met waits. Each is claimed again as it
        reports itself, and by the next play.
        """
        self._machine.fire(SystemEvent.RETURN)
        self.rate = rate
        self._timeline.turn(backwards=rate < 0)
        self._timeline.place(position)
        self._line.put()
        self.clock = PlaybackClock(now_ns, min(position, self.duration), 0.0)
        self.message = say.COORDINATOR_RESTARTED()

    def play(self, now_ns: int) -> float:
        """Bring every member to its place, then play; return how long the staging takes, s."""
        return self._stage(now_ns, SystemEvent.STAGE)

    def pause(self, now_ns: int) -> Diagnostic:
        """Pause all members; play continues from there.

        Returns where, and which one does not answer: it is lost until it does.
        """
        self._machine.check(SystemEvent.PAUSE)
        silent: list[str] = []
        try:
            self._freeze(now_ns)
        except Unreached:
            silent = self._silent
        self._machine.fire(SystemEvent.PAUSE)
        at = self.clock.position
        self.message = playback.PAUSED(position=at)
        if silent:
            self.message = say.PAUSED_WITHOUT(position=at, robots=silent)
        return self.message

    def stop(self, now_ns: int) -> None:
        """End the run; the next play begins at the start of the timeline.

        A member that does not answer may still move: the system is STOPPING until it does.
        """
        self._machine.check(SystemEvent.STOP)
        there = [
            m
            for m in self._timeline
            if m.playback_state is not State.IDLE or m in self._orders.stranded
        ]
        self._machine.fire(SystemEvent.STOP)
        self.message = playback.STOPPED()
        self._stop_members(now_ns, there)
        self._rewind(now_ns)

    def seek(self, now_ns: int, position: float) -> None:
        """Go to `position` (s) of the timeline at once; PLAYING plays on from there.

        Members before their share go to their starts, members after it to their ends.
        """
        self._go_to(now_ns, position, SystemEvent.SEEK)

    def step(self, now_ns: int, frames: int) -> float:
        """Step a standing system by frames of its fastest member; return the position, s."""
        self._machine.check(SystemEvent.STEP)
        rate = self._timeline.frame_rate
        frame = round(self.clock.position * rate) + frames
        position = min(max(frame / rate, 0.0), self.duration)
        self._go_to(now_ns, position, SystemEvent.STEP)
        return position

    def set_rate(self, now_ns: int, rate: float) -> None:
        """Set the speed of the timeline, 0.1 to 4 or -4 to -0.1, without a jump.

        A change of direction is refused while the members move to their places.
        """
        checked_rate(rate)
        if (rate < 0) != (self.rate < 0):
            self._turn(now_ns, rate)
            return
        if self.state is SystemState.PLAYING:
            since_ns = max(now_ns, self.clock.stamp_ns)
            running, waiting = self._split_ordered(self.clock.at(now_ns))
            self._orders.withdraw(now_ns, waiting)
            self._orders.drive(
                now_ns,
                [Order(m.robot, Command.SET_RATE, stamp_ns=since_ns, rate=rate) for m in running],
            )
            # Until the tick that notices the end, the clock shows more than the duration.
            self.clock = PlaybackClock(since_ns, self._position(since_ns), rate)
        self.rate = rate
        self._order_due(now_ns)

    def _turn(self, now_ns: int, rate: float) -> None:
        """Go on in the other direction."""
        if self.state is SystemState.STAGING:
            raise Misuse(say.MEMBERS_MOVE_TO_PLACES())
        playing = self.state is SystemState.PLAYING
        if playing:
            self._freeze(now_ns)
        self.rate = rate
        ended = [m for m in self._timeline if m.done]
        self._timeline.turn(backwards=rate < 0)
        self._line_up(now_ns)
        if playing:
            # Their playbacks are ready for another run.
            orders = [
                Order(m.robot, Command.SEEK, position=m.position) for m in ended if not m.done
            ]
            self._orders.drive(now_ns, orders)
            self._start(now_ns)
        elif self.state is SystemState.READY:
            self._rewind(now_ns)

    def set_mode(self, mode: Mode) -> None:
        """Set how the members share the timeline; only while nothing is under way."""
        self._machine.check(SystemEvent.SET_MODE)
        self._timeline.check_circles(mode)
        self._machine.fire(SystemEvent.SET_MODE)
        self._timeline.mode = mode
        self._timeline.lay_out()

    # reports --------------------------------------------------------------------------------

    def member_changed(
        self,
        now_ns: int,
        robot: str,
        state: State,
        position: float,
        stamp_ns: int | None = None,
        owner: str | None = None,
        trajectory_id: str = "",
    ) -> None:
        """Take a member's new state, and let the system follow it.

        stamp_ns: when the member was in that state; one from before its last reply is out of
        date and ignored. None: now. owner: the system that the member obeys; None: this one.
        trajectory_id: what it has loaded. One that came back with its trajectory is claimed again.
        """
        member = self.members[robot]
        if stamp_ns is not None and stamp_ns < member.replied_ns:
            return
        with self._announcing():
            if owner is not None and (owner != self.name or member.playback_state is State.IDLE):
                if owner != self.name or state is State.IDLE:
                    self._lose(now_ns, member)
                if owner in ("", self.name) and trajectory_id == member.trajectory_id:
                    self._take_back(now_ns, member)
                return
            if state is State.IDLE:
                self._lose(now_ns, member)
                self._poll(now_ns)
                return
            before, member.playback_state = member.playback_state, state
            if state is State.COLLISION_HALT:
                if before is not State.COLLISION_HALT:
                    self._collide(now_ns, member)
                member.position = position
                self._line_up(now_ns)
            elif state is State.PAUSED:
                member.position = position
                member.ordered = False
                self._line_up(now_ns)
                self._clear()
                self._start_when_staged(now_ns)
            elif state is State.READY and member.ordered:
                member.ordered, member.done = False, True
                member.position = member.last
            self._poll(now_ns)

    def members_down(
        self, now_ns: int, at_ns: int, robots: Collection[str], process: str, how: str
    ) -> None:
        """Stand as at `at_ns`, when the process that plays `robots` ended or froze.

        how: how it ended, such as SIGKILL; empty: it froze, and orders wait for it.
        """
        lost = [m for m in self._timeline if m.robot in robots]
        with self._announcing():
            for member in lost:
                member.playback_state = State.IDLE
            if how:
                # A process that has ended moves nothing.
                self._orders.forget(lost)
            self._down = [m.robot for m in lost]
            complete = self.state is SystemState.COMPLETE
            if not self._machine.ignores(SystemEvent.LOSE):
                self._machine.fire(SystemEvent.LOSE)
                if complete:
                    self._rewind(now_ns)
                else:
                    self._stand(now_ns, at_ns)
            if not how:
                self._orders.leave(lost)
            said = say.PROCESS_DIED if how else say.PROCESS_FROZE
            at = self.clock.position
            self.message = said(process=process, how=how or None, robots=self._down, position=at)
            self._poll(now_ns)

    def members_run(self, now_ns: int, robots: Collection[str]) -> None:
        """Claim members again whose process was frozen: they may have nothing to report."""
        with self._announcing():
            for member in self._timeline:
                if member.robot in robots and member.playback_state is State.IDLE:
                    self._take_back(now_ns, member)

    def grasped(self, now_ns: int, robot: str, held: str | None) -> None:
        """Take what a robot holds now: an object's name, or None."""
        with self._announcing():
            self._timeline.grasped(robot, held)
            self._poll(now_ns)

    def poll(self, now_ns: int) -> None:
        """Do what time has made due: starts, met waits, the end, a staging that takes too long."""
        with self._announcing():
            self._poll(now_ns)

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

    def _go_to(self, now_ns: int, position: float, event: SystemEvent) -> None:
        """Put the timeline and every member at `position`, s."""
        target = self._machine.check(event)
        checked_position(position, self.duration)
        self._claims.revive()
        if self.state is SystemState.PLAYING:
            self._freeze(now_ns)
        self._line.leave()
        self._timeline.seek(position)
        orders = [Order(m.robot, Command.SEEK, position=m.position) for m in self._timeline]
        try:
            self._orders.drive(now_ns, orders)
        except Unreached:
            if self.state is not SystemState.READY:
                self._timeline.seek(self.clock.position)
                self._line.put()
            raise
        self._line.put()
        self.clock = PlaybackClock(now_ns, position, 0.0)
        self._machine.fire(event)
        self.message = playback.AT_POSITION(position=position)
        if target is SystemState.PLAYING:
            self._start(now_ns)

    def _collide(self, now_ns: int, member: Member) -> None:
        """Halt all members, or let the others go on, as the policy says."""
        event = COLLISIONS[self.policy]
        if self._machine.ignores(event):
            member.ordered = False
            return
        if self._machine.fire(event) is SystemState.COLLISION_HALT:
            self.message = say.MEMBER_COLLIDED(robot=member.robot)
            self._freeze(now_ns)
            return
        member.ordered = False
        self.message = say.OTHERS_GO_ON(robot=member.robot)
        if self.mode is Mode.SEQUENTIAL:
            self._orders.withdraw(now_ns, self._split_ordered(self.clock.at(now_ns))[1])

    def _clear(self) -> None:
        """Leave a halt once no member is halted any more."""
        halted = any(m.playback_state is State.COLLISION_HALT for m in self._timeline)
        if halted or self._machine.ignores(SystemEvent.CLEAR):
            return
        self._machine.fire(SystemEvent.CLEAR)
        self.message = playback.CLEAR_AGAIN()

    def _lose(self, now_ns: int, member: Member) -> None:
        """Stop all: a member was unloaded or joined another system."""
        known, member.playback_state = member.playback_state, State.IDLE
        if known is State.IDLE or self._machine.ignores(SystemEvent.LOSE):
            member.ordered = False
            return
        complete = self.state is SystemState.COMPLETE
        self._machine.fire(SystemEvent.LOSE)
        if complete:
            self.message = say.MEMBER_LOST_AT_END(robot=member.robot)
            self._rewind(now_ns)
            return
        self.message = say.MEMBER_LOST(robot=member.robot)
        self._stand(now_ns)

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

    def _take_back(self, now_ns: int, member: Member) -> None:
        """Claim a member that came back; the next play moves it to its place."""
        state = self._claims.take_back(member)
        self._line_up(now_ns)
        if member.robot in self._down and all(
            m.playback_state is not State.IDLE for m in self._timeline if m.robot in self._down
        ):
            at = self.clock.position
            self.message = say.MEMBERS_BACK(robots=self._down, position=at)
            self._down = []
        if state is State.COLLISION_HALT and self._machine.can(SystemEvent.RETURN_HALTED):
            self._machine.fire(SystemEvent.RETURN_HALTED)
            self.message = say.STILL_COLLIDES(robot=member.robot)

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
