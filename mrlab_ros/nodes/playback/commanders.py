"""Other ways to drive a robot: an action, a topic of trajectories, a stream of joint commands."""

from __future__ import annotations

import math
import time
from collections import deque
from collections.abc import Callable
from dataclasses import replace
from typing import Any

from control_msgs.action import FollowJointTrajectory
from rclpy.node import Node
from rclpy.qos import QoSProfile, ReliabilityPolicy
from rclpy.timer import Timer
from sensor_msgs.msg import JointState
from trajectory_msgs.msg import JointTrajectory

from mrlab_ros.core.base.errors import LabError, Misuse
from mrlab_ros.core.playback import diagnostics as say
from mrlab_ros.core.playback.execution import PlaybackStatus
from mrlab_ros.core.playback.goal import Code, WrongGoal
from mrlab_ros.core.playback.playback import Playback
from mrlab_ros.core.playback.pursuit import Bounds, Instant, Outcome, Pursuit
from mrlab_ros.core.robots.frames import joint_name
from mrlab_ros.core.trajectory.trajectory import Trajectory
from mrlab_ros.messages import qos
from mrlab_ros.messages.playback import (
    bounds_from_goal,
    feedback_to_message,
    goal_from_message,
    own_names,
    result_to_message,
)
from mrlab_ros.ros import clock
from mrlab_ros.ros.actions import GoalServer
from mrlab_ros.ros.clock import LabClock, every
from mrlab_ros.ros.deadlines import Command, Player
from mrlab_ros.ros.decoding import subscribe

# Refusals of one kind are logged so far apart, s: a stream of thousands must not fill /rosout.
WARNING_PERIOD_S = 1.0
# How often feedback is sent and a goal's end is looked for, s.
FEEDBACK_PERIOD_S = 0.05
# Best effort takes what reliable publishers send, too.
COMMANDS = QoSProfile(depth=10, reliability=ReliabilityPolicy.BEST_EFFORT)


