"""Bodies of KUKA's QUANTEC pro (KR 120), QUANTEC-2 (KR 150, KR 300) and FORTEC (KR 560).

Sizes: robots/<id>/robot.yaml names the descriptions they were measured on.
"""

from __future__ import annotations

from body import (
    BLACK,
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
from solids import Solid, disc, plate, strap


def _carousel_base(half: float, rear: float, top: float, ring: float) -> Solid:
    """A heavy base: a plate with four bolted feet, a ring for axis 1, a box for the plugs."""
    c = half * 0.55
    outline = [(half, -c), (half, c), (c, half), (-c, half), (-half, c), (-half, -c), (-c, -half)]
    foot = plate("z", [*outline, (c, -half)], 0.05, 0.008, 0.04).moved(0, 0, 0.025)
    window = disc("z", half * 0.2, 1.0)
    body = cone("z", 0.0, top, (ring * 1.12, ring), 0.02)
    for angle in (45, 135, 225, 315):
        arm = slab((0.0, -0.075, 0.0), (half * 0.98, 0.075, 0.12), 0.025).turned("z", angle)
        body = body.blend(arm, 0.05)
    foot = foot.blend(body, 0.03)
    for angle in (45, 135, 225, 315):
        foot = foot - disc("z", 0.02, 1.0).moved(half * 0.9, 0, 0).turned("z", angle)
    for angle in (0, 90, 270):
        foot = foot.cut(window.moved(half * 0.93, 0, 0).turned("z", angle), 0.01)
    box = plate(
        "y",
        [(rear, 0.06), (0, 0.06), (0, top), (rear * 0.45, top + 0.03), (rear, top * 0.8)],
        half * 0.9,
        0.02,
        0.03,
    )
    return foot.blend(box, 0.04)


def _plugs(body: Body, x: float, width: float, z: float) -> None:
    panel = slab((x - 0.012, -width, z - 0.09), (x + 0.02, width, z + 0.09), 0.006)
    body.add("base_link", LIGHT_GREY, panel)
    for y, dz, radius in ((-0.6, 0.02, 0.04), (-0.05, 0.03, 0.03), (0.5, -0.01, 0.034)):
        plug = drum("x", x - 0.08, x, radius, 0.005).moved(0, y * width, z + dz)
        body.add("base_link", BLACK, plug)


def _large_wrist(
    body: Body, start: float, wrist: float, tip: float, z: float, size: float, radius: float
) -> None:
    """The in-line wrist of the big arms: a slim tube, a one-sided fork, a stout last joint."""
    plate_disc = drum("x", start, start + 0.05, 0.1005, 0.008).moved(0, 0, z)
    tube = cone("x", start + 0.03, wrist - 0.08, (0.066, 0.06), 0.01).moved(0, 0, z)
    cheek = strap("y", (wrist - 0.1, 0), (wrist, 0), (0.062, size * 0.86), 0.05, 0.015)
    arm = plate_disc.blend(tube, 0.03).blend(cheek.moved(0, 0.025, z), 0.03)
    body.add("link_4", ORANGE, arm)
    body.add("link_4", BLACK, bolts("x", start + 0.05, 0.085, 10, 0.007).moved(0, 0, z))
    body.add("link_4", RUBBER, drum("x", start - 0.004, start + 0.004, 0.085, 0).moved(0, 0, z))
    shell = drum("y", 0.052, size * 1.57, size, 0.022).moved(wrist, 0, z)
    cheek = strap("y", (wrist, 0), (wrist + 0.12, 0), (size * 0.66, size * 0.6), 0.07, 0.02)
    nose = drum("x", wrist + 0.075, tip - 0.027, radius * 1.27, 0.018).moved(0, 0, z)
    yoke = shell.blend(cheek.moved(0, -0.087, z), 0.02).blend(nose, 0.04)
    room = strap("y", (wrist - 0.12, 0), (wrist, 0), (0.08, size * 0.92), 0.104, 0.0)
    body.add("link_5", ORANGE, yoke.cut(room.moved(0, 0.0, z), 0.01))
    body.add("link_5", BLACK, cap("y", size * 1.58, 1, size * 0.66, 0.006).moved(wrist, 0, z))
    body.add("link_5", BLACK, bolts("y", size * 1.58, size * 0.83, 12, 0.006).moved(wrist, 0, z))
    flange = drum("x", tip - 0.03, tip, radius, 0.003) - drum(
        "x", tip - 0.012, tip + 1, radius * 0.4
    )
    body.add("link_6", STEEL, flange.moved(0, 0, z))
    body.add("link_6", BLACK, bolts("x", tip, radius * 0.8, 11, radius * 0.065).moved(0, 0, z))


def kr150_r2700_2() -> Body:
    """KR 150 R2700-2, after its sibling KR 120 R2700-2."""
    return _quantec(tip=2.915, size=0.1055, flange=0.071, motors=0.062)


def kr300_r2700_2() -> Body:
    """KR 300 R2700-2: the stronger wrist and larger wrist motors."""
    return _quantec(tip=2.94, size=0.12, flange=0.1, motors=0.074)


def _quantec(tip: float, size: float, flange: float, motors: float) -> Body:
    body = Body()
    a, height, elbow, z4, wrist = 0.33, 0.645, 1.48, 0.76, 2.7
    body.add("base_link", BLACK, _carousel_base(0.377, -0.47, 0.214, 0.27))
    _plugs(body, -0.47, 0.14, 0.15)
    body.add("base_link", STEEL, bolts("z", 0.052, 0.34, 4, 0.022).turned("z", 45))

    table = cone("z", 0.222, 0.36, (0.272, 0.262), 0.02)
    tower = plate(
        "y",
        [
            (-0.27, 0.3),
            (0.3, 0.3),
            (0.5, 0.48),
            (0.515, 0.66),
            (0.45, 0.79),
            (0.3, 0.83),
            (0.1, 0.76),
            (-0.05, 0.62),
            (-0.27, 0.5),
        ],
        0.26,
        0.05,
        0.08,
    ).moved(0, 0.08, 0)
    gear = drum("y", 0.022, 0.235, 0.205, 0.03).moved(a, 0, height)
    rear = plate(
        "y", [(-0.5, 0.36), (-0.1, 0.3), (-0.1, 0.6), (-0.3, 0.66), (-0.5, 0.6)], 0.26, 0.06, 0.07
    ).moved(0, -0.02, 0)
    body.add("link_1", ORANGE, table.blend(tower, 0.08).blend(rear, 0.08).blend(gear, 0.05))
    body.add("link_1", BLACK, motor("z", 0.55, 0.83, 0.12).moved(-0.33, -0.05, 0))
    body.add("link_1", BLACK, motor("y", 0.12, -0.27, 0.125).moved(-0.06, 0, 0.66))
    second = drum("y", 0.2, 0.272, 0.115, 0.02).moved(a, 0, height)
    body.add("link_1", BLACK, second)
    tray = slab((-0.2, -0.36, 0.36), (0.32, -0.27, 0.42), 0.02)
    body.add("link_1", BLACK, tray)
    way = curve(
        [
            (-0.34, -0.26, 0.42),
            (-0.15, -0.32, 0.45),
            (0.12, -0.335, 0.46),
            (0.3, -0.34, 0.55),
            (0.34, -0.345, 0.7),
        ],
        5,
    )
    body.add("link_1", RUBBER, hose(way, 0.04))

    low = drum("y", -0.235, 0.017, 0.1945, 0.03).moved(a, 0, height)
    web = plate(
        "y",
        [
            (a - 0.05, -0.15),
            (0.52, -0.185),
            (1.38, -0.135),
            (1.55, -0.1),
            (1.55, 0.11),
            (1.36, 0.135),
            (0.55, 0.19),
            (a - 0.05, 0.17),
        ],
        0.175,
        0.05,
        0.08,
    ).moved(0, -0.298, height)
    high = drum("y", -0.32, -0.105, 0.17, 0.026).moved(elbow, 0, height)
    link_2 = low.blend(web, 0.07).blend(high, 0.05)
    pocket = strap("y", (0.66, 0), (1.2, 0), (0.1, 0.078), 0.06, 0.008).moved(0, -0.4055, height)
    body.add("link_2", ORANGE, link_2.cut(pocket, 0.008))
    body.add("link_2", BLACK, cap("y", -0.386, -1, 0.1, 0.008).moved(a + 0.06, 0, height))
    body.add("link_2", BLACK, cap("y", -0.385, -1, 0.09, 0.008).moved(elbow - 0.02, 0, height))
    way = curve(
        [
            (a + 0.03, -0.375, 0.74),
            (0.5, -0.42, 0.84),
            (0.8, -0.4, 0.83),
            (1.15, -0.4, 0.81),
            (1.42, -0.385, 0.83),
        ],
        5,
    )
    body.add("link_2", RUBBER, hose(way, 0.038))
    for x in (0.62, 1.2):
        clamp = slab((x - 0.035, -0.44, 0.74), (x + 0.035, -0.32, 0.86), 0.015)
        body.add("link_2", BLACK, clamp)

    knee = drum("y", -0.1025, 0.19, 0.17, 0.03).moved(elbow, 0, height + 0.02)
    trunk = plate(
        "y",
        [
            (1.33, 0.64),
            (1.4, 0.51),
            (1.53, 0.5),
            (1.7, 0.62),
            (2.02, 0.64),
            (2.02, 0.885),
            (1.7, 0.905),
            (1.33, 0.9),
        ],
        0.25,
        0.05,
        0.05,
    )
    shank = cone("x", 1.8, 2.343, (0.132, 0.106), 0.014).moved(0, 0, z4)
    body.add("link_3", ORANGE, knee.blend(trunk, 0.05).blend(shank, 0.05))
    body.add("link_3", BLACK, cap("y", 0.19, 1, 0.1, 0.008).moved(elbow, 0, height + 0.02))
    for dy, dz in ((-0.08, -0.03), (0.08, -0.03), (0.0, 0.085)):
        seat = drum("x", 1.26, 1.4, motors * 1.1, 0.012).moved(0, dy, z4 + dz)
        body.add("link_3", ORANGE, seat)
        end = 1.064 if motors > 0.07 else 1.114
        body.add("link_3", BLACK, motor("x", 1.28, end, motors).moved(0, dy, z4 + dz))
    body.add("link_3", BLACK, motor("y", -0.1, -0.12, 0.1).moved(elbow, 0, height))
    way = curve(
        [
            (1.42, -0.37, 0.84),
            (1.56, -0.3, 0.87),
            (1.72, -0.2, 0.87),
            (1.95, -0.165, 0.84),
            (2.25, -0.145, 0.81),
        ],
        5,
    )
    body.add("link_3", RUBBER, hose(way, 0.038))
    for x in (1.75, 2.12):
        clamp = slab((x - 0.03, -0.22, 0.76), (x + 0.03, -0.09, 0.89), 0.015)
        body.add("link_3", BLACK, clamp)
    _large_wrist(body, 2.349, wrist, tip, z4, size, flange)
    return body


def kr120_r2500_pro() -> Body:
    """KR 120 R2500 pro: the first QUANTEC, with a wide base plate and a lower forearm."""
    body = Body()
    a, height, elbow, z4, wrist, tip = 0.35, 0.675, 1.5, 0.634, 2.5, 2.715
    floor = slab((-0.565, -0.4145, 0.0), (0.407, 0.4145, 0.04), 0.012)
    body.add("base_link", BLACK, floor.blend(_carousel_base(0.39, -0.53, 0.206, 0.25), 0.02))
    _plugs(body, -0.53, 0.16, 0.14)
    for x, y in ((0.35, 0.36), (0.35, -0.36), (-0.5, 0.36), (-0.5, -0.36)):
        body.add("base_link", STEEL, drum("z", 0.035, 0.06, 0.026, 0.004).moved(x, y, 0))

    table = cone("z", 0.218, 0.37, (0.254, 0.246), 0.02)
    tower = plate(
        "y",
        [
            (-0.25, 0.3),
            (0.3, 0.3),
            (0.53, 0.5),
            (0.56, 0.69),
            (0.49, 0.83),
            (0.32, 0.89),
            (0.12, 0.8),
            (-0.03, 0.66),
            (-0.25, 0.55),
        ],
        0.23,
        0.05,
        0.08,
    ).moved(0, 0.1, 0)
    gear = drum("y", 0.014, 0.215, 0.228, 0.03).moved(a - 0.01, 0, height)
    rear = plate(
        "y",
        [(-0.5, 0.46), (-0.1, 0.32), (-0.1, 0.7), (-0.3, 0.72), (-0.5, 0.68)],
        0.24,
        0.06,
        0.07,
    )
    body.add("link_1", ORANGE, table.blend(tower, 0.08).blend(rear, 0.08).blend(gear, 0.05))
    body.add("link_1", BLACK, motor("z", 0.6, 0.86, 0.115).moved(-0.2, 0.03, 0))
    body.add("link_1", BLACK, motor("y", 0.02, -0.24, 0.12).moved(-0.38, 0, 0.6))
    body.add("link_1", BLACK, drum("y", 0.19, 0.2495, 0.12, 0.02).moved(a, 0, height))
    way = curve(
        [(-0.3, -0.2, 0.4), (-0.1, -0.23, 0.42), (0.15, -0.23, 0.46), (0.33, -0.22, 0.46)], 5
    )
    body.add("link_1", RUBBER, hose(way, 0.038))

    low = drum("y", -0.235, 0.0095, 0.2, 0.03).moved(a, 0, height)
    web = plate(
        "y",
        [
            (a - 0.06, -0.16),
            (0.56, -0.2),
            (1.38, -0.14),
            (1.57, -0.105),
            (1.57, 0.105),
            (1.36, 0.14),
            (0.6, 0.19),
            (a - 0.06, 0.2),
        ],
        0.19,
        0.055,
        0.08,
    ).moved(0, -0.295, height)
    high = drum("y", -0.34, -0.175, 0.163, 0.026).moved(elbow, 0, height)
    link_2 = low.blend(web, 0.07).blend(high, 0.05)
    pocket = strap("y", (0.68, 0), (1.2, 0), (0.105, 0.08), 0.06, 0.008).moved(0, -0.41, height)
    body.add("link_2", ORANGE, link_2.cut(pocket, 0.008))
    body.add("link_2", BLACK, cap("y", -0.39, -1, 0.105, 0.008).moved(a + 0.06, 0, height))
    body.add("link_2", BLACK, cap("y", -0.39, -1, 0.09, 0.008).moved(elbow - 0.02, 0, height))
    way = curve(
        [
            (0.36, -0.37, 0.82),
            (0.55, -0.42, 0.88),
            (0.85, -0.41, 0.86),
            (1.2, -0.4, 0.84),
            (1.44, -0.38, 0.86),
        ],
        5,
    )
    body.add("link_2", RUBBER, hose(way, 0.038))
    for x in (0.66, 1.22):
        clamp = slab((x - 0.035, -0.428, 0.77), (x + 0.035, -0.32, 0.9), 0.015)
        body.add("link_2", BLACK, clamp)

    knee = drum("y", -0.172, 0.17, 0.172, 0.03).moved(elbow, 0, height - 0.01)
    trunk = plate(
        "y",
        [
            (1.32, 0.56),
            (1.4, 0.47),
            (1.6, 0.47),
            (1.75, 0.52),
            (2.0, 0.52),
            (2.0, 0.75),
            (1.7, 0.8),
            (1.32, 0.8),
        ],
        0.25,
        0.05,
        0.05,
    )
    shank = cone("x", 1.8, 2.238, (0.125, 0.104), 0.014).moved(0, 0, z4)
    body.add("link_3", ORANGE, knee.blend(trunk, 0.05).blend(shank, 0.05))
    body.add("link_3", BLACK, motor("y", 0.15, 0.295, 0.105).moved(elbow, 0, height))
    for dy, dz in ((-0.08, 0.06), (0.08, 0.06), (0.0, -0.06)):
        seat = drum("x", 1.24, 1.4, 0.074, 0.012).moved(0, dy, z4 + 0.02 + dz)
        body.add("link_3", ORANGE, seat)
        end = 1.08 if dz > 0 else 1.13
        body.add("link_3", BLACK, motor("x", 1.26, end, 0.067).moved(0, dy, z4 + 0.02 + dz))
    way = curve(
        [
            (1.44, -0.28, 0.8),
            (1.6, -0.2, 0.82),
            (1.78, -0.12, 0.815),
            (2.0, -0.1, 0.77),
            (2.22, -0.09, 0.74),
        ],
        5,
    )
    body.add("link_3", RUBBER, hose(way, 0.036))
    _large_wrist(body, 2.244, wrist, tip, z4, 0.106, 0.071)
    return body


def kr560_r3100_2() -> Body:
    """KR 560 R3100-2: the FORTEC; the upper arm holds the elbow on both sides."""
    body = Body()
    a, height, elbow, z4, wrist, tip = 0.5, 0.86, 2.05, 1.04, 3.0845, 3.3895
    body.add("base_link", BLACK, _carousel_base(0.472, -0.44, 0.352, 0.31))
    _plugs(body, -0.43, 0.17, 0.24)
    body.add("base_link", STEEL, bolts("z", 0.052, 0.425, 4, 0.028).turned("z", 45))

    table = cone("z", 0.3605, 0.55, (0.335, 0.325), 0.025)
    tower = plate(
        "y",
        [
            (-0.3, 0.45),
            (0.35, 0.45),
            (0.66, 0.66),
            (0.715, 0.86),
            (0.64, 1.03),
            (0.47, 1.085),
            (0.15, 1.0),
            (-0.3, 0.86),
        ],
        0.31,
        0.06,
        0.1,
    )
    gear = drum("y", -0.165, 0.165, 0.222, 0.035).moved(a, 0, height)
    rear = plate(
        "y", [(-0.5, 0.62), (-0.1, 0.48), (-0.1, 0.92), (-0.4, 0.97), (-0.5, 0.9)], 0.44, 0.08, 0.1
    )
    side = slab((-0.25, 0.08, 0.52), (0.2, 0.3, 0.86), 0.07)
    link_1 = table.blend(tower, 0.1).blend(rear, 0.1).blend(side, 0.08).blend(gear, 0.05)
    body.add("link_1", ORANGE, link_1)
    body.add("link_1", BLACK, motor("z", 0.8, 1.088, 0.13).moved(-0.02, 0.2, 0))
    body.add("link_1", BLACK, motor("z", 0.86, 1.08, 0.12).moved(-0.32, -0.05, 0))
    body.add("link_1", BLACK, motor("y", -0.2, -0.36, 0.125).moved(-0.05, 0, 0.82))
    way = curve(
        [(-0.4, -0.26, 0.62), (-0.1, -0.34, 0.56), (0.2, -0.36, 0.58), (0.42, -0.345, 0.66)], 5
    )
    body.add("link_1", RUBBER, hose(way, 0.05))

    link_2: Solid | None = None
    for way_y in (1, -1):
        low = drum("y", 0.17, 0.37, 0.225, 0.03).moved(a, 0, height)
        web = plate(
            "y",
            [
                (a - 0.06, -0.19),
                (0.8, -0.215),
                (1.9, -0.16),
                (2.2, -0.13),
                (2.25, 0.0),
                (2.2, 0.13),
                (1.9, 0.165),
                (0.8, 0.23),
                (a - 0.06, 0.21),
            ],
            0.15,
            0.05,
            0.1,
        ).moved(0, 0.3, height)
        high = drum("y", 0.19, 0.375, 0.19, 0.03).moved(elbow, 0, height)
        half = low.blend(web, 0.07).blend(high, 0.05)
        pocket = strap("y", (0.95, 0), (1.7, 0), (0.12, 0.095), 0.06, 0.008).moved(
            0, 0.395, height
        )
        half = half.cut(pocket, 0.008)
        half = half if way_y > 0 else half.mirrored("y")
        link_2 = half if link_2 is None else link_2 | half
        lid = cap("y", way_y * 0.378, way_y, 0.12, 0.008)
        body.add("link_2", BLACK, lid.moved(a + 0.02, 0, height), lid.moved(elbow, 0, height))
    assert link_2 is not None
    for x in (1.0, 1.42):
        tie = drum("y", -0.26, 0.26, 0.085, 0.01).moved(x, 0, height)
        link_2 = link_2.blend(tie, 0.05)
    body.add("link_2", ORANGE, link_2)
    body.add("link_2", BLACK, motor("y", 0.36, 0.525, 0.13).moved(a, 0, height))
    way = curve(
        [
            (0.5, -0.36, 1.06),
            (0.75, -0.4, 1.11),
            (1.2, -0.385, 1.09),
            (1.7, -0.385, 1.06),
            (2.0, -0.37, 1.1),
        ],
        5,
    )
    body.add("link_2", RUBBER, hose(way, 0.05))
    for x in (0.85, 1.6):
        clamp = slab((x - 0.045, -0.444, 0.98), (x + 0.045, -0.3, 1.15), 0.02)
        body.add("link_2", BLACK, clamp)

    knee = drum("y", -0.185, 0.185, 0.2, 0.03).moved(elbow, 0, height)
    trunk = plate(
        "y",
        [
            (1.86, 0.82),
            (1.95, 0.66),
            (2.15, 0.66),
            (2.3, 0.84),
            (2.5, 0.875),
            (2.5, 1.2),
            (2.2, 1.21),
            (1.86, 1.2),
        ],
        0.33,
        0.06,
        0.06,
    )
    shank = cone("x", 2.3, 2.806, (0.168, 0.134), 0.016).moved(0, 0, z4)
    body.add("link_3", ORANGE, knee.blend(trunk, 0.06).blend(shank, 0.05))
    for dy, dz in ((-0.09, -0.03), (0.09, -0.03), (0.0, 0.09)):
        seat = drum("x", 1.76, 1.95, 0.088, 0.014).moved(0, dy, z4 + dz)
        body.add("link_3", ORANGE, seat)
        body.add("link_3", BLACK, motor("x", 1.79, 1.606, 0.08).moved(0, dy, z4 + dz))
    way = curve(
        [(2.02, -0.37, 1.1), (2.2, -0.32, 1.16), (2.4, -0.23, 1.14), (2.7, -0.185, 1.1)], 5
    )
    body.add("link_3", RUBBER, hose(way, 0.05))
    _heavy_wrist(body, wrist, tip, z4)
    return body


def _heavy_wrist(body: Body, wrist: float, tip: float, z: float) -> None:
    disc_part = drum("x", 2.813, 2.87, 0.131, 0.01).moved(0, 0, z)
    tube = cone("x", 2.85, wrist - 0.1, (0.095, 0.085), 0.012).moved(0, 0, z)
    cheek = strap("y", (wrist - 0.12, 0), (wrist, 0), (0.085, 0.128), 0.075, 0.02)
    arm = disc_part.blend(tube, 0.04).blend(cheek.moved(0, 0.03, z), 0.04)
    body.add("link_4", ORANGE, arm)
    body.add("link_4", BLACK, bolts("x", 2.872, 0.113, 12, 0.009).moved(0, 0, z))
    body.add("link_4", RUBBER, drum("x", 2.808, 2.818, 0.11, 0).moved(0, 0, z))
    shell = drum("y", 0.072, 0.228, 0.15, 0.03).moved(wrist, 0, z)
    flank = strap("y", (wrist, 0), (wrist + 0.17, 0), (0.1, 0.09), 0.09, 0.025)
    nose = drum("x", wrist + 0.12, tip - 0.043, 0.14, 0.025).moved(0, 0, z)
    yoke = shell.blend(flank.moved(0, -0.122, z), 0.03).blend(nose, 0.05)
    room = strap("y", (wrist - 0.15, 0), (wrist, 0), (0.11, 0.136), 0.146, 0.0)
    body.add("link_5", ORANGE, yoke.cut(room.moved(0, 0, z), 0.012))
    body.add("link_5", BLACK, cap("y", 0.228, 1, 0.1, 0.008).moved(wrist, 0, z))
    body.add("link_5", BLACK, bolts("y", 0.2285, 0.123, 14, 0.009).moved(wrist, 0, z))
    flange = drum("x", tip - 0.046, tip, 0.125, 0.004) - drum("x", tip - 0.015, tip + 1, 0.05)
    body.add("link_6", STEEL, flange.moved(0, 0, z))
    body.add("link_6", BLACK, bolts("x", tip, 0.1, 11, 0.008).moved(0, 0, z))
