"""The gateway as one ASGI application."""

from __future__ import annotations

import asyncio
import time
from collections.abc import AsyncIterator
from contextlib import asynccontextmanager

from fastapi import APIRouter, Depends, FastAPI

import mrlab_ros
from mrlab_ros.adapters.robots.library import RobotLibrary
from mrlab_ros.adapters.share import directory
from mrlab_ros.adapters.store.objects import open_store
from mrlab_ros.extensions import extensions, named
from mrlab_ros.gateway import certificate_authority, errors, pages, robots
from mrlab_ros.gateway.assets import routes as asset_routes
from mrlab_ros.gateway.assets.cache import AssetCache
from mrlab_ros.gateway.assets.routes import Robots
from mrlab_ros.gateway.checks import routes as check_routes
from mrlab_ros.gateway.checks.desk import CheckDesk, CheckProcess
from mrlab_ros.gateway.checks.scene import SceneWatch
from mrlab_ros.gateway.guard import Guard, Hosts
from mrlab_ros.gateway.link import socket
from mrlab_ros.gateway.link.limits import read_limits
from mrlab_ros.gateway.people import oidc_routes, pairing_routes
from mrlab_ros.gateway.people import routes as people_routes
from mrlab_ros.gateway.people.oidc import Oidc, read_provider
from mrlab_ros.gateway.people.people import People, token_of
from mrlab_ros.gateway.policy import authorise, read_policy
from mrlab_ros.gateway.ports import Ports
from mrlab_ros.gateway.settings import Settings
from mrlab_ros.gateway.store import routes as trajectory_routes
from mrlab_ros.gateway.store.shelf import Shelf
from mrlab_ros.gateway.uploads import live
from mrlab_ros.gateway.uploads import routes as upload_routes
from mrlab_ros.gateway.uploads.receive import Receiver

# One module a subject; each has a `router`, and each route a line in policy.py or in the POLICY of
# its extension. The pages come last: they answer any path.
ROUTERS: tuple[APIRouter, ...] = (
    people_routes.router,
    pairing_routes.router,
    oidc_routes.router,
    certificate_authority.router,
    asset_routes.router,
    upload_routes.router,
    live.router,
    robots.router,
    robots.schema_router,
    trajectory_routes.router,
    check_routes.router,
    *(named(router) for each in extensions() for router in each.ROUTERS),
    socket.router,
    pages.router,
)


def create_app(settings: Settings, ports: Ports) -> FastAPI:
    """Return the application; it opens the ports when it starts and closes them at its end.

    Raises BadInput where the settings cannot be served.
    """
    people = ports.people or People(settings)
    if settings.oidc is not None and ports.oidc is None:
        ports.oidc = Oidc(read_provider(settings.oidc))
    policy = read_policy(settings.allow_list)
    limits = read_limits(settings.limits)
    assets = None if ports.lab is None else AssetCache(ports.lab)
    store = ports.store or open_store(settings.store or str(settings.state_dir / "store"))
    library = Robots(RobotLibrary(directory() / "robots"), assets)
    shelf = Shelf(store, settings.state_dir, policy, library, signs_in=settings.signs_in)
    link = None
    if ports.lab is not None:
        link = socket.link_port(ports.lab, policy, limits, shelf.why_not_load)
    checking = check_routes.Checking(
        CheckDesk(ports.checker or CheckProcess()),
        None if ports.lab is None else SceneWatch(ports.lab, time.monotonic),
    )

    @asynccontextmanager
    async def lifespan(_: FastAPI) -> AsyncIterator[None]:
        followed = [people.follow(), *([] if link is None else [link.clock.follow()])]
        following = [asyncio.create_task(each) for each in followed]
        if ports.lab is not None:
            await ports.lab.open()
        try:
            yield
        finally:
            await checking.desk.close()
            for task in following:
                task.cancel()
            await asyncio.gather(*following, return_exceptions=True)
            if link is not None:
                link.sessions.close()
            if ports.lab is not None:
                await ports.lab.close()
            people.database.close()

    app = FastAPI(
        title="MR-Lab gateway",
        version=mrlab_ros.__version__,
        summary="Pages, people, uploads and the lab for browsers.",
        openapi_url="/api/openapi.json",
        # FastAPI's own pages load scripts from other hosts.
        docs_url=None,
        redoc_url=None,
        lifespan=lifespan,
        responses=errors.RESPONSES,
        dependencies=[Depends(authorise)],
    )
    app.state.settings = settings
    app.state.ports = ports
    app.state.people = people
    app.state.oidc = ports.oidc
    app.state.policy = policy
    app.state.link = link
    app.state.checking = checking
    app.state.assets = assets
    app.state.shelf = shelf
    app.state.live = live.LiveDesk()
    app.state.desk = upload_routes.Desk(Receiver(store, shelf.work))
    app.state.pages = settings.pages or pages.pages_folder()
    errors.install(app)
    app.add_api_route("/healthz", healthz, tags=["health"])
    for router in ROUTERS:
        app.include_router(router)
    hosts = Hosts.of(settings)
    app.add_middleware(
        Guard,
        host_allowed=hosts.allows,
        public_origin=hosts.public_origin,
        csrf_matches=people.csrf_matches,
        token_of=token_of,
        posted=[path for each in extensions() for path in each.POSTED],
    )
    return app


async def healthz() -> dict[str, str]:
    """Say that the gateway runs."""
    return {"status": "ok"}
