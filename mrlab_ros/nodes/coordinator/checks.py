"""What is checked of the members of a new system before any robot is touched."""

from __future__ import annotations

import time
from collections.abc import Mapping
from typing import Any

from mrlab_msgs import msg, srv
from rclpy.node import Node

from mrlab_ros.core.base.diagnostic import Diagnostic, heard
from mrlab_ros.core.base.errors import BadInput, Misuse
from mrlab_ros.core.playback.diagnostics import MEMBER_OF_SYSTEM, NOT_STANDING
from mrlab_ros.core.playback.states import State
from mrlab_ros.core.systems.diagnostics import NO_TRAJECTORY_LOADED
from mrlab_ros.core.systems.robot_system import RobotSystem
from mrlab_ros.core.trajectory.trajectory import check_fits
from mrlab_ros.messages import qos
from mrlab_ros.nodes.coordinator.fleet import FIND_TIMEOUT_S, MemberClient
from mrlab_ros.ros.services import call_all

# The converter answers what it has of a trajectory within this time, s.
CATALOGUE_TIMEOUT_S = 4.0
# A robot that a system takes stands, and nothing waits to be cleared.
FREE = (State.IDLE, State.READY, State.PAUSED)
# A new subscription receives the last states of a robot one after another: one that refuses the
# robot counts once no newer one has followed for this time, s.
SETTLED_S = 0.25


class MemberChecks:
    """Checks that robots are free, that their trajectories exist and fit, and the waits.

    node: is spun by another thread than the one that checks.
    """

    def __init__(self, node: Node) -> None:
        self._get = node.create_client(
            srv.GetTrajectory, "/converter/get_any", qos_profile=qos.SERVICES
        )

    def check(
        self,
        system: RobotSystem,
        clients: Mapping[str, MemberClient],
        robots: Mapping[str, msg.Robot],
    ) -> None:
        """Raise LabError where `system` cannot be made of its members; nothing is changed."""
        deadline = time.monotonic() + FIND_TIMEOUT_S
        wanted: dict[str, str] = {}
        for member in system.members.values():
            robot, client = member.robot, clients[member.robot]
            while True:
                state = client.wait(deadline)
                why = _not_free(robot, state, system.name, member.trajectory_id)
                if why is None:
                    break
                if not client.wait_for_newer(state, SETTLED_S):
                    raise Misuse(why)
            if member.trajectory_id not in ("", state.trajectory_id):
                wanted[robot] = member.trajectory_id
            else:
                member.duration, member.frame_rate = state.duration, state.frame_rate
        known = self._trajectories(set(wanted.values()))
        for robot, trajectory_id in wanted.items():
            trajectory, placed = known[trajectory_id], robots[robot]
            info = trajectory.info
            check_fits(
                info.id,
                (info.robot_model, tuple(trajectory.joint_names), info.end_effector),
                (placed.model, tuple(placed.joint_names), placed.end_effector),
            )
            member = system.members[robot]
            member.duration, member.frame_rate = info.duration, info.frame_rate
        system.check()

    def _trajectories(self, ids: set[str]) -> dict[str, Any]:
        """Return what the catalogue has; raise BadInput where it lacks one."""
        requests = [srv.GetTrajectory.Request(id=name, file_only=True) for name in sorted(ids)]
        found = {}
        answers = call_all([(self._get, request) for request in requests], CATALOGUE_TIMEOUT_S)
        for request, answer in zip(requests, answers, strict=True):
            if not answer.success:
                raise BadInput(heard(answer))
            found[request.id] = answer.trajectory
        return found


def _not_free(
    robot: str, state: msg.PlaybackState, system: str, trajectory: str
) -> Diagnostic | None:
    """Return why a robot cannot become a member of `system`; None: it can.

    trajectory: what it shall load; empty: it plays what it has.
    """
    if not (trajectory or state.trajectory_id):
        return NO_TRAJECTORY_LOADED(robot=robot)
    if state.system == system:
        # This coordinator has no system of that name: it died, and its claim has not run out yet.
        return None
    if state.system:
        return MEMBER_OF_SYSTEM(robot=robot, system=state.system)
    if State(state.state) not in FREE:
        return NOT_STANDING(robot=robot, state=state.label)
    return None
