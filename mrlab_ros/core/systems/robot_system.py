"""Robots that play as one: the commands of a system and the coordination of its members.

A system commands its members through a `Fleet` and takes time as an argument. The timeline is
one clock; each member has a share of it, and the clock pair a member plays by always lies on the
system's line, so members stay together through pauses, seeks and changes of rate.
"""

from __future__ import annotations

from collections.abc import Collection

from mrlab_ros.core.base.clock import PlaybackClock, checked_position, checked_rate
from mrlab_ros.core.base.diagnostic import Diagnostic
from mrlab_ros.core.base.errors import Misuse, Unreached
from mrlab_ros.core.playback import diagnostics as playback
from mrlab_ros.core.playback.states import State
from mrlab_ros.core.systems import diagnostics as say
from mrlab_ros.core.systems.execution import SystemExecution
from mrlab_ros.core.systems.members import Command, Order
from mrlab_ros.core.systems.states import COLLISIONS, SystemEvent, SystemState
from mrlab_ros.core.systems.timeline import SAME_INSTANT, Member, Mode


class RobotSystem(SystemExecution):
    """A robot system. A refused command raises Misuse or BadInput and changes nothing."""

    # commands -------------------------------------------------------------------------------

    def check(self) -> None:
        """Raise BadInput where the waits cannot be; the lengths of the members are known."""
        self._timeline.check_waits()

    def prepare(self) -> None:
        """Claim and load every member; one that is halted halts the system.

        Raises LabError where one cannot be had; every robot is then as it was before.
        """
        self._claims.prepare()
        self._timeline.lay_out()
        for member in self._timeline:
            self._return_halted(member.robot, member.playback_state)

    def come_back(self, now_ns: int, position: float, rate: float) -> None:
        """Stand PAUSED at `position` (s) after a restart of the coordinator.

        The members have their shares, trajectories and met waits. Each is claimed again as it
        reports itself, and by the next play.
        """
        self._machine.fire(SystemEvent.RETURN)
        self.rate = rate
        self._timeline.turn(backwards=rate < 0)
        self._timeline.place(position)
        position = min(position, self.duration)
        self._line.put(position)
        self.clock = PlaybackClock(now_ns, position, 0.0)
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
                if self.state is SystemState.PLAYING and _stopped_by_itself(member, position):
                    self._machine.fire(SystemEvent.LOSE)
                    self.message = say.MEMBERS_SILENT(robots=[robot])
                    self._stand(now_ns)
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

    # inside ---------------------------------------------------------------------------------

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
                self._line.put(self.clock.position)
            raise
        self._line.put(position)
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
        self._return_halted(member.robot, state)

    def _return_halted(self, robot: str, state: State) -> None:
        if state is State.COLLISION_HALT and self._machine.can(SystemEvent.RETURN_HALTED):
            self._machine.fire(SystemEvent.RETURN_HALTED)
            self.message = say.STILL_COLLIDES(robot=robot)


def _stopped_by_itself(member: Member, position: float) -> bool:
    """Return whether a member that plays stands at `position` (s) and no wait holds it there."""
    holds = (member.wait_position(wait) for wait in member.waits)
    return member.ordered and all(abs(position - hold) > SAME_INSTANT for hold in holds)
