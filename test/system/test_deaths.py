"""A playback that is killed, ended or frozen in a playing system of two robots.

The end is published before anything follows from it, the system stands where its members stood,
and plays on from that one place. Random faults in random states follow: MRLAB_DEATHS of them, two
unless it says otherwise, by MRLAB_DEATHS_SEED. Each prints how long its steps took.
A freeze lasts 3 s; of ten faults and more every other freeze lasts 30 s. Before some faults the
lab's wall clock is set, or the disk of its state fills up where a small one may be mounted.
"""

from __future__ import annotations

import os
import random
import signal
import time
from collections.abc import Callable, Iterator
from contextlib import nullcontext, suppress
from pathlib import Path
from typing import Any

import pytest
from blows import Clock, Disk, small_disk
from graph import wait_for
from launched_lab import done, launched_lab
from mrlab_msgs import msg, srv
from mrlab_msgs.srv import Trigger
from sensor_msgs.msg import JointState

from mrlab_ros.core.base.clock import SECOND
from mrlab_ros.core.base.errors import LabError
from mrlab_ros.messages import qos
from mrlab_ros.messages.time import time_from_message
from mrlab_ros.processes.run_file import RunFile
from mrlab_ros.ros.graph_node import Graph

MOTION = Path(__file__).parents[2] / "examples" / "quintic_ur5e.mat"
FREEZE_S, LONG_FREEZE_S = 3.0, 30.0
FAULTS = ("SIGKILL", "SIGTERM", "SIGSTOP")
# Two clocks agree to the nanosecond where the rounding of their stamps is allowed for, s.
NANOSECOND = 2e-9
RECOVERY_S = 30.0
SETTLED_S = 2.0


class Watched:
    """A lab with the system `cell` of two robots, followed by a node of the test's own."""

    def __init__(self, graph: Graph, clock: Clock, disk: Disk) -> None:
        self.graph, self.clock, self.disk = graph, clock, disk
        # What arrived, in its order: the instant, and the message.
        self.events: list[tuple[int, Any]] = []
        self.systems = graph.watch(msg.RobotSystems, "/systems", qos.LATCHED_EVENTS)
        self.states = {
            robot: graph.watch(msg.PlaybackState, f"/{robot}/playback_state", qos.LATCHED_EVENTS)
            for robot in ("ur5e_1", "ur5e_2")
        }
        # By robot the newest joint positions.
        self.joints: dict[str, list[float]] = {}
        for robot in self.states:
            graph.subscribe(
                JointState,
                f"/{robot}/joint_states",
                lambda state, robot=robot: self.joints.__setitem__(robot, list(state.position)),
                qos.STREAM,
            )
        for kind, topic in ((msg.LabProcesses, "/processes"), (msg.RobotSystems, "/systems")):
            graph.subscribe(kind, topic, self._take, qos.LATCHED_EVENTS)

    def _take(self, message: Any) -> None:
        self.events.append((time.monotonic_ns(), message))

    @property
    def system(self) -> msg.RobotSystem:
        [system] = self.systems.value.systems
        return system

    def order(self, kind: Any, service: str, **fields: Any) -> None:
        self.graph.order(kind, f"/cell/{service}", kind.Request(**fields))

    def until(self, label: str) -> None:
        wait_for(lambda: self.system.label == label, label)

    def play(self) -> None:
        self.order(Trigger, "play")
        self.until("PLAYING")
        wait_for(lambda: all(w.value.label == "PLAYING" for w in self.states.values()), "members")

    def clocks(self) -> list[tuple[int, float, float]]:
        """The clocks of the system and its members on its timeline: ns, s, rate."""
        starts = {member.robot: member.start for member in self.system.members}
        found = [(0.0, self.system.clock)]
        found += [(starts[robot], watch.value.clock) for robot, watch in self.states.items()]
        return [(time_from_message(c.stamp), start + c.position, c.rate) for start, c in found]

    def apart(self) -> float:
        """How far the members are from the system's line, s."""
        [(at_ns, position, rate), *members] = self.clocks()
        return max(
            abs(own - position - rate * (own_ns - at_ns) / SECOND) if rate else abs(own - position)
            for own_ns, own, _ in members
        )

    def processes(self, since: int, name: str) -> list[tuple[int, msg.LabProcess]]:
        """What /processes said of a process after `since` events, each with its arrival."""
        return [
            (at_ns, process)
            for at_ns, message in self.events[since:]
            if isinstance(message, msg.LabProcesses)
            for process in message.processes
            if process.name == name
        ]

    def first(self, since: int, name: str) -> tuple[int, msg.LabProcess]:
        """The first that says that it ended or froze."""
        down = (msg.LabProcess.WAITING, msg.LabProcess.FROZEN)
        return wait_for(
            lambda: next(
                (one for one in self.processes(since, name) if one[1].state in down), None
            ),
            "the event",
        )


