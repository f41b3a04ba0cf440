"""GET /assets/...: meshes, textures, thumbnails, URDFs and the documents about them."""

from __future__ import annotations

from fastapi import APIRouter, Request, Response
from fastapi.responses import StreamingResponse

from mrlab_ros.core.base.errors import Unavailable
from mrlab_ros.gateway.assets.cache import AssetCache
from mrlab_ros.gateway.diagnostics import GATEWAY_WITHOUT_LAB
from mrlab_ros.gateway.pages import Page, is_known, respond

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
