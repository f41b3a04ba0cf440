"""The converter node: workspace files in, a catalogue of trajectories out."""

from __future__ import annotations

import threading
import time
from collections.abc import Callable
from concurrent.futures import Future, ThreadPoolExecutor
from functools import partial
from pathlib import Path
from typing import Any

from mrlab_msgs import msg, srv
from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.context import Context
from rclpy.parameter import Parameter

from mrlab_ros.adapters.robots.library import RobotLibrary
from mrlab_ros.adapters.trajectories.coefficients import load_coefficients
from mrlab_ros.adapters.trajectories.store import Damaged, TrajectoryStore
from mrlab_ros.adapters.workspaces.pool import ConversionPool
from mrlab_ros.adapters.workspaces.reader import (
    Limits,
    MiB,
    TooSlow,
    WorkspaceReader,
    in_memory,
    opened,
)
from mrlab_ros.adapters.workspaces.results import Converted, Task, refused
from mrlab_ros.core.conversion.convert import ID
from mrlab_ros.core.diagnostics import Refused
from mrlab_ros.core.errors import BadInput, LabError
from mrlab_ros.core.naming import did_you_mean
from mrlab_ros.messages import qos, trajectories
from mrlab_ros.messages.trajectories import (
    candidate_to_message,
    catalogue_to_message,
    info_from_head,
    trajectory_without_frames,
)
from mrlab_ros.nodes import parameters
from mrlab_ros.nodes.parameters import ConverterParameters
from mrlab_ros.ros import share
from mrlab_ros.ros.answers import create_deferred_service
from mrlab_ros.ros.parameters import ParameterNode

