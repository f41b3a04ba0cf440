"""`mrlab system`: robots of the running lab that play as one."""

from __future__ import annotations

import json
from contextlib import suppress
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from mrlab_ros.commands import completion, output
from mrlab_ros.commands.diagnostics import DISSOLVED_IN_PLAY, NO_MODE, SYSTEM_STANDS
from mrlab_ros.commands.output import AsJson, say
from mrlab_ros.core.base.diagnostic import Fix, heard
from mrlab_ros.core.base.errors import BadInput, Misuse
from mrlab_ros.core.base.names import checked_name, close_to
from mrlab_ros.core.playback.diagnostics import MEMBER_OF_SYSTEM, PLAYED_TO_END
from mrlab_ros.core.systems.diagnostics import NO_SYSTEM

if TYPE_CHECKING:
    from message_bases import Service
    from mrlab_msgs import msg

    from mrlab_ros.core.systems.cell_file import MemberEntry, SystemEntry
    from mrlab_ros.ros.graph import GraphClient, Request, Said

app = typer.Typer(
    no_args_is_help=True,
    help="Robots that play as one: create from a YAML file, play, pause, seek, dissolve.",
)
# A negative number is no option.
NEGATIVE = {"ignore_unknown_options": True}
Name = Annotated[
    str,
    typer.Argument(
        help="A system of the lab; mrlab system list shows them.",
        autocompletion=completion.systems,
    ),
]


@app.command("list")
def list_systems(
    as_json: Annotated[
        bool, typer.Option("--json", help="Print one JSON object a system.")
    ] = False,
) -> None:
    """List the systems, their members and each one's share of the timeline."""
    from rich.table import Table

    from mrlab_ros.client.connect import open_graph

    with open_graph() as graph:
        systems = _systems(graph)
    if as_json:
        for system in systems:
            print(json.dumps(_document(system)))
        return
    table = Table(
        "system", "state", "mode", "at", "robot", "trajectory", "from", "to", "waits for"
    )
    for system in systems:
        for i, member in enumerate(system.members):
            head = (
                (system.name, system.label, _mode(system), f"{system.duration:g} s")
                if i == 0
                else ("", "", "", "")
            )
            table.add_row(
                *head,
                member.robot,
                member.trajectory_id,
                f"{member.start:.2f} s",
                f"{member.start + member.duration:.2f} s",
                member.waiting_for,
            )
    none = "no systems; mrlab system create cell.yaml makes one"
    output.console().print(table if systems else none)


@app.command()
def create(
    file: Annotated[
        Path, typer.Argument(help="The system's YAML file; docs/systems.md explains.")
    ],
    as_json: AsJson = False,
) -> None:
    """Make a system as its YAML file describes it."""
    from dataclasses import replace

    from mrlab_msgs import srv

    from mrlab_ros.adapters.scenes.files import content
    from mrlab_ros.client.connect import open_graph
    from mrlab_ros.core.scene.document import parse_cell
    from mrlab_ros.messages.scenes import create_system_request

    systems = parse_cell(content(file), file.name)
    with open_graph() as graph:
        # All robots and names, before the first conversion adds to the catalogue.
        for system in systems:
            _check_entry(graph, system)
        for system in systems:
            members = tuple(
                replace(member, trajectory=_trajectory(graph, file, member))
                for member in system.members
            )
            request = create_system_request(replace(system, members=members))
            answer = graph.order(srv.CreateSystem, "/coordinator/create_system", request, 30.0)
            name = answer.system.name
            if system.rate != 1.0:
                rate = srv.SetRate.Request(rate=system.rate)
                graph.order(srv.SetRate, f"/{name}/set_rate", rate)
            if system.at > 0:
                at = srv.Seek.Request(position=system.at)
                graph.order(srv.Seek, f"/{name}/seek", at)
            say(heard(answer), as_json=as_json, system=name)
            if not as_json:
                print(f"next: mrlab system play {name}")


def _check_entry(graph: GraphClient, system: SystemEntry) -> None:
    """Raise where the coordinator would refuse the system for its robots or its name."""
    others = _systems(graph, system.name) if system.name else _systems(graph)
    for member in system.members:
        graph.robot(member.robot)
        for other in others:
            if any(each.robot == member.robot for each in other.members):
                raise Misuse(MEMBER_OF_SYSTEM(robot=member.robot, system=other.name))
    if system.name:
        taken = {robot.name for robot in graph.robots()} | {other.name for other in others}
        checked_name(system.name, frozenset(taken), "system")


