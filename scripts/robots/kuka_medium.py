"""Bodies of KUKA's CYBERTECH (KR 16 R1610-2, KR 20 R1810-2) and IONTEC (KR 50, KR 70 R2100).

Sizes: robots/<id>/robot.yaml names the descriptions they were measured on.
"""

from __future__ import annotations

from body import (
    BLACK,
    GREY,
    LIGHT_GREY,
    ORANGE,
    RUBBER,
    STEEL,
    Body,
    bolts,
    cap,
    cone,
    curve,
    drum,
    hose,
    motor,
    slab,
)
from solids import block, disc, plate, rod, strap


def kr16_r1610_2() -> Body:
    """KR 16 R1610-2."""
    return _cybertech(wrist=1.595, sleeve=1.235, rear=0.685)


def kr20_r1810_2() -> Body:
    """KR 20 R1810-2: as the KR 16 R1610-2 with a forearm that is 205 mm longer."""
    return _cybertech(wrist=1.8, sleeve=1.235, rear=0.705)


def _cybertech(wrist: float, sleeve: float, rear: float) -> Body:
    body = Body()
    a, height, elbow, z4 = 0.16, 0.52, 0.94, 0.67
    column = cone("z", 0.0, 0.253, (0.186, 0.158), 0.012)
    back = plate(
        "y", [(-0.36, 0.02), (0, 0.02), (0, 0.25), (-0.2, 0.25), (-0.36, 0.13)], 0.22, 0.018, 0.02
    )
    foot = drum("z", 0.0, 0.032, 0.188, 0.004)
    for angle in (30, 90, 150, 210, 270, 330):
        foot = foot - disc("z", 0.011, 1).moved(0.168, 0, 0).turned("z", angle)
        foot = foot | block((0.05, 0.07, 0.03), 0.006).moved(0.163, 0, 0.015).turned(
            "z", angle + 30
        )
    body.add("base_link", BLACK, (column.blend(back, 0.03)).blend(foot, 0.012))
    panel = slab((-0.372, -0.095, 0.03), (-0.35, 0.095, 0.125), 0.004)
    body.add("base_link", LIGHT_GREY, panel)
    for y, radius in ((-0.055, 0.026), (0.01, 0.02), (0.06, 0.015)):
        plug = drum("x", -0.4, -0.36, radius, 0.003).moved(0, y, 0.078)
        body.add("base_link", BLACK, plug)
    body.add("base_link", STEEL, bolts("z", 0.034, 0.168, 6, 0.009).turned("z", 60))

    table = cone("z", 0.258, 0.33, (0.186, 0.19), 0.014)
    tower = plate(
        "y",
        [
            (-0.12, 0.31),
            (0.29, 0.31),
            (0.295, 0.52),
            (0.24, 0.62),
            (0.13, 0.655),
            (0.03, 0.58),
            (-0.11, 0.42),
        ],
        0.14,
        0.02,
        0.035,
    ).moved(0, -0.005, 0)
    gear = drum("y", -0.079, 0.085, 0.138, 0.014).moved(a, 0, height)
    body.add("link_1", ORANGE, table.blend(tower, 0.04).blend(gear, 0.03))
    body.add("link_1", BLACK, motor("y", 0.07, 0.31, 0.083).moved(a, 0, height))
    first = motor("z", 0.32, 0.69, 0.078).moved(-0.075, 0.085, 0)
    body.add("link_1", BLACK, first)
    body.add("link_1", ORANGE, drum("z", 0.315, 0.36, 0.092, 0.01).moved(-0.075, 0.085, 0))
    box = slab((-0.155, 0.03, 0.6), (-0.1, 0.14, 0.68), 0.01)
    body.add("link_1", BLACK, box)
    way = curve([(-0.15, -0.06, 0.3), (-0.1, -0.17, 0.37), (0.02, -0.25, 0.42), (a, -0.3, 0.5)], 5)
    body.add("link_1", RUBBER, hose(way, 0.026))
    body.add("link_1", BLACK, slab((0.0, -0.19, 0.31), (0.16, -0.09, 0.36), 0.012))

    # link_2: a slim aluminium casting on the right, ribbed inside, turned at both ends.
    y = -0.185
    low = drum("y", -0.225, -0.0825, 0.136, 0.014).moved(a, 0, height)
    high = drum("y", -0.225, -0.1, 0.0985, 0.012).moved(elbow, 0, height)
    web = strap("y", (a + 0.06, 0), (elbow - 0.02, 0), (0.105, 0.078), 0.1, 0.022).moved(
        0, y, height
    )
    pocket = strap("y", (a + 0.17, 0), (elbow - 0.17, 0), (0.058, 0.043), 0.06, 0.012)
    link_2 = low.blend(web, 0.045).blend(high, 0.04)
    link_2 = link_2.cut(pocket.moved(0, y - 0.062, height), 0.008)
    for x in (0.41, 0.56, 0.7):
        rib = block((0.014, 0.05, 0.11), 0.004).moved(x, y - 0.022, height)
        link_2 = link_2.blend(rib, 0.006)
    body.add("link_2", ORANGE, link_2)
    body.add("link_2", BLACK, cap("y", -0.2265, -1, 0.085, 0.005).moved(a, 0, height))
    body.add("link_2", BLACK, bolts("y", -0.2265, 0.112, 12, 0.007).moved(a, 0, height))
    body.add("link_2", BLACK, cap("y", -0.2265, -1, 0.066, 0.005).moved(elbow, 0, height))
    way = curve(
        [
            (a, -0.3, 0.53),
            (a + 0.13, -0.31, 0.59),
            (0.5, -0.29, 0.58),
            (0.75, -0.29, 0.58),
            (0.9, -0.31, 0.58),
        ],
        5,
    )
    body.add("link_2", RUBBER, hose(way, 0.024))
    for x in (0.36, 0.72):
        clamp = slab((x - 0.02, -0.318, 0.545), (x + 0.02, -0.215, 0.615), 0.008)
        body.add("link_2", BLACK, clamp)

    # link_3: elbow, gear of axis 3 on the inside, three wrist motors in line at the back.
    knee = drum("y", -0.0985, 0.1, 0.128, 0.02).moved(elbow, 0, height + 0.012)
    trunk = plate(
        "y",
        [
            (0.83, 0.54),
            (0.9, 0.44),
            (1.0, 0.43),
            (1.12, 0.56),
            (1.24, 0.585),
            (1.24, 0.755),
            (1.1, 0.775),
            (0.85, 0.775),
            (0.82, 0.72),
        ],
        0.205,
        0.035,
        0.03,
    )
    shank = cone("x", 1.0, sleeve, (0.11, 0.086), 0.012).moved(0, 0, z4)
    body.add("link_3", ORANGE, knee.blend(trunk, 0.03).blend(shank, 0.03))
    for dy, dz in ((-0.062, -0.02), (0.062, -0.02), (0.0, 0.056)):
        start = motor("x", 0.845, rear, 0.053).moved(0, dy, z4 + dz)
        body.add("link_3", BLACK, start)
    body.add("link_3", BLACK, motor("y", 0.085, 0.272, 0.075).moved(elbow, 0, height + 0.03))
    body.add("link_3", RUBBER, drum("x", sleeve - 0.006, sleeve + 0.005, 0.072, 0).moved(0, 0, z4))
    rail = slab((0.86, 0.03, 0.772), (1.13, 0.12, 0.792), 0.006)
    body.add("link_3", BLACK, rail)
    way = curve(
        [
            (0.9, -0.3, 0.59),
            (0.9, -0.24, 0.74),
            (0.96, -0.05, 0.815),
            (1.08, 0.06, 0.818),
            (1.22, 0.07, 0.8),
            (sleeve + 0.12, 0.055, 0.775),
        ],
        5,
    )
    body.add("link_3", RUBBER, hose(way, 0.026))

    tube = cone("x", sleeve + 0.005, wrist - 0.12, (0.0685, 0.058), 0.01).moved(0, 0, z4)
    collar = drum("x", sleeve + 0.005, sleeve + 0.06, 0.069, 0.008).moved(0, 0, z4)
    cheek = strap("y", (wrist - 0.13, 0), (wrist, 0), (0.056, 0.0575), 0.05, 0.012)
    fork = cheek.moved(0, 0.0645, z4)
    bridge = drum("x", wrist - 0.165, wrist - 0.085, 0.062, 0.02).moved(0, 0.012, z4)
    room = drum("y", -0.3, 0.038, 0.072, 0.0).moved(wrist, 0, z4)
    arm = tube.blend(collar, 0.02).blend(bridge, 0.025).blend(fork, 0.025)
    right = strap("y", (wrist - 0.12, 0), (wrist - 0.02, 0), (0.05, 0.02), 0.01, 0.003)
    body.add("link_4", ORANGE, arm.cut(room, 0.006))
    body.add("link_4", BLACK, right.moved(-0.07, -0.06, z4))
    body.add("link_4", BLACK, cap("y", 0.0895, 1, 0.04, 0.004).moved(wrist, 0, z4))

    hub = drum("y", -0.045, 0.0375, 0.057, 0.012).moved(wrist, 0, z4)
    side = strap("y", (wrist, 0), (wrist + 0.1, 0), (0.052, 0.036), 0.04, 0.014).moved(
        0, -0.065, z4
    )
    nose = cone("x", wrist, wrist + 0.144, (0.05, 0.044), 0.01).moved(0, 0, z4)
    body.add("link_5", ORANGE, hub.blend(nose, 0.02).blend(side, 0.02))
    tip = wrist + 0.153
    flange = drum("x", tip - 0.0095, tip, 0.0335, 0.0015) - drum("x", tip - 0.006, tip + 1, 0.016)
    body.add("link_6", STEEL, flange.moved(0, 0, z4))
    body.add("link_6", BLACK, bolts("x", tip, 0.025, 7, 0.003).moved(0, 0, z4))
    return body


