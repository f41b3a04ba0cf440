"""The catalogue in the graph: services of the converter, and what is announced.

Fetches trajectories from the lab's catalogue for other nodes.
"""

from __future__ import annotations

import tempfile
import threading
import weakref
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import replace
from pathlib import Path
from typing import Any, BinaryIO

from mrlab_msgs import msg, srv
from rclpy.node import Node

from mrlab_ros.adapters import threads
from mrlab_ros.adapters.store import keys
from mrlab_ros.adapters.store.port import StoreFailure
from mrlab_ros.adapters.trajectories import npz_file
from mrlab_ros.adapters.trajectories.catalogue_writer import DAY_S, CatalogueWriter
from mrlab_ros.adapters.trajectories.files import TrajectoryFiles
from mrlab_ros.adapters.trajectories.npz_file import Damaged
from mrlab_ros.core.base.diagnostic import heard
from mrlab_ros.core.base.errors import BadInput, LabError
from mrlab_ros.core.trajectory.catalogue import (
    Record,
    TrajectoryName,
    Version,
    checked_id,
    free_name,
    head_of,
    newest,
    parse,
)
from mrlab_ros.core.trajectory.diagnostics import (
    DAMAGED_VERSION,
    DRAFT_OF_ANOTHER,
    HANDED_OVER,
    NOT_A_NEW_NAME,
    OWNER_ERASED,
    PUBLISHED_ALREADY,
    REPLACED_MEANWHILE,
    TRAJECTORY_DELETED,
    TRAJECTORY_HIDDEN,
    TRAJECTORY_PUBLISHED,
    TRAJECTORY_RESTORED,
    TRAJECTORY_SHARED,
)
from mrlab_ros.core.trajectory.trajectory import Trajectory
from mrlab_ros.messages import qos, trajectories
from mrlab_ros.messages.texts import tell
from mrlab_ros.messages.trajectories import catalogue_to_message, info_from_head
from mrlab_ros.ros.calls import call
from mrlab_ros.ros.worker import Worker

# A longer trajectory is announced without its frames, which `get` gives in parts.
MOST_ANNOUNCED = 20_000
# Trajectories in the latched message: 0.2 MB. A client asks `list` for more.
MOST_LISTED = 1000
# Of a class that publishes at once, what changed in this time is one announcement, s.
ANNOUNCE_PERIOD_S = 0.1
# A store that does not answer at the start is asked again after this time, s.
RETRY_S = 2.0


