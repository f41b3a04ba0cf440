"""The converter node: workspace files in, a catalogue of trajectories out."""

from __future__ import annotations

import threading
import time
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import Any

from mrlab_msgs import msg, srv
from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.context import Context
from rclpy.parameter import Parameter

from mrlab_ros.adapters.robots.library import RobotLibrary
from mrlab_ros.adapters.trajectories.coefficients import load_coefficients
from mrlab_ros.adapters.trajectories.store import Damaged, TrajectoryStore
from mrlab_ros.adapters.workspaces.reader import Limits, MiB, WorkspaceReader
from mrlab_ros.core.conversion.convert import ConversionResult, convert
from mrlab_ros.core.errors import BadInput, LabError
from mrlab_ros.core.naming import did_you_mean
from mrlab_ros.messages import qos, trajectories
from mrlab_ros.messages.trajectories import (
    candidate_to_message,
    catalogue_to_message,
    info_from_head,
)
from mrlab_ros.nodes import parameters
from mrlab_ros.nodes.parameters import ConverterParameters
from mrlab_ros.ros import share
from mrlab_ros.ros.answers import create_deferred_service
from mrlab_ros.ros.parameters import ParameterNode


class ConverterNode(ParameterNode[ConverterParameters]):
    """Converts, keeps and announces trajectories; no callback ever holds up the executor."""

    def __init__(
        self,
        *,
        context: Context | None = None,
        parameter_overrides: list[Parameter] | None = None,
    ) -> None:
        super().__init__(
            "converter",
            ConverterParameters,
            parameters.ALL,
            context=context,
            parameter_overrides=parameter_overrides,
        )
        state = self.parameters.state_dir
        folder = Path(state) if state else Path.home() / ".local" / "share" / "mrlab"
        self._coefficients = load_coefficients(share.directory() / "config" / "torque_proxy.yaml")
        self._library = RobotLibrary(share.directory() / "robots")
        self._store = TrajectoryStore(folder / "trajectories")
        self._reader = WorkspaceReader(self._limits())
        # One thread: conversions happen one after another. Others read and delete meanwhile.
        self._work = ThreadPoolExecutor(max_workers=1, thread_name_prefix="converter")
        self._reads = ThreadPoolExecutor(max_workers=2, thread_name_prefix="catalogue")
        self._infos: dict[str, msg.TrajectoryInfo] = {}
        self._lock = threading.Lock()  # held while the catalogue is changed or announced

        self._catalogue = self.create_publisher(
            msg.TrajectoryCatalogue, "/trajectories", qos.LATCHED
        )
        self._converted = self.create_publisher(
            msg.Trajectory, "/trajectories/converted", qos.EVENTS
        )
        self._group = ReentrantCallbackGroup()
        self._serve(srv.ConvertTrajectory, "~/convert", self._convert, self._work)
        self._serve(srv.GetTrajectory, "~/get", self._get, self._reads)
        self._serve(srv.ListTrajectories, "~/list", self._list, self._reads)
        self._serve(srv.Remove, "~/delete", self._delete, self._reads)
        self._read_catalogue()
        self._work.submit(self._reader.start)

    def parameters_changed(self) -> None:
        self._reader.limits = self._limits()

    def _limits(self) -> Limits:
        values = self.parameters
        return Limits(
            memory=values.memory_limit * MiB,
            time=values.time_limit,
            output=values.output_limit * MiB,
            file_size=values.file_size_limit * MiB,
        )

    def destroy_node(self) -> None:
        """Give up what is being read and end the reading process."""
        self._work.shutdown(wait=False, cancel_futures=True)
        self._reads.shutdown(wait=False, cancel_futures=True)
        self._reader.close()
        self._work.shutdown()
        self._reads.shutdown()
        self._reader.close()
        super().destroy_node()

    def _serve(
        self,
        kind: Any,
        name: str,
        answer: Callable[[Any, Any], None],
        threads: ThreadPoolExecutor,
    ) -> None:
        """Offer a service whose `answer(request, response)` runs on one of these threads."""
        create_deferred_service(
            self,
            kind,
            name,
            lambda request, response: threads.submit(self._answered, answer, request, response),
            callback_group=self._group,
        )

    def _answered(self, answer: Callable[[Any, Any], None], request: Any, response: Any) -> Any:
        try:
            answer(request, response)
        except LabError as error:
            response.success, response.message = False, str(error)
        except Exception as error:
            self.get_logger().error(f"{answer.__name__}: {error!r}")
            if hasattr(response, "success"):
                response.success = False
                response.message = f"the converter failed ({error!r}); its log has the details"
        return response

    def _convert(self, request: Any, response: Any) -> None:
        robot = self._library.model(request.robot_model)
        known = self._library.end_effectors()
        if request.end_effector and request.end_effector not in known:
            raise BadInput(
                f"there is no end effector '{request.end_effector}'; known are: "
                f"{', '.join(known)}; leave it empty for a bare flange"
                f"{did_you_mean(request.end_effector, known)}"
            )
        path = Path(request.path)
        if request.path:
            file, read = path.name, lambda: self._reader.read_file(path)
        else:
            file = Path(request.file_name).name or "upload.mat"
            data = memoryview(request.data)
            read = lambda: self._reader.read_bytes(data, file)  # noqa: E731
        result = convert(
            file,
            read,
            trajectories.options_from_request(request),
            robot,
            self._coefficients,
            end_effector=request.end_effector or None,
            trajectory_id=request.id,
            created_ns=time.time_ns(),
            default_frame_rate=self.parameters.default_frame_rate,
        )
        self._answer(result, response)
        trajectory = result.trajectory
        if trajectory is None:
            self.get_logger().info(f"refused: {result.message}")
            return
        self._store.save(trajectory)
        response.trajectory = trajectories.info_to_message(trajectory)
        self._change(trajectory.id, response.trajectory)
        self._converted.publish(trajectories.trajectory_to_message(trajectory))
        self.get_logger().info(result.message)

    def _answer(self, result: ConversionResult, response: Any) -> None:
        response.success = result.trajectory is not None
        response.message = result.message
        response.outcome = result.outcome.value
        response.candidates = [candidate_to_message(c) for c in result.candidates]
        if result.preview is not None:
            response.preview = trajectories.preview_to_message(result.preview)
        response.diagnostics = [trajectories.diagnostic_to_message(d) for d in result.diagnostics]

    def _get(self, request: Any, response: Any) -> None:
        try:
            if request.file_only:
                info = info_from_head(self._store.head(request.id))
                response.trajectory = msg.Trajectory(info=info)
            else:
                frames = self._store.frames(request.id, request.begin, request.count)
                response.trajectory = trajectories.frames_to_message(frames)
            response.file = str(self._store.file(request.id))
        except Damaged as error:
            self.get_logger().error(f"removed from the catalogue: {error}")
            self._change(request.id, None)
            raise
        response.success = True

    def _list(self, request: Any, response: Any) -> None:
        infos = self._sorted()
        if request.robot_model:
            infos = [
                info
                for info in infos
                if info.robot_model == request.robot_model
                and info.end_effector in ("", request.end_effector)
            ]
        response.trajectories = infos

    def _delete(self, request: Any, response: Any) -> None:
        self._store.delete(request.name)
        self._change(request.name, None)
        response.success, response.message = True, f"'{request.name}' was deleted"

    def _read_catalogue(self) -> None:
        for trajectory_id in self._store.ids():
            try:
                self._infos[trajectory_id] = info_from_head(self._store.head(trajectory_id))
            except BadInput as error:
                self.get_logger().error(f"left out of the catalogue: {error}")
        self._catalogue.publish(catalogue_to_message(self._sorted()))

    def _sorted(self) -> list[msg.TrajectoryInfo]:
        infos = dict(self._infos)
        return [infos[key] for key in sorted(infos)]

    def _change(self, trajectory_id: str, info: msg.TrajectoryInfo | None) -> None:
        """Put an entry into the catalogue, or take it out, and announce the catalogue."""
        with self._lock:
            if info is None:
                self._infos.pop(trajectory_id, None)
            else:
                self._infos[trajectory_id] = info
            self._catalogue.publish(catalogue_to_message(self._sorted()))
