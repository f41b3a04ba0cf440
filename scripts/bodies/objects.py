"""Bodies of the catalogue's objects, each in its own frame: origin at the centre of mass.

The collision shapes are in config/objects.yaml; these are the visual meshes, and a test compares
the two.
"""

from __future__ import annotations

import sys
from collections.abc import Callable, Sequence
from itertools import product
from pathlib import Path

import glb
import numpy as np
from facets import bevelled, joined, moved, screw_head, turned
from materials import (
    BEECH,
    BELT,
    BLACK,
    BLUE,
    CLAY,
    GLASS,
    GLAZE,
    GREY,
    IRON,
    LIGHT_GREY,
    PAPER,
    PORCELAIN,
    RED,
    RUBBER,
    STEEL,
    WHITE,
    WOOD,
    WOOD_DARK,
    YELLOW,
    ZINC,
)
from mesher import contour
from solids import lathe, ring

from mrlab_ros.adapters.robots.packing.surfaces import Material, Mesh, creased, decimated

FOLDER = Path(__file__).resolve().parents[2] / "config" / "objects"
CELL, CUP_TRIANGLES = 0.0009, 1500  # m, of the grid on which the cup is meshed
Pieces = list[tuple[Material, Mesh]]
Place = tuple[float, float, float]
FOOT = [(0.024, 0.0), (0.025, 0.005), (0.02, 0.014), (0.008, 0.018), (0.008, 0.03)]  # that levels
RESTS = [(-0.07, -0.03), (0.04, -0.06), (0.0, 0.03)]  # of a fixture
FIN = [(0.055, 0.0), (0.055, 0.005), (0.047, 0.006), (0.047, 0.0115)]  # one of a motor


def _boxes(edge: float, *corners: tuple[Place, Place]) -> Mesh:
    """Return boxes between two corners each, as one mesh."""
    return joined([bevelled(low, high, edge) for low, high in corners])


def _posts(half: float, low: float, high: float, x: float, y: float) -> list[tuple[Place, Place]]:
    """Return four upright square posts at (+-x, +-y)."""
    return [
        ((i * x - half, j * y - half, low), (i * x + half, j * y + half, high))
        for i, j in product((-1, 1), repeat=2)
    ]


def _screws(size: float, places: Sequence[Place], sides: int = 10) -> Mesh:
    """Return the heads of socket screws that look up."""
    head = turned("z", screw_head(size), sides)
    return joined([moved(head, *place) for place in places])


def cup() -> Pieces:
    """A cup of 80 mm with an unglazed foot, a glazed band, a thin rim and a handle."""
    outside = [
        (-0.001, -0.0385),
        (0.03, -0.0385),
        (0.0376, -0.028),
        (0.0376, 0.04),
        (-0.001, 0.04),
    ]
    inside = [(-0.001, -0.034), (0.028, -0.034), (0.0345, -0.026), (0.0345, 0.06), (-0.001, 0.06)]
    wall = lathe("z", outside, 0.0015) - lathe("z", inside, 0.003)
    ear = ring("y", 0.019, 0.0042).moved(0.041, 0.0, 0.0)
    room = lathe("z", [(-0.001, -0.05), (0.036, -0.05), (0.036, 0.05), (-0.001, 0.05)])
    band = [(0.0376, 0.024), (0.03785, 0.0245), (0.03785, 0.0325), (0.0376, 0.033)]
    foot = [(0.0, -0.04), (0.0275, -0.04), (0.0285, -0.039), (0.0285, -0.0375)]
    body = contour(wall.blend(ear - room, 0.003), CELL)
    return [
        (PORCELAIN, creased(decimated(body, CUP_TRIANGLES))),
        (GLAZE, turned("z", band, 40)),
        (CLAY, turned("z", foot, 32)),
    ]


