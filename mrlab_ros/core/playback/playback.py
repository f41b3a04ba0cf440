"""One robot's playback: its commands and the seven states. No node, no thread.

The caller owns time: it passes `now_ns` to every command, asks `due_ns()` when the next joint
state leaves, and calls `tick(now_ns)` then. Changes of state come out of `take_statuses()`.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import NamedTuple

from mrlab_ros.core.base.clock import SECOND, PlaybackClock, checked_position, checked_rate
from mrlab_ros.core.base.diagnostic import Diagnostic
from mrlab_ros.core.base.errors import LabError, Misuse
from mrlab_ros.core.base.geometry import Array
from mrlab_ros.core.base.state_machine import Machine
from mrlab_ros.core.playback import diagnostics as say
from mrlab_ros.core.playback import goal as goals
from mrlab_ros.core.playback import live
from mrlab_ros.core.playback.planner import MotionPlanner
from mrlab_ros.core.playback.states import MOVING, TABLE, Event, State
from mrlab_ros.core.playback.stream import Sample, Stream
from mrlab_ros.core.robots.model import RobotModel
from mrlab_ros.core.trajectory.fit import check_fits
from mrlab_ros.core.trajectory.trajectory import Trajectory

# A refused joint command is named in the status this often, ns.
REFUSAL_NS = SECOND


@dataclass(frozen=True)
class PlaybackStatus:
    """The state of a playback at one instant, as it is published; message: why it is in it."""

    state: State
    message: Diagnostic | None
    trajectory: Trajectory | None
    clock: PlaybackClock
    frame: int
    rate: float
    loop: bool
    system: str


class Kept(NamedTuple):
    """What a playback knows again after its process was restarted.

    position: s on the trajectory. halted: it stood in COLLISION_HALT. begun: it does not stand
    READY for the first frame. arm: (J,) rad, as last sent.
    """

    trajectory_id: str
    version: int
    position: float
    rate: float
    loop: bool
    halted: bool
    begun: bool
    arm: Array


class Playback:
    """Plays one trajectory at a time on one robot.

    A command that the state forbids raises Misuse, a bad argument BadInput; either way nothing
    changes. `by` names the robot system that gives the command; a member of a system accepts
    commands from that system alone.

    end_effector: what the robot carries; empty: nothing.
    """

    def __init__(self, model: RobotModel, planner: MotionPlanner, standing_rate: float) -> None:
        """Stand at the model's home pose; `standing_rate` (Hz, 0: never) repeats the pose."""
        self.model = model
        self.end_effector = ""
        self.loop = False
        self.system = ""
        self._planner = planner
        self._machine = Machine(TABLE)
        self._stream = Stream(model.home, standing_rate)
        self._message: Diagnostic | None = None
        # None: physics has said nothing yet.
        self._touching: bool | None = None
        self._play_on_arrival = False
        self._set_points = live.SetPoints(model)
        # When the last joint command came, accepted or not, and when one was refused last.
        self._commanded_ns: int | None = None
        self._refused_ns = 0
        self._statuses: list[PlaybackStatus] = []
        self._announce(None)

    # what it is -----------------------------------------------------------------------------

    @property
    def state(self) -> State:
        """The state of the playback."""
        return self._machine.state

    @property
    def moving(self) -> bool:
        """Whether the arm moves."""
        return self.state in MOVING

    @property
    def trajectory(self) -> Trajectory | None:
        """The loaded trajectory."""
        return self._stream.trajectory

    @property
    def clock(self) -> PlaybackClock:
        """The position on the trajectory at any time."""
        return self._stream.clock

    @property
    def rate(self) -> float:
        """The speed of playback; 1 is the trajectory's own, -1 the same backwards."""
        return self._stream.rate

    @property
    def arm(self) -> Array:
        """The joint positions sent last, (J,) rad."""
        return self._stream.arm

    @property
    def frame(self) -> int:
        """The last source frame reached."""
        return self._stream.frame

    def progress(self) -> tuple[Trajectory | None, int, int]:
        """Return the trajectory and how many of this run's joint states were sent, and left out.

        Left out are those that were too late.
        """
        stream = self._stream
        return stream.trajectory, stream.sent, stream.lost

    def status(self) -> PlaybackStatus:
        """Return the present state as it is published."""
        return PlaybackStatus(
            self.state,
            self._message,
            self.trajectory,
            self.clock,
            self.frame,
            self.rate,
            self.loop,
            self.system,
        )

    # commands -------------------------------------------------------------------------------

    def load(self, now_ns: int, trajectory: Trajectory, by: str = "") -> None:
        """Load a trajectory made for this model and end effector; the arm stays where it is."""
        self._require_owner(by)
        self._machine.check(Event.LOAD)
        self._check_fits(trajectory)
        self._stream.trajectory = trajectory
        loaded = say.LOADED(
            trajectory=trajectory.id,
            frames=trajectory.frame_count,
            duration=trajectory.duration,
        )
        self._stand(now_ns, Event.LOAD, self._stream.begin, loaded)

    def stand_at(self, now_ns: int, arm: Array) -> None:
        """Stand at `arm`, (J,) rad, where the arm stood before its process was restarted."""
        self._machine.check(Event.RETURNED_PAUSED)
        self._stream.stand_at(now_ns, arm)

    def come_back(self, now_ns: int, trajectory: Trajectory, kept: Kept) -> None:
        """Stand where the arm stood before its process was restarted.

        PAUSED, or READY where it had not begun; in COLLISION_HALT where it was halted, unless
        physics has reported meanwhile that the arm is clear.
        """
        self._machine.check(Event.RETURNED_PAUSED)
        self._check_fits(trajectory)
        position = min(max(kept.position, 0.0), trajectory.duration)
        if kept.halted and self._touching is not False:
            event = Event.RETURNED_HALTED
        else:
            event = Event.RETURNED_PAUSED if kept.begun else Event.LOAD
        self._machine.fire(event)
        self._stream.trajectory = trajectory
        self._stream.rate = checked_rate(kept.rate)
        self.loop = kept.loop
        if event is Event.LOAD:
            self._stream.arm = kept.arm
            self._stream.stand(now_ns, self._stream.begin)
        else:
            self._stream.come_back(now_ns, position, kept.arm)
        self._announce(say.PLAYBACK_RESTARTED())

    def kept(self) -> Kept | None:
        """Return what a restart has to know again; None without a trajectory."""
        if self.trajectory is None:
            return None
        return Kept(
            self.trajectory.id,
            self.trajectory.version,
            self._stream.position,
            self.rate,
            self.loop,
            halted=self.state is State.COLLISION_HALT,
            begun=self.state not in (State.READY, State.COMPLETE),
            arm=self.arm,
        )

    def unload(self, now_ns: int, by: str = "") -> None:
        """Forget the trajectory; the arm stays where it is."""
        self._require_owner(by)
        self._machine.check(Event.UNLOAD)
        self._stream.trajectory = None
        self._stand(now_ns, Event.UNLOAD, 0.0, say.UNLOADED())

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
        self._require_owner(by)
        self._machine.check(Event.PLAY)
        if self.is_live:
            # The stream goes on, if it still comes; else it ends again.
            self._commanded_ns = now_ns
            self._go_live(now_ns)
            return
        position = self.clock.position
        if until is not None:
            checked_position(until, self._loaded().duration)
        rate = self.rate if rate is None else checked_rate(rate)
        there = self._stream.is_at(position)
        if by and not there:
            raise Misuse(say.NOT_IN_PLACE(position=position))
        self._stream.rate = rate
        if there:
            self._stream.until = until
            self._follow(now_ns if start_ns is None else start_ns, position, Event.PLAY)
        else:
            self._approach(now_ns, position, Event.STAGE, play_on_arrival=True)

    # what others say where to go --------------------------------------------------------------

    def pursue(self, now_ns: int, goal: goals.Goal) -> Trajectory:
        """Follow a goal's points from where the arm is, in place of what it does now.

        An arm that moves goes on with the velocity that it has. Returns the trajectory that was
        made of it, which plays once at rate 1. Raises WrongGoal for a bad goal and Misuse where
        the state or a system forbids it; then nothing has changed.
        """
        self._require_owner("")
        if not self.moving:
            self._machine.check(Event.LOAD)
        start_ns, arm, velocities = now_ns, self.arm, None
        if self.moving:
            start_ns, arm, velocities = self._stream.motion(now_ns)
        trajectory = goals.trajectory(goal, self.model, arm, start_ns, velocities)
        self._replace(now_ns, trajectory)
        self._stream.rate, self.loop = 1.0, False
        if velocities is not None:
            self._stream.go_on_from(start_ns)
        self._follow(start_ns, 0.0, Event.PLAY)
        return trajectory

    def command(
        self,
        now_ns: int,
        names: Sequence[str],
        positions: Sequence[float],
        velocities: Sequence[float] = (),
    ) -> bool:
        """Go to a set-point of a stream; return whether the stream begins with it.

        A stream may begin wherever a trajectory could be loaded. It ends in PAUSED when nothing
        comes for live.SILENCE s. Raises LabError; what is refused moves nothing, and the status
        says it once.
        """
        came_ns, self._commanded_ns = self._commanded_ns, now_ns
        silent = came_ns is None or now_ns - came_ns > live.SILENCE * SECOND
        try:
            begins = self._take_command(now_ns, names, positions, velocities, silent)
        except LabError as error:
            # A stream of thousands is not refused a thousand times.
            if now_ns - self._refused_ns > REFUSAL_NS:
                self._refused_ns = now_ns
                self._announce(say.COMMAND_REFUSED(why=error))
            raise
        if self._refused_ns and now_ns - self._refused_ns > REFUSAL_NS:
            self._refused_ns = 0
            self._announce(say.FOLLOWS_COMMANDS())
        return begins

    def _take_command(
        self,
        now_ns: int,
        names: Sequence[str],
        positions: Sequence[float],
        velocities: Sequence[float],
        silent: bool,
    ) -> bool:
        self._require_owner("")
        target = self._set_points.checked(names, positions, velocities)
        if self.is_live and self.state is State.PLAYING:
            self._set_points.go_to(now_ns, target)
            return False
        self._machine.check(Event.LOAD)
        if self.is_live and not silent:
            raise Misuse(say.COMMANDS_IGNORED(state=self.state.name, silence=live.SILENCE))
        self._replace(now_ns, self._set_points.place(self.arm))
        self._go_live(now_ns)
        self._set_points.go_to(now_ns, target)
        return True

    @property
    def is_live(self) -> bool:
        """Whether a stream of joint commands stands in for a trajectory."""
        trajectory = self.trajectory
        return (
            trajectory is not None
            and trajectory.version == goals.UNPUBLISHED
            and trajectory.id == live.LIVE
        )

    def _replace(self, now_ns: int, trajectory: Trajectory) -> None:
        """Load what begins where the arm is; what moves is given up without a stop."""
        if self.moving:
            self._machine.fire(Event.PAUSE)
            self._stream.halt(now_ns)
        self._machine.fire(Event.LOAD)
        self._stream.trajectory = trajectory
        self._stream.stand(now_ns, 0.0)

    def _go_live(self, now_ns: int) -> None:
        self._machine.fire(Event.PLAY)
        self._stream.stand(now_ns, 0.0)
        self._set_points.rest(now_ns)
        self._announce(say.FOLLOWS_COMMANDS())

    def stage(self, now_ns: int, position: float, by: str = "") -> float:
        """Move to `position` (s) and wait there in PAUSED; return how long that takes, s.

        An arm that is paused there already stays as it is.
        """
        self._require_owner(by)
        self._machine.check(Event.STAGE)
        checked_position(position, self._loaded().duration)
        there = self.clock.position == position and self._stream.is_at(position)
        if there and self._machine.can(Event.IN_PLACE):
            self._machine.fire(Event.IN_PLACE)
            return 0.0
        return self._approach(now_ns, position, Event.STAGE, play_on_arrival=False)

    def pause(self, now_ns: int, by: str = "") -> None:
        """Stand still where the last joint state left the arm."""
        self._require_owner(by)
        self._halt(now_ns, Event.PAUSE, say.PAUSED(position=self._stream.position))

    def stop(self, now_ns: int, by: str = "") -> None:
        """End the run: READY to play from the first frame, the arm stays where it is.

        In COLLISION_HALT the arm goes back to the first frame, and the halt goes on until the
        arm is clear. A playback that goes backwards begins at its last frame.
        """
        self._require_owner(by)
        if self._machine.check(Event.STOP) is State.COLLISION_HALT:
            self._jump(now_ns, Event.STOP, self._stream.begin, say.BACK_AT_BEGIN())
        else:
            begin = 0.0 if self.trajectory is None else self._stream.begin
            self._stand(now_ns, Event.STOP, begin, say.STOPPED())

    def seek(self, now_ns: int, position: float, by: str = "") -> None:
        """Go to `position` (s) at once; PLAYING plays on from there, the rest stand there."""
        self._require_owner(by)
        target = self._machine.check(Event.SEEK)
        checked_position(position, self._loaded().duration)
        if target is State.PLAYING:
            self._follow(now_ns, position, Event.SEEK)
        else:
            self._jump(now_ns, Event.SEEK, position, say.AT_POSITION(position=position))

    def set_rate(
        self, now_ns: int, rate: float, since_ns: int | None = None, by: str = ""
    ) -> None:
        """Set the speed of playback, 0.1 to 4 or -4 to -0.1, without a jump.

        What is READY then begins at the other end where the direction changes. A system names
        the instant, a little in the past, from which on the new rate holds, so that its members
        stay together.
        """
        self._require_owner(by)
        turns = (checked_rate(rate) < 0) != (self.rate < 0)
        self._stream.set_rate(now_ns if since_ns is None else since_ns, rate)
        if turns and self.state is State.READY:
            self._stream.stand(now_ns, self._stream.begin)
        self._announce(say.RATE_SET(rate=rate))

    def set_standing_rate(self, now_ns: int, rate: float) -> None:
        """Repeat the joint state of a robot that does not move at `rate` Hz (0: never)."""
        self._stream.set_standing_rate(now_ns, rate)

    def hold_at(self, until: float | None, by: str = "") -> None:
        """Wait in PAUSED at a later position than now, `until` (s); None: play to the end."""
        self._require_owner(by)
        if until is not None:
            checked_position(until, self._loaded().duration)
            streamed = self._stream.streamed
            if streamed is not None and until <= streamed:
                raise Misuse(say.PASSED_ALREADY(until=until))
        self._stream.end_at(until)

    def set_loop(self, loop: bool, by: str = "") -> None:
        """Set whether the trajectory starts over after its last frame."""
        self._require_owner(by)
        self.loop = loop
        self._announce(say.LOOPS() if loop else say.PLAYS_ONCE())

    def clear_halt(self, now_ns: int) -> None:
        """End a halt by command; raise Misuse while physics still reports a collision."""
        self._machine.check(Event.CLEAR_HALT)
        if self._touching:
            raise Misuse(say.STILL_TOUCHES())
        self._halt(now_ns, Event.CLEAR_HALT, say.CLEAR_AGAIN())

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
            # The system was restarted, and knows nothing of what its member does.
            self._halt(now_ns, Event.RELEASED, None)
        self.system = system
        self._announce(say.DRIVEN_BY(system=system))

    def release(self, now_ns: int, by: str) -> None:
        """Leave the system, paused where the arm is; no effect for another system's robot."""
        if self.system != by:
            return
        self._report(now_ns, Event.RELEASED, None)
        self.system = ""
        self._announce(say.RELEASED_BY(system=by))

    # reports of physics ---------------------------------------------------------------------

    def collide(self, now_ns: int, why: Diagnostic) -> bool:
        """Take that the arm collides: halt where it is.

        Returns False where the arm did not move anyway; then the state stays.
        """
        self._touching = True
        return self._report(now_ns, Event.COLLIDED, why)

    def clear(self, now_ns: int) -> bool:
        """Take that the arm is clear again: end a halt; play then goes on in place.

        Returns False where there was no halt.
        """
        self._touching = False
        return self._report(now_ns, Event.CLEARED, say.CLEAR_AGAIN())

    # time -----------------------------------------------------------------------------------

    def due_ns(self) -> int | None:
        """Return when the next joint state leaves; None: not before something changes."""
        return self._stream.next_ns

    def tick(self, now_ns: int) -> Sample | None:
        """Return the joint state that is due at `now_ns`, or None."""
        stream, state = self._stream, self._machine.state
        if stream.next_ns is None or now_ns < stream.next_ns:
            return None
        if state is State.PLAYING and self.is_live:
            return self._live_sample(now_ns)
        if state is State.PLAYING:
            sample = stream.trajectory_sample(now_ns)
            if stream.ended:
                self._finish(sample.due_ns)
            elif stream.held:
                self._halt(now_ns, Event.HELD, say.HELD_BY_WAIT())
            return sample
        if state is State.ADJUSTING:
            sample = stream.approach_sample(now_ns)
            if stream.arrived:
                self._arrive(sample.due_ns)
            return sample
        return stream.standing_sample(now_ns)

    def _live_sample(self, now_ns: int) -> Sample:
        sample = self._stream.live_sample(now_ns, self._set_points.step)
        came_ns = self._commanded_ns
        silent = came_ns is None or now_ns - came_ns > live.SILENCE * SECOND
        if silent:
            self._halt(now_ns, Event.HELD, say.COMMANDS_ENDED())
        return sample

    def shift(self, by_ns: int) -> None:
        """Go on as before after the clock was set by `by_ns`."""
        self._stream.shift(by_ns)
        self._set_points.shift(by_ns)
        if self._commanded_ns is not None:
            self._commanded_ns += by_ns
        self._announce(self._message)

    def take_statuses(self) -> list[PlaybackStatus]:
        """Return the statuses of all changes since the last call, oldest first."""
        taken = self._statuses
        if taken:
            self._statuses = []
        return taken

    # inside ---------------------------------------------------------------------------------

    def _require_owner(self, by: str) -> None:
        if by != self.system:
            raise Misuse(
                say.DRIVEN_BY_SYSTEM(system=self.system)
                if self.system
                else say.NOT_DRIVEN_BY(system=by)
            )

    def _loaded(self) -> Trajectory:
        if self.trajectory is None:
            raise Misuse(say.NOTHING_LOADED(state=self.state.name))
        return self.trajectory

    def _check_fits(self, trajectory: Trajectory) -> None:
        """Raise BadInput where the trajectory was not made for this robot."""
        check_fits(
            trajectory.id,
            (trajectory.robot_model, trajectory.joint_names, trajectory.end_effector or ""),
            (self.model.id, self.model.joint_names, self.end_effector),
        )

    def _announce(self, message: Diagnostic | None) -> None:
        self._message = message
        self._statuses.append(self.status())

    # Each of these fires an event, has the arm do what the new state says, and announces it.

    def _stand(self, now_ns: int, event: Event, position: float, message: Diagnostic) -> None:
        """Stand still; the next play begins at `position` (s)."""
        self._machine.fire(event)
        self._stream.stand(now_ns, position)
        self._announce(message)

    def _jump(self, now_ns: int, event: Event, position: float, message: Diagnostic) -> None:
        """Put the arm at `position` (s) of the trajectory at once."""
        self._machine.fire(event)
        self._stream.jump(now_ns, position)
        self._announce(message)

    def _halt(self, now_ns: int, event: Event, message: Diagnostic | None) -> None:
        """Stand still exactly where the last joint state left the arm."""
        self._machine.fire(event)
        self._stream.halt(now_ns)
        self._announce(message)

    def _approach(
        self, now_ns: int, position: float, event: Event, *, play_on_arrival: bool
    ) -> float:
        """Move to `position` (s) of the trajectory; return how long that takes, s."""
        goal = self._loaded().sample(position)
        motion = self._planner.plan(self.model, self.arm, goal)
        self._machine.fire(event)
        self._play_on_arrival = play_on_arrival
        self._stream.approach(now_ns, motion, position)
        self._announce(say.MOVES_TO_START())
        return motion.duration

    def _follow(self, start_ns: int, position: float, event: Event) -> None:
        """Follow the trajectory from `position` (s) on."""
        self._machine.fire(event)
        self._stream.follow(start_ns, position)
        self._announce(None)

    def _report(self, now_ns: int, event: Event, message: Diagnostic | None) -> bool:
        """Take an event from outside; halt the arm unless the state ignores the event."""
        if self._machine.ignores(event):
            self._machine.fire(event)
            return False
        self._halt(now_ns, event, message)
        return True

    def _arrive(self, due_ns: int) -> None:
        """Play, or wait at the start: the last joint state of the approach left at `due_ns`."""
        position, next_ns = self.clock.position, self._stream.next_ns
        if self._play_on_arrival:
            assert next_ns is not None
            self._follow(next_ns, position, Event.ARRIVED)
        else:
            self._stand(due_ns, Event.STAGED, position, say.AT_START())

    def _finish(self, end_ns: int) -> None:
        """End the run, or start over: its last joint state left at `end_ns`."""
        begin = self._stream.begin
        # A member's own loop would keep its system from ending.
        if self.system or not self.loop:
            # COMPLETE lasts no longer than its announcement.
            message = say.PLAYED_BACK() if self.rate < 0 else say.PLAYED_TO_END()
            self._stand(end_ns, Event.FINISHED, self._stream.end, message)
            self._machine.fire(Event.REARMED)
            self._stream.stand(end_ns, begin, sent=True)
            self._announce(message)
        elif self._stream.is_at(begin):
            self._follow(end_ns + self._stream.period_ns, begin, Event.REPEATED)
        else:
            self._approach(end_ns, begin, Event.RETURNED, play_on_arrival=True)
