"""Hard surfaces that no outline shows well: housings of motors, turntables, brackets.

`housings` of details/<id>.yaml are turned parts and prisms on a link, mm in its frame, and boxes
of `without` what they replace of its casting (castings.py). Pages draw them; meshes and hulls stay
as they are measured.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import materials
from details import MM
from facets import moved, prism, turned
from solids import AXES

from mrlab_ros.adapters.robots.packing.occlusion import Pieces
from mrlab_ros.adapters.robots.packing.surfaces import Mesh

SIDES, SIDES_FAR = 40, 14  # of a turned part
FACETS, FACETS_FAR = 4, 1  # of a rounded edge
EDGE, CORNER = 6.0, 16.0  # mm, where none is stated


def housings(table: Mapping[str, Any], afar: bool = False) -> Pieces:
    """Return the housings of each link that has some; afar: of few triangles."""
    found: Pieces = {}
    for entry in table.get("housings", []):
        material = getattr(materials, entry["material"].upper())
        # The fins of a motor are plates, one each `pitch`; from afar the body within shows.
        for number in range(0 if afar and "count" in entry else entry.get("count", 1)):
            shift = [0.0, 0.0, 0.0]
            shift[AXES[entry["axis"]]] = number * entry.get("pitch", 0.0) * MM
            found.setdefault(entry["link"], []).append(
                (material, moved(_mesh(entry, afar), *shift))
            )
    return found


def _mesh(entry: Mapping[str, Any], afar: bool) -> Mesh:
    if "profile" in entry:
        profile = [(radius * MM, at * MM) for radius, at in entry["profile"]]
        mesh = turned(entry["axis"], profile, SIDES_FAR if afar else SIDES)
        return moved(mesh, *(value * MM for value in entry.get("centre", (0, 0, 0))))
    return prism(
        entry["axis"],
        [(u * MM, v * MM) for u, v in entry["outline"]],
        [end * MM for end in entry["ends"]],
        entry.get("edge", EDGE) * MM,
        entry.get("corner", CORNER) * MM,
        FACETS_FAR if afar else FACETS,
    )
