"""KUKA's arms as tables: materials of the measured castings, and the parts on top.

Boxes are mm in the link's frame; robots/<id>/robot.yaml names where the frames come from, and
scripts/bodies/sections/<id>.json where the outlines do.
"""

from __future__ import annotations

from body import Part, bolts
from materials import BLACK, GREY, LIGHT_GREY, ORANGE, RUBBER, STEEL, WHITE
from measured import Link, Region

from mrlab_ros.adapters.robots.packing.surfaces import Material

ALL = 5000.0


def _flange(face: float, circle: float, count: int, screw: float, axis: str = "z") -> Link:
    """The last link: steel, with the heads of its screws sunk half into the face at `face`."""
    return Link(STEEL, (), (Part(BLACK, bolts(axis, face, circle, count, screw)),))


def _small(skin: Material, base: Link, flange: Link) -> dict[str, Link]:
    return {
        "base_link": base,
        **{f"link_{n}": Link(skin) for n in range(1, 6)},
        "link_6": flange,
    }


def _cybertech(plugs: float) -> dict[str, Link]:
    return {
        "base_link": Link(BLACK, (Region(LIGHT_GREY, (-ALL, -120, 5), (-plugs, 0, 230)),)),
        "link_1": Link(
            ORANGE,
            (
                Region(BLACK, (-ALL, -ALL, -ALL), (120, -98, -30)),
                Region(BLACK, (-ALL, -98, -ALL), (-28, 110, -92)),
                Region(BLACK, (-ALL, -98, -ALL), (2, 110, -205)),
                Region(RUBBER, (-ALL, 110, -230), (ALL, ALL, -10)),
            ),
        ),
        "link_2": Link(ORANGE, (Region(BLACK, (-ALL, -ALL, -ALL), (ALL, ALL, -257)),)),
        "link_3": Link(ORANGE, (Region(BLACK, (-ALL, -ALL, -ALL), (-150, ALL, ALL)),)),
        "link_4": Link(ORANGE, (Region(BLACK, (-ALL, -ALL, 117), (ALL, ALL, ALL)),)),
        "link_5": Link(ORANGE),
        "link_6": _flange(0.0, 0.025, 7, 0.003),
    }


def _kr120() -> dict[str, Link]:
    return {
        "base_link": Link(BLACK),
        "link_1": Link(
            ORANGE,
            (
                Region(BLACK, (250, 50, -106), (470, ALL, 106)),
                Region(BLACK, (-320, -103, -160), (-60, 103, 100)),
            ),
        ),
        "link_2": Link(ORANGE),
        "link_3": Link(
            ORANGE,
            (
                Region(BLACK, (-ALL, -ALL, -ALL), (-200, ALL, ALL)),
                Region(BLACK, (-120, 128, -ALL), (120, ALL, ALL)),
                Region(BLACK, (760, -ALL, -ALL), (ALL, ALL, ALL)),
            ),
        ),
        "link_4": Link(ORANGE),
        "link_5": Link(ORANGE),
        "link_6": _flange(0.215, 0.0625, 11, 0.005, "x"),
    }


def _quantec(flange: Link) -> dict[str, Link]:
    return {
        "base_link": Link(BLACK, (Region(LIGHT_GREY, (-ALL, -ALL, 40), (-480, ALL, ALL)),)),
        "link_1": Link(
            ORANGE,
            (
                Region(BLACK, (210, -ALL, -560), (450, -205, -310)),
                Region(BLACK, (-460, -85, -ALL), (-200, 185, -330)),
                Region(RUBBER, (-ALL, 195, -ALL), (200, ALL, 20)),
            ),
        ),
        "link_2": Link(ORANGE),
        "link_3": Link(
            ORANGE,
            (
                Region(BLACK, (-ALL, -ALL, -ALL), (-215, ALL, ALL)),
                Region(BLACK, (-100, -100, -ALL), (100, 100, 50)),
                Region(BLACK, (864, -ALL, -ALL), (ALL, ALL, ALL)),
            ),
        ),
        "link_4": Link(ORANGE),
        "link_5": Link(ORANGE),
        "link_6": flange,
    }


