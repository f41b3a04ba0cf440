"""Bodies of the catalogue's objects, each in its own frame: origin at the centre of mass.

The collision shapes are in config/objects.yaml; these are the visual meshes, and a test compares
the two.
"""

from __future__ import annotations

import sys
from collections.abc import Callable
from pathlib import Path

import glb
from body import LIGHT_GREY, STEEL, WHITE, drum, slab
from mesher import contour
from solids import Solid, lathe, ring, union

from mrlab_ros.adapters.robots.packing.surfaces import Material, creased, decimated

FOLDER = Path(__file__).resolve().parents[2] / "config" / "objects"
PORCELAIN = Material("porcelain", (0.93, 0.93, 0.94), 0.0, 0.25)
GLASS = Material("green_glass", (0.16, 0.42, 0.22), 0.0, 0.12)
PAPER = Material("paper", (0.93, 0.9, 0.8), 0.0, 0.8)
RED = Material("red_lacquer", (0.78, 0.1, 0.1), 0.2, 0.35)
IRON = Material("iron", (0.35, 0.37, 0.4), 0.8, 0.5)
WOOD = Material("wood", (0.72, 0.55, 0.35), 0.0, 0.75)
BEECH = Material("beech", (0.82, 0.75, 0.62), 0.0, 0.55)
BLUE = Material("blue_plastic", (0.2, 0.4, 0.7), 0.0, 0.45)
Pieces = list[tuple[Material, Solid]]


def cup() -> Pieces:
    """A cup of 80 mm with a rounded foot, a thin rim and a handle."""
    outside = [(-0.001, -0.04), (0.03, -0.04), (0.0382, -0.028), (0.0382, 0.04), (-0.001, 0.04)]
    inside = [(-0.001, -0.034), (0.028, -0.034), (0.0345, -0.026), (0.0345, 0.06), (-0.001, 0.06)]
    wall = lathe("z", outside, 0.0015) - lathe("z", inside, 0.003)
    ear = ring("y", 0.019, 0.0042).moved(0.041, 0.0, 0.0)
    room = lathe("z", [(-0.001, -0.05), (0.036, -0.05), (0.036, 0.05), (-0.001, 0.05)])
    return [(PORCELAIN, wall.blend(ear - room, 0.003))]


def bottle() -> Pieces:
    """A bottle of half a litre with a label and a cap."""
    profile = [
        (-0.001, -0.1),
        (0.033, -0.1),
        (0.033, 0.045),
        (0.014, 0.073),
        (0.0125, 0.11),
        (-0.001, 0.11),
    ]
    label = drum("z", -0.06, 0.02, 0.0334, 0.0003)
    return [
        (GLASS, lathe("z", profile, 0.004)),
        (PAPER, label - drum("z", -0.1, 0.1, 0.031, 0.0)),
        (WHITE, drum("z", 0.103, 0.12, 0.014, 0.002)),
    ]


def can() -> Pieces:
    """A drinks can: a lacquered side between two necks of bare metal."""
    side = [(-0.001, -0.05), (0.033, -0.05), (0.033, 0.047), (-0.001, 0.047)]
    ends = [
        (-0.001, -0.0575),
        (0.025, -0.0575),
        (0.0325, -0.049),
        (0.0325, 0.046),
        (0.027, 0.0575),
        (-0.001, 0.0575),
    ]
    lid = drum("z", 0.0545, 0.07, 0.0245, 0.001)
    return [(RED, lathe("z", side, 0.001)), (STEEL, lathe("z", ends, 0.0012) - lid)]


def peg() -> Pieces:
    """A steel peg of 30 mm, chamfered at both ends."""
    profile = [
        (-0.001, -0.05),
        (0.0125, -0.05),
        (0.015, -0.0475),
        (0.015, 0.0475),
        (0.0125, 0.05),
        (-0.001, 0.05),
    ]
    return [(STEEL, lathe("z", profile))]


def hole() -> Pieces:
    """A block with a square hole of 32 mm."""
    block = slab((-0.06, -0.06, -0.03), (0.06, 0.06, 0.03), 0.003)
    return [(IRON, block.cut(slab((-0.016, -0.016, -0.05), (0.016, 0.016, 0.05), 0.0), 0.0015))]


