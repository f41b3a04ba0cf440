"""Robots that play as one: the commands of a system and the coordination of its members.

A system commands its members through a `Fleet` and takes time as an argument. The timeline is
one clock; each member has a share of it, and the clock pair a member plays by always lies on the
system's line, so members stay together through pauses, seeks and changes of rate.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from contextlib import contextmanager
from enum import Enum

from mrlab_ros.core.clock import SECOND, PlaybackClock, checked_position, checked_rate
from mrlab_ros.core.errors import LabError, Misuse
from mrlab_ros.core.playback.states import MOVING, State
from mrlab_ros.core.state_machine import Machine
from mrlab_ros.core.systems.members import Command, Fleet, Order, Reply
from mrlab_ros.core.systems.states import ACTIVE, TABLE, SystemEvent, SystemState, reason
from mrlab_ros.core.systems.timeline import Member, Mode, Timeline

# A common start lies this far ahead, so that every member has its order in time, s.
START_LEAD_S = 0.1
# A member receives its PLAY order this long before its start, s: until then the start can still
# change.
ORDER_HORIZON_S = 0.3
# A staging that takes this much longer than planned has failed, s.
STAGING_TIMEOUT_S = 5.0


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

    message: why the system is in its state, for a person; may be empty.
    clock: the position on the timeline at any time. rate: the speed it plays at.
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
        self.message = ""
        self.clock = PlaybackClock()
        self.rate = 1.0
        self._timeline = Timeline(members, mode)
        self._fleet = fleet
        self._announce = announce
        self._machine = Machine(TABLE, reason)
        self._staged_by_ns = 0

    # what it is -----------------------------------------------------------------------------

    @property
    def state(self) -> SystemState:
        """The state of the system."""
        return self._machine.state

    @property
    def active(self) -> bool:
        """Whether members move, so that time makes something due: then call poll() often."""
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

    def prepare(self) -> None:
        """Claim and load every member; raise LabError where one cannot be had."""
        for member in self._timeline:
            self._prepare(member)
        self._timeline.check_waits()
        self._timeline.lay_out()

    def play(self, now_ns: int) -> float:
        """Bring every member to its place, then play; return how long the staging takes, s."""
        return self._stage(now_ns, SystemEvent.STAGE)

    def pause(self, now_ns: int) -> None:
        """Let all members stand where they are; play goes on from there."""
        self._machine.check(SystemEvent.PAUSE)
        self._freeze(now_ns)
        self._machine.fire(SystemEvent.PAUSE)
        self.message = "paused"

    def stop(self, now_ns: int) -> None:
        """End the run; the next play begins at the start of the timeline."""
        self._machine.check(SystemEvent.STOP)
        there = [m for m in self._timeline if m.playback_state is not State.IDLE]
        self._drive(now_ns, [Order(m.robot, Command.STOP) for m in there])
        self._rewind(now_ns)
        self._machine.fire(SystemEvent.STOP)
        self.message = "stopped"

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
        """Set the speed of the timeline, 0.1 to 4, without a jump."""
        checked_rate(rate)
        if self.state is SystemState.PLAYING:
            since_ns = max(now_ns, self.clock.stamp_ns)
            running, waiting = self._split_ordered(self.clock.at(now_ns))
            self._withdraw(now_ns, waiting)
            self._drive(
                now_ns,
                [Order(m.robot, Command.SET_RATE, stamp_ns=since_ns, rate=rate) for m in running],
            )
            # Until the tick that notices the end, the clock shows more than the duration.
            position = min(self.clock.at(since_ns), self.duration)
            self.clock = PlaybackClock(since_ns, position, rate)
        self.rate = rate
        self._order_due(now_ns)

    def set_mode(self, mode: Mode) -> None:
        """Set how the members share the timeline; only while nothing is under way."""
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
    ) -> None:
        """Take a member's new state, and let the system follow it.

        stamp_ns: when the member was in that state; one from before its last reply is out of
        date and ignored. None: now.
        """
        member = self.members[robot]
        if stamp_ns is not None and stamp_ns < member.replied_ns:
            return
        with self._announcing():
            before, member.playback_state = member.playback_state, state
            if state is State.IDLE:
                self._lose(now_ns, member)
            elif state is State.COLLISION_HALT:
                member.position = position
                if before is not State.COLLISION_HALT:
                    self._collide(now_ns, member)
            elif state is State.PAUSED:
                member.position = position
                member.ordered = False
                self._clear()
                self._start_when_staged(now_ns)
            elif state is State.READY and member.ordered:
                member.ordered, member.done = False, True
                member.position = member.duration
            self._poll(now_ns)

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
        self._revive()
        if self.state is not SystemState.PAUSED:
            self._rewind(now_ns)
        self._machine.fire(event)
        self.message = "members move to their places"
        orders = [
            Order(m.robot, Command.STAGE, position=m.position)
            for m in self._timeline
            if not m.done
        ]
        replies = self._drive(now_ns, orders)
        longest = max((reply.duration for reply in replies), default=0.0)
        self._staged_by_ns = now_ns + round((longest + STAGING_TIMEOUT_S) * SECOND)
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
        self.message = ""
        start_ns = now_ns + round(START_LEAD_S * SECOND)
        self.clock = PlaybackClock(start_ns, self.clock.position, self.rate)
        self._order_due(now_ns)

    def _go_to(self, now_ns: int, position: float, event: SystemEvent) -> None:
        """Put the timeline and every member at `position`, s."""
        target = self._machine.check(event)
        checked_position(position, self.duration)
        self._revive()
        if self.state is SystemState.PLAYING:
            self._freeze(now_ns)
        self._timeline.seek(position)
        orders = [Order(m.robot, Command.SEEK, position=m.position) for m in self._timeline]
        self._drive(now_ns, orders)
        self.clock = PlaybackClock(now_ns, position, 0.0)
        self._machine.fire(event)
        self.message = f"at {position:g} s"
        if target is SystemState.PLAYING:
            self._start(now_ns)

    def _collide(self, now_ns: int, member: Member) -> None:
        """Halt all members, or let the others go on, as the policy says."""
        member.ordered = False
        event = COLLISIONS[self.policy]
        if self._machine.ignores(event):
            return
        if self._machine.fire(event) is SystemState.COLLISION_HALT:
            self.message = f"{member.robot} collided"
            self._freeze(now_ns)
            return
        self.message = f"{member.robot} collided; the others go on"
        if self.mode is Mode.SEQUENTIAL:
            self._withdraw(now_ns, self._split_ordered(self.clock.at(now_ns))[1])

    def _clear(self) -> None:
        """Leave a halt once no member is halted any more."""
        halted = any(m.playback_state is State.COLLISION_HALT for m in self._timeline)
        if halted or self._machine.ignores(SystemEvent.CLEAR):
            return
        self._machine.fire(SystemEvent.CLEAR)
        self.message = "clear again"

    def _lose(self, now_ns: int, member: Member) -> None:
        """End the run: the member's playback has no trajectory any more."""
        if not self._machine.ignores(SystemEvent.LOSE):
            message = f"{member.robot} lost its playback; play again to start over"
            self._come_to_rest(now_ns, SystemEvent.LOSE, message)
        member.playback_state = State.IDLE

    def _come_to_rest(self, now_ns: int, event: SystemEvent, why: str) -> None:
        """Stop every member after something failed; the next play begins at the start."""
        self._machine.fire(event)
        self.message = why
        for member in self._timeline:
            member.ordered = False
            try:
                self._take(self._fleet.drive([Order(member.robot, Command.STOP)]), [member])
            except LabError:
                # The member is unreachable or no longer a member; the next play claims it again.
                member.playback_state = State.IDLE
        self._rewind(now_ns)

    def _finish(self, now_ns: int) -> None:
        """End the run: READY, or the next round where it loops."""
        self.clock = PlaybackClock(now_ns, self.duration, 0.0)
        self._machine.fire(SystemEvent.FINISH)
        self.message = "played to the end"
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
                self._come_to_rest(now_ns, SystemEvent.ABORT, str(error))
            raise

    # inside: members ------------------------------------------------------------------------

    def _prepare(self, member: Member) -> None:
        """Claim a member, with its trajectory loaded."""
        loaded = self._fleet.claim(member.robot)
        if member.trajectory_id not in ("", loaded.trajectory_id):
            # A member accepts no load, so it leaves the system for it.
            self._fleet.release(member.robot)
            self._fleet.load(member.robot, member.trajectory_id)
            loaded = self._fleet.claim(member.robot)
        if not loaded.trajectory_id:
            raise Misuse(f"{member.robot} has no trajectory; load one, or name one for the system")
        member.trajectory_id = loaded.trajectory_id
        member.duration, member.frame_rate = loaded.duration, loaded.frame_rate
        member.replied_ns = loaded.stamp_ns
        member.playback_state = State.READY

    def _revive(self) -> None:
        """Claim and load those members again that lost their playback."""
        for member in self._timeline:
            if member.playback_state is State.IDLE:
                self._prepare(member)

    def _rewind(self, now_ns: int) -> None:
        self.clock = PlaybackClock(now_ns, 0.0, 0.0)
        self._timeline.rewind()

    def _drive(self, now_ns: int, orders: Sequence[Order]) -> list[Reply]:
        """Send the orders; where one fails, bring all members to rest and raise its error."""
        if not orders:
            return []
        try:
            replies = self._fleet.drive(orders)
        except LabError as error:
            self._come_to_rest(now_ns, SystemEvent.ABORT, str(error))
            raise
        self._take(replies, [self.members[order.robot] for order in orders])
        return replies

    @staticmethod
    def _take(replies: Sequence[Reply], members: Sequence[Member]) -> None:
        for member, reply in zip(members, replies, strict=True):
            member.playback_state, member.position = reply.state, reply.position
            member.replied_ns = reply.stamp_ns

    def _freeze(self, now_ns: int) -> None:
        """Let the timeline and every moving member stand."""
        position = min(self.clock.at(now_ns), self.duration)
        self.clock = PlaybackClock(now_ns, position, 0.0)
        moving = [m for m in self._timeline if m.playback_state in MOVING]
        for member in self._timeline:
            member.ordered = False
        self._drive(now_ns, [Order(m.robot, Command.PAUSE) for m in moving])

    def _split_ordered(self, position: float) -> tuple[list[Member], list[Member]]:
        """Return the ordered members whose share began by `position` (s), and the others."""
        running = [m for m in self._timeline.ordered if m.start <= position]
        return running, [m for m in self._timeline.ordered if m.start > position]

    def _withdraw(self, now_ns: int, members: Sequence[Member]) -> None:
        """Take back the PLAY orders of members whose start lies ahead."""
        self._drive(now_ns, [Order(m.robot, Command.PAUSE) for m in members])
        for member in members:
            member.ordered = False

    # inside: time ---------------------------------------------------------------------------

    def _poll(self, now_ns: int) -> None:
        if self.state is SystemState.STAGING and now_ns > self._staged_by_ns:
            late = [m.robot for m in self._timeline if m.playback_state is State.ADJUSTING]
            why = f"{', '.join(late)} did not arrive at the start in time"
            self._come_to_rest(now_ns, SystemEvent.ABORT, why)
        if self.state is not SystemState.PLAYING:
            return
        changed = self._timeline.meet_waits(self.clock.at(now_ns))
        self._drive(now_ns, [Order(m.robot, Command.HOLD, until=m.until) for m in changed])
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
        self._drive(now_ns, orders)