def _trajectory(graph: GraphClient, cell: Path, member: MemberEntry) -> str:
    """Return the id of the member's trajectory; convert it where `cell` names a workspace."""

    from mrlab_ros.client.lab import Lab
    from mrlab_ros.commands.lab.play import in_catalogue, is_file
    from mrlab_ros.core.conversion.options import Options

    name = member.trajectory
    if not name or not is_file(name):
        return name
    lab = Lab(graph)
    file = str(cell.parent / name)
    given = ["mrlab", "load", member.robot, file]
    console = output.console(stderr=True)
    try:
        return in_catalogue(lab, lab.robot(member.robot), file, Options(), given, console)
    except typer.Exit:
        console.print(
            f"{cell} was not made into a system. Once the file is loaded, write the name that is "
            f"printed in place of {name} there, and run: mrlab system create {cell}"
        )
        raise


@app.command()
def play(
    name: Name,
    wait: Annotated[
        bool, typer.Option("--wait/--no-wait", help="Follow the system to its end.")
    ] = True,
    as_json: AsJson = False,
) -> None:
    """Stage all members, then play; play on where the system is paused."""
    from mrlab_msgs import msg
    from mrlab_msgs.srv import Trigger

    from mrlab_ros.client.connect import open_graph
    from mrlab_ros.messages import qos

    with open_graph() as graph:
        _system(graph, name)
        seen: list[msg.RobotSystem] = []
        watch = graph.watch(msg.RobotSystems, "/systems", qos.LATCHED_EVENTS)

        def note(message: msg.RobotSystems) -> bool:
            state = next((s for s in message.systems if s.name == name), None)
            if state is None:
                # The latched messages go back to before it was made; gone is what was there.
                return bool(seen)
            if not seen or seen[-1].label != state.label:
                seen.append(state)
                if len(seen) > 1:
                    words = f"{name}: {state.label}{': ' * bool(state.message)}{state.message}"
                    say(words, as_json=as_json, system=name, state=state.label)
            return len(seen) > 1 and state.label in ("READY", "PAUSED", "COLLISION_HALT")

        watch.wait(lambda m: note(m) or True, 5.0)
        answer = graph.order(Trigger, f"/{name}/play", Trigger.Request(), 30.0)
        say(heard(answer), as_json=as_json, system=name)
        if not wait:
            return
        try:
            last = watch.wait(note, 24 * 3600.0)
        except KeyboardInterrupt:
            print(
                f"{name} plays on; end it with: mrlab system pause {name}, or mrlab system stop "
                f"{name}"
            )
            raise typer.Exit(130) from None
        state = next((s for s in last.systems if s.name == name), None)
    if state is None:
        raise Misuse(DISSOLVED_IN_PLAY(system=name))
    if state.code != PLAYED_TO_END.code:
        why = heard(state) if state.message else None
        raise Misuse(SYSTEM_STANDS(system=name, state=state.label, why=why))


def _simple(verb: str, words: str) -> None:
    @app.command(verb, help=words)
    def command(name: Name, as_json: AsJson = False) -> None:
        from mrlab_msgs.srv import Trigger

        from mrlab_ros.client.connect import open_graph

        with open_graph() as graph:
            _system(graph, name)
            answer = graph.order(Trigger, f"/{name}/{verb}", Trigger.Request())
        say(heard(answer), as_json=as_json, system=name)


_simple("pause", "Pause all members; play continues from there.")
_simple("stop", "End the run; the next play begins at the start.")


@app.command(context_settings=NEGATIVE)
def seek(
    name: Name,
    position: Annotated[float, typer.Argument(help="Place on the timeline, s.")],
    as_json: AsJson = False,
) -> None:
    """Show another place on the timeline at once."""
    from mrlab_msgs import srv

    _order(name, "seek", srv.Seek, srv.Seek.Request(position=position), as_json=as_json)


