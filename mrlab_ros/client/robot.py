"""One robot of a running lab, and a run of it.

How a run of one robot goes, read off the states that follow `play`.

A trajectory of the lab's catalogue.
"""

from __future__ import annotations

import asyncio
import math
import time
import traceback
from collections.abc import Callable, Collection, Generator, Sequence
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any, TypeVar

from mrlab_msgs import msg, srv
from mrlab_msgs.srv import SetLoop, Trigger

from mrlab_ros.client import diagnostics as say
from mrlab_ros.client.follow import Follower
from mrlab_ros.core.base.diagnostic import Diagnostic, Fix, heard
from mrlab_ros.core.base.diagnostics import ILLEGAL_EVENT
from mrlab_ros.core.base.errors import LabError, Misuse
from mrlab_ros.core.playback.diagnostics import HALTED_BY_CONTACT, OF_ROBOT
from mrlab_ros.core.playback.states import State
from mrlab_ros.core.trajectory.diagnostics import NO_TRAJECTORY_OF_NAME
from mrlab_ros.messages import qos
from mrlab_ros.messages.time import time_from_message
from mrlab_ros.ros.calls import NoAnswer
from mrlab_ros.ros.graph import GraphClient, Request, Said

if TYPE_CHECKING:
    from message_bases import Service

    from mrlab_ros.core.base.geometry import Array


@dataclass(frozen=True)
class Motion:
    """A trajectory of the catalogue. frame_rate: Hz; duration: s.

    version: grows with each conversion under the same id; 0: not known. Known only of a file that
    was just converted: warnings, sentences, and findings, with the notes and each with its remedy.
    """

    id: str
    robot_model: str
    frame_rate: float
    frame_count: int
    duration: float
    warnings: tuple[str, ...] = ()
    version: int = 0
    findings: tuple[Diagnostic, ...] = field(default=(), repr=False)
    _graph: GraphClient | None = field(default=None, repr=False, compare=False)

    def positions(self) -> tuple[Array, tuple[str, ...]]:
        """Return the positions, (N, J) rad or m, and the names of the joints.

        Raises Misuse where the lab no longer has it, or where it comes from no lab.
        """
        # numpy, which no other call of a motion needs
        from mrlab_ros.messages.trajectories import trajectory_from_message

        if self._graph is None:
            raise Misuse(NO_TRAJECTORY_OF_NAME(id=self.id))
        version = f"@{self.version}" if self.version else ""
        request = srv.GetTrajectory.Request(id=self.id + version)
        answer = self._graph.order(srv.GetTrajectory, "/converter/get_any", request)
        found = trajectory_from_message(answer.trajectory)
        return found.positions, found.joint_names

    def to_dataframe(self) -> Any:
        """Return a pandas.DataFrame of the positions, rad or m: a column a joint, by time, s.

        Raises Misuse as positions() does, and without pandas.
        """
        from mrlab_ros.adapters.data_frame import data_frame

        rows, names = self.positions()
        return data_frame(rows, [i / self.frame_rate for i in range(len(rows))], names)


def motion_of(info: msg.TrajectoryInfo, graph: GraphClient) -> Motion:
    """Return the catalogue's entry."""
    return Motion(
        info.id,
        info.robot_model,
        info.frame_rate,
        info.frame_count,
        info.duration,
        tuple(warning.message for warning in info.warnings),
        info.version,
        _graph=graph,
    )


class Course:
    """Reads a run off its states: how it stands, and how it ended."""

    def __init__(self, robot: str, objects: Callable[[], Collection[str]] = tuple) -> None:
        """objects: returns the names of the objects of the scene."""
        self._robot = robot
        self._objects = objects
        self.moving = False
        self.complete = False

    def take(self, state: Any) -> None:
        """Take the next state; raise LabError where it says that the run will not complete."""
        kind = msg.PlaybackState
        if state.state in (kind.ADJUSTING, kind.PLAYING):
            self.moving = True
        elif state.state == kind.COMPLETE:
            self.complete = True
        elif state.state == kind.COLLISION_HALT:
            raise Misuse(halted(self._robot, heard(state), self._objects()))
        elif state.state == kind.IDLE and self.moving:
            raise LabError(say.PLAYBACK_GONE(robot=self._robot))
        elif state.state == kind.READY and self.moving and not self.complete:
            why = heard(state) if state.message else None
            raise Misuse(say.ENDED_EARLY(robot=self._robot, why=why))