def bottle() -> Pieces:
    """A bottle of half a litre, of glass with a thick foot, with a label and a ribbed cap."""
    side = [
        (0.0, -0.0965), (0.018, -0.0975), (0.0245, -0.1), (0.029, -0.1), (0.0325, -0.0965),
        (0.033, -0.09), (0.033, 0.042), (0.0315, 0.05), (0.0265, 0.0605), (0.0185, 0.071),
        (0.0145, 0.079), (0.013, 0.09), (0.0128, 0.099), (0.0142, 0.1), (0.0142, 0.103),
        (0.0125, 0.1035),
    ]  # fmt: skip
    label = [(0.033, -0.066), (0.0334, -0.0655), (0.0334, -0.05)]
    upper = [(0.0334, -0.03), (0.0334, 0.0205), (0.033, 0.021)]
    rib = bevelled((-0.0007, 0.0131, 0.1045), (0.0007, 0.01405, 0.1175), 0.0004)
    cap = [
        (0.0136, 0.1035), (0.0138, 0.104), (0.0138, 0.1185), (0.0125, 0.12), (0.0, 0.12),
    ]  # fmt: skip
    stripe = [(0.0334, -0.05), (0.0334, -0.03)]
    return [
        (GLASS, turned("z", side, 32)),
        (PAPER, joined([turned("z", label, 32), turned("z", upper, 32)])),
        (GLAZE, turned("z", stripe, 32)),
        (WHITE, joined([turned("z", cap, 24), *_about(rib, 16)])),
    ]


def _about(mesh: Mesh, count: int) -> list[Mesh]:
    """Return so many copies of a mesh, turned about z."""
    found = []
    for n in range(count):
        c, s = np.cos(2 * np.pi * n / count), np.sin(2 * np.pi * n / count)
        turn = np.array([[c, s, 0], [-s, c, 0], [0, 0, 1]])
        found.append(Mesh(mesh.vertices @ turn, mesh.faces, mesh.normals @ turn))
    return found


def can() -> Pieces:
    """A drinks can: a lacquered side between two necks of bare metal, a lid with its tab."""
    side = [(0.0318, -0.0505), (0.033, -0.049), (0.033, -0.012)]
    upper = [(0.033, 0.018), (0.033, 0.046), (0.0318, 0.0475)]
    band = [(0.033, -0.012), (0.033, 0.018)]
    foot = [
        (0.0, -0.048), (0.021, -0.051), (0.0235, -0.0575), (0.0255, -0.0575), (0.0318, -0.0505),
    ]  # fmt: skip
    lid = [
        (0.0318, 0.0475), (0.0275, 0.0545), (0.0282, 0.0562), (0.0275, 0.0575), (0.0258, 0.057),
        (0.0248, 0.0525), (0.0, 0.0525),
    ]  # fmt: skip
    tab = bevelled((-0.0075, -0.012, 0.0528), (0.0075, 0.01, 0.0545), 0.0006)
    rivet = moved(turned("z", [(0.003, 0.0), (0.003, 0.0025), (0.0, 0.0027)], 12), 0, 0, 0.0528)
    return [
        (RED, joined([turned("z", side, 40), turned("z", upper, 40)])),
        (WHITE, turned("z", band, 40)),
        (STEEL, joined([turned("z", foot, 40), turned("z", lid, 40), tab, rivet])),
    ]


def peg() -> Pieces:
    """A ground peg of 30 mm, chamfered at both ends, with a groove and a centre hole."""
    profile = [
        (0.0, -0.05), (0.0125, -0.05), (0.015, -0.0475), (0.015, 0.0375), (0.0138, 0.038),
        (0.0138, 0.0405), (0.015, 0.041), (0.015, 0.0475), (0.0125, 0.05), (0.004, 0.05),
        (0.003, 0.0485), (0.0, 0.0465),
    ]  # fmt: skip
    return [(STEEL, turned("z", profile, 40))]


def hole() -> Pieces:
    """A blackened block with a square hole of 32 mm, screwed down at its corners."""
    sides = _boxes(
        0.0015,
        ((-0.06, 0.016, -0.03), (0.06, 0.06, 0.03)),
        ((-0.06, -0.06, -0.03), (0.06, -0.016, 0.03)),
        ((0.016, -0.0175, -0.03), (0.06, 0.0175, 0.0298)),
        ((-0.06, -0.0175, -0.03), (-0.016, 0.0175, 0.0298)),
    )
    frame = _boxes(
        0.0008,
        *(((-0.021, y - 0.0025, 0.029), (0.021, y + 0.0025, 0.031)) for y in (-0.0185, 0.0185)),
        *(((x - 0.0025, -0.0185, 0.029), (x + 0.0025, 0.0185, 0.031)) for x in (-0.0185, 0.0185)),
    )
    places = [(x, y, 0.0265) for x, y in product((-0.047, 0.047), repeat=2)]
    return [(IRON, sides), (STEEL, joined([frame, _screws(0.011, places)]))]