@app.command(context_settings=NEGATIVE)
def step(
    name: Name,
    frames: Annotated[int, typer.Argument(help="Frames; negative: backwards.")] = 1,
    as_json: AsJson = False,
) -> None:
    """Step a standing system frame by frame."""
    from mrlab_msgs import srv

    _order(name, "step", srv.Step, srv.Step.Request(frames=frames), as_json=as_json)


@app.command(context_settings=NEGATIVE)
def rate(
    name: Name,
    rate: Annotated[
        float, typer.Argument(help="0.1 to 4; 1 is the declared speed, -1 the same backwards.")
    ],
    as_json: AsJson = False,
) -> None:
    """Set the speed of the timeline."""
    from mrlab_msgs import srv

    _order(name, "set_rate", srv.SetRate, srv.SetRate.Request(rate=rate), as_json=as_json)


@app.command()
def mode(
    name: Name,
    mode: Annotated[str, typer.Argument(help="parallel or sequential.")],
    as_json: AsJson = False,
) -> None:
    """Set how the members share the timeline."""
    from mrlab_msgs import srv

    from mrlab_ros.core.systems.timeline import Mode

    if mode.upper() not in Mode.__members__:
        raise BadInput(NO_MODE(mode=mode))
    _order(
        name,
        "set_mode",
        srv.SetMode,
        srv.SetMode.Request(mode=Mode[mode.upper()].value),
        as_json=as_json,
    )


@app.command()
def loop(
    name: Name,
    on: Annotated[bool, typer.Argument(help="true or false.")] = True,
    as_json: AsJson = False,
) -> None:
    """Have the system start over after its end, or not."""
    from mrlab_msgs.srv import SetLoop

    _order(name, "set_loop", SetLoop, SetLoop.Request(loop=on), as_json=as_json)


@app.command()
def dissolve(name: Name, as_json: AsJson = False) -> None:
    """Set the members free, paused where they are."""
    from mrlab_msgs import srv

    from mrlab_ros.client.connect import open_graph

    with open_graph() as graph:
        request = srv.Remove.Request(name=name)
        answer = graph.order(srv.Remove, "/coordinator/dissolve_system", request)
    say(heard(answer), as_json=as_json, system=name)


def _order(
    name: str, service: str, kind: type[Service[Request, Said]], request: Request, *, as_json: bool
) -> None:
    from mrlab_ros.client.connect import open_graph

    with open_graph() as graph:
        _system(graph, name)
        answer = graph.order(kind, f"/{name}/{service}", request)
    say(heard(answer), as_json=as_json, system=name)


def _systems(graph: GraphClient, name: str = "") -> list[msg.RobotSystem]:
    """Return the systems as last published, or as soon as one called `name` is among them.

    The latched messages come oldest first, one soon after the other.
    """
    from mrlab_msgs import msg

    from mrlab_ros.ros.calls import NoAnswer
    from mrlab_ros.ros.graph import LATCHED_BURST_S

    watch = graph.watch(msg.RobotSystems, "/systems")
    watch.wait(lambda _: True, 5.0)
    with suppress(NoAnswer):
        watch.wait(lambda m: any(s.name == name for s in m.systems), LATCHED_BURST_S)
    assert watch.value is not None
    return list(watch.value.systems)


def _system(graph: GraphClient, name: str) -> msg.RobotSystem:
    systems = _systems(graph, name)
    for system in systems:
        if system.name == name:
            return system
    known = [system.name for system in systems]
    fixes = () if known else (Fix(command="mrlab system create cell.yaml"),)
    close = close_to(name, known)
    raise Misuse(NO_SYSTEM(system=name, known=known, close=close, fixes=fixes))


def _mode(system: msg.RobotSystem) -> str:
    from mrlab_ros.core.systems.timeline import Mode

    return Mode(system.mode).name.lower()


def _document(system: msg.RobotSystem) -> dict[str, Any]:
    return {
        "name": system.name,
        "state": system.label,
        "message": system.message,
        "mode": _mode(system),
        "duration": system.duration,
        "rate": system.rate,
        "loop": system.loop,
        "members": [
            {
                "robot": m.robot,
                "trajectory": m.trajectory_id,
                "start": m.start,
                "duration": m.duration,
                "dwell": m.dwell,
                "waits": list(m.waits),
                "waiting_for": m.waiting_for,
            }
            for m in system.members
        ],
    }
