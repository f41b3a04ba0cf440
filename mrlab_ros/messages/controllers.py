"""Robots as controllers of ros2_control: what a controller manager lists, what each publishes."""

from __future__ import annotations

from collections.abc import Sequence

from control_msgs.msg import JointTrajectoryControllerState
from controller_manager_msgs.msg import ControllerState

from mrlab_ros.core.playback.goal import FRAME_RATE
from mrlab_ros.core.playback.pursuit import Instant
from mrlab_ros.core.robots.controllers import TYPE, Controller
from mrlab_ros.messages.playback import point
from mrlab_ros.messages.time import make_header


def controller_to_message(controller: Controller) -> ControllerState:
    commands = [f"{joint}/position" for joint in controller.joint_names]
    return ControllerState(
        name=controller.name,
        state="inactive" if controller.system else "active",
        type=TYPE,
        update_rate=round(FRAME_RATE),
        claimed_interfaces=[] if controller.system else commands,
        required_command_interfaces=commands,
        required_state_interfaces=[
            f"{joint}/{kind}"
            for kind in ("position", "velocity")
            for joint in controller.joint_names
        ],
    )


def controller_state_to_message(
    now_ns: int, joint_names: Sequence[str], instant: Instant, rate: float
) -> JointTrajectoryControllerState:
    """rate: the speed of playback; 1 is the declared one."""
    measured = point(instant, instant.actual, instant.actual_velocities)
    return JointTrajectoryControllerState(
        header=make_header(now_ns, ""),
        joint_names=list(joint_names),
        reference=point(instant, instant.desired, instant.desired_velocities),
        feedback=measured,
        error=point(instant, instant.errors[0], instant.errors[1]),
        output=measured,
        speed_scaling_factor=rate,
    )