def pallet() -> Pieces:
    """A pallet of 1200 x 800 mm: five boards on three cross boards, nine blocks, three skids."""
    boards = [
        ((-0.6, y - w / 2, 0.05), (0.6, y + w / 2, 0.072))
        for y, w in ((-0.3275, 0.145), (-0.165, 0.1), (0.0, 0.145), (0.165, 0.1), (0.3275, 0.145))
    ]
    across = [((x - 0.0725, -0.4, 0.028), (x + 0.0725, 0.4, 0.05)) for x in (-0.5275, 0, 0.5275)]
    blocks = [
        ((x - 0.0725, y - w / 2, -0.05), (x + 0.0725, y + w / 2, 0.028))
        for x in (-0.5275, 0.0, 0.5275)
        for y, w in ((-0.35, 0.1), (0.0, 0.145), (0.35, 0.1))
    ]
    skids = [
        ((-0.6, y - w / 2, -0.072), (0.6, y + w / 2, -0.05))
        for y, w in ((-0.35, 0.1), (0.0, 0.145), (0.35, 0.1))
    ]
    nails = [
        (x + dx, y + dy, 0.0718)
        for x in (-0.5275, 0.0, 0.5275)
        for y in (-0.3275, 0.0, 0.3275)
        for dx, dy in ((-0.035, -0.03), (0.035, 0.03))
    ]
    nail = turned("z", [(0.0045, 0.0), (0.0032, 0.0009), (0.0, 0.001)], 8)
    return [
        (WOOD, _boxes(0.003, *boards[::2], *skids)),
        (WOOD_DARK, _boxes(0.003, *boards[1::2], *across)),
        (BEECH, _boxes(0.003, *blocks)),
        (ZINC, joined([moved(nail, *place) for place in nails])),
    ]


def table() -> Pieces:
    """A table of 1.2 x 0.7 m: a beech top with a dark edge on a steel frame on feet."""
    rails = [
        *(((-0.53, y - 0.012, 0.28), (0.53, y + 0.012, 0.335)) for y in (-0.3, 0.3)),
        *(((x - 0.012, -0.28, 0.28), (x + 0.012, 0.28, 0.335)) for x in (-0.55, 0.55)),
        *(((x - 0.012, -0.28, -0.25), (x + 0.012, 0.28, -0.22)) for x in (-0.55, 0.55)),
        ((-0.55, -0.012, -0.248), (0.55, 0.012, -0.222)),
    ]
    feet = [(x, y, 0.0) for x, y in product((-0.55, 0.55), (-0.3, 0.3))]
    return [
        (BEECH, _boxes(0.0025, ((-0.6, -0.35, 0.345), (0.6, 0.35, 0.37)))),
        (BLACK, _boxes(0.001, ((-0.597, -0.347, 0.34), (0.597, 0.347, 0.3455)))),
        (GREY, _boxes(0.004, *_posts(0.025, -0.345, 0.34, 0.55, 0.3), *rails)),
        (RUBBER, joined([moved(turned("z", FOOT, 20), x, y, -0.37) for x, y, _ in feet])),
    ]


def bin_() -> Pieces:
    """A parts bin of 400 x 300 mm: ribbed walls, a rim that stacks, grips and a label's frame."""
    walls = [
        ((-0.193, -0.143, -0.065), (0.193, 0.143, -0.055)),
        *(((-0.194, s * 0.144, -0.06), (0.194, s * 0.137, 0.064)) for s in (-1, 1)),
        *(((s * 0.194, -0.144, -0.06), (s * 0.187, 0.144, 0.064)) for s in (-1, 1)),
    ]
    rim = [
        *(((-0.2, s * 0.15, 0.048), (0.2, s * 0.137, 0.065)) for s in (-1, 1)),
        *(((s * 0.2, -0.15, 0.048), (s * 0.187, 0.15, 0.065)) for s in (-1, 1)),
    ]
    ribs = [
        *(
            ((x - 0.003, s * 0.1425, -0.058), (x + 0.003, s * 0.1492, 0.05))
            for s in (-1, 1)
            for x in (-0.19, -0.13, -0.065, 0.065, 0.13, 0.19)
        ),
        *(
            ((s * 0.1925, y - 0.003, -0.058), (s * 0.1992, y + 0.003, 0.05))
            for s in (-1, 1)
            for y in (-0.14, -0.075, 0.075, 0.14)
        ),
        *(((-0.199, s * 0.1425, -0.048), (0.199, s * 0.149, -0.041)) for s in (-1, 1)),
        *(((s * 0.1925, -0.149, -0.048), (s * 0.199, 0.149, -0.041)) for s in (-1, 1)),
    ]
    grips = [((s * 0.193, -0.05, 0.02), (s * 0.1998, 0.05, 0.034)) for s in (-1, 1)]
    card = ((-0.045, -0.1449, -0.03), (0.045, -0.1435, 0.03))
    return [
        (BLUE, _boxes(0.0012, *walls, *rim, *ribs)),
        (BLACK, _boxes(0.002, *grips)),
        (PAPER, _boxes(0.0005, card)),
    ]