def halted(robot: str, why: Diagnostic, objects: Collection[str] = ()) -> Diagnostic:
    """Return what is said of a robot that a collision halted, with the commands that end it.

    why: what its state says. objects: the names of those in the scene, which can be removed.
    """
    place, resume = (
        Fix(command=f"mrlab place {robot} --at X,Y"),
        Fix(command=f"mrlab resume {robot}"),
    )
    reason = why if why.message else None
    if why.message and why.code != HALTED_BY_CONTACT.code:
        # It was taken elsewhere already; what it touches there is not said.
        fixes = (Fix(command="mrlab objects list"), place, resume)
        return say.STILL_HALTED(robot=robot, why=reason, fixes=fixes)
    other = why.values.get("other", "")
    remove = (Fix(command=f"mrlab objects remove {other}"),) if other in objects else ()
    fixes = (Fix(command=f"mrlab stop {robot}"), *remove, place, resume)
    return say.HALTED(robot=robot, why=reason, fixes=fixes)


T = TypeVar("T")
# A robot of the scene has published its state by then, and moves by then after play, s.
STATE_TIMEOUT_S = 5.0
# The objects are latched; where physics is away, none are named, s.
OBJECTS_TIMEOUT_S = 1.0
POLL_PERIOD_S = 0.02
# A robot that moves reports ten times a second; one that is silent for longer than this has gone,
# or its machine stands still, s.
SILENCE_S = 10.0
HALT = State.COLLISION_HALT.name
MOVING = (msg.PlaybackState.ADJUSTING, msg.PlaybackState.PLAYING)
# Commands that begin a motion, and states in which one goes on.
STARTS = ("play", "load")
GOES_ON = (State.ADJUSTING.name, State.PLAYING.name)


@dataclass(frozen=True)
class JointSample:
    """One joint state. time_ns: on the lab's clock; positions: rad or m, in names' order."""

    time_ns: int
    names: tuple[str, ...]
    positions: tuple[float, ...]
    velocities: tuple[float, ...]


