"""The execution of one robot's playback: its state, its joint states, its announcements.

`Playback` and `External` command it: each method fires an event, has the arm do what the new state
says, and announces it.
"""

from __future__ import annotations

from dataclasses import dataclass

from mrlab_ros.core.base.clock import SECOND, PlaybackClock
from mrlab_ros.core.base.diagnostic import Diagnostic
from mrlab_ros.core.base.errors import Misuse
from mrlab_ros.core.base.geometry import Array
from mrlab_ros.core.base.state_machine import Machine
from mrlab_ros.core.playback import diagnostics as say
from mrlab_ros.core.playback.states import MOVING, TABLE, Event, State
from mrlab_ros.core.playback.stream import Stream
from mrlab_ros.core.robots.model import RobotModel
from mrlab_ros.core.trajectory.trajectory import Trajectory, check_fits


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


class Execution:
    """One robot's state machine and its joint states.

    end_effector: what the robot carries; empty: nothing. system: the robot system that commands
    it; empty: it is independent. loop: whether it starts over after its last frame.
    touching: whether physics reports a collision; None: physics has reported nothing yet.
    """

    def __init__(self, model: RobotModel, standing_rate: float) -> None:
        self.model = model
        self.end_effector = ""
        self.loop = False
        self.system = ""
        self.machine = Machine(TABLE)
        self.stream = Stream(model.home, standing_rate)
        self.touching: bool | None = None
        self._message: Diagnostic | None = None
        self._statuses: list[PlaybackStatus] = []
        self.announce(None)

    @property
    def state(self) -> State:
        """The state of the playback."""
        return self.machine.state

    @property
    def moving(self) -> bool:
        """Return whether the arm moves."""
        return self.state in MOVING

    @property
    def trajectory(self) -> Trajectory | None:
        """The loaded trajectory."""
        return self.stream.trajectory

    @property
    def clock(self) -> PlaybackClock:
        """The position on the trajectory at any time."""
        return self.stream.clock

    @property
    def rate(self) -> float:
        """The speed of playback; 1 is the trajectory's own, -1 the same backwards."""
        return self.stream.rate

    @property
    def arm(self) -> Array:
        """The joint positions sent last, (J,) rad."""
        return self.stream.arm

    @property
    def frame(self) -> int:
        """The last source frame reached."""
        return self.stream.frame

    def progress(self) -> tuple[Trajectory | None, int, int]:
        """Return the trajectory and how many of this run's joint states were sent, and left out.

        Left out are those that were too late.
        """
        stream = self.stream
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

    def at(self, instant_ns: int) -> tuple[Array, Array, Array]:
        """Return what the arm's course has at an instant: (J,) rad, rad/s and rad/s^2.

        Raises Misuse where the arm follows nothing, and for an instant before the newest change of
        its course or after its end.
        """
        trajectory, clock = self.trajectory, self.clock
        if trajectory is None or self.state not in (State.PLAYING, State.PAUSED):
            raise Misuse(say.FOLLOWS_NOTHING(state=self.state.name))
        early = clock.stamp_ns - instant_ns
        if early > 0:
            raise Misuse(say.OUTSIDE_COURSE(away=early / SECOND, side="before"))
        position = clock.at(instant_ns)
        inside = min(max(position, 0.0), trajectory.duration)
        if position != inside:
            late = abs((position - inside) / clock.rate)
            raise Misuse(say.OUTSIDE_COURSE(away=late, side="after"))
        _, positions, velocities = trajectory.at(position)
        accelerations = trajectory.accelerations(position)
        return positions, velocities * clock.rate, accelerations * clock.rate**2

    def take_statuses(self) -> list[PlaybackStatus]:
        """Return the statuses of all changes since the last call, oldest first."""
        taken = self._statuses
        if taken:
            self._statuses = []
        return taken

    # guards -----------------------------------------------------------------------------------

    def require_owner(self, by: str) -> None:
        """Raise Misuse unless `by` is the system that commands the robot; empty: none."""
        if by != self.system:
            raise Misuse(
                say.DRIVEN_BY_SYSTEM(system=self.system)
                if self.system
                else say.NOT_DRIVEN_BY(system=by)
            )

    def loaded(self) -> Trajectory:
        """Return the loaded trajectory; raise Misuse without one."""
        if self.trajectory is None:
            raise Misuse(say.NOTHING_LOADED(state=self.state.name))
        return self.trajectory

    def check_fits(self, trajectory: Trajectory) -> None:
        """Raise BadInput where the trajectory was not made for this robot."""
        check_fits(
            trajectory.id,
            (trajectory.robot_model, trajectory.joint_names, trajectory.end_effector or ""),
            (self.model.id, self.model.joint_names, self.end_effector),
        )

    def announce(self, message: Diagnostic | None) -> None:
        """Add the present state to the statuses to publish; message: why it is in it."""
        self._message = message
        self._statuses.append(self.status())

    def announce_again(self) -> None:
        """Add the present state once more."""
        self.announce(self._message)

    # Each of these fires an event, has the arm do what the new state says, and announces it.

    def stand(self, now_ns: int, event: Event, position: float, message: Diagnostic) -> None:
        """Stand still; the next play begins at `position` (s)."""
        self.machine.fire(event)
        self.stream.stand(now_ns, position)
        self.announce(message)

    def jump(self, now_ns: int, event: Event, position: float, message: Diagnostic) -> None:
        """Put the arm at `position` (s) of the trajectory at once."""
        self.machine.fire(event)
        self.stream.jump(now_ns, position)
        self.announce(message)

    def halt(self, now_ns: int, event: Event, message: Diagnostic | None) -> None:
        """Stand still exactly where the last joint state left the arm."""
        self.machine.fire(event)
        self.stream.halt(now_ns)
        self.announce(message)

    def follow(self, start_ns: int, position: float, event: Event) -> None:
        """Follow the trajectory from `position` (s) on."""
        self.machine.fire(event)
        self.stream.follow(start_ns, position)
        self.announce(None)

    def report(self, now_ns: int, event: Event, message: Diagnostic | None) -> bool:
        """Take an event from outside; halt the arm unless the state ignores the event."""
        if self.machine.ignores(event):
            self.machine.fire(event)
            return False
        self.halt(now_ns, event, message)
        return True