def _iontec() -> dict[str, Link]:
    return {
        "base_link": Link(BLACK, (Region(LIGHT_GREY, (-ALL, -170, 12), (-345, 170, ALL)),)),
        "link_1": Link(
            ORANGE,
            (
                Region(BLACK, (-ALL, -ALL, -ALL), (ALL, -165, -250)),
                Region(BLACK, (-ALL, -ALL, -ALL), (-95, ALL, -225)),
                Region(RUBBER, (-ALL, 170, -ALL), (ALL, ALL, -130)),
            ),
        ),
        "link_2": Link(ORANGE),
        "link_3": Link(ORANGE, (Region(BLACK, (-ALL, -ALL, -ALL), (ALL, ALL, -12)),)),
        "link_4": Link(ORANGE, (Region(BLACK, (-ALL, -ALL, -30), (ALL, ALL, ALL)),)),
        "link_5": Link(ORANGE),
        "link_6": _flange(-0.036, 0.05, 11, 0.0048),
    }


def _fortec() -> dict[str, Link]:
    return {
        "base_link": Link(BLACK, (Region(LIGHT_GREY, (-ALL, -ALL, 390), (-340, ALL, ALL)),)),
        "link_1": Link(ORANGE, (Region(RUBBER, (215, 262, -ALL), (ALL, ALL, ALL)),)),
        "link_2": Link(ORANGE),
        "link_3": Link(
            ORANGE,
            (
                Region(BLACK, (-ALL, -ALL, -ALL), (ALL, -295, ALL)),
                Region(BLACK, (-ALL, 549, -ALL), (ALL, ALL, ALL)),
            ),
        ),
        "link_4": Link(ORANGE),
        "link_5": Link(ORANGE),
        "link_6": _flange(-0.305, 0.1, 11, 0.007),
    }


def _iisy() -> dict[str, Link]:
    return {
        "base_link": Link(WHITE, (Region(BLACK, (-ALL, -ALL, -ALL), (-165, ALL, ALL)),)),
        "link_1": Link(WHITE, (Region(BLACK, (-ALL, -ALL, -186), (ALL, ALL, ALL)),)),
        "link_2": Link(WHITE, (Region(BLACK, (-ALL, -ALL, -106), (ALL, ALL, ALL)),)),
        "link_3": Link(WHITE, (Region(BLACK, (-ALL, -ALL, -ALL), (ALL, ALL, -108)),)),
        "link_4": Link(WHITE, (Region(BLACK, (-ALL, -ALL, -120), (ALL, ALL, ALL)),)),
        "link_5": Link(WHITE),
        "link_6": Link(
            WHITE,
            (
                Region(BLACK, (-ALL, 66, -122), (ALL, ALL, ALL)),
                Region(STEEL, (-ALL, -ALL, -ALL), (ALL, 62, -166)),
            ),
            (Part(BLACK, bolts("z", -0.178, 0.025, 7, 0.0033)),),
        ),
    }


ROBOTS: dict[str, dict[str, Link]] = {
    "kuka_lbr_iisy15_r930": _iisy(),
    "kuka_kr3_r540": _small(WHITE, Link(GREY), _flange(0.0, 0.02, 6, 0.0025, "x")),
    "kuka_kr6_r900_sixx": _small(ORANGE, Link(BLACK), _flange(0.0, 0.0145, 4, 0.0022, "x")),
    "kuka_kr10_r900_2": _small(
        WHITE,
        Link(BLACK, (Region(LIGHT_GREY, (-ALL, -68, 31), (-198, 68, 162)),)),
        _flange(-0.0285, 0.0157, 7, 0.0022),
    ),
    "kuka_kr16_r1610_2": _cybertech(265),
    "kuka_kr120_r2500_pro": _kr120(),
    "kuka_kr150_r2700_2": _quantec(_flange(-0.0485, 0.0625, 11, 0.005)),
    "kuka_kr300_r2700_2": _quantec(_flange(-0.0705, 0.08, 11, 0.0065)),
    "kuka_kr50_r2100": _iontec(),
    "kuka_kr70_r2100": _iontec(),
    "kuka_kr560_r3100_2": _fortec(),
    "kuka_kr20_r1810_2": _cybertech(265),
}