class LabRobot:
    """A robot of the scene. message: what the lab said when it was spawned."""

    def __init__(self, graph: GraphClient, robot: Any, message: str = "") -> None:
        self._graph = graph
        self.name: str = robot.name
        self.model: str = robot.model
        self.end_effector: str = robot.end_effector
        self.joint_names: tuple[str, ...] = tuple(robot.joint_names)
        self.message = message
        self._follower: Follower | None = None

    def __repr__(self) -> str:
        return (
            f"<{self.name}: {self.model}{' with ' * bool(self.end_effector)}{self.end_effector}>"
        )

    @property
    def follower(self) -> Follower:
        """Return the reports of the robot's playback; raise NoAnswer where it has none."""
        if self._follower is None:
            self._follower = Follower(self._graph, self.name)
            self._follower.watch.wait(lambda _: True, STATE_TIMEOUT_S)
        return self._follower

    @property
    def state(self) -> str:
        """The state of its playback, such as PLAYING."""
        return str(self.follower.state.label)

    def load(self, motion: Motion | str) -> str:
        """Load a trajectory of the catalogue, by its id; return what the robot says."""
        request = srv.LoadTrajectory.Request(id=_id(motion))
        return self._say(srv.LoadTrajectory, "load", request)

    def play(
        self,
        motion: Motion | str | None = None,
        *,
        speed: float | None = None,
        loop: bool | None = None,
    ) -> Run:
        """Play what is loaded, or `motion`, which is loaded first; return the run.

        speed: 0.1 to 4, 1 is the declared one, negative backwards. speed and loop: as before
        where None.
        """
        follower = self.follower
        state = follower.state
        if motion is not None and not self._has_loaded(motion):
            self.load(motion)
        if speed is not None and speed != state.rate:
            self.set_speed(speed)
        if loop is not None and loop != state.loop:
            self.set_loop(loop)
        since = len(follower.states)
        self.resume()
        return Run(follower, since, self._objects)

    def _has_loaded(self, motion: Motion | str) -> bool:
        """Return whether the newest version of `motion` is loaded: a file may change."""
        state = self.follower.state
        if state.trajectory_id != _id(motion):
            return False
        newest = (
            motion.version
            if isinstance(motion, Motion)
            else next((info.version for info in self._graph.catalogue() if info.id == motion), 0)
        )
        return bool(newest == state.trajectory_version)

    def run(self) -> Run | None:
        """Return the run that goes on; None where the robot stands."""
        follower = self.follower
        if follower.state.state not in MOVING:
            return None
        return Run(follower, len(follower.states) - 1, self._objects)

    def resume(self) -> str:
        """Play on from where it stands."""
        return self._trigger("play")

    def pause(self) -> str:
        """Stand still where it is."""
        return self._trigger("pause")

    def stop(self) -> str:
        """End the run; after a collision go back to the first frame, too."""
        return self._trigger("stop")

    def clear_halt(self) -> str:
        """End a collision halt once nothing is touched any more."""
        return self._trigger("clear_halt")

    def seek(self, position: float) -> str:
        """Go to a place on the trajectory, s from its first frame."""
        return self._say(srv.Seek, "seek", srv.Seek.Request(position=position))

    def set_speed(self, speed: float) -> str:
        """Set the speed of playback, 0.1 to 4; negative: backwards."""
        return self._say(srv.SetRate, "set_rate", srv.SetRate.Request(rate=speed))

    def set_loop(self, on: bool) -> str:
        """Have it start over after the last frame, or not."""
        return self._say(SetLoop, "set_loop", SetLoop.Request(loop=on))

    def place(self, x: float, y: float, yaw: float = 0.0, z: float = 0.0) -> str:
        """Move its base; x, y, z in m, yaw in rad about the vertical."""
        request = srv.PlaceRobot.Request(robot=self.name, pose=standing(x, y, yaw, z))
        return str(self._graph.order(srv.PlaceRobot, "/lab/place_robot", request).message)

    def set_end_effector(self, end_effector: str) -> str:
        """Exchange its end effector; empty: a bare flange."""
        request = srv.SetEndEffector.Request(robot=self.name, end_effector=end_effector)
        answer = self._graph.order(srv.SetEndEffector, "/lab/set_end_effector", request)
        self.end_effector = end_effector
        return str(answer.message)

    def remove(self) -> str:
        """Take it out of the scene."""
        request = srv.Remove.Request(name=self.name)
        return str(self._graph.order(srv.Remove, "/lab/remove_robot", request).message)

    def watch(self, callback: Callable[[JointSample], None]) -> None:
        """Call `callback` with every joint state, in a thread of the lab client's own.

        What it raises is printed, and the next joint state comes all the same.
        """
        # It loads numpy, which no other command of a robot needs.
        from sensor_msgs.msg import JointState

        surviving_callback = surviving(callback)

        def receive(message: JointState) -> None:
            surviving_callback(
                JointSample(
                    time_from_message(message.header.stamp),
                    tuple(message.name),
                    tuple(message.position),
                    tuple(message.velocity),
                )
            )

        self._graph.subscribe(JointState, f"/{self.name}/joint_states", receive, qos.STREAM)

    def _objects(self) -> list[str]:
        """Return the names of the objects of the scene; none where nobody says them at once."""
        try:
            watch = self._graph.watch(msg.SceneObjects, "/objects")
            said = watch.wait(lambda _: True, OBJECTS_TIMEOUT_S)
        except NoAnswer:
            return []
        return [thing.name for thing in said.objects]

    def _trigger(self, verb: str) -> str:
        return self._say(Trigger, verb, Trigger.Request())

    def _say(self, kind: type[Service[Request, Said]], verb: str, request: Request) -> str:
        """Call a service of the robot; raise Misuse, with its name, where it refuses."""
        answer = self._graph.call(kind, f"/{self.name}/{verb}", request)
        if answer.success:
            return str(answer.message)
        why, state = heard(answer), self.follower.state
        in_halt = why.code == ILLEGAL_EVENT.code and why.values["state"] == HALT == state.label
        if in_halt and verb in STARTS:
            raise Misuse(halted(self.name, heard(state), self._objects()))
        if why.code == ILLEGAL_EVENT.code and why.values["state"] in GOES_ON and verb in STARTS:
            raise Misuse(say.MOVES_ALREADY(robot=self.name, why=why))
        raise Misuse(OF_ROBOT(robot=self.name, why=why))


