"""One robot of a running lab, and a run of it."""

from __future__ import annotations

import asyncio
import math
import threading
import time
from collections.abc import Callable, Generator, Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from mrlab_client.errors import LabError, NoAnswer
from mrlab_client.link import Link

if TYPE_CHECKING:
    from mrlab_client.motion import Motion

STATE_TIMEOUT_S = 5.0
# A robot that moves reports several times a second.
SILENCE_S = 10.0
MOVING = ("ADJUSTING", "PLAYING")
# Codes of the state of a robot that played to its end.
ENDED = ("played_to_end", "played_back")


@dataclass(frozen=True)
class JointSample:
    """One joint state. time_ns: on the lab's clock; positions: rad or m, in names' order."""

    time_ns: int
    names: tuple[str, ...]
    positions: tuple[float, ...]
    velocities: tuple[float, ...]


class States:
    """The states of a robot's playback since it was asked for first."""

    def __init__(self, link: Link, robot: str) -> None:
        self.all: list[Any] = []
        self.changed = threading.Condition()
        link.subscribe(f"{robot}/playback_state", self._take)
        self.wait(lambda: bool(self.all), STATE_TIMEOUT_S, robot)

    def _take(self, _: str, state: Any) -> None:
        with self.changed:
            self.all.append(state)
            self.changed.notify_all()

    def wait(self, true: Callable[[], bool], timeout: float, robot: str) -> None:
        """Wait until something is so; raise NoAnswer where it is not in time."""
        with self.changed:
            if not self.changed.wait_for(true, timeout):
                raise NoAnswer(f"{robot} reports nothing within {timeout:g} s.", "run_silent")


class LabRobot:
    """A robot of the scene."""

    def __init__(self, link: Link, robot: Any) -> None:
        self._link = link
        self.name, self.model = str(robot.name), str(robot.model)
        self.end_effector = str(robot.end_effector)
        self.joint_names = tuple(map(str, robot.joint_names))
        self._states: States | None = None

    def __repr__(self) -> str:
        return (
            f"<{self.name}: {self.model}{' with ' * bool(self.end_effector)}{self.end_effector}>"
        )

    @property
    def states(self) -> States:
        """Return the states of its playback; raise NoAnswer where it has none."""
        if self._states is None:
            self._states = States(self._link, self.name)
        return self._states

    @property
    def state(self) -> str:
        """The state of its playback, such as PLAYING."""
        return str(self.states.all[-1].label)

    def load(self, motion: Motion | str) -> str:
        """Load a trajectory of the catalogue; return what the robot says."""
        return self._call("load", id=named(motion))

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
        if motion is not None:
            self.load(motion)
        if speed is not None:
            self.set_speed(speed)
        if loop is not None:
            self.set_loop(loop)
        since = len(self.states.all)
        self.resume()
        return Run(self.name, self.states, since)

    def resume(self) -> str:
        """Play on from where it stands."""
        return self._call("play")

    def pause(self) -> str:
        """Stand still where it is."""
        return self._call("pause")

    def stop(self) -> str:
        """End the run; after a collision go back to the first frame, once more: to home."""
        return self._call("stop")

    def clear_halt(self) -> str:
        """End a collision halt once nothing is touched any more."""
        return self._call("clear_halt")

    def seek(self, position: float) -> str:
        """Go to a place on the trajectory, s from its first frame."""
        return self._call("seek", position=position)

    def set_speed(self, speed: float) -> str:
        """Set the speed of playback, 0.1 to 4; negative: backwards."""
        return self._call("set_rate", rate=speed)

    def set_loop(self, on: bool) -> str:
        """Have it start over after the last frame, or not."""
        return self._call("set_loop", loop=on)

    def place(self, x: float, y: float, yaw: float = 0.0, z: float = 0.0) -> str:
        """Move its base; x, y, z in m, yaw in rad about the vertical."""
        pose = standing(x, y, yaw, z)
        return str(self._link.call("lab/place_robot", {"robot": self.name, "pose": pose}).message)

    def set_end_effector(self, end_effector: str) -> str:
        """Exchange its end effector; empty: a bare flange."""
        request = {"robot": self.name, "end_effector": end_effector}
        answer = self._link.call("lab/set_end_effector", request)
        self.end_effector = end_effector
        return str(answer.message)

    def remove(self) -> str:
        """Take it out of the scene."""
        return str(self._link.call("lab/remove_robot", {"name": self.name}).message)

    def watch(self, callback: Callable[[JointSample], None]) -> None:
        """Call `callback` with joint states, in a thread of the client's own."""

        def take(_: str, message: Any) -> None:
            stamp = message.header.stamp
            callback(
                JointSample(
                    stamp.sec * 1_000_000_000 + stamp.nanosec,
                    tuple(map(str, message.name)),
                    tuple(map(float, message.position)),
                    tuple(map(float, message.velocity)),
                )
            )

        self._link.subscribe(f"{self.name}/joint_states", take)

    def _call(self, verb: str, **request: Any) -> str:
        return str(self._link.call(f"{self.name}/{verb}", request).message)


class Run:
    """A run that `play` began; `await` waits as `wait` does."""

    def __init__(self, robot: str, states: States, since: int) -> None:
        self.robot = robot
        self._states, self._next = states, since
        self._moving = False
        self.complete = False

    def wait(self, timeout: float = math.inf) -> bool:
        """Wait until the last frame was played; return False where `timeout` s were not enough.

        Raises LabError where the run was stopped or halted, NoAnswer where the robot is silent.
        """
        end = time.monotonic() + timeout
        with self._states.changed:
            while not self.complete:
                left = end - time.monotonic()
                if left <= 0:
                    return False
                if self._next < len(self._states.all):
                    self._take(self._states.all[self._next])
                    self._next += 1
                elif not self._states.changed.wait(min(left, SILENCE_S)) and left > SILENCE_S:
                    raise NoAnswer(f"{self.robot} reports nothing any more.", "run_silent")
        return True

    def __await__(self) -> Generator[Any, None, bool]:
        return asyncio.to_thread(self.wait).__await__()

    def _take(self, state: Any) -> None:
        label = str(state.label)
        if label in MOVING:
            self._moving = True
        elif state.code in ENDED:  # READY follows COMPLETE at once, and the newest state counts
            self.complete = True
        elif label == "COLLISION_HALT" or (self._moving and label in ("READY", "IDLE")):
            said = f": {state.message}" if state.message else ""
            raise LabError(
                f"{self.robot} is {label}{said}. Stop it before it plays on.", state.code
            )


def named(motion: Motion | str) -> str:
    """Return the id by which the lab loads a motion."""
    return motion if isinstance(motion, str) else f"{motion.id}@{motion.version}"


def standing(x: float, y: float, yaw: float, z: float = 0.0) -> Mapping[str, Any]:
    """Return the pose of a base that stands upright; m, rad."""
    turned = {"z": math.sin(yaw / 2), "w": math.cos(yaw / 2)}
    return {"position": {"x": x, "y": y, "z": z}, "orientation": turned}
