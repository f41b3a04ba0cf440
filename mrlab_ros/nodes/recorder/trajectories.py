"""Answers for the converter while a bag is replayed: the bag's own trajectories."""

from __future__ import annotations

from typing import Any

from mrlab_msgs import srv
from rclpy.node import Node

from mrlab_ros.adapters.bags.reader import Bag
from mrlab_ros.adapters.trajectories.formats import parse
from mrlab_ros.core.base.diagnostic import Diagnostic
from mrlab_ros.core.base.errors import BadInput
from mrlab_ros.messages import trajectories
from mrlab_ros.nodes.recorder.attachments import trajectory_name
from mrlab_ros.nodes.recorder.diagnostics import BAG_TRAJECTORY
from mrlab_ros.ros.services import answered, create_service


class ReplayedTrajectories:
    """Offers /converter/get on `node`, from the attachments of `bag`, until close()."""

    def __init__(self, node: Node, bag: Bag) -> None:
        self._node = node
        self._bag = bag
        self._service = create_service(node, srv.GetTrajectory, "/converter/get", self._get)

    def close(self) -> None:
        self._node.destroy_service(self._service)

    def get_logger(self) -> Any:
        return self._node.get_logger()

    @answered
    def _get(self, request: Any, response: Any) -> Diagnostic:
        name = trajectory_name(request.id)
        try:
            found = self._bag.attachment(name)
        except BadInput:
            # the only version that was recorded has the id alone for a name
            whole, at, _ = request.id.rpartition("@")
            if not at:
                raise
            found = self._bag.attachment(trajectory_name(whole))
        trajectory = parse(found.data, name)
        response.trajectory = trajectories.trajectory_to_message(
            trajectory, request.begin, request.count
        )
        return BAG_TRAJECTORY(trajectory=request.id, bag=self._bag.path.name)