class TrajectoryServices:
    """Answers get, list, delete, publish, share and restore, and announces every change.

    Where the store does not answer at the start, every service says so until it does.
    """

    def __init__(self, node: Node, catalogue: CatalogueWriter, files: TrajectoryFiles) -> None:
        self.catalogue, self.files = catalogue, files
        self._log = node.get_logger()
        self._catalogue_topic = node.create_publisher(
            msg.TrajectoryCatalogue, "/trajectories", qos.LATCHED
        )
        self._converted = node.create_publisher(
            msg.Trajectory, "/trajectories/converted", qos.EVENTS
        )
        self._closed = threading.Event()
        self._infos: dict[str, tuple[Record, msg.TrajectoryInfo, msg.TrajectoryInfo]] = {}
        self._announcing = threading.Lock()
        self._waiting = False
        self._announcer = Worker(
            "announce_trajectories",
            on_error=lambda error: self._log.error(f"cannot announce a trajectory: {error!r}"),
        )
        self._problem: StoreFailure | None = None
        self._open()
        self._publish_catalogue()
        if self._problem is not None:
            self._log.error(f"the catalogue is not there yet: {self._problem}")
            threads.loop("open_store", self._open_later).start()

    def close(self) -> None:
        self._closed.set()
        self._announcer.close()

    def check_ready(self) -> None:
        """Pass where the catalogue was read; raise StoreFailure."""
        if self._problem is not None:
            raise StoreFailure(self._problem.diagnostic)

    def get(
        self,
        request: srv.GetTrajectory.Request,
        response: srv.GetTrajectory.Response,
        *,
        private: bool = False,
    ) -> None:
        self.check_ready()
        record, version = self._find(request.id, private=private)
        with self._damage(record, version):
            if request.file_only:
                npz_file.read_head(self.files.path(version))
                response.trajectory.info = info_from_head(head_of(record, version))
            else:
                frames = self.files.frames(record, version, request.begin, request.count)
                response.trajectory = trajectories.frames_to_message(frames)
            response.file = str(self.files.path(version))
        response.success = True

    def get_any(
        self, request: srv.GetTrajectory.Request, response: srv.GetTrajectory.Response
    ) -> None:
        self.get(request, response, private=True)

    def list_fitting(
        self,
        request: srv.ListTrajectories.Request,
        response: srv.ListTrajectories.Response,
        *,
        private: bool = False,
    ) -> None:
        self.check_ready()
        fitting = [
            record
            for record in self._visible(private=private)
            if not request.robot_model
            or (
                record.newest.head["robot_model"] == request.robot_model
                and (record.newest.head["end_effector"] or "") in ("", request.end_effector)
            )
        ]
        end = request.begin + request.count if request.count else None
        response.trajectories = [self._info(record) for record in fitting[request.begin : end]]
        response.total = len(fitting)
        response.success = True

    def list_any_fitting(
        self, request: srv.ListTrajectories.Request, response: srv.ListTrajectories.Response
    ) -> None:
        self.list_fitting(request, response, private=True)

    def delete(self, request: srv.Remove.Request, response: srv.Remove.Response) -> None:
        self.check_ready()
        self.catalogue.delete(request.name)
        self.announce()
        tell(response, True, TRAJECTORY_DELETED(id=request.name))

    def erase(self, request: srv.Remove.Request, response: srv.Remove.Response) -> None:
        """Erase all that somebody uploaded and published; the request's name is the owner's id."""
        self.check_ready()
        try:
            count = self.catalogue.erase(request.name)
        finally:
            self.announce()
        tell(response, True, OWNER_ERASED(owner=request.name, count=count))

    def hand_over(self, request: srv.HandOver.Request, response: srv.HandOver.Response) -> None:
        self.check_ready()
        try:
            count = self.catalogue.hand_over(request.owner, request.to)
        finally:
            self.announce()
        tell(response, True, HANDED_OVER(owner=request.owner, to=request.to, count=count))

    def publish(
        self, request: srv.PublishTrajectory.Request, response: srv.PublishTrajectory.Response
    ) -> None:
        self.check_ready()
        user = keys.owner_of(request.draft, keys.DRAFT)
        if request.owner and keys.segment(request.owner) != user:
            raise BadInput(DRAFT_OF_ANOTHER(owner=request.owner))
        record, version = self.publish_draft(
            request.draft, request.id, request.owner, shared=request.shared
        )
        response.trajectory = info_from_head(head_of(record, version))
        tell(response, True, TRAJECTORY_PUBLISHED(id=record.id, version=version.number))

    def share(
        self, request: srv.ShareTrajectory.Request, response: srv.ShareTrajectory.Response
    ) -> None:
        self.check_ready()
        record = self.catalogue.share(request.id, request.shared)
        self.announce()
        said = TRAJECTORY_SHARED(id=record.id)
        if not record.shared:
            said = TRAJECTORY_HIDDEN(id=record.id, owner=record.owner)
        tell(response, True, said)

    def restore(
        self, request: srv.RestoreTrajectory.Request, response: srv.RestoreTrajectory.Response
    ) -> None:
        self.check_ready()
        record = self.catalogue.restore(request.id, request.version)
        self.announce()
        response.trajectory = info_from_head(head_of(record, record.newest))
        version = record.newest.number
        tell(response, True, TRAJECTORY_RESTORED(id=record.id, version=version))

    def publish_draft(
        self, draft: str, text: str, owner: str, *, shared: bool
    ) -> tuple[Record, Version]:
        """Put a draft into the catalogue; a draft that was published before, once."""
        name = _own_name(text, owner)
        for record in self.catalogue.records():
            for version in record.versions:
                if version.draft == draft:
                    if name not in ("", record.name) or owner != record.owner:
                        raise BadInput(PUBLISHED_ALREADY(id=record.id))
                    return record, version
        with self._opened(draft) as path:
            npz_file.read(path)
            head = npz_file.read_head(path)
        name = name or self.free_name(head, owner)
        return self.keep(head, draft, name, owner, shared=shared)

    def free_name(self, head: dict[str, Any], owner: str) -> str:
        """Return a name for a trajectory that was given none; see record.free_name()."""
        return free_name(head["id"], owner, head["robot_model"], self.catalogue.records())

    def keep(
        self, head: dict[str, Any], source: BinaryIO | str, name: str, owner: str, *, shared: bool
    ) -> tuple[Record, Version]:
        """Put a converted trajectory into the catalogue and announce it."""
        self.check_ready()
        place = TrajectoryName(owner, checked_id(name))
        record, version = self.catalogue.publish(place, head, source, shared=shared)
        self.announce()
        if record.shared and self._converted.get_subscription_count():
            self._say_converted(record, version)
        return record, version

    def announce(self) -> None:
        """Publish the catalogue soon; changes in quick succession are one message."""
        with self._announcing:
            if self._waiting:
                return
            self._waiting = True

        def work() -> None:
            with self._announcing:
                self._waiting = False
            self._publish_catalogue()
            self._closed.wait(ANNOUNCE_PERIOD_S)

        self._announcer.send(work)

    def sweep(self, trash_days: float, unpublished_days: float) -> None:
        """Remove what is no longer of use; a store that fails is asked again the next time."""
        try:
            self.check_ready()
            self.catalogue.sweep(trash_days * DAY_S, unpublished_days * DAY_S)
        except LabError as error:
            self._log.error(f"old trajectories and uploads stay for now: {error}")

    def _open(self) -> None:
        try:
            self.catalogue.open()
            self._problem = None
        except StoreFailure as error:
            self._problem = error

    def _open_later(self) -> None:
        while self._problem is not None and not self._closed.wait(RETRY_S):
            self._open()
        if self._problem is None:
            self._log.info(f"the catalogue is there: {self.catalogue.store.place} answers")
            self.announce()

    @contextmanager
    def _opened(self, key: str) -> Iterator[Path]:
        """Yield the path of an object's bytes on this machine; raise Missing."""
        path = self.catalogue.store.path(key)
        if path is not None:
            self.catalogue.store.size(key)
            yield path
            return
        with tempfile.NamedTemporaryFile(suffix=npz_file.SUFFIX) as file:
            self.catalogue.store.get_file(key, file)  # type: ignore[arg-type]
            file.flush()
            yield Path(file.name)

    def _find(self, text: str, *, private: bool) -> tuple[Record, Version]:
        # Everybody who loads a robot reads the answer of get_any: it names nothing private.
        return self.catalogue.find(
            text,
            lambda record: private or record.visible_to(""),
            named=lambda record: record.visible_to(""),
        )

    @contextmanager
    def _damage(self, record: Record, version: Version) -> Iterator[None]:
        """Take a version whose file is damaged out of the catalogue, and say so."""
        try:
            yield
        except Damaged as error:
            aside = self.catalogue.set_aside(record, version)
            self.announce()
            said = DAMAGED_VERSION(
                id=record.id, version=version.number, folder=str(aside), why=error
            )
            self._log.error(f"removed from the catalogue: {said}")
            raise Damaged(said) from error

    def _visible(self, *, private: bool) -> list[Record]:
        return [
            record
            for record in self.catalogue.records()
            if not record.deleted_ns and (private or record.visible_to(""))
        ]

    def _info(self, record: Record, *, short_one: bool = False) -> msg.TrajectoryInfo:
        """Return the catalogue's entry, with its warnings or without, made once a record."""
        known = self._infos.get(record.id)
        if known is None or known[0] is not record:
            head = head_of(record, record.newest)
            bare = head | {"warnings": []}
            known = record, info_from_head(head), info_from_head(bare)
            self._infos[record.id] = known
        _, whole, short = known
        return short if short_one else whole

    def _publish_catalogue(self) -> None:
        if self._closed.is_set():
            return
        visible = self._visible(private=False)
        infos = [self._info(record, short_one=True) for record in newest(visible, MOST_LISTED)]
        self._catalogue_topic.publish(catalogue_to_message(infos, len(visible)))

    def _say_converted(self, record: Record, version: Version) -> None:
        """Say all frames of a trajectory, of a long one the info alone.

        rclpy holds the interpreter while it copies a message, so a long one would hold up every
        node of the process.
        """
        head = head_of(record, version)
        if head["frame_count"] <= MOST_ANNOUNCED:
            frames = self.files.frames(record, version, 0, 0)
            self._converted.publish(trajectories.frames_to_message(frames))
        else:
            self._converted.publish(trajectories.trajectory_without_frames(head))