class Commanders:
    """Takes goals and set-points for one robot's playback.

    All but note() runs in the node's executor. command: locks the scheduler. loaded: is called
    with what was loaded by a goal or a stream. warn: takes a sentence.
    """

    def __init__(
        self,
        node: Node,
        robot: str,
        playback: Playback,
        player: Player,
        clock: LabClock,
        command: Callable[[], Command],
        loaded: Callable[[int, Trajectory | None], None],
        warn: Callable[[str], None],
    ) -> None:
        self._node = node
        self._robot = robot
        self._playback = playback
        self._player = player
        self._clock = clock
        self._command = command
        self._loaded = loaded
        self._warn = warn
        # By the name among all robots' joints its own.
        self._own = {joint_name(robot, joint): joint for joint in playback.model.joint_names}
        # The joints of the goal, named as its client names them.
        self._named: list[str] = []
        self._goal: Any = None
        self._pursuit: Pursuit | None = None
        self._timer: Timer | None = None
        # Changes of state that the goal's watch has not seen yet.
        self._statuses: deque[PlaybackStatus] = deque()
        # By what is refused, when that was logged last, monotonic s.
        self._warned: dict[str, float] = {}
        self._last_warning = ""
        self._server = GoalServer(
            node,
            FollowJointTrajectory,
            "follow_joint_trajectory",
            self._on_goal,
            self._on_cancel,
        )
        subscribe(node, JointTrajectory, "joint_trajectory", self._on_trajectory, qos.EVENTS)
        subscribe(node, JointState, "joint_command", self._on_set_point, COMMANDS)

    def close(self) -> None:
        """End the goal that is followed; call it before the node is destroyed."""
        self._end(Outcome(Code.INVALID_GOAL, say.ROBOT_GONE(robot=self._robot)), "abort")
        self._server.close()

    @property
    def seen(self) -> Instant | None:
        """What was seen last of the goal that is followed; None: there is none."""
        pursuit = self._pursuit
        return None if pursuit is None else pursuit.seen

    def note(self, status: PlaybackStatus) -> None:
        """Take a change of the playback's state, in any thread."""
        if self._pursuit is not None:
            self._statuses.append(status)

    def _pursue(self, message: JointTrajectory, bounds: Bounds) -> None:
        """Begin to follow a goal in place of the one before it; raise LabError where it is bad."""
        bounds.check(self._playback.model.joint_names)
        goal = goal_from_message(message, self._own)
        with self._command() as now_ns:
            if goal.stamp_ns:
                goal = replace(goal, stamp_ns=self._clock.instant(goal.stamp_ns))
            trajectory = self._playback.external.pursue(now_ns, goal)
            start_ns = self._playback.clock.stamp_ns
            # Statuses from here on are of the new goal.
            self._statuses.clear()
            replaced, self._pursuit = self._pursuit, Pursuit(trajectory, start_ns, bounds)
        if replaced is not None and self._goal is not None:
            given_up = Outcome(Code.INVALID_GOAL, say.GOAL_REPLACED(), replaced.figures())
            self._finish(self._goal, given_up, "abort")
        self._goal = None
        self._loaded(now_ns, trajectory)

    def _on_goal(self, goal: Any) -> None:
        request = goal.request
        try:
            if request.multi_dof_trajectory.points:
                raise WrongGoal(say.HAS_MULTI_DOF(field="multi_dof_trajectory"))
            _refuse_doubtful()
            self._pursue(request.trajectory, bounds_from_goal(request, self._own))
            self._named = (
                list(self._own)
                if set(request.trajectory.joint_names) <= self._own.keys()
                else list(self._own.values())
            )
        except LabError as error:
            code = error.code if isinstance(error, WrongGoal) else Code.INVALID_GOAL
            self._warn_seldom("goal", f"{self._robot} refuses a goal: {error}")
            self._finish(goal, Outcome(code, error.diagnostic), "abort")
            return
        self._goal = goal
        if self._timer is None:
            self._timer = every(self._node, FEEDBACK_PERIOD_S, self._watch)

    def _on_cancel(self, goal: Any) -> None:
        """Hold in place; the next watch ends the goal, when its client knows of the cancelling."""
        if self._goal is None or goal.goal_id != self._goal.goal_id:
            return
        with self._command() as now_ns:
            if self._playback.moving:
                self._playback.pause(now_ns)

    def _on_trajectory(self, message: JointTrajectory) -> None:
        try:
            _refuse_doubtful()
            self._pursue(message, Bounds())
            self._pursuit = None  # nobody waits for its end
        except LabError as error:
            said = f"{self._robot} refuses a joint_trajectory: {error}"
            self._warn_seldom("joint_trajectory", said)

    def _on_set_point(self, message: JointState) -> None:
        begins, refused = False, None
        with self._command() as now_ns:
            try:
                _refuse_doubtful()
                begins = self._playback.external.command(
                    now_ns, own_names(message.name, self._own), message.position, message.velocity
                )
                trajectory = self._playback.trajectory
            except LabError as error:
                refused = error.diagnostic
        if begins:
            self._loaded(now_ns, trajectory)
        # The same refusal comes with every set-point; its numbers differ.
        if refused is None:
            self._last_warning = ""
        elif refused.code != self._last_warning and self._warn_seldom(
            "joint_command", f"{self._robot}: {refused}"
        ):
            self._last_warning = refused.code

    def _warn_seldom(self, what: str, said: str) -> bool:
        """Warn, unless the same was refused a moment ago; return whether it was said."""
        now = time.monotonic()
        if now - self._warned.get(what, -math.inf) < WARNING_PERIOD_S:
            return False
        self._warned[what] = now
        self._warn(said)
        return True

    def _watch(self) -> None:
        goal, pursuit, last = self._goal, self._pursuit, self._player.last
        if goal is None or pursuit is None:
            self._stop_watching()
            return
        if goal.is_cancel_requested:
            held = Outcome(Code.SUCCESSFUL, say.GOAL_CANCELLED(), pursuit.figures())
            self._end(held, "canceled")
            return
        while self._statuses:
            pursuit.note(self._statuses.popleft())
        if last is None:
            return
        now_ns = self._now_ns()
        instant = pursuit.instant(now_ns, last.sample)
        outcome = pursuit.outcome(now_ns, instant)
        stamp_ns = self._clock.stamp(now_ns)
        goal.publish_feedback(feedback_to_message(stamp_ns, self._robot, self._named, instant))
        if outcome is None:
            return
        if outcome.code is not Code.SUCCESSFUL:
            with self._command() as now_ns:
                ours = self._playback.trajectory is pursuit.trajectory
                if ours and self._playback.moving:
                    self._playback.pause(now_ns)
        self._end(outcome, "succeed" if outcome.code is Code.SUCCESSFUL else "abort")

    def _now_ns(self) -> int:
        with self._command() as now_ns:
            return now_ns

    def _end(self, outcome: Outcome, how: str) -> None:
        goal, self._goal, self._pursuit = self._goal, None, None
        self._statuses.clear()
        self._stop_watching()
        if goal is not None:
            self._finish(goal, outcome, how)

    def _finish(self, goal: Any, outcome: Outcome, how: str) -> None:
        self._server.finish(goal, result_to_message(outcome), how)

    def _stop_watching(self) -> None:
        if self._timer is not None:
            self._node.destroy_timer(self._timer)
            self._timer = None


def _refuse_doubtful() -> None:
    """Raise Misuse while what comes may have waited for the end of a freeze of this process."""
    why = clock.why_doubtful()
    if why:
        raise Misuse(why)
