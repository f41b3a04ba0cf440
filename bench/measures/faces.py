"""What drawn robots cost: draw calls, triangles and textures, and s until one is whole.

Chromium without a lab. Thirteen robots stand in the room in two rows, seen from within ("near")
and from 14 m away ("far"). One robot at a time comes over a network of 20 Mbit/s, 20 ms
away, without a cache: from the request of its meshes until it is whole.
"""

from __future__ import annotations

from typing import Any

from faces_page import ROOT, Faces, faces
from size import Size

NEEDS = ("chromium", "playwright")
MBIT = 20.0
APART = 3.2  # m, between robots


def robots() -> list[str]:
    return sorted(path.parent.name for path in (ROOT / "robots").glob("*/robot.yaml"))


def room(size: Size) -> list[dict[str, Any]]:
    names = robots()[: size.of(2, 13, 13)]
    stand = [
        {"id": name, "at": ((n % 7 - 3) * APART, (n // 7) * APART, 0, 0)}
        for n, name in enumerate(names)
    ]
    with faces((800, 600)) as page:
        page.show(stand, stage="room")
        rows = []
        for label, eyes in (("near", (0.0, 1.6, 1.6)), ("far", (0.0, -14.0, 4.0))):
            for _ in range(3):  # until no level dissolves into the other
                page.look(eyes, (0.0, 1.6, 1.0), 60)
            rows.append({"robots": len(names), "seen": label, **_figures(page)})
    return rows


def _figures(page: Faces) -> dict[str, Any]:
    cost = page.cost()
    return {
        "draw calls": int(cost["calls"]),
        "triangles": int(cost["triangles"]),
        "textures MB": cost["textures"] / 1e6,
    }


def loading(size: Size) -> list[dict[str, Any]]:
    rows = []
    with faces((400, 300), gpu=False) as page:
        for name in robots()[: size.of(1, 13, 13)]:
            lod = ROOT / "robots" / name / "lod"
            kilobytes = sum(file.stat().st_size for file in lod.glob("*.glb")) / 1e3
            page.throttle(MBIT)
            rows.append({"robot": name, "kB": kilobytes, "whole s": page.show([{"id": name}])})
    return rows


TABLES = {
    "Thirteen robots in the room": room,
    "One robot over 20 Mbit/s": loading,
}
