"""`mrlab open`: the pages of the running lab in the browser."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Annotated, Any

import typer

from mrlab_ros.commands.diagnostics import NO_PAGES
from mrlab_ros.commands.up.web import open_in_browser, opening_url
from mrlab_ros.core.base.errors import Misuse
from mrlab_ros.processes.run_file import RunFile, domains, nobody
from mrlab_ros.ros.environment import domain_id


def open_pages(
    path: Annotated[str, typer.Argument(help="The page, such as /lab or /trajectories.")] = "/",
    print_only: Annotated[
        bool, typer.Option("--print", help="Print the address and open nothing.")
    ] = False,
    as_json: Annotated[
        bool, typer.Option("--json", help="Print one JSON object and open nothing.")
    ] = False,
) -> None:
    """Open the pages of the lab that runs on this machine, signed in.

    The printed address signs in one browser of this machine, once, within a day.
    """
    web = running_web()
    url = opening_url(web["open"], Path(web["users"]), f"/{path.lstrip('/')}")
    if as_json:
        print(json.dumps({"url": url}))
    elif print_only or not open_in_browser(url):
        print(url)


def running_web() -> dict[str, Any]:
    """Return what the run file says of the pages; raises Misuse where there are none."""
    domain = domain_id()
    found = RunFile(domain).read()
    if found is None:
        raise Misuse(nobody(domain, domains()))
    web: dict[str, Any] | None = found.get("web")
    if web is None:
        raise Misuse(NO_PAGES())
    return web
