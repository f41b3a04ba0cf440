"""`mrlab status`: the graph at a glance."""

from __future__ import annotations

import json
import sys
import time
from typing import TYPE_CHECKING, Annotated

import typer

from mrlab_ros.commands import output

if TYPE_CHECKING:
    from rich.console import Console

    from mrlab_ros.commands.status.view import Presence, View

REFRESH_RATE_HZ = 4.0


def status(
    once: Annotated[bool, typer.Option("--once", help="Print the tables once and end.")] = False,
    as_json: Annotated[
        bool, typer.Option("--json", help="Print one JSON object and end.")
    ] = False,
) -> None:
    """Show robots, trajectories, systems and processes of the running lab.

    On a terminal the arrows, space and page keys scroll, q ends. Ends with 0 where a lab answers,
    1 where none does.
    """
    from mrlab_ros.client.connect import open_graph
    from mrlab_ros.commands.status.view import Presence, View

    console = output.console()
    with open_graph() as graph:
        presence = Presence(graph.node_names)
        graph.robots()
        view = View(graph)
        view.settle()
        if as_json:
            nodes = presence.wait(view.expected_nodes)
            sys.stdout.write(json.dumps({**view.facts(), "nodes": nodes}, indent=2) + "\n")
        elif once or not console.is_terminal:
            from mrlab_ros.commands.status.table import overview

            nodes = presence.wait(view.expected_nodes)
            console.print(overview(view.facts(), nodes, console.width))
        else:
            _live(console, view, presence)


def _live(console: Console, view: View, presence: Presence) -> None:
    """Show the tables until q or Ctrl-C, as much of them as fits, and let keys scroll."""
    from rich.live import Live

    from mrlab_ros.commands.status.table import overview
    from mrlab_ros.commands.status.view import MISSING_AFTER_S, Scroll

    scroll = Scroll(console, sys.stdin.fileno() if sys.stdin.isatty() else None)
    with scroll, Live(console=console, auto_refresh=False, screen=True) as live:
        try:
            while not scroll.ended:
                nodes = presence.present(view.expected_nodes(), MISSING_AFTER_S)
                shown = overview(view.facts(), nodes, console.width)
                scroll.take(shown)
                live.update(scroll, refresh=True)
                deadline = time.monotonic() + 1 / REFRESH_RATE_HZ
                while (left := deadline - time.monotonic()) > 0 and not scroll.ended:
                    if scroll.key(left):
                        live.update(scroll, refresh=True)
        except KeyboardInterrupt:
            pass
    console.print(scroll.whole)
