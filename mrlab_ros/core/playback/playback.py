"""One robot's playback: its commands and the seven states. No node, no thread.

The caller owns time: it passes `now_ns` to every command, asks `due_ns()` when the next joint
state leaves, and calls `tick(now_ns)` then. Changes of state come out of `take_statuses()`.
"""

from __future__ import annotations

from mrlab_ros.core.base.clock import checked_position, checked_rate
from mrlab_ros.core.base.diagnostic import Diagnostic
from mrlab_ros.core.base.errors import Misuse
from mrlab_ros.core.base.geometry import Array
from mrlab_ros.core.playback import diagnostics as say
from mrlab_ros.core.playback.execution import Execution
from mrlab_ros.core.playback.external import External
from mrlab_ros.core.playback.planner import MotionPlanner
from mrlab_ros.core.playback.states import Event, State
from mrlab_ros.core.playback.stream import Sample
from mrlab_ros.core.robots.model import RobotModel
from mrlab_ros.core.trajectory.trajectory import Trajectory


class Playback(Execution):
    """Plays one trajectory at a time on one robot.

    A command that the state forbids raises Misuse, a bad argument BadInput; either way nothing
    changes. `by` names the robot system that gives the command; a member of a system accepts
    commands from that system alone.
    """

    def __init__(self, model: RobotModel, planner: MotionPlanner, standing_rate: float) -> None:
        """Stand at the model's home pose; `standing_rate` (Hz, 0: never) repeats the pose."""
        super().__init__(model, standing_rate)
        self.external = External(self)
        self._planner = planner
        self._play_on_arrival = False

    # commands -------------------------------------------------------------------------------

    def load(self, now_ns: int, trajectory: Trajectory, by: str = "") -> None:
        """Load a trajectory made for this model and end effector; the arm stays where it is."""
        self.require_owner(by)
        self.machine.check(Event.LOAD)
        self.check_fits(trajectory)
        self.stream.trajectory = trajectory
        loaded = say.LOADED(
            trajectory=trajectory.id,
            frames=trajectory.frame_count,
            duration=trajectory.duration,
        )
        self.stand(now_ns, Event.LOAD, self.stream.begin, loaded)

    def stand_at(self, now_ns: int, arm: Array) -> None:
        """Stand at `arm`, (J,) rad, where the arm stood before its process was restarted."""
        self.machine.check(Event.RETURNED_PAUSED)
        self.stream.stand_at(now_ns, arm)

    def unload(self, now_ns: int, by: str = "") -> None:
        """Forget the trajectory; the arm stays where it is."""
        self.require_owner(by)
        self.machine.check(Event.UNLOAD)
        self.stream.trajectory = None
        self.stand(now_ns, Event.UNLOAD, 0.0, say.UNLOADED())

    def play(
        self,
        now_ns: int,
        start_ns: int | None = None,
        rate: float | None = None,
        until: float | None = None,
        by: str = "",
    ) -> None:
        """Play on from the clock's position: the clock shows it at `start_ns` (default: now).

        An arm that stands elsewhere moves there first, in ADJUSTING, and plays when it arrives.
        A system may set the rate as well, choose a `start_ns` a little in the past, and have the
        arm wait in PAUSED at the position `until` (s).
        """
        self.require_owner(by)
        self.machine.check(Event.PLAY)
        if self.external.is_live:
            self.external.resume(now_ns)
            return
        position = self.clock.position
        if until is not None:
            checked_position(until, self.loaded().duration)
        rate = self.rate if rate is None else checked_rate(rate)
        there = self.stream.is_at(position)
        if by and not there:
            raise Misuse(say.NOT_IN_PLACE(position=position))
        self.stream.rate = rate
        if there:
            self.stream.until = until
            self.follow(now_ns if start_ns is None else start_ns, position, Event.PLAY)
        else:
            self._approach(now_ns, position, Event.STAGE, play_on_arrival=True)

    def stage(self, now_ns: int, position: float, by: str = "") -> float:
        """Move to `position` (s) and wait there in PAUSED; return how long that takes, s.

        An arm that is paused there already stays as it is.
        """
        self.require_owner(by)
        self.machine.check(Event.STAGE)
        checked_position(position, self.loaded().duration)
        there = self.clock.position == position and self.stream.is_at(position)
        if there and self.machine.can(Event.IN_PLACE):
            self.machine.fire(Event.IN_PLACE)
            return 0.0
        return self._approach(now_ns, position, Event.STAGE, play_on_arrival=False)

    def pause(self, now_ns: int, by: str = "") -> None:
        """Stand still where the last joint state left the arm."""
        self.require_owner(by)
        self.halt(now_ns, Event.PAUSE, say.PAUSED(position=self.stream.position))

    def stop(self, now_ns: int, by: str = "") -> None:
        """End the run: READY to play from the first frame, the arm stays where it is.

        In COLLISION_HALT the arm goes back to the first frame, and from there, where it is not
        clear either, to the model's home pose; the halt goes on until the arm is clear. A member
        of a system stays at its first frame. A playback that goes backwards begins at its last.
        """
        self.require_owner(by)
        if self.machine.check(Event.STOP) is State.COLLISION_HALT:
            if by or not self.stream.is_at(self.stream.begin):
                self.jump(now_ns, Event.STOP, self.stream.begin, say.BACK_AT_BEGIN())
            else:
                self.machine.fire(Event.STOP)
                self.stream.stand_at(now_ns, self.model.home)
                self.announce(say.BACK_AT_HOME())
        else:
            begin = 0.0 if self.trajectory is None else self.stream.begin
            self.stand(now_ns, Event.STOP, begin, say.STOPPED())

    def seek(self, now_ns: int, position: float, by: str = "") -> None:
        """Go to `position` (s) at once; PLAYING plays on from there, the rest stand there."""
        self.require_owner(by)
        target = self.machine.check(Event.SEEK)
        checked_position(position, self.loaded().duration)
        if target is State.PLAYING:
            self.stream.until = None
            self.follow(now_ns, position, Event.SEEK)
        else:
            self.jump(now_ns, Event.SEEK, position, say.AT_POSITION(position=position))

    def set_rate(
        self, now_ns: int, rate: float, since_ns: int | None = None, by: str = ""
    ) -> None:
        """Set the speed of playback, 0.1 to 4 or -4 to -0.1, without a jump.

        What is READY then begins at the other end where the direction changes. A system names
        the instant, a little in the past, from which on the new rate holds, so that its members
        stay together.
        """
        self.require_owner(by)
        turns = (checked_rate(rate) < 0) != (self.rate < 0)
        self.stream.set_rate(now_ns if since_ns is None else since_ns, rate)
        if turns and self.state is State.READY:
            self.stream.stand(now_ns, self.stream.begin)
        self.announce(say.RATE_SET(rate=rate))

    def set_standing_rate(self, now_ns: int, rate: float) -> None:
        """Repeat the joint state of a robot that does not move at `rate` Hz (0: never)."""
        self.stream.set_standing_rate(now_ns, rate)

    def repeat(self, now_ns: int) -> None:
        """Repeat the joint state of a robot that does not move now, for who has just come."""
        self.stream.repeat(now_ns)

    def hold_at(self, until: float | None, by: str = "") -> None:
        """Wait in PAUSED at a later position than now, `until` (s); None: play to the end."""
        self.require_owner(by)
        if until is not None:
            checked_position(until, self.loaded().duration)
            if self.stream.passed(until):
                raise Misuse(say.PASSED_ALREADY(until=until))
        self.stream.end_at(until)

    def set_loop(self, loop: bool, by: str = "") -> None:
        """Set whether the trajectory starts over after its last frame."""
        self.require_owner(by)
        self.loop = loop
        self.announce(say.LOOPS() if loop else say.PLAYS_ONCE())

    def clear_halt(self, now_ns: int) -> None:
        """End a halt by command; raise Misuse while physics still reports a collision."""
        self.machine.check(Event.CLEAR_HALT)
        if self.touching:
            raise Misuse(say.STILL_TOUCHES())
        self.halt(now_ns, Event.CLEAR_HALT, say.CLEAR_AGAIN())

    # membership -----------------------------------------------------------------------------

    def claim(self, now_ns: int, system: str) -> None:
        """Become a member of `system`, standing where the arm is.

        Raises Misuse where another system has the robot, or where the robot moves by itself.
        """
        if self.system not in ("", system):
            raise Misuse(say.MEMBER_OF_SYSTEM(system=self.system))
        if self.moving:
            if not self.system:
                raise Misuse(say.NOT_STANDING(state=self.state.name))
            # The restarted system has no record of its member.
            self.halt(now_ns, Event.RELEASED, None)
        self.system = system
        self.announce(say.DRIVEN_BY(system=system))

    def release(self, now_ns: int, by: str) -> None:
        """Leave the system, paused where the arm is; no effect for another system's robot."""
        if self.system != by:
            return
        self.report(now_ns, Event.RELEASED, None)
        self.system = ""
        self.announce(say.RELEASED_BY(system=by))

    # reports of physics ---------------------------------------------------------------------

    def collide(self, now_ns: int, why: Diagnostic) -> bool:
        """Record a collision and halt the arm.

        Returns False where the arm did not move anyway; then the state stays.
        """
        self.touching = True
        return self.report(now_ns, Event.COLLIDED, why)

    def clear(self, now_ns: int) -> bool:
        """Take that the arm is clear again: end a halt; play then goes on in place.

        Returns False where there was no halt.
        """
        self.touching = False
        return self.report(now_ns, Event.CLEARED, say.CLEAR_AGAIN())

    # time -----------------------------------------------------------------------------------

    def thaw(self, now_ns: int) -> None:
        """Let a member of a system stand where its last joint state before a freeze left it.

        Its system stands too; what has become late meanwhile must not be caught up.
        """
        if self.system and self.moving:
            self.halt(now_ns, Event.PAUSE, say.PAUSED(position=self.stream.position))

    def due_ns(self) -> int | None:
        """Return when the next joint state leaves; None: not before something changes."""
        return self.stream.next_ns

    def tick(self, now_ns: int) -> Sample | None:
        """Return the joint state that is due at `now_ns`, or None."""
        stream, state = self.stream, self.machine.state
        if stream.next_ns is None or now_ns < stream.next_ns:
            return None
        if state is State.PLAYING and self.external.is_live:
            return self.external.sample(now_ns)
        if state is State.PLAYING:
            sample = stream.trajectory_sample(now_ns)
            if stream.ended:
                self._finish(sample.due_ns)
            elif stream.held:
                self.halt(now_ns, Event.HELD, say.HELD_BY_WAIT())
            return sample
        if state is State.ADJUSTING:
            sample = stream.approach_sample(now_ns)
            if stream.arrived:
                self._arrive(sample.due_ns)
            return sample
        return stream.standing_sample(now_ns)

    # inside ---------------------------------------------------------------------------------

    def _approach(
        self, now_ns: int, position: float, event: Event, *, play_on_arrival: bool
    ) -> float:
        """Move to `position` (s) of the trajectory; return how long that takes, s."""
        goal = self.loaded().sample(position)
        motion = self._planner.plan(self.model, self.arm, goal)
        self.machine.fire(event)
        self._play_on_arrival = play_on_arrival
        self.stream.approach(now_ns, motion, position)
        self.announce(say.MOVES_TO_START())
        return motion.duration

    def _arrive(self, due_ns: int) -> None:
        """Play, or wait at the start: the last joint state of the approach left at `due_ns`."""
        position, next_ns = self.clock.position, self.stream.next_ns
        if self._play_on_arrival:
            assert next_ns is not None
            self.follow(next_ns, position, Event.ARRIVED)
        else:
            self.stand(due_ns, Event.STAGED, position, say.AT_START())

    def _finish(self, end_ns: int) -> None:
        """End the run, or start over: its last joint state left at `end_ns`."""
        begin = self.stream.begin
        # A member's own loop would keep its system from ending.
        if self.system or not self.loop:
            # COMPLETE lasts no longer than its announcement.
            message = say.PLAYED_BACK() if self.rate < 0 else say.PLAYED_TO_END()
            self.stand(end_ns, Event.FINISHED, self.stream.end, message)
            self.machine.fire(Event.REARMED)
            self.stream.stand(end_ns, begin, sent=True)
            self.announce(message)
        elif self.stream.is_at(begin):
            self.follow(end_ns + self.stream.period_ns, begin, Event.REPEATED)
        else:
            self._approach(end_ns, begin, Event.RETURNED, play_on_arrival=True)
