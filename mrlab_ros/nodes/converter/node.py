"""The converter node: workspace files in, a catalogue of trajectories out."""

from __future__ import annotations

import contextlib
import tempfile
import time
from collections.abc import Callable, Iterator
from concurrent.futures import Future
from dataclasses import replace
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any

from mrlab_msgs import srv
from rclpy.callback_groups import ReentrantCallbackGroup

from mrlab_ros.adapters import private_folder, share, threads
from mrlab_ros.adapters.robots.diagnostics import NO_END_EFFECTOR
from mrlab_ros.adapters.robots.library import RobotLibrary
from mrlab_ros.adapters.store import keys
from mrlab_ros.adapters.store.objects import open_store
from mrlab_ros.adapters.trajectories.catalogue_writer import CatalogueWriter
from mrlab_ros.adapters.trajectories.files import TrajectoryFiles, load_coefficients
from mrlab_ros.adapters.workspaces.diagnostics import TOO_LARGE
from mrlab_ros.adapters.workspaces.reader import (
    ConversionPool,
    Limits,
    MiB,
    TooSlow,
    WorkspaceReader,
    in_memory,
    opened,
)
from mrlab_ros.adapters.workspaces.results import Converted, Task, failed_here, refused
from mrlab_ros.core.base.errors import BadInput, LabError
from mrlab_ros.core.base.foreign_text import visible
from mrlab_ros.core.base.names import close_to
from mrlab_ros.core.trajectory.catalogue import checked_id, head_of
from mrlab_ros.core.trajectory.diagnostics import UPLOAD_OF_ANOTHER
from mrlab_ros.messages import trajectories
from mrlab_ros.messages.texts import tell
from mrlab_ros.messages.trajectories import candidate_to_message, info_from_head
from mrlab_ros.nodes import parameters
from mrlab_ros.nodes.converter.catalogue import TrajectoryServices
from mrlab_ros.nodes.parameters import ConverterParameters
from mrlab_ros.ros.clock import every
from mrlab_ros.ros.diagnostics import FAULT
from mrlab_ros.ros.parameters import NodeArguments, ParameterNode
from mrlab_ros.ros.services import (
    DeferredCallback,
    Response,
    ServiceCallback,
    create_deferred_service,
)

if TYPE_CHECKING:
    from typing_extensions import Unpack

SWEEP_PERIOD_S = 3600.0


