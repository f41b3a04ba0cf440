"""Goals and live set-points: what others command in place of a loaded trajectory."""

from __future__ import annotations

from collections.abc import Sequence

from mrlab_ros.core.base.clock import SECOND
from mrlab_ros.core.base.errors import LabError, Misuse
from mrlab_ros.core.playback import diagnostics as say
from mrlab_ros.core.playback import goal as goals
from mrlab_ros.core.playback import live
from mrlab_ros.core.playback.execution import Execution
from mrlab_ros.core.playback.states import Event, State
from mrlab_ros.core.playback.stream import Sample
from mrlab_ros.core.trajectory.trajectory import Trajectory

# A refused joint command is named in the status this often, ns.
REFUSAL_NS = SECOND
GOAL_PERIOD_NS = round(SECOND / goals.FRAME_RATE)


class External:
    """Goals and streams of set-points for one robot."""

    def __init__(self, execution: Execution) -> None:
        self._execution = execution
        self._set_points = live.SetPoints(execution.model)
        # When the last joint command came, accepted or not, and when one was refused last.
        self._commanded_ns: int | None = None
        self._refused_ns = 0

    def pursue(self, now_ns: int, goal: goals.Goal) -> Trajectory:
        """Follow a goal's points from where the arm is, in place of what it does now.

        An arm that moves goes on with the velocity that it has. Returns the trajectory that was
        made of it, which plays once at rate 1. Raises WrongGoal for a bad goal and Misuse where
        the state or a system forbids it; then nothing has changed.
        """
        self._execution.require_owner("")
        if not self._execution.moving:
            self._execution.machine.check(Event.LOAD)
        start_ns, arm, velocities = now_ns, self._execution.arm, None
        if self._execution.moving:
            start_ns, arm, velocities = self._execution.stream.motion(now_ns, GOAL_PERIOD_NS)
        trajectory = goals.trajectory(goal, self._execution.model, arm, start_ns, velocities)
        self._replace(now_ns, trajectory)
        self._execution.stream.rate, self._execution.loop = 1.0, False
        if velocities is not None:
            self._execution.stream.go_on_from(start_ns)
        self._execution.follow(start_ns, 0.0, Event.PLAY)
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
                self._execution.announce(say.COMMAND_REFUSED(why=error))
            raise
        if self._refused_ns and now_ns - self._refused_ns > REFUSAL_NS:
            self._refused_ns = 0
            self._execution.announce(say.FOLLOWS_COMMANDS())
        return begins

    def _take_command(
        self,
        now_ns: int,
        names: Sequence[str],
        positions: Sequence[float],
        velocities: Sequence[float],
        silent: bool,
    ) -> bool:
        self._execution.require_owner("")
        target = self._set_points.checked(names, positions, velocities)
        if self.is_live and self._execution.state is State.PLAYING:
            self._set_points.go_to(now_ns, target)
            return False
        self._execution.machine.check(Event.LOAD)
        if self.is_live and not silent:
            raise Misuse(
                say.COMMANDS_IGNORED(state=self._execution.state.name, silence=live.SILENCE)
            )
        self._replace(now_ns, self._set_points.place(self._execution.arm))
        self._go_live(now_ns)
        self._set_points.go_to(now_ns, target)
        return True

    @property
    def is_live(self) -> bool:
        """Return whether a stream of joint commands stands in for a trajectory."""
        trajectory = self._execution.trajectory
        return (
            trajectory is not None
            and trajectory.version == goals.UNPUBLISHED
            and trajectory.id == live.LIVE
        )

    def _replace(self, now_ns: int, trajectory: Trajectory) -> None:
        """Load what begins where the arm is; what moves is given up without a stop."""
        if self._execution.moving:
            self._execution.machine.fire(Event.PAUSE)
            self._execution.stream.halt(now_ns)
        self._execution.machine.fire(Event.LOAD)
        self._execution.stream.trajectory = trajectory
        self._execution.stream.stand(now_ns, 0.0)

    def resume(self, now_ns: int) -> None:
        """Go on with the stream, if it still comes; else it ends again."""
        self._commanded_ns = now_ns
        self._go_live(now_ns)

    def _go_live(self, now_ns: int) -> None:
        self._execution.machine.fire(Event.PLAY)
        self._execution.stream.stand(now_ns, 0.0)
        self._set_points.rest(now_ns)
        self._execution.announce(say.FOLLOWS_COMMANDS())

    def sample(self, now_ns: int) -> Sample:
        """Return the joint state of the stream that is due at `now_ns`."""
        sample = self._execution.stream.live_sample(now_ns, self._set_points.step)
        came_ns = self._commanded_ns
        silent = came_ns is None or now_ns - came_ns > live.SILENCE * SECOND
        if silent:
            self._execution.halt(now_ns, Event.HELD, say.COMMANDS_ENDED())
        return sample
