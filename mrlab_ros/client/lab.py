"""The Python API of a running lab: spawn, convert, load, play, wait, watch, record."""

from __future__ import annotations

import atexit
import os
import tempfile
from collections.abc import Callable, Sequence
from dataclasses import replace
from pathlib import Path
from types import TracebackType
from typing import TYPE_CHECKING, Any

from mrlab_msgs import srv
from mrlab_msgs.srv import Trigger

from mrlab_ros.client.connect import open_graph
from mrlab_ros.client.diagnostics import BAD_BASE_PLACE, NAME_A_ROBOT, NO_SINGLE_BAG
from mrlab_ros.client.recording import STOP_RECORDING_TIMEOUT_S, Recording
from mrlab_ros.client.robot import LabRobot, Motion, Run, motion_of, standing, surviving
from mrlab_ros.core.base.diagnostic import heard
from mrlab_ros.core.base.errors import BadInput, Misuse
from mrlab_ros.core.conversion.options import Options
from mrlab_ros.ros.graph import GraphClient

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

    from mrlab_ros.core.conversion.convert import ConversionResult

CONVERT_TIMEOUT_S = 60.0
# Endings of what a recorded bag's folder holds.
BAG_FILES = (".mcap", ".db3", ".mcap.zstd", ".db3.zstd")


class FileRefused(BadInput):
    """A file that the converter does not take; `result` has its findings and candidates."""

    def __init__(self, result: ConversionResult) -> None:
        super().__init__(result.message)
        self.result = result