class ConverterNode(
    ParameterNode[ConverterParameters],
    name="converter",
    kind=ConverterParameters,
    others=parameters.ALL,
):
    """Converts, keeps and announces trajectories; no callback ever holds up the executor."""

    def __init__(self, **ros: Unpack[NodeArguments]) -> None:
        super().__init__(**ros)
        state = self.parameters.state_dir
        folder = Path(state) if state else Path.home() / ".local" / "share" / "mrlab"
        self._coefficients = load_coefficients(share.directory() / "config" / "torque_proxy.yaml")
        self._library = RobotLibrary(share.directory() / "robots")
        self._store = open_store(self.parameters.store or str(folder / "store"))
        # Folder of converted files until the store has them.
        self._work = private_folder.make(private_folder.make(folder) / "work")
        self._writer = CatalogueWriter(self._store, self.get_logger().error)
        self._set_bounds()
        self.trajectories = TrajectoryServices(
            self,
            self._writer,
            TrajectoryFiles(self._store, folder / "fetched"),
        )
        self._pool = ConversionPool(self._limits())
        self._reads = threads.Pool("catalogue", 2)
        self._group = ReentrantCallbackGroup()
        self._serve(srv.ConvertTrajectory, "~/convert", self._begin_conversion)
        for kind, name, answer in (
            (srv.GetTrajectory, "get", self.trajectories.get),
            (srv.GetTrajectory, "get_any", self.trajectories.get_any),
            (srv.ListTrajectories, "list", self.trajectories.list_fitting),
            (srv.ListTrajectories, "list_any", self.trajectories.list_any_fitting),
            (srv.Remove, "delete", self.trajectories.delete),
            (srv.Remove, "erase", self.trajectories.erase),
            (srv.HandOver, "hand_over", self.trajectories.hand_over),
            (srv.PublishTrajectory, "publish", self.trajectories.publish),
            (srv.ShareTrajectory, "share", self.trajectories.share),
            (srv.RestoreTrajectory, "restore", self.trajectories.restore),
        ):
            self._serve(kind, f"~/{name}", self._on_threads(answer))
        every(self, SWEEP_PERIOD_S, self._sweep, self._group)

    def parameters_changed(self) -> None:
        self._pool.limits = self._limits()
        self._set_bounds()

    def _set_bounds(self) -> None:
        self._writer.versions_kept = self.parameters.versions_kept
        self._writer.quota = self.parameters.quota * MiB

    def _sweep(self) -> None:
        values = self.parameters
        self._reads.send(self.trajectories.sweep, values.trash_time, values.upload_time)

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
        self.trajectories.close()
        super().destroy_node()

    def _serve(self, kind: Any, name: str, begin: Callable[[Any, Any], Future[Any]]) -> None:
        create_deferred_service(self, kind, name, begin, callback_group=self._group)

    def _on_threads(self, answer: ServiceCallback) -> DeferredCallback:
        """Return a callback that runs `answer` on one of the catalogue's threads."""
        return lambda request, response: self._reads.submit(
            self._answered, lambda: answer(request, response), response
        )

    def _answered(self, answer: Callable[[], None], response: Response) -> Response:
        try:
            answer()
        except Exception as error:
            why = FAULT(service="converter", error=repr(error))
            if isinstance(error, LabError):
                why = error.diagnostic
            else:
                self.get_logger().error(repr(error))
            tell(response, False, why)
        return response

    def _begin_conversion(
        self, request: srv.ConvertTrajectory.Request, response: srv.ConvertTrajectory.Response
    ) -> Future[Any]:
        """Queue a conversion; the future has its answer, whatever becomes of it."""
        answered: Future[srv.ConvertTrajectory.Response] = Future()

        def finish(done: Future[Converted]) -> None:
            if done.cancelled():
                answered.cancel()
            else:
                answer = partial(self._answer, done, task, response)
                answered.set_result(self._answered(answer, response))

        try:
            task = self._task(request)
            self.trajectories.check_ready()
            data = None if request.path or request.upload else memoryview(request.data)
            size = _size(request.path) if data is None else data.nbytes
            if request.upload:
                size = self._store.size(request.upload)
            work = partial(self._convert, task, request, data)
            self._pool.submit(work, size, 0 if data is None else size).add_done_callback(finish)
        except LabError as error:
            tell(response, False, error.diagnostic)
            answered.set_result(response)
        return answered

    def _task(self, request: srv.ConvertTrajectory.Request) -> Task:
        known = self._library.end_effectors()
        if request.end_effector and request.end_effector not in known:
            close = close_to(request.end_effector, known)
            raise BadInput(
                NO_END_EFFECTOR(end_effector=request.end_effector, known=known, close=close)
            )
        if request.id:
            checked_id(request.id)
        file = Path(request.path or request.file_name).name
        if request.upload:
            user = keys.owner_of(request.upload, keys.UPLOAD)
            file = keys.name_of(request.upload.rsplit("/", 1)[1])
            if request.owner and keys.segment(request.owner) != user:
                raise BadInput(UPLOAD_OF_ANOTHER(owner=request.owner))
        if request.draft:
            keys.owner_of(request.draft, keys.DRAFT)
        return Task(
            file=file or "upload.mat",
            options=trajectories.options_from_request(request),
            robot=self._library.model(request.robot_model),
            coefficients=self._coefficients,
            end_effector=request.end_effector or None,
            trajectory_id=request.id,
            created_ns=time.time_ns(),
            default_frame_rate=self.parameters.default_frame_rate,
        )

    def _convert(
        self,
        task: Task,
        request: srv.ConvertTrajectory.Request,
        data: memoryview | None,
        reader: WorkspaceReader,
    ) -> Converted:
        """Convert in the sandbox; put an accepted trajectory into the store."""
        try:
            with (
                self._opened(task, request, data) as source,
                tempfile.TemporaryFile(dir=self._work) as file,
            ):
                converted = reader.convert(source, task, file)  # type: ignore[arg-type]
                if converted.head is None:
                    return converted
                return replace(converted, head=self._keep(converted.head, file, request))
        except TooSlow:
            raise  # the pool decides whether it has more time
        except BadInput as error:
            return _refused(task, error)
        except OSError as error:
            raise BadInput(failed_here(task.file, error, str(self._work))) from None

    @contextlib.contextmanager
    def _opened(
        self, task: Task, request: srv.ConvertTrajectory.Request, data: memoryview | None
    ) -> Iterator[int]:
        """Yield the descriptor of the file that a request names or holds."""
        if data is not None:
            with in_memory(data) as source:
                yield source
            return
        path = Path(request.path) if request.path else self._store.path(request.upload)
        if path is not None:
            with opened(path) as source:
                yield source
            return
        size, limit = self._store.size(request.upload), self._pool.limits.file_size
        if size > limit:
            raise BadInput(TOO_LARGE(file=task.file, part="file", size=size, limit=limit))
        with tempfile.TemporaryFile(dir=self._work) as fetched:
            self._store.get_file(request.upload, fetched)  # type: ignore[arg-type]
            fetched.flush()
            yield fetched.fileno()

    def _keep(
        self, head: dict[str, Any], file: Any, request: srv.ConvertTrajectory.Request
    ) -> dict[str, Any]:
        """Leave a trajectory as a draft, or put it into the catalogue; return its head there."""
        if request.draft:
            self._store.put_file(request.draft, file)
            return head | {"owner": request.owner, "version": 0, "shared": False}
        name = request.id or self.trajectories.free_name(head, request.owner)
        record, version = self.trajectories.keep(
            head, file, name, request.owner, shared=request.shared
        )
        return head_of(record, version)

    def _answer(
        self, done: Future[Converted], task: Task, response: srv.ConvertTrajectory.Response
    ) -> None:
        try:
            converted = done.result()
        except TooSlow as error:
            converted = _refused(task, error)
        result, head = converted.result, converted.head
        tell(response, head is not None, converted.said)
        response.outcome = result.outcome.value
        response.candidates = [candidate_to_message(c) for c in result.candidates]
        if result.preview is not None:
            response.preview = trajectories.preview_to_message(result.preview)
        response.diagnostics = [trajectories.diagnostic_to_message(d) for d in result.diagnostics]
        if head is None:
            # Of the preview, for a time of its rows.
            response.trajectory.frame_rate = result.frame_rate
            self.get_logger().info(f"refused: {visible(str(converted.said))}")
            return
        response.trajectory = info_from_head(head)
        self.get_logger().info(visible(str(converted.said)))


def _refused(task: Task, error: BadInput) -> Converted:
    result = refused(task.file, error.diagnostic)
    return Converted(result, result.said)


def _size(path: str) -> int:
    """Return the size of a file, bytes, for the order of work; 0 where it cannot be read."""
    try:
        return Path(path).stat().st_size
    except (OSError, ValueError):
        return 0
