"""Robots that play as one: a system's members, states and timeline.

A system knows its members through a `Fleet` alone and takes time as an argument. The timeline
is one clock; each member has a share of it, and the clock pair a member plays by always lies on
the system's line, so members stay together through pauses, seeks and changes of rate.
"""

from __future__ import annotations

import itertools
from collections.abc import Iterable, Iterator, Sequence
from enum import Enum

from mrlab_ros.core.clock import SECOND, PlaybackClock, checked_position, checked_rate
from mrlab_ros.core.errors import BadInput, LabError, Misuse
from mrlab_ros.core.playback.states import State
from mrlab_ros.core.systems.members import (
    Command,
    Fleet,
    Order,
    Reply,
)
from mrlab_ros.core.systems.states import SystemEvent, SystemState, after
from mrlab_ros.core.systems.timeline import SAME_INSTANT, Member, Mode
from mrlab_ros.core.systems.waits import AfterFrame, Held, Wait

# A common start lies this far ahead, so that every member knows of it in time, s.
LEAD = 0.1
# A member is told to play this long before its start, s: what happens until then can still
# change when that is.
HORIZON = 0.3
# Staging that takes this much longer than planned has failed, s.
STAGING_PATIENCE = 5.0


class Policy(Enum):
    """Whom a collision of one member halts."""

    HALT_ALL = 0
    HALT_MEMBER = 1


