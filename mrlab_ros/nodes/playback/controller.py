"""What a controller of joint trajectories publishes and answers beside its action."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
from control_msgs.msg import JointTrajectoryControllerState
from control_msgs.srv import QueryTrajectoryState
from rclpy.node import Node

from mrlab_ros.core.base.errors import Misuse
from mrlab_ros.core.playback.playback import Playback
from mrlab_ros.core.playback.pursuit import Instant
from mrlab_ros.core.playback.stream import Sample
from mrlab_ros.core.robots.frames import joint_name
from mrlab_ros.messages import qos
from mrlab_ros.messages.controllers import controller_state_to_message
from mrlab_ros.messages.time import time_from_message
from mrlab_ros.ros.clock import LabClock
from mrlab_ros.ros.deadlines import Command
from mrlab_ros.ros.services import create_service


class Controller:
    """One robot as /controller_manager/list_controllers names it, joints as all robots' are.

    command: locks the scheduler.
    """

    def __init__(
        self,
        node: Node,
        robot: str,
        playback: Playback,
        clock: LabClock,
        command: Callable[[], Command],
    ) -> None:
        self._playback = playback
        self._clock = clock
        self._command = command
        self._joints = [joint_name(robot, joint) for joint in playback.model.joint_names]
        self._state = node.create_publisher(
            JointTrajectoryControllerState, "controller_state", qos.EVENTS
        )
        create_service(
            node, QueryTrajectoryState, "query_state", self._query, halts=lambda request: True
        )

    def publish(self, now_ns: int, sent: Sample, seen: Instant | None) -> None:
        """Publish the state, where somebody wants it. now_ns: the stamp.

        sent: the newest joint state. seen: of the goal that is followed; None: there is none, and
        the arm is where it should be.
        """
        if not self._state.get_subscription_count():
            return
        if seen is None:
            none = np.zeros((3, len(self._joints)))
            positions, velocities = sent.positions, sent.velocities
            seen = Instant(sent.position, positions, velocities, positions, velocities, none)
        rate = self._playback.rate
        self._state.publish(controller_state_to_message(now_ns, self._joints, seen, rate))

    def _query(
        self, request: QueryTrajectoryState.Request, response: QueryTrajectoryState.Response
    ) -> Any:
        response.name = self._joints
        try:
            with self._command():
                course = self._playback.at(self._clock.instant(time_from_message(request.time)))
        except Misuse as error:
            response.message = str(error)
            return response
        response.position, response.velocity, response.acceleration = (
            each.tolist() for each in course
        )
        response.success = True
        return response
