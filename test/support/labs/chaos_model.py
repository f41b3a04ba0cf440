"""What a user of a lab may expect of it, whatever happens to its processes."""

from __future__ import annotations

import random
import time
from typing import Any

import rclpy
from graph import wait_for
from mrlab_msgs import msg, srv
from mrlab_msgs.srv import Trigger
from rclpy.node import Node

from mrlab_ros.messages import qos
from mrlab_ros.ros.calls import NoAnswer, call
from mrlab_ros.ros.spinning import SpunNode

# After a blow the next command works within this time, s: 5 on a machine that is not busy.
RECOVERY_S = 40.0
# A client that has no answer by then asks again, s.
ANSWER_S = 2.0
MOVING = (msg.PlaybackState.ADJUSTING, msg.PlaybackState.PLAYING)


class Client:
    """Calls the lab's services and keeps what it publishes."""

    def __enter__(self) -> Client:
        self._context = rclpy.Context()
        self._context.init()
        self.node = Node("chaos", context=self._context)
        self._spun = SpunNode(self.node)
        self.robots: msg.Robots | None = None
        self.systems: msg.RobotSystems | None = None
        self.states: dict[str, msg.PlaybackState] = {}
        self._followed: set[str] = set()
        self._collisions: dict[str, Any] = {}
        self.node.create_subscription(msg.Robots, "/robots", self._on_robots, qos.LATCHED)
        self.node.create_subscription(
            msg.RobotSystems, "/systems", self._on_systems, qos.LATCHED_EVENTS
        )
        return self

    def __exit__(self, *exception: object) -> None:
        self._context.try_shutdown()
        self._spun.close()

    def ask(self, kind: Any, service: str, **fields: Any) -> Any:
        """Return the answer; raise NoAnswer where none came in time."""
        client = self.node.create_client(kind, service, qos_profile=qos.SERVICES)
        try:
            return call(client, kind.Request(**fields), ANSWER_S)
        finally:
            self.node.destroy_client(client)

    def collide(self, robot: str, *, colliding: bool) -> None:
        """Say of a robot what physics would."""
        if robot not in self._collisions:
            self._collisions[robot] = self.node.create_publisher(
                msg.Collision, f"/{robot}/collision", qos.LATCHED
            )
        contact = msg.Contact(link="forearm_link", other="a wall")
        self._collisions[robot].publish(msg.Collision(colliding=colliding, contact=contact))

    def _on_robots(self, message: msg.Robots) -> None:
        self.robots = message
        for robot in message.robots:
            if robot.name not in self._followed:
                self._followed.add(robot.name)
                self.node.create_subscription(
                    msg.PlaybackState,
                    f"/{robot.name}/playback_state",
                    lambda state, name=robot.name: self.states.__setitem__(name, state),
                    qos.LATCHED_EVENTS,
                )

    def _on_systems(self, message: msg.RobotSystems) -> None:
        self.systems = message


class Model:
    """What the user was told; step() gives a random command, recover() expects the lab back."""

    def __init__(self, client: Client, dice: random.Random, said: list[str]) -> None:
        self._client, self._dice, self._said = client, dice, said
        self._robots: list[str] = []
        self._trajectory = ""
        # What the lab said last when it was to obey again.
        self._answer = ""
        # None: the answer of the last command that changes it was lost.
        self._system: bool | None = False

    def prepare(self) -> None:
        """Load a trajectory on every robot."""
        client = self._client
        wait_for(lambda: client.robots and len(client.robots.robots) == 2, "the robots")
        assert client.robots is not None
        self._robots = [robot.name for robot in client.robots.robots]
        answer = client.ask(srv.ListTrajectories, "/converter/list_any", robot_model="ur5e")
        self._trajectory = answer.trajectories[0].id
        for robot in self._robots:
            wait_for(
                lambda robot=robot: (
                    client.ask(srv.LoadTrajectory, f"/{robot}/load", id=self._trajectory).success
                ),
                f"the load of {robot}",
            )

    def step(self) -> None:
        """Give one command that a user might; what it answers is true."""
        client, dice = self._client, self._dice
        robot = dice.choice(self._robots)
        choices = ["create", "dissolve"] if self._system is None else []
        if self._system:
            choices += ["system play", "system pause", "system stop", "dissolve"]
        else:
            choices += ["play", "play back", "pause", "stop", "load", "seek", "create"]
        choices.append("halt")
        what = dice.choice(choices)
        self._said.append(f"{what} {robot}")
        if what == "halt":
            client.collide(robot, colliding=True)
            client.collide(robot, colliding=False)
            return
        try:
            if what == "create":
                members = [msg.SystemMember(robot=name) for name in self._robots]
                answer = client.ask(
                    srv.CreateSystem, "/coordinator/create_system", name="cell", members=members
                )
                self._system = True if answer.success else self._system
            elif what == "dissolve":
                answer = client.ask(srv.Remove, "/coordinator/dissolve_system", name="cell")
                self._system = False if answer.success else self._system
            elif what == "load":
                answer = client.ask(srv.LoadTrajectory, f"/{robot}/load", id=self._trajectory)
            elif what == "play back":
                client.ask(srv.SetRate, f"/{robot}/set_rate", rate=dice.choice((-1.0, 1.0)))
                answer = client.ask(Trigger, f"/{robot}/play")
            elif what == "seek":
                answer = client.ask(srv.Seek, f"/{robot}/seek", position=0.2)
            else:
                verb = what.split()[-1]
                name = "cell" if what.startswith("system") else robot
                answer = client.ask(Trigger, f"/{name}/{verb}")
            self._said.append(f"  {answer.success}: {answer.message}")
            assert answer.success or answer.message
        except NoAnswer as error:
            self._said.append(f"  no answer: {error}")
            if what in ("create", "dissolve"):
                self._system = None

    def recover(self) -> None:
        """Expect that every robot obeys again, alone or through its system, within a time."""
        began = time.monotonic()
        try:
            wait_for(self._obeys, "a lab that obeys", RECOVERY_S)
        finally:
            self._said.append(f"  the last answer: {self._answer}")
        self._said.append(f"  recovered after {time.monotonic() - began:.1f} s")
        self.check()

    def check(self) -> None:
        """Expect that nothing is orphaned: robots, trajectories and systems are what was told."""
        client = self._client
        wait_for(self._is_whole, "robots and systems as they were told", RECOVERY_S)
        states = [client.states[robot] for robot in self._robots]
        assert all(state.trajectory_id == self._trajectory for state in states)

    def _is_whole(self) -> bool:
        client = self._client
        if client.robots is None or client.systems is None:
            return False
        names = [system.name for system in client.systems.systems]
        if self._system is not None and names != ["cell"] * self._system:
            return False
        self._system = bool(names)
        owner = "cell" if names else ""
        states = [client.states.get(robot) for robot in self._robots]
        return [robot.name for robot in client.robots.robots] == self._robots and all(
            state is not None and state.trajectory_id and state.system == owner for state in states
        )

    def _obeys(self) -> bool:
        """Stop everything, as anybody who sees a robot move after a crash would."""
        try:
            if self._system is None:
                self._client.ask(srv.Remove, "/coordinator/dissolve_system", name="cell")
                self._system = False
            for name in ["cell"] if self._system else self._robots:
                answer = self._client.ask(Trigger, f"/{name}/stop")
                self._answer = f"{name}: {answer.message}"
                if not answer.success:
                    return False
            return True
        except NoAnswer as error:
            self._answer = str(error)
            return False