class RobotSystem:
    """A robot system. A refused command raises Misuse or BadInput and changes nothing."""

    def __init__(
        self,
        name: str,
        members: Iterable[Member],
        fleet: Fleet,
        mode: Mode = Mode.PARALLEL,
        policy: Policy = Policy.HALT_ALL,
        loop: bool = False,
    ) -> None:
        self.name = name
        self.members = {member.robot: member for member in members}
        self.mode = mode
        self.policy = policy
        self.loop = loop
        self.state = SystemState.READY
        self.message = ""
        self.clock = PlaybackClock()
        self.rate = 1.0
        self.holders: dict[str, str] = {}
        self._fleet = fleet
        self._staged_by_ns = 0

    # commands -------------------------------------------------------------------------------

    def prepare(self) -> None:
        """Claim and load every member; raise LabError where one cannot be had."""
        for member in self.members.values():
            self._prepare(member)
        self._check_waits()
        self._lay_out()

    def play(self, now_ns: int) -> float:
        """Bring every member to its place, then play; return how long the staging takes, s."""
        state = after(self.state, SystemEvent.STAGE)
        self._revive()
        if self.state is SystemState.READY:
            self._rewind(now_ns)
        self.state, self.message = state, "members move to their places"
        orders = [
            Order(m.robot, Command.STAGE, position=m.position)
            for m in self.members.values()
            if not m.done
        ]
        replies = self._drive(now_ns, orders)
        longest = max((reply.duration for reply in replies), default=0.0)
        self._staged_by_ns = now_ns + round((longest + STAGING_PATIENCE) * SECOND)
        self._start_when_staged(now_ns)
        return longest

    def pause(self, now_ns: int) -> None:
        """Let all members stand where they are; play goes on from there."""
        state = after(self.state, SystemEvent.PAUSE)
        self._freeze(now_ns)
        self.state, self.message = state, "paused"

    def stop(self, now_ns: int) -> None:
        """End the run; the next play begins at the start of the timeline."""
        state = after(self.state, SystemEvent.STOP)
        alive = [r for r, m in self.members.items() if m.state is not State.IDLE]
        self._drive(now_ns, [Order(robot, Command.STOP) for robot in alive])
        self._rewind(now_ns)
        self.state, self.message = state, "stopped"

    def seek(self, now_ns: int, position: float) -> None:
        """Show another place on the timeline at once: members before it at their ends, those
        after it at their starts. PLAYING plays on from there."""
        state = after(self.state, SystemEvent.SEEK)
        checked_position(position, self.duration)
        self._revive()
        if self.state is SystemState.PLAYING:
            self._freeze(now_ns)
        orders = []
        for member in self.members.values():
            local = min(max(position - member.start, 0.0), member.duration)
            member.position = local
            member.met = {w for w in member.waits if member.place(w) < local}
            member.done = position >= member.end - SAME_INSTANT and local > 0
            orders.append(Order(member.robot, Command.SEEK, position=local))
        self._drive(now_ns, orders)
        self.clock = PlaybackClock(now_ns, position, 0.0)
        self.state, self.message = state, f"at {position:g} s"
        if state is SystemState.PLAYING:
            self._start(now_ns)

    def step(self, now_ns: int, frames: int) -> float:
        """Step a standing system by frames of its fastest member; return the position, s."""
        if self.state is SystemState.PLAYING:
            raise Misuse("cannot step in PLAYING; pause first")
        rate = max(member.frame_rate for member in self.members.values())
        now_at = round(self.clock.position * rate) + frames
        position = min(max(now_at / rate, 0.0), self.duration)
        self.seek(now_ns, position)
        return position

    def set_rate(self, now_ns: int, rate: float) -> None:
        """Set the speed of the timeline, 0.1 to 4, without a jump."""
        checked_rate(rate)
        if self.state is SystemState.PLAYING:
            since_ns = max(now_ns, self.clock.stamp_ns)
            running = [m for m in self._ordered() if m.start <= self.clock.at(now_ns)]
            waiting = [m for m in self._ordered() if m not in running]
            self._drive(now_ns, [Order(m.robot, Command.PAUSE) for m in waiting])
            for member in waiting:
                member.ordered = False
            self._drive(
                now_ns,
                [Order(m.robot, Command.SET_RATE, stamp_ns=since_ns, rate=rate) for m in running],
            )
            self.clock = PlaybackClock(since_ns, self.clock.at(since_ns), rate)
        self.rate = rate
        self._order_due(now_ns)

    def set_mode(self, mode: Mode) -> None:
        """Set how the members share the timeline; only while nothing is under way."""
        if self.state is not SystemState.READY:
            raise Misuse(f"cannot change the mode in {self.state.name}; stop first")
        self.mode = mode
        self._lay_out()

    # what happens ---------------------------------------------------------------------------

    def member_changed(self, now_ns: int, robot: str, state: State, position: float) -> None:
        """Take a member's new state; move the system on where that ends or halts something."""
        member = self.members[robot]
        before, member.state = member.state, state
        if state is State.IDLE:
            self._lose(now_ns, member)
        elif state is State.COLLISION_HALT:
            member.position = position
            if before is not State.COLLISION_HALT:
                self._collide(now_ns, member)
        elif state is State.PAUSED:
            member.position = position
            member.ordered = False
            self._clear(now_ns)
            self._start_when_staged(now_ns)
        elif state is State.READY and self.state is SystemState.PLAYING and member.ordered:
            member.ordered, member.done = False, True
            member.position = member.duration
        self.poll(now_ns)

    def grasped(self, now_ns: int, robot: str, held: str | None) -> None:
        """Take what a robot holds now: an object's name, or None."""
        self.holders = {o: r for o, r in self.holders.items() if r != robot}
        if held is not None:
            self.holders[held] = robot
        self.poll(now_ns)

    def poll(self, now_ns: int) -> None:
        """Do what time has made due: starts, met waits, the end, a staging that takes too long."""
        if self.state is SystemState.STAGING and now_ns > self._staged_by_ns:
            late = [m.robot for m in self.members.values() if m.state is State.ADJUSTING]
            self.abort(now_ns, f"{', '.join(late)} did not arrive at the start in time")
        if self.state is not SystemState.PLAYING:
            return
        self._meet_waits(now_ns)
        self._order_due(now_ns)
        if all(member.done for member in self.members.values()):
            self._finish(now_ns)

    def abort(self, now_ns: int, why: str) -> None:
        """Bring every member to rest after something failed."""
        self.state = after(self.state, SystemEvent.ABORT)
        self.message = why
        for robot, member in self.members.items():
            member.ordered = False
            try:
                self._take(self._fleet.drive([Order(robot, Command.STOP)]), [robot])
            except LabError:
                # Nobody is there who knows of the system; the next play claims it anew.
                member.state = State.IDLE
        self._rewind(now_ns)

    @property
    def duration(self) -> float:
        """Length of the timeline, s."""
        return max((member.end for member in self.members.values()), default=0.0)

    # the inside -----------------------------------------------------------------------------

    def _prepare(self, member: Member) -> None:
        loaded = self._fleet.prepare(member.robot, member.trajectory_id)
        member.trajectory_id = loaded.trajectory_id
        member.duration, member.frame_rate = loaded.duration, loaded.frame_rate
        member.state = State.READY

    def _revive(self) -> None:
        """Claim and load those members again that lost their playback."""
        for member in self.members.values():
            if member.state is State.IDLE:
                self._prepare(member)

    def _check_waits(self) -> None:
        for member in self.members.values():
            for wait in member.waits:
                condition = wait.condition
                frames = round(member.duration * member.frame_rate) + 1
                if wait.frame >= frames:
                    raise BadInput(
                        f"{member.robot} waits at frame {wait.frame}, its trajectory has frames 0 "
                        f"to {frames - 1}"
                    )
                if isinstance(condition, AfterFrame) and condition.robot not in self.members:
                    raise BadInput(
                        f"'{wait.text}' names {condition.robot}; expected a member of the system: "
                        f"{', '.join(self.members)}"
                    )

    def _lay_out(self) -> None:
        """Give every member its share, as if no wait took any time."""
        start = 0.0
        for member in self.members.values():
            member.start = start
            if self.mode is Mode.SEQUENTIAL:
                start = member.end + member.dwell

    def _shift(self, member: Member, start: float) -> None:
        """Begin a member's share at `start`; in sequential mode those after it follow."""
        member.start = start
        if self.mode is Mode.SEQUENTIAL:
            robots = list(self.members.values())
            for before, behind in itertools.pairwise(robots):
                if not (behind.done or behind.ordered):
                    behind.start = max(behind.start, before.end + before.dwell)

    def _rewind(self, now_ns: int) -> None:
        self.clock = PlaybackClock(now_ns, 0.0, 0.0)
        for member in self.members.values():
            member.position, member.ordered, member.done = 0.0, False, False
            member.met = set()
        self._lay_out()

    def _ordered(self) -> list[Member]:
        return [member for member in self.members.values() if member.ordered]

    def _take(self, replies: list[Reply], robots: Sequence[str]) -> None:
        for robot, reply in zip(robots, replies, strict=True):
            self.members[robot].state = reply.state
            self.members[robot].position = reply.position

    def _drive(self, now_ns: int, orders: list[Order]) -> list[Reply]:
        """Give the orders; where one fails, bring all to rest and raise its error."""
        if not orders:
            return []
        try:
            replies = self._fleet.drive(orders)
        except LabError as error:
            self.abort(now_ns, str(error))
            raise
        self._take(replies, [order.robot for order in orders])
        return replies

    def _freeze(self, now_ns: int) -> None:
        """Let the timeline and every moving member stand."""
        position = min(self.clock.at(now_ns), self.duration)
        self.clock = PlaybackClock(now_ns, position, 0.0)
        moving = (State.PLAYING, State.ADJUSTING)
        orders = [
            Order(m.robot, Command.PAUSE) for m in self.members.values() if m.state in moving
        ]
        for member in self.members.values():
            member.ordered = False
        self._drive(now_ns, orders)

    def _start_when_staged(self, now_ns: int) -> None:
        waiting = [m for m in self.members.values() if not m.done and m.state is not State.PAUSED]
        if self.state is SystemState.STAGING and not waiting:
            self.state = after(self.state, SystemEvent.START)
            self._start(now_ns)

    def _start(self, now_ns: int) -> None:
        self.message = ""
        start_ns = now_ns + round(LEAD * SECOND)
        self.clock = PlaybackClock(start_ns, self.clock.position, self.rate)
        self._order_due(now_ns)

    def _known_starts(self) -> Iterator[Member]:
        """Yield the members whose turn is known: in sequential mode none behind one that waits."""
        for member in self.members.values():
            if member.done:
                continue
            if member.held_by is None and member.state is not State.COLLISION_HALT:
                yield member
            undecided = member.open_waits() or member.state is State.COLLISION_HALT
            if self.mode is Mode.SEQUENTIAL and undecided:
                return

    def _order_due(self, now_ns: int) -> None:
        """Tell those members to play whose turn comes within the horizon."""
        if self.state is not SystemState.PLAYING:
            return
        orders = []
        horizon_ns = now_ns + round(HORIZON * SECOND)
        for member in self._known_starts():
            due_ns = self.clock.due(member.start + member.position)
            if member.ordered or due_ns > horizon_ns:
                continue
            if due_ns < now_ns:
                # It was held: its share begins later than it was laid out.
                due_ns = now_ns + round(LEAD * SECOND)
                self._shift(member, self.clock.at(due_ns) - member.position)
            holds = member.open_waits()
            until = member.place(holds[0]) if holds else None
            member.ordered = True
            orders.append(
                Order(member.robot, Command.PLAY, due_ns, member.position, self.rate, until)
            )
        self._drive(now_ns, orders)

    def _met(self, now_ns: int, wait: Wait) -> bool:
        condition = wait.condition
        if isinstance(condition, Held):
            return self.holders.get(condition.object) == condition.robot
        other = self.members[condition.robot]
        local = self.clock.at(now_ns) - other.start if other.ordered else other.position
        return other.done or local >= condition.frame / other.frame_rate - SAME_INSTANT

    def _meet_waits(self, now_ns: int) -> None:
        orders = []
        for member in self.members.values():
            if member.done:
                continue
            before = member.open_waits()
            held = member.held_by
            for wait in before:
                # Who holds an object says nothing before the member is there to see it.
                early = isinstance(wait.condition, Held) and (
                    held is None or wait.frame != held.frame
                )
                if not early and self._met(now_ns, wait):
                    member.met.add(wait)
            now = member.open_waits()
            if member.ordered and before and now[:1] != before[:1]:
                until = member.place(now[0]) if now else None
                orders.append(Order(member.robot, Command.HOLD, until=until))
        self._drive(now_ns, orders)

    def _collide(self, now_ns: int, member: Member) -> None:
        member.ordered = False
        if self.state not in (SystemState.PLAYING, SystemState.STAGING):
            return
        staging = self.state is SystemState.STAGING
        if self.policy is Policy.HALT_MEMBER and not staging:
            if self.mode is Mode.SEQUENTIAL:
                behind = [m for m in self._ordered() if m.start > self.clock.at(now_ns)]
                self._drive(now_ns, [Order(m.robot, Command.PAUSE) for m in behind])
                for other in behind:
                    other.ordered = False
            self.message = f"{member.robot} collided; the others go on"
            return
        self._freeze(now_ns)
        self.state = after(self.state, SystemEvent.COLLIDE)
        self.message = f"{member.robot} collided"

    def _clear(self, now_ns: int) -> None:
        halted = any(m.state is State.COLLISION_HALT for m in self.members.values())
        if self.state is SystemState.COLLISION_HALT and not halted:
            self.state = after(self.state, SystemEvent.CLEAR)
            self.message = "clear again"

    def _lose(self, now_ns: int, member: Member) -> None:
        if self.state is not SystemState.READY:
            self.abort(now_ns, f"{member.robot} lost its playback; play again to begin anew")
        member.state = State.IDLE

    def _finish(self, now_ns: int) -> None:
        self.clock = PlaybackClock(now_ns, self.duration, 0.0)
        self.state = after(self.state, SystemEvent.FINISH)
        self.message = "played to the end"

    def rearm(self, now_ns: int) -> None:
        """Leave COMPLETE once it was announced: READY, or the next round where it loops."""
        self.state = after(self.state, SystemEvent.REARM)
        self._rewind(now_ns)
        if self.loop:
            self.play(now_ns)