def _own_name(text: str, owner: str) -> str:
    """Return a name without the owner that may stand before it; raise BadInput for another's."""
    if not text:
        return ""
    name = parse(text)
    if name.version or (name.owner and name.owner != owner):
        raise BadInput(NOT_A_NEW_NAME(id=text, name=name.name))
    return name.name


# Frames in one answer: 17 MB for seven joints, which takes about 0.2 s.
CHUNK = 100_000
TIMEOUT_S = 5.0


class CatalogueClient:
    """Calls /converter/get_any; `node` must be spun by another thread than the one that fetches.

    On the converter's machine the matrices are read from the file that the answer names: a
    million frames take 0.2 s, as a message more than 1 s. Elsewhere they come as messages.
    """

    def __init__(self, node: Node) -> None:
        self._node = node
        self._client = node.create_client(
            srv.GetTrajectory, "/converter/get_any", qos_profile=qos.SERVICES
        )
        # Robots that play the same trajectory share its matrices.
        self._loaded: weakref.WeakValueDictionary[str, Trajectory] = weakref.WeakValueDictionary()

    def close(self) -> None:
        self._node.destroy_client(self._client)

    def fetch(self, trajectory_id: str) -> Trajectory:
        """Return a trajectory; raise BadInput where there is none, NoAnswer without converter."""
        answer = self._ask(id=trajectory_id, file_only=True)
        key = repr(answer.trajectory.info)
        trajectory = self._loaded.get(key)
        if trajectory is None:
            trajectory = self._read(answer) or self._receive(answer)
            self._loaded[key] = trajectory
        return trajectory

    def _ask(self, **request: Any) -> Any:
        answer = call(self._client, srv.GetTrajectory.Request(**request), TIMEOUT_S)
        if not answer.success:
            raise BadInput(heard(answer))
        return answer

    def _read(self, answer: Any) -> Trajectory | None:
        """Return what the file holds; None where it is not here, or not what it should be."""
        path = Path(answer.file)
        if not answer.file or not path.is_file():
            return None
        try:
            read = npz_file.read(path)
        except (BadInput, OSError):
            return None  # the converter says what is wrong with it when it is asked for frames
        # The file does not say under which id, for whom and as which version it was published.
        info = answer.trajectory.info
        trajectory = replace(
            read, id=info.id, owner=info.owner, version=info.version, shared=info.shared
        )
        return trajectory if _same(trajectories.info_to_message(trajectory), info) else None

    def _receive(self, answer: Any) -> Trajectory:
        """Return what the answers of the converter hold."""
        message = answer.trajectory
        for begin in range(0, message.info.frame_count if answer.file else 0, CHUNK):
            part = self._ask(id=message.info.id, begin=begin, count=CHUNK).trajectory
            if not _same(part.info, message.info):
                raise BadInput(REPLACED_MEANWHILE(id=message.info.id))
            message.joint_names = part.joint_names
            for name in ("positions", "velocities", "effort_proxy", "gripper"):
                getattr(message, name).extend(getattr(part, name))
        return trajectories.trajectory_from_message(message)


def _same(one: Any, other: Any) -> bool:
    """Compare two infos as text: a warning without a number holds NaN, which equals nothing."""
    return repr(one) == repr(other)
