"""One robot's playback: a trajectory, a clock and the seven states. No node, no thread.

The caller owns time: it passes `now_ns` to every command, asks `due_ns()` when the next joint
state leaves, and calls `tick(now_ns)` then. What changed comes out of `take_statuses()`.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from mrlab_ros.core.clock import SECOND, PlaybackClock, checked_position, checked_rate
from mrlab_ros.core.errors import BadInput, Misuse
from mrlab_ros.core.geometry import Array
from mrlab_ros.core.playback.planner import Motion, MotionPlanner
from mrlab_ros.core.playback.states import Event, State, after
from mrlab_ros.core.robots.model import RobotModel
from mrlab_ros.core.trajectory.trajectory import ON_FRAME, Trajectory

# A machine that stalls for less than this delays joint states but loses none; what is later than
# this is left out, for catching up would take longer than it is worth.
LOST_AFTER_NS = 10 * SECOND
# Late joint states follow each other no closer than this share of the period: the stream
# catches up without a burst.
CATCH_UP_SPACING = 0.5
# The arm stands on the trajectory when no joint is further off than this, rad.
ON_TRAJECTORY = 1e-6
# Rate of joint states while the arm moves without a trajectory's frame rate, Hz.
MOTION_RATE = 100.0


@dataclass(frozen=True)
class Sample:
    """One joint state. due_ns is its deadline and its stamp; arrays are (J,) rad and rad/s."""

    due_ns: int
    positions: Array
    velocities: Array
    position: float
    frame: int
    streamed: bool


@dataclass(frozen=True)
class PlaybackStatus:
    """What a client may know of a playback at one instant."""

    state: State
    message: str
    trajectory: Trajectory | None
    clock: PlaybackClock
    frame: int
    rate: float
    loop: bool
    system: str


class Playback:
    """Plays one trajectory at a time on one robot.

    A command that the state forbids raises Misuse, a bad argument BadInput; either way nothing
    changes. `by` names the robot system that commands; a member obeys its system alone.
    """

    def __init__(self, model: RobotModel, planner: MotionPlanner, standing_rate: float) -> None:
        """Stand at the model's home pose; `standing_rate` (Hz, 0: never) repeats the pose."""
        self.model = model
        self._planner = planner
        self._standing_ns = round(SECOND / standing_rate) if standing_rate > 0 else None
        self.state = State.IDLE
        self.trajectory: Trajectory | None = None
        self.clock = PlaybackClock()
        self.rate = 1.0
        self.loop = False
        self.system = ""
        self.sent = 0
        self.lost = 0
        self._message = ""
        self._arm: Array = model.home
        self._next_ns: int | None = 0
        # The next joint state: its number at this rate, its position (s) and its deadline.
        self._tick, self._place, self._due_ns = 0, 0.0, 0
        self._streamed: float | None = None
        self._motion: Motion | None = None
        self._motion_start_ns = 0
        self._play_on_arrival = False
        self._until: float | None = None
        self._statuses: list[PlaybackStatus] = []
        self._announce("")

    # commands -------------------------------------------------------------------------------

    def load(self, now_ns: int, trajectory: Trajectory, by: str = "") -> None:
        """Load a trajectory made for this model; the arm stays where it is."""
        self._require_master(by)
        state = after(self.state, Event.LOAD)
        if trajectory.robot_model != self.model.id:
            raise BadInput(
                f"trajectory '{trajectory.id}' was made for {trajectory.robot_model}, this robot "
                f"is a {self.model.id}; convert the file again for {self.model.id}"
            )
        if trajectory.joint_names != self.model.joint_names:
            raise BadInput(
                f"trajectory '{trajectory.id}' has the joints {', '.join(trajectory.joint_names)}"
                f"; expected {', '.join(self.model.joint_names)}; convert the file again"
            )
        self.trajectory = trajectory
        self._stand(now_ns, state, 0.0, f"loaded {trajectory.id}")

    def unload(self, now_ns: int, by: str = "") -> None:
        """Forget the trajectory; the arm stays where it is."""
        self._require_master(by)
        state = after(self.state, Event.UNLOAD)
        self.trajectory = None
        self._stand(now_ns, state, 0.0, "unloaded")

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
        A system may set the rate with it, have the clock pair begin a little in the past, and
        have the arm wait in PAUSED at the position `until` (s).
        """
        self._require_master(by)
        after(self.state, Event.PLAY)
        position = self.clock.position
        if until is not None:
            checked_position(until, self._loaded().duration)
        self.rate = self.rate if rate is None else checked_rate(rate)
        if by and not self._on_trajectory(position):
            raise Misuse(f"does not stand at {position:g} s of its trajectory; stage it first")
        if self._on_trajectory(position):
            self._until = until
            self._begin(
                now_ns if start_ns is None else start_ns, position, after(self.state, Event.PLAY)
            )
        else:
            self._move_to(now_ns, position, play_on_arrival=True)

    def stage(self, now_ns: int, position: float, by: str = "") -> float:
        """Move to `position` (s) and wait there in PAUSED; return how long that takes, s.

        An arm that is paused there already stays as it is.
        """
        self._require_master(by)
        after(self.state, Event.STAGE)
        checked_position(position, self._loaded().duration)
        there = self.clock.position == position and self._on_trajectory(position)
        if self.state is State.PAUSED and there:
            return 0.0
        return self._move_to(now_ns, position, play_on_arrival=False)

    def pause(self, now_ns: int, by: str = "") -> None:
        """Stand still where the last joint state left the arm."""
        self._require_master(by)
        state = after(self.state, Event.PAUSE)
        self._halt(now_ns, state, "paused")

    def stop(self, now_ns: int, by: str = "") -> None:
        """End the run: READY to play from the first frame, the arm stays where it is.

        In COLLISION_HALT the arm goes back to the first frame and waits there to be clear.
        """
        self._require_master(by)
        state = after(self.state, Event.STOP)
        if state is State.COLLISION_HALT:
            self._jump(now_ns, state, 0.0, "back at the first frame, waits until it is clear")
        else:
            self._stand(now_ns, state, 0.0, "stopped")

    def seek(self, now_ns: int, position: float, by: str = "") -> None:
        """Go to `position` (s) at once; PLAYING plays on from there, the rest stand there."""
        self._require_master(by)
        state = after(self.state, Event.SEEK)
        checked_position(position, self._loaded().duration)
        if state is State.PLAYING:
            self._begin(now_ns, position, state)
        else:
            self._jump(now_ns, state, position, f"stands at {position:g} s")

    def set_rate(
        self, now_ns: int, rate: float, since_ns: int | None = None, by: str = ""
    ) -> None:
        """Set the speed of playback, 0.1 to 4, without a jump.

        A system names the instant, a little in the past, from which on the new rate holds, so
        that its members stay together.
        """
        self._require_master(by)
        self.rate = checked_rate(rate)
        if self.state is State.PLAYING:
            start_ns = max(now_ns if since_ns is None else since_ns, self.clock.stamp_ns)
            self.clock = PlaybackClock(start_ns, self.clock.at(start_ns), rate)
            if self._streamed is None:
                self._aim(self.clock.position, skip=False)
            else:
                self._aim(max(self.clock.position, self._streamed), skip=True)
        self._announce(f"rate {rate:g}")

    def hold_at(self, until: float | None, by: str = "") -> None:
        """Wait in PAUSED at a later position than now, `until` (s); None: play to the end."""
        self._require_master(by)
        if until is not None:
            checked_position(until, self._loaded().duration)
            if self._streamed is not None and until <= self._streamed:
                raise Misuse(f"has passed {until:g} s already; pause, then seek back")
        self._until = until
        if self.state is State.PLAYING:
            self._take_up(self._tick)
            self._next_ns = self._due_ns

    def set_loop(self, loop: bool, by: str = "") -> None:
        """Set whether the trajectory starts over after its last frame."""
        self._require_master(by)
        self.loop = loop
        self._announce("loops" if loop else "plays once")

    def collide(self, now_ns: int, why: str) -> bool:
        """Halt where the arm stands; return False where the arm did not move anyway."""
        if self.state not in (State.PLAYING, State.ADJUSTING):
            return False
        self._halt(now_ns, after(self.state, Event.COLLIDED), why)
        return True

    def clear(self, now_ns: int) -> None:
        """End the halt: physics confirmed that the arm is clear; playing on resumes in place."""
        state = after(self.state, Event.CLEARED)
        self._halt(now_ns, state, "clear again")

    def claim(self, system: str) -> None:
        """Become a member of `system`; raise Misuse where another system has the robot."""
        if self.system not in ("", system):
            raise Misuse(f"is a member of system '{self.system}' already; dissolve that one first")
        self.system = system
        self._announce(f"driven by system {system}")

    def release(self, now_ns: int, by: str) -> None:
        """Leave the system, paused where the arm is; nothing to do for a stranger."""
        if self.system != by:
            return
        if self.state in (State.PLAYING, State.ADJUSTING):
            self._halt(now_ns, after(self.state, Event.PAUSE), "")
        self.system = ""
        self._announce(f"released by system {by}")

    # time -----------------------------------------------------------------------------------

    def due_ns(self) -> int | None:
        """Return when the next joint state leaves; None: not before something changes."""
        return self._next_ns

    def tick(self, now_ns: int) -> Sample | None:
        """Return the joint state that is due at `now_ns`, or None."""
        if self._next_ns is None or now_ns < self._next_ns:
            return None
        if self.state is State.PLAYING:
            return self._stream(now_ns)
        if self.state is State.ADJUSTING:
            return self._adjust(now_ns)
        self._next_ns = None if self._standing_ns is None else now_ns + self._standing_ns
        return self._unstreamed(now_ns, np.zeros_like(self._arm))

    def take_statuses(self) -> list[PlaybackStatus]:
        """Return the snapshots of all changes since the last call, oldest first."""
        taken, self._statuses = self._statuses, []
        return taken

    def status(self) -> PlaybackStatus:
        """Return the present state as a client may know it."""
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

    @property
    def frame(self) -> int:
        """The last source frame reached."""
        if self.trajectory is None:
            return 0
        position = self.clock.position if self._streamed is None else self._streamed
        return self.trajectory.frame_at(position)

    @property
    def arm(self) -> Array:
        """The joint positions sent last, (J,) rad."""
        return self._arm

    # the inside -----------------------------------------------------------------------------

    def _require_master(self, by: str) -> None:
        if by != self.system:
            raise Misuse(
                f"is driven by system '{self.system}'; command the system, or dissolve it"
                if self.system
                else f"is not a member of system '{by}'; create the system again"
            )

    def _loaded(self) -> Trajectory:
        if self.trajectory is None:
            raise Misuse(f"cannot move in {self.state.name}: load a trajectory first")
        return self.trajectory

    def _on_trajectory(self, position: float) -> bool:
        goal = self._loaded().sample(position)
        return bool(np.abs(goal - self._arm).max() <= ON_TRAJECTORY)

    def _announce(self, message: str) -> None:
        self._message = message
        self._statuses.append(self.status())

    def _stand(self, now_ns: int, state: State, position: float, message: str) -> None:
        """Stand still; the next play begins at `position` (s)."""
        self.state = state
        self._motion = None
        self._streamed = None
        self._until = None
        self.clock = PlaybackClock(now_ns, position, 0.0)
        self._next_ns = now_ns
        self._announce(message)

    def _jump(self, now_ns: int, state: State, position: float, message: str) -> None:
        self._arm = self._loaded().sample(position)
        self._stand(now_ns, state, position, message)

    def _halt(self, now_ns: int, state: State, message: str) -> None:
        """Stand still exactly where the last joint state left the arm."""
        position = self.clock.position if self._streamed is None else self._streamed
        streamed = self._streamed
        self._stand(now_ns, state, position, message)
        self._streamed = streamed

    def _move_to(self, now_ns: int, position: float, *, play_on_arrival: bool) -> float:
        goal = self._loaded().sample(position)
        motion = self._planner.plan(self.model, self._arm, goal)
        self._stand(now_ns, after(self.state, Event.STAGE), position, "moves to the start")
        self._motion, self._motion_start_ns = motion, now_ns
        self._play_on_arrival = play_on_arrival
        return motion.duration

    def _begin(self, start_ns: int, position: float, state: State) -> None:
        """Stream from `position` (s) on, its joint state first unless it was the last sent."""
        resumed = self._streamed == position
        if self.state is not State.PLAYING and not resumed:
            self.sent = self.lost = 0
        self.state = state
        self._motion = None
        self.clock = PlaybackClock(start_ns, position, self.rate)
        self._streamed = position if resumed else None
        self._aim(position, skip=resumed)
        self._announce("")

    @property
    def _step(self) -> float:
        """Return the time on the trajectory between two joint states, s."""
        return self.rate / self._loaded().frame_rate

    def _aim(self, position: float, *, skip: bool) -> None:
        """Aim at the first joint state at (or, with skip, after) `position` (s)."""
        ticks = position / self._step
        self._take_up(math.floor(ticks + 1e-6) + 1 if skip else math.ceil(ticks - 1e-6))
        self._next_ns = self._due_ns

    @property
    def _end(self) -> float:
        """Return where this run ends, s."""
        return self._loaded().duration if self._until is None else self._until

    def _take_up(self, tick: int) -> None:
        """Make `tick` the next joint state: its position, the last one's being the end itself."""
        trajectory = self._loaded()
        position, end = tick * self.rate / trajectory.frame_rate, self._end
        if position > end - ON_FRAME / trajectory.frame_rate:
            position = end
        self._tick, self._place = tick, position
        self._due_ns = self.clock.due(position)

    def _stream(self, now_ns: int) -> Sample:
        trajectory = self._loaded()
        if now_ns - self._due_ns > LOST_AFTER_NS:
            shown = min(self.clock.at(now_ns), self._end)
            newest = math.floor(shown / self._step + ON_FRAME)
            self.lost += max(newest - self._tick, 0)
            self._take_up(max(newest, self._tick))
        position, due_ns = self._place, self._due_ns
        self._streamed = position
        frame, self._arm, velocities = trajectory.at(position)
        if self.rate != 1.0:
            velocities = velocities * self.rate
        sample = Sample(due_ns, self._arm, velocities, position, frame, True)
        self.sent += 1
        self._take_up(self._tick + 1)
        period_ns = SECOND / trajectory.frame_rate
        self._next_ns = max(self._due_ns, now_ns + round(CATCH_UP_SPACING * period_ns))
        if position >= trajectory.duration:
            self._finish(due_ns, round(period_ns))
        elif position == self._until:
            self._halt(now_ns, after(self.state, Event.PAUSE), "waits for its signal")
        return sample

    def _finish(self, end_ns: int, period_ns: int) -> None:
        trajectory = self._loaded()
        if self.loop and self._on_trajectory(0.0):
            self._streamed = None
            self._begin(end_ns + period_ns, 0.0, after(self.state, Event.SEEK))
        elif self.loop:
            self._move_to(end_ns, 0.0, play_on_arrival=True)
        else:
            complete = after(self.state, Event.FINISHED)
            self._stand(end_ns, complete, trajectory.duration, "played to the end")
            self._stand(end_ns, after(complete, Event.REARMED), 0.0, "played to the end")
            self._next_ns = None if self._standing_ns is None else end_ns + self._standing_ns

    def _adjust(self, now_ns: int) -> Sample:
        assert self._motion is not None
        assert self._next_ns is not None
        due_ns = self._next_ns
        elapsed = (due_ns - self._motion_start_ns) / SECOND
        self._arm, velocities = self._motion.at(elapsed)
        sample = self._unstreamed(due_ns, velocities)
        rate = self.trajectory.frame_rate if self.trajectory else MOTION_RATE
        # A motion that fell behind goes on from the present: nobody counts its joint states.
        self._next_ns = max(due_ns, now_ns - round(SECOND / rate)) + round(SECOND / rate)
        if elapsed >= self._motion.duration:
            position = self.clock.position
            if self._play_on_arrival:
                self._begin(self._next_ns, position, after(self.state, Event.ARRIVED))
            else:
                self._stand(due_ns, after(self.state, Event.STAGED), position, "at the start")
        return sample

    def _unstreamed(self, due_ns: int, velocities: Array) -> Sample:
        """Return a joint state of an arm that is not on its way along the trajectory."""
        return Sample(due_ns, self._arm, velocities, self.clock.position, self.frame, False)
