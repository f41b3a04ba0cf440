"""The files that go into a one-file page."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from pathlib import Path

from mrlab_ros.adapters.diagnostics import REPORT_NOT_BUILT
from mrlab_ros.adapters.robots import mesh_files, urdf
from mrlab_ros.app.show.page import Code
from mrlab_ros.core.base.errors import BadInput


def code(share: Path, *, flat: bool = False) -> Code:
    """Return the built code in the package's share folder; raise BadInput where it is missing.

    flat: that of pages without a 3D view, a third of the other.
    """
    name = "flat" if flat else "show"
    script = share / "web" / "dist" / name / f"{name}.js"
    try:
        style = script.with_suffix(".css").read_text(encoding="utf-8")
        return Code(script.read_bytes(), style)
    except OSError:
        raise BadInput(REPORT_NOT_BUILT(path=str(script))) from None


def meshes_of(descriptions: Iterable[str], resolve: Callable[[str], Path]) -> dict[str, bytes]:
    """Return the visual meshes of URDFs as small GLB files, by URI.

    resolve: returns the file of a URI. A mesh that is missing or cannot be read is left out: the
    page says so and draws a placeholder.
    """
    uris = {
        str(mesh.get("filename"))
        for text in descriptions
        for mesh in urdf.parse(text, "the robot").iterfind("link/visual/geometry/mesh")
    }
    return small(uris, resolve)


def small(uris: Iterable[str], resolve: Callable[[str], Path]) -> dict[str, bytes]:
    """Return the meshes that can be read as small GLB files, by URI."""
    found = {}
    for uri in sorted(uris):
        try:
            found[uri] = mesh_files.quantised(resolve(uri))
        except BadInput:
            continue
    return found