def crate() -> Pieces:
    """A wooden crate of 500 x 350 mm: sides of slats, screwed to posts in the corners."""
    posts = _posts(0.014, -0.12, 0.119, 0.224, 0.149)
    long, short, heads = [], [], []
    dome = [(0.0045, 0.0), (0.003, 0.0011), (0.0, 0.0012)]
    screws = {axis: turned(axis, dome, 7) for axis in "xy"}
    back = {axis: turned(axis, [(r, -h) for r, h in dome[::-1]], 7) for axis in "xy"}
    for z in (-0.085, 0.0, 0.085):
        for side in (-1, 1):
            y, x = side * 0.169, side * 0.244
            low, high = z - 0.032, min(z + 0.032, 0.12)
            long.append(((-0.25, y - 0.006, low), (0.25, y + 0.006, high)))
            short.append(((x - 0.006, -0.163, low), (x + 0.006, 0.163, high)))
            face = screws if side > 0 else back
            for dz in (-0.016, 0.016):
                heads += [moved(face["y"], e * 0.224, side * 0.1748, z + dz) for e in (-1, 1)]
                heads += [moved(face["x"], side * 0.2498, e * 0.149, z + dz) for e in (-1, 1)]
    floor = [((-0.238, y - 0.052, -0.12), (0.238, y + 0.052, -0.108)) for y in (-0.11, 0.0, 0.11)]
    return [
        (WOOD, _boxes(0.002, *long, *floor)),
        (WOOD_DARK, _boxes(0.002, *short, *posts)),
        (ZINC, joined(heads)),
    ]


def pedestal() -> Pieces:
    """A pedestal of 40 cm: a column with a door between a drilled plate and a bolted foot."""
    foot = ((-0.2, -0.2, -0.2), (0.2, 0.2, -0.18))
    top = ((-0.2, -0.2, 0.18), (0.2, 0.2, 0.2))
    column = ((-0.16, -0.16, -0.18), (0.16, 0.16, 0.18))
    stiff = [
        *(
            ((x - 0.005, s * 0.155, -0.18), (x + 0.005, s * 0.19, 0.18))
            for s in (-1, 1)
            for x in (-0.1, 0.1)
        ),
        *(
            ((s * 0.155, y - 0.005, -0.18), (s * 0.19, y + 0.005, 0.18))
            for s in (-1, 1)
            for y in (-0.1, 0.1)
        ),
    ]
    door = ((-0.075, -0.163, -0.13), (0.075, -0.158, 0.13))
    anchors = [(x, y, -0.18) for x, y in product((-0.18, 0.18), repeat=2)]
    holes = [(x, y, 0.1995) for x, y in product((-0.15, -0.05, 0.05, 0.15), repeat=2)]
    hole_ = turned("z", [(0.0075, 0.0), (0.006, 0.0006), (0.0, 0.0006)], 12)
    nut = turned(
        "z",
        [
            (0.014, 0.0),
            (0.014, 0.009),
            (0.009, 0.011),
            (0.007, 0.011),
            (0.007, 0.016),
            (0.0, 0.017),
        ],
        6,
    )
    return [
        (GREY, _boxes(0.004, column, *stiff)),
        (YELLOW, _boxes(0.003, door)),
        (LIGHT_GREY, _boxes(0.003, foot, top)),
        (ZINC, joined([moved(nut, *place) for place in anchors])),
        (BLACK, joined([moved(hole_, *place) for place in holes])),
    ]