# A longer trajectory is announced without its frames, which `get` gives in parts.
MOST_ANNOUNCED = 20_000


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
        self._store = TrajectoryStore(folder / "trajectories", self.get_logger().error)
        self._pool = ConversionPool(self._limits())
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
        self._serve(srv.ConvertTrajectory, "~/convert", self._begin_conversion)
        self._serve(srv.GetTrajectory, "~/get", self._on_threads(self._get))
        self._serve(srv.ListTrajectories, "~/list", self._on_threads(self._list))
        self._serve(srv.Remove, "~/delete", self._on_threads(self._delete))
        self._read_catalogue()

    def parameters_changed(self) -> None:
        self._pool.limits = self._limits()

    def _limits(self) -> Limits:
        values = self.parameters
        return Limits(
            memory=values.memory_limit * MiB,
            time=values.time_limit,
            output=values.output_limit * MiB,
            file_size=values.file_size_limit * MiB,
            rows=values.row_limit,
        )

    def destroy_node(self) -> None:
        """Give up what is being converted and end the processes that do it."""
        self._reads.shutdown(wait=False, cancel_futures=True)
        self._pool.close()
        self._reads.shutdown()
        super().destroy_node()

    def _serve(self, kind: Any, name: str, begin: Callable[[Any, Any], Future[Any]]) -> None:
        create_deferred_service(self, kind, name, begin, callback_group=self._group)

    def _on_threads(self, answer: Callable[[Any, Any], None]) -> Callable[[Any, Any], Future[Any]]:
        """Return a callback that runs `answer` on one of the catalogue's threads."""
        return lambda request, response: self._reads.submit(
            self._answered, lambda: answer(request, response), response
        )

    def _answered(self, answer: Callable[[], None], response: Any) -> Any:
        try:
            answer()
        except LabError as error:
            response.success, response.message = False, str(error)
        except Exception as error:
            self.get_logger().error(repr(error))
            if hasattr(response, "success"):
                response.success = False
                response.message = f"the converter failed ({error!r}); its log has the details"
        return response

    def _begin_conversion(self, request: Any, response: Any) -> Future[Any]:
        """Queue a conversion; the future has its answer, whatever becomes of it."""
        answered: Future[Any] = Future()

        def finish(done: Future[Converted]) -> None:
            if done.cancelled():
                answered.cancel()
            else:
                answer = partial(self._answer, done, task, response)
                answered.set_result(self._answered(answer, response))

        try:
            task = self._task(request)
            data = None if request.path else memoryview(request.data)
            size = _size(request.path) if data is None else data.nbytes
            work = partial(self._convert, task, Path(request.path), data)
            self._pool.submit(work, size, 0 if data is None else size).add_done_callback(finish)
        except LabError as error:
            response.success, response.message = False, str(error)
            answered.set_result(response)
        return answered

    def _task(self, request: Any) -> Task:
        known = self._library.end_effectors()
        if request.end_effector and request.end_effector not in known:
            raise BadInput(
                f"there is no end effector '{request.end_effector}'; known are: "
                f"{', '.join(known)}; leave it empty for a bare flange"
                f"{did_you_mean(request.end_effector, known)}"
            )
        if request.id and not ID.fullmatch(request.id):
            raise BadInput(
                f"the name '{request.id}' cannot be used; expected letters, digits, '.', '_' and "
                "'-', at most 128, beginning with a letter or digit"
            )
        return Task(
            file=Path(request.path or request.file_name).name or "upload.mat",
            options=trajectories.options_from_request(request),
            robot=self._library.model(request.robot_model),
            coefficients=self._coefficients,
            end_effector=request.end_effector or None,
            trajectory_id=request.id,
            created_ns=time.time_ns(),
            default_frame_rate=self.parameters.default_frame_rate,
        )

    def _convert(
        self, task: Task, path: Path, data: memoryview | None, reader: WorkspaceReader
    ) -> Converted:
        """Convert behind the wall; put an accepted trajectory into the catalogue's folder."""
        try:
            with (
                opened(path) if data is None else in_memory(data) as source,
                self._store.new_file() as (file, commit),
            ):
                converted = reader.convert(source, task, file)
                if converted.head is not None:
                    commit(converted.head["id"])
                return converted
        except TooSlow:
            raise  # the pool decides whether it has more time
        except Refused as error:
            result = refused(task.file, error.finding)
            return Converted(result, result.message)

    def _answer(self, done: Future[Converted], task: Task, response: Any) -> None:
        try:
            converted = done.result()
        except TooSlow as error:
            result = refused(task.file, error.finding)
            converted = Converted(result, result.message)
        result, head = converted.result, converted.head
        response.success = head is not None
        response.message = converted.message
        response.outcome = result.outcome.value
        response.candidates = [candidate_to_message(c) for c in result.candidates]
        if result.preview is not None:
            response.preview = trajectories.preview_to_message(result.preview)
        response.diagnostics = [trajectories.diagnostic_to_message(d) for d in result.diagnostics]
        if head is None:
            self.get_logger().info(f"refused: {converted.message}")
            return
        response.trajectory = info_from_head(head)
        self._update(head["id"])
        if self._converted.get_subscription_count():
            self._converted.publish(self._event(head))
        self.get_logger().info(converted.message)

    def _event(self, head: dict[str, Any]) -> msg.Trajectory:
        """Return what `/trajectories/converted` says: all frames, of a long one the info alone.

        rclpy holds the interpreter while it copies a message, so a long one would hold up every
        node of the process.
        """
        if head["frame_count"] <= MOST_ANNOUNCED:
            return trajectories.frames_to_message(self._store.frames(head["id"], 0, 0))
        return trajectory_without_frames(head)

    def _get(self, request: Any, response: Any) -> None:
        try:
            if request.file_only:
                response.trajectory.info = info_from_head(self._store.head(request.id))
            else:
                frames = self._store.frames(request.id, request.begin, request.count)
                response.trajectory = trajectories.frames_to_message(frames)
            response.file = str(self._store.file(request.id))
        except Damaged as error:
            self.get_logger().error(f"removed from the catalogue: {error}")
            self._update(request.id)
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
        self._update(request.name)
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

    def _update(self, trajectory_id: str) -> None:
        """Let the catalogue say of a trajectory what its file says, and announce it.

        The file is asked, as conversions of the same name end in any order.
        """
        with self._lock:
            try:
                head = self._store.head(trajectory_id)
            except BadInput:
                self._infos.pop(trajectory_id, None)
            else:
                self._infos[trajectory_id] = info_from_head(head)
            self._catalogue.publish(catalogue_to_message(self._sorted()))


def _size(path: str) -> int:
    """Return the size of a file, bytes, for the order of work; 0 where it cannot be read."""
    try:
        return Path(path).stat().st_size
    except (OSError, ValueError):
        return 0