def kr50_r2100() -> Body:
    """KR 50 R2100."""
    return _iontec(0.107)


def kr70_r2100() -> Body:
    """KR 70 R2100: as the KR 50 R2100 with a larger motor on axis 2."""
    return _iontec(0.116)


def _iontec(second_motor: float) -> Body:
    body = Body()
    a, height, elbow, z4, wrist, tip = 0.175, 0.575, 1.065, 0.625, 2.1, 2.285
    ring = cone("z", 0.0, 0.166, (0.2, 0.21), 0.012)
    back = plate(
        "y",
        [
            (-0.36, 0.0),
            (0, 0),
            (0, 0.15),
            (-0.2, 0.17),
            (-0.23, 0.252),
            (-0.34, 0.252),
            (-0.36, 0.23),
        ],
        0.306,
        0.016,
        0.015,
    )
    foot = plate(
        "z",
        [
            (-0.33, -0.2),
            (-0.2, -0.24),
            (0.19, -0.24),
            (0.24, -0.19),
            (0.24, 0.19),
            (0.19, 0.24),
            (-0.2, 0.24),
            (-0.33, 0.2),
        ],
        0.036,
        0.004,
        0.02,
    ).moved(0, 0, 0.018)
    for x, y in ((0.19, 0.17), (0.19, -0.17), (-0.17, 0.205), (-0.17, -0.205)):
        foot = foot - disc("z", 0.013, 1).moved(x, y, 0)
        lug = drum("z", 0.0, 0.1, 0.04, 0.012).moved(x * 0.85, y * 0.85, 0)
        foot = foot.blend(lug, 0.02)
    body.add("base_link", BLACK, ring.blend(back, 0.03).blend(foot, 0.02))
    panel = slab((-0.372, -0.12, 0.04), (-0.35, 0.12, 0.22), 0.005)
    body.add("base_link", LIGHT_GREY, panel)
    for y, z, radius in ((-0.07, 0.15, 0.032), (0.0, 0.09, 0.022), (0.06, 0.155, 0.026)):
        plug = drum("x", -0.42, -0.36, radius, 0.004).moved(0, y, z)
        body.add("base_link", BLACK, plug)

    table = cone("z", 0.17, 0.3, (0.232, 0.215), 0.016)
    tower = plate(
        "y",
        [
            (-0.13, 0.26),
            (0.3, 0.26),
            (0.345, 0.56),
            (0.3, 0.68),
            (0.18, 0.74),
            (0.06, 0.7),
            (-0.1, 0.5),
        ],
        0.25,
        0.04,
        0.06,
    ).moved(0, 0.02, 0)
    gear = drum("y", -0.115, 0.12, 0.174, 0.02).moved(a, 0, height)
    link_1 = table.blend(tower, 0.06).blend(gear, 0.04)
    seat = drum("z", 0.24, 0.42, 0.115, 0.02).moved(-0.165, 0.015, 0)
    body.add("link_1", ORANGE, link_1.blend(seat, 0.04))
    body.add("link_1", BLACK, motor("z", 0.41, 0.69, 0.098).moved(-0.17, 0.015, 0))
    body.add(
        "link_1", BLACK, motor("y", 0.13, 0.375, second_motor).moved(a - 0.06, 0, height + 0.04)
    )
    body.add("link_1", BLACK, slab((-0.25, -0.11, 0.28), (-0.1, -0.19, 0.40), 0.02))
    way = curve(
        [(-0.18, -0.16, 0.38), (-0.06, -0.22, 0.5), (0.06, -0.25, 0.62), (a, -0.27, 0.68)], 5
    )
    body.add("link_1", RUBBER, hose(way, 0.03))

    y = -0.215
    low = drum("y", -0.262, -0.1165, 0.1425, 0.018).moved(a, 0, height)
    web = plate(
        "y",
        [
            (a - 0.02, -0.1),
            (0.42, -0.118),
            (0.98, -0.082),
            (1.1, -0.075),
            (1.1, 0.082),
            (0.95, 0.094),
            (0.4, 0.122),
            (a - 0.02, 0.11),
        ],
        0.135,
        0.035,
        0.05,
    ).moved(0, -0.243, height)
    high = drum("y", -0.3, -0.17, 0.107, 0.016).moved(elbow, 0, height)
    link_2 = low.blend(web, 0.045).blend(high, 0.035)
    pocket = strap("y", (0.47, 0), (0.85, 0), (0.066, 0.05), 0.05, 0.014).moved(0, -0.31, height)
    body.add("link_2", ORANGE, link_2.cut(pocket, 0.014))
    body.add("link_2", BLACK, cap("y", -0.2635, -1, 0.075, 0.006).moved(a - 0.02, 0, height))
    body.add("link_2", BLACK, cap("y", -0.3, -1, 0.072, 0.006).moved(elbow, 0, height))
    body.add("link_2", BLACK, bolts("y", -0.3015, 0.089, 10, 0.008).moved(elbow, 0, height))
    way = curve(
        [
            (a + 0.02, -0.3, 0.7),
            (0.36, -0.34, 0.73),
            (0.65, -0.33, 0.715),
            (0.9, -0.33, 0.7),
            (1.02, -0.32, 0.7),
        ],
        5,
    )
    body.add("link_2", RUBBER, hose(way, 0.028))
    for x in (0.42, 0.86):
        clamp = slab((x - 0.024, -0.33, 0.655), (x + 0.024, -0.27, 0.735), 0.01)
        body.add("link_2", BLACK, clamp)

    knee = drum("y", -0.168, 0.13, 0.138, 0.025).moved(elbow, 0, height)
    trunk = plate(
        "y",
        [
            (0.95, 0.5),
            (1.02, 0.44),
            (1.12, 0.44),
            (1.22, 0.53),
            (1.36, 0.545),
            (1.36, 0.71),
            (1.15, 0.735),
            (0.95, 0.73),
        ],
        0.21,
        0.04,
        0.03,
    )
    sleeve = drum("x", 1.2, 1.384, 0.1, 0.014).moved(0, 0, z4)
    body.add("link_3", ORANGE, knee.blend(trunk, 0.04).blend(sleeve, 0.03))
    body.add("link_3", BLACK, motor("y", 0.12, 0.245, 0.1).moved(elbow, 0, height))
    for dy, dz in ((-0.058, 0.03), (0.058, 0.03), (0.0, -0.07)):
        body.add("link_3", BLACK, motor("x", 0.985, 0.866, 0.06).moved(0, dy, z4 + dz))
    body.add("link_3", RUBBER, drum("x", 1.382, 1.394, 0.088, 0).moved(0, 0, z4))
    way = curve(
        [(1.02, -0.32, 0.71), (1.12, -0.27, 0.75), (1.22, -0.14, 0.75), (1.34, -0.06, 0.735)], 5
    )
    body.add("link_3", RUBBER, hose(way, 0.028))

    _medium_wrist(body, 1.392, wrist, tip, z4)
    return body