def fixture() -> Pieces:
    """A fixture of 300 x 200 mm: a drilled plate with stops, rests and a lever clamp."""
    plate = ((-0.15, -0.1, -0.02), (0.15, 0.1, 0.0))
    stops = [
        ((-0.12, 0.06, 0.0), (0.12, 0.08, 0.05)),
        ((-0.14, -0.06, 0.0), (-0.12, 0.04, 0.05)),
    ]
    tower = ((0.09, -0.02, 0.0), (0.13, 0.02, 0.06))
    arm = ((0.035, -0.008, 0.06), (0.12, 0.008, 0.074))
    handle = ((0.105, -0.009, 0.066), (0.128, 0.009, 0.14))
    pad = [
        (0.008, -0.02),
        (0.01, -0.018),
        (0.01, -0.012),
        (0.004, -0.01),
        (0.004, 0.01),
        (0.008, 0.01),
        (0.008, 0.017),
        (0.0, 0.018),
    ]
    rest = [(0.013, 0.0), (0.013, 0.004), (0.0115, 0.0055), (0.0, 0.0055)]
    grid = [
        (x, y, -0.0006)
        for x in (-0.13, -0.08, -0.03, 0.02, 0.07, 0.12)
        for y in (-0.085, -0.045, -0.005, 0.035)
        if not (x < -0.11 and y > -0.07) and not (x > 0.08 and abs(y) < 0.03)
    ]
    bore = turned("z", [(0.006, 0.0), (0.0, 0.0009)], 10)
    heads = [(x, 0.07, 0.0492) for x in (-0.09, 0.0, 0.09)] + [
        (-0.13, y, 0.0492) for y in (-0.04, 0.02)
    ]
    return [
        (LIGHT_GREY, _boxes(0.0015, plate)),
        (IRON, _boxes(0.0015, *stops, tower)),
        (ZINC, _boxes(0.002, arm)),
        (RED, _boxes(0.007, handle)),
        (RUBBER, moved(turned("z", pad, 16), 0.045, 0.0, 0.067)),
        (STEEL, joined([
            *(moved(turned("z", rest, 20), *place, 0.0) for place in RESTS),
            _screws(0.009, heads),
        ])),
        (BLACK, joined([moved(bore, *place) for place in grid])),
    ]  # fmt: skip


def conveyor() -> Pieces:
    """A piece of belt conveyor with its drive, 1.2 x 0.4 m and 0.75 m high, that stands still."""
    h, end = 0.375, 0.57
    drive = [(0.0, -0.15), (0.03, -0.15), (0.03, 0.15), (0.0, 0.15)]
    drums = [moved(turned("y", drive, 14), x, 0.0, h - 0.03) for x in (-end, end)]
    belt = _boxes(
        0.001,
        ((-end, -0.15, h - 0.03), (end, 0.15, h)),
        ((-end, -0.15, h - 0.06), (end, 0.15, h - 0.057)),
    )
    sides = [((-0.6, s * 0.155, h - 0.075), (0.6, s * 0.2, h - 0.005)) for s in (-1, 1)]
    slots = [
        ((-0.59, s * 0.1985, h - 0.06 + dz), (0.59, s * 0.2003, h - 0.052 + dz))
        for s in (-1, 1)
        for dz in (0.0, 0.032)
    ]
    rails = [
        *(((x - 0.015, -0.16, -0.2), (x + 0.015, 0.16, -0.17)) for x in (-0.45, 0.45)),
        ((-0.45, -0.015, -0.198), (0.45, 0.015, -0.172)),
    ]
    feet = [(x, y, 0.0) for x, y in product((-0.45, 0.45), (-0.175, 0.175))]
    fins = [(r, 0.025 * n + dy) for n in range(4) for r, dy in FIN]
    housing = turned("y", [(0.0, 0.0), *fins, (0.05, 0.11), (0.05, 0.135), (0.0, 0.135)], 18)
    gear = bevelled((0.36, 0.035, h - 0.21), (0.48, 0.12, h - 0.075), 0.008)
    cap = bevelled((-0.018, -0.2, -0.018), (0.018, 0.2, 0.018), 0.006)
    caps = [moved(cap, x, 0.0, h - 0.036) for x in (-end, end)]
    return [
        (BELT, joined([belt, *drums])),
        (LIGHT_GREY, _boxes(0.003, *sides, *_posts(0.02, -0.36, h - 0.07, 0.45, 0.175), *rails)),
        (BLACK, joined([_boxes(0.0005, *slots), moved(housing, 0.42, -0.1, h - 0.15), *caps])),
        (YELLOW, gear),
        (RUBBER, joined([moved(turned("z", FOOT, 12), x, y, -h) for x, y, _ in feet])),
    ]


OBJECTS: dict[str, Callable[[], Pieces]] = {
    "bin": bin_,
    "bottle": bottle,
    "can": can,
    "conveyor": conveyor,
    "crate": crate,
    "cup": cup,
    "fixture": fixture,
    "hole": hole,
    "pallet": pallet,
    "pedestal": pedestal,
    "peg": peg,
    "table": table,
}


def make(name: str) -> Path:
    """Write one object's mesh and return its path."""
    path = FOLDER / f"{name}.glb"
    glb.write(path, OBJECTS[name]())
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