@pytest.fixture(scope="module")
def watched(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Watched]:
    folder = tmp_path_factory.mktemp("deaths")
    clock = Clock(folder)
    with pytest.MonkeyPatch.context() as patch, small_disk(folder / "state") as disk:
        for name, value in clock.environment.items():
            patch.setenv(name, value)
        options = ("--robots", "ur5e,ur5e", "--no-physics", "--state-dir", disk.folder)
        with launched_lab(folder, patch, *options):
            done("play", "ur5e_1", MOTION)
            done("stop", "ur5e_1")
            with Graph() as graph:
                watched = Watched(graph, clock, disk)
                wait_for(lambda: watched.systems.value is not None, "the coordinator")
                loaded = watched.states["ur5e_1"].wait(lambda s: s.trajectory_id, 10.0)
                members = [
                    msg.SystemMember(robot=robot, trajectory_id=loaded.trajectory_id)
                    for robot in watched.states
                ]
                request = srv.CreateSystem.Request(name="cell", members=members, loop=True)
                graph.order(srv.CreateSystem, "/coordinator/create_system", request)
                wait_for(lambda: watched.systems.value.systems, "the system")
                yield watched


def pid_of(name: str) -> int:
    found = RunFile(int(os.environ["ROS_DOMAIN_ID"])).read()
    assert found is not None
    [pid] = [p["pid"] for p in found["processes"] if p["name"] == name]
    return int(pid)


def strike(fault: str, victim: str, freeze_s: float = FREEZE_S) -> None:
    """Kill, end or freeze a process of the lab; a freeze ends again after `freeze_s`."""
    pid = pid_of(victim)
    os.kill(pid, signal.Signals[fault])
    if fault == "SIGSTOP":
        try:
            time.sleep(freeze_s)
        finally:
            os.kill(pid, signal.SIGCONT)


def back(watched: Watched, victim: str, since: int, *, frozen: bool) -> Callable[[], bool]:
    """Return what tells whether the victim runs again and every member stands for the system."""
    holder = watched.systems.value.holder

    def is_back() -> bool:
        said = watched.processes(since, victim)
        stands = {"PAUSED", "READY"}
        return (
            bool(said)
            and said[-1][1].state == msg.LabProcess.RUNNING
            and (victim == "playback" or frozen or watched.systems.value.holder != holder)
            and watched.system.label in stands
            and all(member.state in (1, 4) for member in watched.system.members)
            and all(w.value.label in stands for w in watched.states.values())
            and all(w.value.system == "cell" for w in watched.states.values())
        )

    return is_back


@pytest.mark.parametrize("fault", FAULTS)
def test_a_fault_is_an_event_and_the_system_plays_on_from_where_its_members_stood(watched, fault):
    if watched.system.label != "PLAYING":
        watched.play()
    time.sleep(0.5)
    since = len(watched.events)
    strike(fault, "playback")
    _, down = watched.first(since, "playback")
    time.sleep(0.05)  # what was sent before has arrived
    stood = {robot: list(joints) for robot, joints in watched.joints.items()}
    frozen = fault == "SIGSTOP"
    # rclpy ends at a SIGTERM as asked: its exit code is 0.
    said = {"SIGKILL": (-9, "SIGKILL"), "SIGTERM": (0, "exit code 0")}
    assert down.state == (msg.LabProcess.FROZEN if frozen else msg.LabProcess.WAITING)
    if not frozen:
        assert (down.exit_code, down.last_exit) == said[fault]
        assert down.restart_in > 0
    assert list(down.nodes) == ["playback_host"]
    code = "process_froze" if frozen else "process_died"
    wait_for(lambda: watched.system.code in (code, "members_back"), "the system's word on it")
    wait_for(back(watched, "playback", since, frozen=frozen), "the return", RECOVERY_S)
    codes = [
        m.systems[0].code for _, m in watched.events[since:] if isinstance(m, msg.RobotSystems)
    ]
    assert code in codes
    assert watched.system.code == "members_back"
    assert watched.system.label == "PAUSED"
    if not frozen:
        # Both stand at the joint state that they had sent last.
        wait_for(lambda: watched.joints == stood, "the pose of before")
    # What follows from the event comes after it.
    kinds = [
        type(m).__name__ if isinstance(m, msg.LabProcesses) else m.systems[0].code
        for _, m in watched.events[since:]
    ]
    assert kinds.index("LabProcesses") < kinds.index(code)
    assert watched.apart() < NANOSECOND, watched.clocks()
    place = watched.system.clock.position
    watched.play()
    assert watched.system.clock.position == pytest.approx(place, abs=NANOSECOND)
    wait_for(lambda: watched.apart() < NANOSECOND, "one line")


