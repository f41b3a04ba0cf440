"""GET /assets/...: meshes, textures, thumbnails, URDFs and the documents about them.

Robots as pages draw them: those installed here, and those that only the lab has.
"""

from __future__ import annotations

import orjson
from anyio import from_thread
from fastapi import APIRouter, Request, Response
from fastapi.responses import StreamingResponse

from mrlab_ros.adapters.robots.library import TIP, RobotLibrary, from_library, shown_robot
from mrlab_ros.core.base.errors import BadInput, LabError, Unavailable
from mrlab_ros.core.bridge.assets import ROBOTS_DOCUMENT
from mrlab_ros.core.robots.model import ShownRobot
from mrlab_ros.gateway.assets.cache import AssetCache
from mrlab_ros.gateway.diagnostics import ASSET_TOO_LARGE, GATEWAY_WITHOUT_LAB, ROBOT_NOWHERE
from mrlab_ros.gateway.pages import Page, is_known, respond


class Robots:
    """A gateway on another machine than the lab does not have the robots imported there."""

    def __init__(self, library: RobotLibrary, assets: AssetCache | None) -> None:
        self._library = library
        self._assets = assets

    def shown(self, model: str, end_effector: str | None) -> ShownRobot:
        """Return a robot; call it in a worker thread of the event loop.

        Raises BadInput where neither this machine nor the lab has it.
        """
        try:
            return from_library(self._library, model, end_effector)
        except BadInput as unknown:
            if self._assets is None:
                raise
            try:
                return self._of_lab(model, end_effector or "")
            except (LabError, ValueError, KeyError, TypeError) as error:
                why = error if isinstance(error, LabError) else str(error)
                raise BadInput(ROBOT_NOWHERE(here=unknown, lab=why)) from error

    def _of_lab(self, model: str, end_effector: str) -> ShownRobot:
        tool = f"+{end_effector}" if end_effector else ""
        description = self._text(f"robots/{model}{tool}.urdf").decode()
        entries = orjson.loads(self._text(ROBOTS_DOCUMENT))["robots"]
        tips = {entry["id"]: str(entry["tip_link"]) for entry in entries}
        return shown_robot(model, end_effector, description, tips.get(model, TIP))

    def _text(self, path: str) -> bytes:
        assert self._assets is not None
        found = from_thread.run(self._assets.get, path)
        if not isinstance(found, Page):
            raise BadInput(ASSET_TOO_LARGE(asset=path, size=found.size))
        return found.body


# Kept by the browser, and compared each time by its ETag: an asset may be imported anew.
CACHE = "private, no-cache"

router = APIRouter(tags=["assets"])


@router.head("/assets/{path:path}", include_in_schema=False, response_class=Response)
@router.get("/assets/{path:path}", operation_id="asset", response_class=Response)
async def asset(request: Request, path: str) -> Response:
    """Return an asset of the lab, such as robots.json or a mesh.

    `package://mrlab_ros/robots/...` of a URDF is /assets/mrlab_ros/robots/... here.
    """
    cache: AssetCache | None = request.app.state.assets
    if cache is None:
        raise Unavailable(GATEWAY_WITHOUT_LAB())
    found = await cache.get(path)
    if isinstance(found, Page):
        return respond(request, found, CACHE)
    headers = {"ETag": f'"{found.sha256}"', "Cache-Control": CACHE}
    if is_known(request, headers["ETag"]):
        return Response(status_code=304, headers=headers)
    headers["Content-Length"] = str(found.size)
    if request.method == "HEAD":
        return Response(headers=headers, media_type=found.media_type)
    return StreamingResponse(
        cache.pieces(path, found), headers=headers, media_type=found.media_type
    )
