"""`mrlab robots meshes --from`: robots in the meshes of the repositories that they come from."""

from __future__ import annotations

import json
import tempfile
from pathlib import Path
from typing import TYPE_CHECKING, Any

from mrlab_ros.commands.diagnostics import NO_MESHES_INSTALLED, NO_OWN_DESCRIPTION
from mrlab_ros.commands.output import print_findings
from mrlab_ros.core.base.diagnostic import plain
from mrlab_ros.core.base.errors import BadInput

if TYPE_CHECKING:
    from mrlab_ros.adapters.robots.library import RobotLibrary

CLONES = "sources"  # beside the imported robots: where clones are looked for


def dress(library: RobotLibrary, robot: str, place: str, *, as_json: bool) -> None:
    """Dress one robot, or all; print a row for each. Raises BadInput where none was dressed.

    place: a folder or an address; empty: the folder of clones in the lab's data folder. A clone of
    an address is kept there no longer than this takes.
    """
    from mrlab_ros.adapters.robots import vendor_sources

    rows: dict[str, Any] = {}
    told: set[str] = set()
    with tempfile.TemporaryDirectory(prefix="mrlab-") as made:
        folder = Path(place) if place else library.imported / CLONES
        if vendor_sources.REMOTE.search(place) and not folder.exists():
            folder = vendor_sources.cloned(place, Path(made))
        pictures = library.imported / "pictures"
        for name in (robot,) if robot else library.ids():
            rows[name] = row = _row(library, name, folder, pictures)
            if not as_json:
                _print(name, row, told)
    if as_json:
        print(json.dumps(plain({"robots": rows})))
    if not any("triangles" in row for row in rows.values()):
        raise BadInput(NO_MESHES_INSTALLED(count=len(rows)))


def _row(library: RobotLibrary, robot: str, folder: Path, pictures: Path) -> dict[str, Any]:
    """Return what came of one robot; `findings` are diagnostics."""
    from mrlab_ros.adapters.robots import checks, vendor_meshes, vendor_sources

    source = vendor_sources.pinned(library.facts(robot))
    if source is None:
        return {"findings": [NO_OWN_DESCRIPTION(robot=robot)]}
    try:
        clone = vendor_sources.find_clone(folder, source)
        worn = vendor_meshes.dress(robot, source, clone, library, pictures)
    except BadInput as error:
        return {"findings": [error.diagnostic]}
    row: dict[str, Any] = {"findings": [*worn.findings]}
    if not checks.errors(worn.findings):
        row |= {
            "triangles": dict(worn.triangles),
            "bytes": dict(worn.sizes),
            "overlap": round(worn.share, 3),
            "licence": source.licence,
            "notices": [*worn.notices],
            "picture": str(worn.picture),
        }
    return row


def _print(robot: str, row: dict[str, Any], told: set[str]) -> None:
    """Print what came of a robot; what was told of another one is not told again."""
    if "triangles" in row:
        levels = ", ".join(
            f"{level} {row['triangles'][level]} triangles {row['bytes'][level] / 1e3:.0f} kB"
            for level in row["triangles"]
        )
        print(f"{robot}: {levels}; silhouettes {row['overlap']:.0%}; {row['licence']}")
        print(f"  before and after: {row['picture']}")
        print(f"  our own again: mrlab robots remove {robot}")
    else:
        print(f"{robot}: keeps the body that it has")
    print_findings([one for one in row["findings"] if str(one) not in told])
    told.update(map(str, row["findings"]))