class Lab:
    """A running lab on the ROS domain of this environment; use it as a context manager.

    Raises NoAnswer where none runs. Every call returns when the lab has answered, and raises
    LabError with the lab's own sentence where it refuses; then nothing has changed.
    """

    def __init__(self, graph: GraphClient | None = None) -> None:
        self.graph = graph or open_graph()
        try:
            self.graph.robots()
        except BaseException:
            self.graph.close()
            raise
        # A script that ends without close(), by an exception say, ends as it would without a lab:
        # a thread that still spins then would abort it.
        atexit.register(self.close)

    def close(self) -> None:
        """End all subscriptions; the lab goes on."""
        atexit.unregister(self.close)
        self.graph.close()

    def __enter__(self) -> Lab:
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        self.close()

    def robots(self) -> list[LabRobot]:
        """Return the robots of the scene."""
        return [LabRobot(self.graph, robot) for robot in self.graph.robots()]

    def robot(self, name: str) -> LabRobot:
        """Return the robot called `name`; raise Misuse that names the others."""
        return LabRobot(self.graph, self.graph.robot(name))

    def spawn(
        self,
        model: str,
        *,
        at: tuple[float, float] | None = None,
        yaw: float = 0.0,
        end_effector: str = "",
        name: str = "",
    ) -> LabRobot:
        """Put a robot into the scene.

        at: x and y of its base in world, m; None: a free place. yaw: rad about the vertical; it
        counts with `at` only. end_effector: empty for a bare flange. name: empty for the model's
        id and a number.
        """
        request = srv.SpawnRobot.Request(
            model=model, end_effector=end_effector, name=name, automatic=at is None
        )
        if at is not None:
            if len(at) != 2:
                raise Misuse(BAD_BASE_PLACE(found=repr(at)))
            request.pose = standing(*at, yaw)
        answer = self.graph.order(srv.SpawnRobot, "/lab/spawn_robot", request)
        return LabRobot(self.graph, answer.robot, answer.message)

    def trajectories(self) -> list[Motion]:
        """Return what there is to load."""
        return [motion_of(info, self.graph) for info in self.graph.catalogue()]

    def convert(
        self,
        file: str | Path | ArrayLike,
        robot: LabRobot | str,
        options: Options | None = None,
        *,
        fs: ArrayLike | None = None,
        end_effector: str = "",
        id: str = "",
    ) -> Motion:
        """Convert a workspace, table, trajectory file, bag or array into the catalogue.

        file: or (N, J) rad, a row a frame, at `fs` Hz, or `fs` the time of each row, s. robot: the
        robot that will play it, with its end effector, or the id of a model. options: as of
        `mrlab convert`, such as Options(degrees=True). id: its name there; empty: from the file's.
        Raises FileRefused with the findings where the file is not taken.
        """
        model = robot if isinstance(robot, str) else robot.model
        tool = end_effector if isinstance(robot, str) else robot.end_effector
        if not isinstance(file, str | Path):
            # numpy, which no other call of a lab needs
            from mrlab_ros.adapters.trajectories import array_file

            with tempfile.TemporaryDirectory(prefix="mrlab-") as folder:
                made = array_file.write(Path(folder), file, fs, id.rsplit("/", 1)[-1] or "array")
                return self.convert(made, robot, options, end_effector=end_effector, id=id)
        path = one_file(Path(file))
        request = srv.ConvertTrajectory.Request(
            path=str(path.absolute()),
            robot_model=model,
            end_effector=tool,
            id=id,
            **vars(options or Options()),
        )
        answer = self.graph.call(
            srv.ConvertTrajectory, "/converter/convert", request, CONVERT_TIMEOUT_S
        )
        if not answer.success:
            if not answer.diagnostics:
                raise BadInput(heard(answer))
            from mrlab_ros.messages.trajectories import result_from_response  # seldom needed

            raise FileRefused(result_from_response(path.name, answer))
        if not answer.diagnostics:
            return motion_of(answer.trajectory, self.graph)
        from mrlab_ros.messages.trajectories import diagnostic_from_message  # seldom needed

        findings = tuple(map(diagnostic_from_message, answer.diagnostics))
        return replace(motion_of(answer.trajectory, self.graph), findings=findings)

    def play(
        self,
        motion: Motion | str | Path | ArrayLike,
        robot: LabRobot | str = "",
        options: Options | None = None,
        *,
        fs: ArrayLike | None = None,
        speed: float | None = None,
        loop: bool | None = None,
    ) -> Run:
        """Play an array, a file or a trajectory of the catalogue; return the run.

        motion: (N, J) rad at `fs` Hz, a Path, or the id of a trajectory. robot: empty: the only
        robot of the lab. Raises FileRefused where the motion is not taken, Misuse where none of
        several robots is named.
        """
        if not isinstance(robot, LabRobot):
            there = self.graph.robots()
            name = robot or (there[0].name if len(there) == 1 else "")
            if not name:
                raise Misuse(NAME_A_ROBOT(robots=[each.name for each in there]))
            robot = self.robot(name)
        if not isinstance(motion, Motion | str):
            motion = self.convert(motion, robot, options, fs=fs)
        return robot.play(motion, speed=speed, loop=loop)

    def record(
        self, bag: str | Path = "", topics: Sequence[str] | str = (), split: float = 0.0
    ) -> Recording:
        """Start a recording; as a context manager it ends with the block.

        bag: the folder to make; empty: one named by date and time. topics: such as
        /*/joint_states; none: all of the lab's. split: s after which a new file begins; 0: never.
        """
        request = srv.StartRecording.Request(
            bag=os.path.abspath(bag) if bag else "",
            topics=[topics] if isinstance(topics, str) else list(topics),
            split_duration=split,
        )
        answer = self.graph.order(srv.StartRecording, "/recorder/start", request)
        return Recording(self.graph, answer.bag)

    def stop_recording(self) -> str:
        """End the recording, or the replay, that runs; return what the recorder says."""
        answer = self.graph.order(
            Trigger, "/recorder/stop", Trigger.Request(), STOP_RECORDING_TIMEOUT_S
        )
        return str(answer.message)

    def watch(self, kind: Any, topic: str, callback: Callable[[Any], None]) -> None:
        """Call `callback` with every message of a topic, in a thread of the lab client's own.

        kind: the message's class, such as mrlab_msgs.msg.SceneObjects. A latched topic gives its
        newest message at once. What `callback` raises is printed, and the next message comes all
        the same.
        """
        from mrlab_ros.messages import qos

        self.graph.subscribe(kind, topic, surviving(callback), qos.LATCHED)


def one_file(path: Path) -> Path:
    """Return `path`, or the one file of the bag that is its folder; raise BadInput."""
    if not path.is_dir():
        return path
    inside = sorted(each for each in path.iterdir() if each.name.endswith(BAG_FILES))
    if len(inside) != 1:
        raise BadInput(NO_SINGLE_BAG(folder=str(path), found=len(inside)))
    return inside[0]
