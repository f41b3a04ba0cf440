"""The gateway as one ASGI application."""

from __future__ import annotations

from collections.abc import AsyncIterator
from contextlib import asynccontextmanager

from fastapi import APIRouter, FastAPI

import mrlab_ros
from mrlab_ros.gateway import errors, pages
from mrlab_ros.gateway.guard import Guard
from mrlab_ros.gateway.people import routes as people
from mrlab_ros.gateway.ports import Ports
from mrlab_ros.gateway.settings import Settings, is_loopback

# One module a subject; each has a `router`. The pages come last: they answer any path.
ROUTERS: tuple[APIRouter, ...] = (people.router, pages.router)


def create_app(settings: Settings, ports: Ports) -> FastAPI:
    """Return the application; it opens the ports when it starts and closes them at its end."""

    @asynccontextmanager
    async def lifespan(_: FastAPI) -> AsyncIterator[None]:
        if ports.lab is not None:
            await ports.lab.open()
        try:
            yield
        finally:
            if ports.lab is not None:
                await ports.lab.close()

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
    )
    app.state.settings = settings
    app.state.ports = ports
    app.state.pages = settings.pages or pages.pages_folder()
    errors.install(app)
    app.add_api_route("/healthz", healthz, tags=["health"])
    for router in ROUTERS:
        app.include_router(router)
    app.add_middleware(
        Guard,
        host_allowed=is_loopback,
        public_origin="",
        csrf_matches=lambda token, _: bool(token),
    )
    return app


async def healthz() -> dict[str, str]:
    """Say that the gateway runs."""
    return {"status": "ok"}
