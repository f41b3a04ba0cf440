"""`mrlab scene` and `mrlab objects`: what stands in the running lab beside its robots."""

from __future__ import annotations

import json
import math
from collections.abc import Sequence
from typing import TYPE_CHECKING, Annotated, Any

import typer

from mrlab_ros.commands import output
from mrlab_ros.commands.diagnostics import BAD_PLACE, NO_PHYSICS_HERE
from mrlab_ros.commands.output import AsJson, say
from mrlab_ros.core.base.diagnostic import Diagnostic, Fix
from mrlab_ros.core.base.errors import BadInput, Misuse

if TYPE_CHECKING:
    from mrlab_ros.ros.graph import GraphClient

# Loading a scene spawns its robots and loads their trajectories, one after another, s.
LOAD_TIMEOUT = 120.0
CATALOGUE = "/physics/list_catalogue"

scene = typer.Typer(no_args_is_help=True, help="Whole scenes: list, save, load.")
objects = typer.Typer(
    no_args_is_help=True, help="Objects of the scene: list, types, spawn, remove, clear."
)
Scene = Annotated[str, typer.Argument(help="A scene; mrlab scene list shows them.")]


@scene.command("list")
def list_scenes(as_json: AsJson = False) -> None:
    """List the scenes: those that came with the lab, and those saved in it."""
    from mrlab_msgs import srv

    from mrlab_ros.client.connect import open_graph

    with open_graph() as graph:
        answer = graph.call(srv.ListScenes, "/lab/list_scenes", srv.ListScenes.Request())
    names = list(answer.scenes)
    print(json.dumps(names) if as_json else "\n".join(names))


@scene.command()
def save(name: Scene, as_json: AsJson = False) -> None:
    """Save robots, places, trajectories, objects, surfaces and systems under a name."""
    say(_scene_file("save", name, 15.0), as_json=as_json, scene=name)


@scene.command()
def load(name: Scene, as_json: AsJson = False) -> None:
    """Bring the lab to a saved or shipped scene; what is there now goes."""
    say(_scene_file("load", name, LOAD_TIMEOUT), as_json=as_json, scene=name)


@scene.command()
def undo(as_json: AsJson = False) -> None:
    """Undo what was loaded, removed or dissolved last, by anybody, up to ten seconds ago."""
    from mrlab_msgs import srv

    from mrlab_ros.client.connect import open_graph
    from mrlab_ros.core.base.diagnostic import heard

    with open_graph() as graph:
        answer = graph.order(srv.Undo, "/lab/undo", srv.Undo.Request(), LOAD_TIMEOUT)
    say(heard(answer), as_json=as_json)


def _scene_file(verb: str, name: str, timeout: float) -> Diagnostic:
    from mrlab_msgs import srv

    from mrlab_ros.client.connect import open_graph
    from mrlab_ros.core.base.diagnostic import heard

    with open_graph() as graph:
        request = srv.SceneFile.Request(name=name)
        service = f"/lab/{verb}_scene"
        return heard(graph.order(srv.SceneFile, service, request, timeout))


@objects.command("list")
def list_objects(as_json: AsJson = False) -> None:
    """List the objects in the scene: where each one is, and who holds it."""
    from mrlab_msgs import msg

    with _graph() as graph:
        watch = graph.watch(msg.SceneObjects, "/objects")
        found = watch.wait(lambda _: True, 5.0).objects
    if as_json:
        print(json.dumps([_document(thing) for thing in found], indent=2))
        return
    rows = [
        (
            thing.name,
            thing.type,
            ", ".join(f"{v:.3f}" for v in _position(thing)),
            _mass(thing.mass),
            thing.held_by,
        )
        for thing in found
    ]
    _show(("name", "type", "x, y, z in m", "mass", "held by"), rows, "no objects in the scene")


@objects.command()
def types(as_json: AsJson = False) -> None:
    """List what can be spawned: the catalogue config/objects.yaml."""
    with _graph() as graph:
        catalogue = _catalogue(graph)
    if as_json:
        rows = [
            {"id": t.id, "about": t.about, "size": _size(t), "mass": t.mass, "mesh": t.mesh}
            for t in catalogue.types
        ]
        print(json.dumps({"types": rows, "limit": catalogue.limit}, indent=2))
        return
    _show(
        ("type", "about", "size, mm", "mass"),
        [
            (t.id, t.about, " x ".join(f"{1e3 * v:.0f}" for v in _size(t)), _mass(t.mass))
            for t in catalogue.types
        ],
        "the catalogue is empty",
    )