STATES = ("PLAYING", "PAUSED", "READY", "STAGING")


def enter(watched: Watched, state: str) -> None:
    """Bring the system into a state."""
    if watched.system.label == "PLAYING" and state == "PLAYING":
        return
    if watched.system.label in ("PLAYING", "STAGING", "PAUSED"):
        watched.order(Trigger, "stop")
        watched.until("READY")
    if state == "READY":
        return
    watched.order(Trigger, "play")
    if state == "STAGING":
        return
    watched.until("PLAYING")
    time.sleep(0.4)
    if state == "PAUSED":
        watched.order(Trigger, "pause")
        watched.until("PAUSED")


COUNT = int(os.environ.get("MRLAB_DEATHS", "2"))
# Long freezes are for long runs.
FREEZES_S = (FREEZE_S, LONG_FREEZE_S) if COUNT >= 10 else (FREEZE_S,)
SEED = int(os.environ.get("MRLAB_DEATHS_SEED", "1"))


@pytest.mark.timeout(90 * (COUNT + 1))
def test_faults_in_random_states_leave_every_clock_on_one_line(watched):
    dice = random.Random(SEED)
    wrong = []
    for number in range(COUNT):
        state, fault = dice.choice(STATES), dice.choice(FAULTS)
        freeze_s = dice.choice(FREEZES_S)
        victim = dice.choice(("playback", "playback", "lab"))
        pair = "lab" if victim == "playback" and dice.random() < 0.25 else ""
        enter(watched, state)
        time.sleep(dice.uniform(0.0, 0.8))
        since, was = len(watched.events), watched.system.label
        frozen = fault == "SIGSTOP" and not pair
        full = watched.disk.small and dice.random() < 0.2
        watched.clock.set_by(dice.choice((-600, 0, 600)))
        is_back = back(watched, pair or victim, since, frozen=frozen)
        struck_ns = time.monotonic_ns()
        with watched.disk.full() if full else nullcontext():
            if pair:
                os.kill(pid_of(pair), signal.SIGKILL)
            strike(fault, victim, freeze_s)
            at_ns, down = watched.first(since, victim)
            took = ((down.down_steady_ns - struck_ns) / 1e6, (at_ns - down.down_steady_ns) / 1e6)
            if victim == "lab" and fault == "SIGSTOP":
                # The members play on while their system's node does not run; so does the system.
                time.sleep(1.0)
                if watched.system.label == "PLAYING":
                    watched.order(Trigger, "pause")
            try:
                wait_for(is_back, "the return", RECOVERY_S)
            except AssertionError as error:
                wrong.append((number, victim, fault, was, str(error)))
        returned = (time.monotonic_ns() - struck_ns) / 1e9
        time.sleep(0.3)
        inside = watched.system.label == "PAUSED"
        if inside:
            # A system that is back hears where its members stand, one after another.
            with suppress(AssertionError):
                wait_for(lambda: watched.apart() < NANOSECOND, "one line", SETTLED_S)
        apart, clocks = watched.apart() if inside else 0.0, watched.clocks()
        place = watched.system.clock.position
        try:
            watched.play()
        except LabError as error:
            wrong.append((number, victim, fault, was, str(error)))
            watched.play()
        wait_for(lambda: watched.apart() < NANOSECOND, "one line")
        jump = abs(watched.system.clock.position - place) if inside else 0.0
        where = f"{was}, disk full" if full else was
        lasts = f" for {freeze_s:g} s" if fault == "SIGSTOP" else ""
        print(
            f"{number} {victim} {pair} {fault}{lasts} in {where}: "
            f"seen after {took[0]:.1f} ms, heard after {took[1]:.1f} ms, "
            f"back after {returned:.1f} s, at {place:.4f} s, "
            f"apart {apart:.1e} s, play from {jump:.1e} s away"
        )
        if apart > NANOSECOND or jump > NANOSECOND:
            wrong.append((number, victim, fault, was, apart, jump, clocks))
    assert not wrong