def pallet() -> Pieces:
    """A pallet of 1200 x 800 mm: five boards on three cross boards, nine blocks, three skids."""
    boards = [
        slab((-0.6, y - w / 2, 0.05), (0.6, y + w / 2, 0.072), 0.002)
        for y, w in ((-0.3275, 0.145), (-0.165, 0.1), (0.0, 0.145), (0.165, 0.1), (0.3275, 0.145))
    ]
    across = [
        slab((x - 0.0725, -0.4, 0.028), (x + 0.0725, 0.4, 0.05), 0.002)
        for x in (-0.5275, 0.0, 0.5275)
    ]
    blocks = [
        slab((x - 0.0725, y - w / 2, -0.05), (x + 0.0725, y + w / 2, 0.029), 0.002)
        for x in (-0.5275, 0.0, 0.5275)
        for y, w in ((-0.35, 0.1), (0.0, 0.145), (0.35, 0.1))
    ]
    skids = [
        slab((-0.6, y - w / 2, -0.072), (0.6, y + w / 2, -0.05), 0.002)
        for y, w in ((-0.35, 0.1), (0.0, 0.145), (0.35, 0.1))
    ]
    return [(WOOD, union(*boards, *across, *blocks, *skids))]


def table() -> Pieces:
    """A table of 1.2 x 0.7 m with a beech top on a steel frame."""
    top = slab((-0.6, -0.35, 0.34), (0.6, 0.35, 0.37), 0.008)
    legs = [
        slab((x - 0.025, y - 0.025, -0.37), (x + 0.025, y + 0.025, 0.34), 0.006)
        for x in (-0.55, 0.55)
        for y in (-0.3, 0.3)
    ]
    return [(BEECH, top), (LIGHT_GREY, union(*legs))]


def bin_() -> Pieces:
    """A parts bin of 400 x 300 mm with a rim around its open top."""
    outside = slab((-0.2, -0.15, -0.065), (0.2, 0.15, 0.065), 0.008)
    inside = slab((-0.19, -0.14, -0.055), (0.19, 0.14, 0.2), 0.006)
    return [(BLUE, outside.cut(inside, 0.002))]


def crate() -> Pieces:
    """A wooden crate of 500 x 350 mm, its sides of slats."""
    posts = [
        slab((x - 0.014, y - 0.014, -0.12), (x + 0.014, y + 0.014, 0.12), 0.002)
        for x in (-0.224, 0.224)
        for y in (-0.149, 0.149)
    ]
    slats = []
    for z in (-0.085, 0.0, 0.085):
        for side in (-1, 1):
            y, x = side * 0.169, side * 0.244
            slats.append(slab((-0.25, y - 0.006, z - 0.032), (0.25, y + 0.006, z + 0.032), 0.002))
            slats.append(
                slab((x - 0.006, -0.163, z - 0.032), (x + 0.006, 0.163, z + 0.032), 0.002)
            )
    floor = slab((-0.238, -0.163, -0.12), (0.238, 0.163, -0.108), 0.002)
    return [(WOOD, union(*posts, *slats, floor))]


def pedestal() -> Pieces:
    """A pedestal of 40 cm: a column between a plate and a foot."""
    foot = slab((-0.2, -0.2, -0.2), (0.2, 0.2, -0.17), 0.004)
    top = slab((-0.2, -0.2, 0.17), (0.2, 0.2, 0.2), 0.004)
    column = slab((-0.185, -0.185, -0.18), (0.185, 0.185, 0.18), 0.01)
    return [(IRON, column), (LIGHT_GREY, union(foot, top))]


# How each is meshed: the grid's cell, m, and about how many triangles are left.
OBJECTS: dict[str, tuple[Callable[[], Pieces], float, int]] = {
    "bin": (bin_, 0.0035, 1200),
    "bottle": (bottle, 0.0014, 1500),
    "can": (can, 0.0012, 1200),
    "crate": (crate, 0.004, 1500),
    "cup": (cup, 0.0009, 2000),
    "hole": (hole, 0.002, 600),
    "pallet": (pallet, 0.0075, 1500),
    "pedestal": (pedestal, 0.005, 500),
    "peg": (peg, 0.0008, 1400),
    "table": (table, 0.0075, 900),
}


def make(name: str) -> Path:
    """Write one object's mesh and return its path."""
    describe, cell, triangles = OBJECTS[name]
    pieces = describe()
    meshes = [contour(solid, cell) for _, solid in pieces]
    every = sum(len(mesh.faces) for mesh in meshes)
    path = FOLDER / f"{name}.glb"
    shares = [max(round(triangles * len(mesh.faces) / every), 100) for mesh in meshes]
    glb.write(
        path,
        [
            (material, creased(decimated(mesh, share)))
            for (material, _), mesh, share in zip(pieces, meshes, shares, strict=True)
        ],
    )
    return path


def main() -> None:
    """Make the objects named on the command line, or all."""
    wanted = sys.argv[1:] or list(OBJECTS)
    unknown = sorted(set(wanted) - set(OBJECTS))
    if unknown:
        sys.exit(f"no body is described for {', '.join(unknown)}; known: {', '.join(OBJECTS)}")
    FOLDER.mkdir(exist_ok=True)
    for name in wanted:
        path = make(name)
        print(f"{path.name}: {path.stat().st_size / 1000:.1f} kB")


if __name__ == "__main__":
    main()