def _medium_wrist(body: Body, start: float, wrist: float, tip: float, z: float) -> None:
    tube = cone("x", start, wrist - 0.13, (0.0925, 0.076), 0.012).moved(0, 0, z)
    cheek = strap("y", (wrist - 0.2, 0), (wrist, 0), (0.078, 0.0925), 0.085, 0.022)
    side = cheek.moved(0, 0.1, z)
    bridge = drum("x", wrist - 0.25, wrist - 0.13, 0.088, 0.03).moved(0, 0.02, z)
    room = drum("y", -0.3, 0.052, 0.11, 0.0).moved(wrist, 0, z)
    arm = tube.blend(bridge, 0.03).blend(side, 0.035).cut(room, 0.008)
    body.add("link_4", ORANGE, arm)
    body.add("link_4", BLACK, cap("y", 0.1425, 1, 0.06, 0.004).moved(wrist, 0, z))
    body.add("link_4", BLACK, bolts("y", 0.143, 0.074, 10, 0.006).moved(wrist, 0, z))
    hub = drum("y", -0.09, 0.05, 0.091, 0.018).moved(wrist, 0, z)
    flank = strap("y", (wrist, 0), (wrist + 0.1, 0), (0.075, 0.066), 0.055, 0.018)
    nose = cone("x", wrist, tip - 0.04, (0.084, 0.077), 0.012).moved(0, 0, z)
    body.add("link_5", ORANGE, hub.blend(nose, 0.02).blend(flank.moved(0, -0.094, z), 0.025))
    body.add("link_5", BLACK, cap("y", -0.1215, -1, 0.045, 0.003).moved(wrist, 0, z))
    flange = drum("x", tip - 0.037, tip, 0.064, 0.003) - drum("x", tip - 0.01, tip + 1, 0.025)
    body.add("link_6", STEEL, flange.moved(0, 0, z))
    body.add("link_6", BLACK, bolts("x", tip, 0.05, 11, 0.0048).moved(0, 0, z))
    body.add("link_6", GREY, rod((tip - 0.03, 0, z + 0.06), (tip - 0.008, 0, z + 0.06), 0.004))