class Run:
    """A run that `play` began."""

    def __init__(
        self, follower: Follower, since: int, objects: Callable[[], Collection[str]] = tuple
    ) -> None:
        self.follower = follower
        self._since = since
        self._course = Course(follower.robot, objects)
        self._deadline = time.monotonic() + STATE_TIMEOUT_S

    def __await__(self) -> Generator[Any, None, bool]:
        """Wait as `wait` does, in a thread, so that a notebook's loop goes on."""
        return asyncio.to_thread(self.wait).__await__()

    def advance(self) -> Sequence[Any]:
        """Take what the robot has reported since, up to COMPLETE; return the new states.

        Raises LabError where the run will not complete, with the reason and what to do.
        """
        new = []
        # The playback is READY at once after COMPLETE; whether that was heard yet is chance.
        while not self.complete and self._since < len(self.follower.states):
            new.append(self.follower.states[self._since])
            self._since += 1
            self._course.take(new[-1])
        if not self._course.moving and not self.complete and time.monotonic() > self._deadline:
            still = say.DOES_NOT_MOVE(robot=self.follower.robot, timeout=STATE_TIMEOUT_S)
            raise LabError(still)
        silent = time.monotonic() - self.follower.heard
        if self.follower.state.state in MOVING and silent > SILENCE_S:
            raise NoAnswer(say.RUN_SILENT(robot=self.follower.robot, silent=round(silent)))
        return new

    @property
    def complete(self) -> bool:
        """Return whether its last frame was played, as far as `advance` has read."""
        return self._course.complete

    def wait(self, timeout: float = math.inf) -> bool:
        """Wait until the last frame was played; return False where `timeout` s were not enough.

        Raises LabError where the run was stopped or halted, or the robot is heard no more.
        """
        end = time.monotonic() + timeout
        while not self.complete:
            if time.monotonic() > end:
                return False
            if not self.advance():
                time.sleep(POLL_PERIOD_S)
        return True


def surviving(callback: Callable[[T], None]) -> Callable[[T], None]:
    """Return `callback` with its exceptions printed: one would end the thread of all answers."""

    def call(value: T) -> None:
        try:
            callback(value)
        except Exception:
            traceback.print_exc()

    return call


def _id(motion: Motion | str) -> str:
    return motion if isinstance(motion, str) else motion.id


def standing(x: float, y: float, yaw: float, z: float = 0.0) -> Any:
    """Return the pose message of a base that stands upright; m, rad."""
    # They load numpy, which commands of a robot that place nothing do not need.
    from mrlab_ros.core.base.geometry import Pose
    from mrlab_ros.messages.poses import pose_to_message

    return pose_to_message(Pose((x, y, z), (0.0, 0.0, math.sin(yaw / 2), math.cos(yaw / 2))))
