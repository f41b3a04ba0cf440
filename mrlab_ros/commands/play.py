"""`mrlab play`: one trajectory on one robot of the running lab."""

from __future__ import annotations

import time
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from mrlab_ros.core.errors import LabError, Misuse

if TYPE_CHECKING:
    from mrlab_ros.commands.follow import Follower
    from mrlab_ros.ros.graph import Graph

# After play the robot moves within this time, or its state gives the reason.
MOVE_TIMEOUT_S = 5.0


def play(
    robot: Annotated[str, typer.Argument(help="A robot of the scene, such as ur5e_1.")],
    trajectory: Annotated[
        str, typer.Argument(help="A trajectory of the catalogue, or a workspace file.")
    ],
    rate: Annotated[
        float, typer.Option(help="Speed, 0.1 to 4; 1 is the declared one, -1 the same backwards.")
    ] = 1.0,
    loop: Annotated[
        bool, typer.Option("--loop", help="Begin again after the last frame.")
    ] = False,
    wait: Annotated[
        bool, typer.Option("--wait/--no-wait", help="Follow the motion to its end.")
    ] = True,
) -> None:
    """Play a trajectory on a robot and follow it to the end.

    A workspace file is converted for the robot first. Ctrl-C ends the following, not the motion.
    Ends with 0 when the last frame was played, 1 when something kept it from that.
    """
    from rich.console import Console

    from mrlab_ros.commands.follow import Follower
    from mrlab_ros.ros.graph import Graph

    console = Console(highlight=False)
    with Graph() as graph:
        found = graph.robot(robot)
        follower = Follower(graph, robot)
        state = follower.watch.wait(lambda _: True, MOVE_TIMEOUT_S, f"the state of {robot}")
        wanted = in_catalogue(graph, found, trajectory)
        begin(graph, robot, state, wanted, rate, loop)
        since = len(follower.states)
        if not wait:
            console.print(f"{robot} plays {wanted}")
            return
        try:
            _follow(console, follower, since)
        except KeyboardInterrupt:
            console.print(
                f"{robot} plays on; its services /{robot}/pause and /{robot}/stop end it"
            )
            raise typer.Exit(130) from None


def in_catalogue(graph: Graph, robot: Any, trajectory: str) -> str:
    """Return the trajectory's id; convert it first where it is a file."""
    from mrlab_msgs import srv

    path = Path(trajectory)
    if path.suffix.lower() != ".mat":
        return trajectory
    request = srv.ConvertTrajectory.Request(
        path=str(path.resolve()), robot_model=robot.model, end_effector=robot.end_effector
    )
    answer = graph.order(srv.ConvertTrajectory, "/converter/convert", request, timeout=60.0)
    return str(answer.trajectory.id)


def begin(graph: Graph, robot: str, state: Any, trajectory: str, rate: float, loop: bool) -> None:
    """Load `trajectory` unless it is loaded, set rate and loop where they differ, and play."""
    from mrlab_msgs import srv
    from std_srvs.srv import SetBool, Trigger

    if state.trajectory_id != trajectory:
        load = srv.LoadTrajectory.Request(id=trajectory)
        graph.order(srv.LoadTrajectory, f"/{robot}/load", load)
    if rate != state.rate:
        graph.order(srv.SetRate, f"/{robot}/set_rate", srv.SetRate.Request(rate=rate))
    if loop != state.loop:
        graph.order(SetBool, f"/{robot}/set_loop", SetBool.Request(data=loop))
    graph.order(Trigger, f"/{robot}/play", Trigger.Request())


class Course:
    """Reads a run off the states that follow `play`: how it stands, and how it ended."""

    def __init__(self, robot: str) -> None:
        self._robot = robot
        self.moving = False
        self.complete = False

    def take(self, state: Any) -> None:
        """Take the next state; raise Misuse where it says that the run will not complete."""
        from mrlab_msgs import msg

        kind = msg.PlaybackState
        if state.state in (kind.ADJUSTING, kind.PLAYING):
            self.moving = True
        elif state.state == kind.COMPLETE:
            self.complete = True
        elif state.state == kind.COLLISION_HALT:
            raise Misuse(
                f"{self._robot} was halted by a collision ({state.message}); place it elsewhere "
                f"or call /{self._robot}/seek, then play again"
            )
        elif state.state == kind.IDLE and self.moving:
            raise LabError(f"the playback of {self._robot} was restarted; play again")
        elif state.state == kind.READY and self.moving and not self.complete:
            raise Misuse(
                f"{self._robot} ended before its last frame: {state.message or 'stopped'}"
            )


def _follow(console: Any, follower: Follower, since: int) -> None:
    from rich.progress import BarColumn, Progress, TextColumn

    from mrlab_ros.commands.follow import milliseconds

    course = Course(follower.robot)
    deadline = time.monotonic() + MOVE_TIMEOUT_S
    label = ""
    columns = (TextColumn("{task.description}"), BarColumn(), TextColumn("{task.fields[words]}"))
    with Progress(*columns, console=console, disable=not console.is_terminal) as bar:
        task = bar.add_task(follower.robot, words="")
        while not course.complete:
            for state in follower.states[since:]:
                since += 1
                course.take(state)
                if state.label != label and not console.is_terminal:
                    console.print(f"{follower.robot} {state.label} {state.message}".rstrip())
                label = state.label
            if not course.moving and time.monotonic() > deadline:
                raise LabError(
                    f"{follower.robot} accepted play but does not move after {MOVE_TIMEOUT_S:g} "
                    "s; mrlab status shows what runs"
                )
            state = follower.state
            words = f"{state.label}  frame {follower.frame} of {state.frame_count}"
            if follower.errors:
                words += f"  {milliseconds(follower.errors[-1])} late"
            total = max(state.frame_count - 1, 1)
            bar.update(task, completed=follower.frame, total=total, words=words)
            time.sleep(0.05)
    console.print(
        f"{follower.robot} played {state.frame_count} frames; deadline error p50 "
        f"{milliseconds(follower.error_p50)}, max {milliseconds(follower.error_max)}, "
        f"{follower.frames_lost} frames left out"
    )