@objects.command()
def spawn(
    type_id: Annotated[
        str, typer.Argument(metavar="TYPE", help="A type; mrlab objects types shows them.")
    ],
    at: Annotated[
        str, typer.Option("--at", help="Where its centre goes, x,y,z in m; not given: free floor.")
    ] = "",
    on: Annotated[
        bool, typer.Option("--on", help="On the nearest surface below --at, beside what is there.")
    ] = False,
    name: Annotated[str, typer.Option(help="Its name; not given: the type and a number.")] = "",
    yaw: Annotated[float, typer.Option(help="Turn about the vertical, degrees.")] = 0.0,
    as_json: AsJson = False,
) -> None:
    """Put an object into the scene."""
    from mrlab_msgs import srv

    from mrlab_ros.core.base.diagnostic import heard
    from mrlab_ros.core.base.geometry import Pose
    from mrlab_ros.messages.poses import pose_to_message

    position = _place(at) if at else (0.0, 0.0, 0.0)
    half = math.radians(yaw) / 2
    request = srv.SpawnObject.Request(
        type=type_id,
        name=name,
        automatic=on or not at,
        pose=pose_to_message(Pose(position, (0.0, 0.0, math.sin(half), math.cos(half)))),
    )
    with _graph() as graph:
        answer = graph.order(srv.SpawnObject, "/physics/spawn_object", request)
    say(heard(answer), as_json=as_json)


@objects.command()
def remove(
    name: Annotated[str, typer.Argument(help="An object of the scene.")],
    as_json: AsJson = False,
) -> None:
    """Take an object out of the scene."""
    from mrlab_msgs import srv

    from mrlab_ros.core.base.diagnostic import heard

    with _graph() as graph:
        request = srv.Remove.Request(name=name)
        answer = graph.order(srv.Remove, "/physics/remove_object", request)
    say(heard(answer), as_json=as_json, object=name)


@objects.command()
def clear(as_json: AsJson = False) -> None:
    """Take all objects out of the scene."""
    from mrlab_msgs.srv import Trigger

    from mrlab_ros.core.base.diagnostic import heard

    with _graph() as graph:
        answer = graph.order(Trigger, "/physics/clear_objects", Trigger.Request())
    say(heard(answer), as_json=as_json)


def _graph() -> GraphClient:
    """Return a client of a lab that has physics; raise Misuse where it has none."""
    from mrlab_ros.client.connect import open_graph

    graph = open_graph()
    try:
        graph.robots()
        if not graph.is_offered(CATALOGUE):
            raise Misuse(NO_PHYSICS_HERE(fixes=(Fix(command="mrlab up --physics"),)))
    except BaseException:
        graph.close()
        raise
    return graph


def _catalogue(graph: GraphClient) -> Any:
    from mrlab_msgs import srv

    return graph.call(srv.ListCatalogue, CATALOGUE, srv.ListCatalogue.Request())


def _place(text: str) -> tuple[float, float, float]:
    """Return the three numbers of 'x,y,z'; raise BadInput where it has not three."""
    try:
        x, y, z = (float(part) for part in text.split(","))
    except ValueError:
        raise BadInput(BAD_PLACE(text=text)) from None
    return x, y, z


def _position(thing: Any) -> tuple[float, float, float]:
    p = thing.pose.position
    return p.x, p.y, p.z


def _size(thing: Any) -> list[float]:
    return [thing.size.x, thing.size.y, thing.size.z]


def _mass(mass: float) -> str:
    return f"{mass:g} kg" if mass else "fixed"


def _document(thing: Any) -> dict[str, Any]:
    q = thing.pose.orientation
    return {
        "name": thing.name,
        "type": thing.type,
        "position": list(_position(thing)),
        "orientation": [q.x, q.y, q.z, q.w],
        "size": _size(thing),
        "mass": thing.mass,
        "held_by": thing.held_by,
    }


def _show(headings: tuple[str, ...], rows: Sequence[tuple[str, ...]], empty: str) -> None:
    from rich.table import Table

    table = Table(*headings)
    for row in rows:
        table.add_row(*row)
    output.console().print(table if rows else empty)
