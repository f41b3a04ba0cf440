"""Bodies of KUKA's small arms: KR 3 AGILUS, KR AGILUS sixx, KR AGILUS-2.

Sizes: robots/<id>/robot.yaml names the descriptions they were measured on.
"""

from __future__ import annotations

from body import (
    BLACK,
    GREY,
    ORANGE,
    RUBBER,
    STEEL,
    WHITE,
    Body,
    Material,
    bolts,
    cap,
    cone,
    drum,
    slab,
)
from solids import Solid, disc, plate, rod, strap


def _foot(half: float, thick: float, hole: float) -> Solid:
    """A mounting plate with chamfered corners and four bolt holes."""
    c = half * 0.72
    outline = [(half, -c), (half, c), (c, half), (-c, half), (-half, c), (-half, -c), (-c, -half)]
    foot = plate("z", [*outline, (c, -half)], thick, 0.003, 0.006).moved(0, 0, thick / 2)
    for angle in (45, 135, 225, 315):
        foot = foot - disc("z", hole, 1.0).moved(half * 1.13, 0, 0).turned("z", angle)
    return foot


def _connectors(body: Body, x: float, z: float, width: float) -> None:
    """The panel at the back of a base with its plugs."""
    panel = slab((x, -width, z - 0.055), (x + 0.02, width, z + 0.055), 0.004)
    body.add("base_link", GREY, panel)
    for y, dz, radius in ((-0.5, 0.02, 0.017), (0.45, 0.022, 0.013), (0.4, -0.024, 0.009)):
        plug = drum("x", x - 0.006, x + 0.01, radius, 0.002).moved(0, y * width, z + dz)
        body.add("base_link", STEEL, plug)


def _wrist(
    body: Body, material: Material, wrist: float, z: float, start: float, tip: float, size: float
) -> None:
    """link_4's fork, link_5 and the flange; size: half the fork's height."""
    tube = cone("x", start, wrist - 1.5 * size, (size * 1.4, size * 1.33), 0.008).moved(0, 0, z)
    prongs = [
        strap("y", (wrist - 2.1 * size, 0), (wrist, 0), (size * 1.12, size), size * 0.5, 0.006)
        for _ in range(2)
    ]
    left = prongs[0].moved(0, size * 1.14, z)
    right = prongs[1].moved(0, -size * 1.14, z)
    room = drum("y", -size * 0.89, size * 0.89, size * 1.22, 0.004).moved(wrist, 0, z)
    ahead = slab(
        (wrist, -size * 0.89, z - 2 * size), (wrist + 1, size * 0.89, z + 2 * size), 0.002
    )
    fork = tube.blend(left, 0.018).blend(right, 0.018).cut(room | ahead, 0.004)
    body.add("link_4", material, fork)
    for way in (1, -1):
        lid = cap("y", way * size * 1.39, way, size * 0.62, 0.003).moved(wrist, 0, z)
        body.add("link_4", BLACK, lid)
    body.add(
        "link_4", RUBBER, drum("x", start - 0.003, start + 0.004, size * 1.3, 0).moved(0, 0, z)
    )

    hub = drum("y", -size * 0.87, size * 0.87, size * 1.0, 0.008).moved(wrist, 0, z)
    nose = cone("x", wrist, tip - 0.014, (size * 0.88, size * 0.82), 0.006).moved(0, 0, z)
    body.add("link_5", material, hub.blend(nose, 0.01))
    radius = size * 0.78
    flange = drum("x", tip - 0.0135, tip, radius, 0.0015) - drum("x", tip - 0.006, tip + 1, 0.01)
    body.add("link_6", STEEL, flange.moved(0, 0, z))
    body.add("link_6", BLACK, bolts("x", tip, radius * 0.72, 4, 0.0025).moved(0, 0, z))


def kr6_r900_sixx() -> Body:
    """KR 6 R900 sixx: orange castings on a black base; the upper arm is a fork at both ends."""
    return _agilus(ORANGE, 0.435, 0.035, second=False)


def kr10_r900_2() -> Body:
    """KR 10 R900-2: the second AGILUS, white on a black base, with a longer elbow housing."""
    return _agilus(WHITE, 0.425, 0.042, second=True)


def _agilus(skin: Material, z4: float, grip: float, *, second: bool) -> Body:
    body = Body()
    a, height, elbow, wrist = 0.025, 0.4, 0.48, 0.9
    column = cone("z", 0.0, 0.247 if second else 0.2605, (0.1075, 0.1055), 0.008)
    rear = plate(
        "y", [(-0.205, 0.0), (0, 0), (0, 0.235), (-0.12, 0.235), (-0.205, 0.16)], 0.165, 0.02, 0.02
    )
    base = column.blend(rear, 0.025).blend(_foot(0.107, 0.02, 0.006), 0.008)
    for y in (-1, 1):
        pocket = slab((-0.165, 0.076, 0.045), (-0.085, 0.2, 0.165), 0.012)
        base = base.cut(pocket if y > 0 else pocket.mirrored("y"), 0.004)
    body.add("base_link", BLACK, base)
    _connectors(body, -0.214, 0.085, 0.06)
    if second:
        socket = slab((-0.33, -0.03, 0.03), (-0.2, 0.03, 0.09), 0.012)
        body.add("base_link", BLACK, socket)

    # link_1: a turntable that carries two ears; the motor of axis 2 sits in the left one.
    top = height + 0.0
    table = cone("z", 0.2625 if not second else 0.249, 0.312, (0.1085, 0.1075), 0.01)
    right = drum("y", -0.139, -0.0665, 0.0835, 0.014).moved(a, 0, top)
    left = plate(
        "y",
        [
            (-0.085, -0.11),
            (0.105, -0.11),
            (0.108, 0.05),
            (0.07, 0.085),
            (-0.03, 0.085),
            (-0.075, 0.03),
        ],
        0.0695,
        0.016,
        0.03,
    ).moved(0, 0.1015, top)
    saddle_r = slab((-0.075, -0.134, 0.275), (0.085, -0.0665, 0.38), 0.02)
    saddle_l = slab((-0.075, 0.0665, 0.275), (0.09, 0.134, 0.38), 0.02)
    ears = right.blend(saddle_r, 0.02) | left.blend(saddle_l, 0.02)
    link_1 = table.blend(ears, 0.03)
    link_1 = link_1.cut(drum("y", -0.0665, 0.0665, 0.0935, 0.0).moved(a, 0, top), 0.004)
    body.add("link_1", skin, link_1)
    body.add("link_1", RUBBER, drum("z", 0.252, 0.266, 0.1045, 0.001))
    body.add("link_1", BLACK, cap("y", -0.139, -1, 0.056, 0.004).moved(a, 0, top))
    body.add("link_1", BLACK, bolts("y", -0.14, 0.068, 8, 0.004).moved(a, 0, top))
    vent = slab((-0.03, 0.134, 0.335), (0.07, 0.139, 0.43), 0.002)
    for n in range(5):
        z = 0.352 + 0.0155 * n
        vent = vent - slab((-0.02, 0.136, z), (0.06, 0.15, z + 0.007), 0.0)
    body.add("link_1", BLACK, vent)

    # link_2: hub between the ears, a waist, and a fork around the elbow.
    hub = drum("y", -0.0635, 0.0635, 0.0878, 0.014).moved(a, 0, top)
    side = [
        (0.03, -0.052),
        (0.17, -0.045),
        (0.42, -0.062),
        (0.47, -0.07),
        (0.47, 0.07),
        (0.36, 0.074),
    ]
    waist = plate("y", [*side, (0.15, 0.068), (0.03, 0.058)], 0.158, 0.03, 0.02)
    waist = waist.moved(a, 0, top)
    prong_r = drum("y", -0.129, -0.066, 0.0845, 0.016).moved(elbow - 0.006, 0, top)
    prong_l = strap("y", (0.44, 0), (elbow, 0), (0.07, 0.076), 0.055, 0.018).moved(0, 0.0925, top)
    cheek_r = slab((0.31, -0.122, top - 0.052), (elbow, -0.062, top + 0.058), 0.024)
    cheek_l = slab((0.31, 0.062, top - 0.052), (elbow, 0.116, top + 0.058), 0.024)
    link_2 = hub.blend(waist, 0.03)
    link_2 = link_2.blend(prong_r.blend(cheek_r, 0.02), 0.025)
    link_2 = link_2.blend(prong_l.blend(cheek_l, 0.02), 0.025)
    link_2 = link_2.cut(drum("y", -0.0655, 0.0655, 0.083, 0.0).moved(elbow, 0, top), 0.006)
    link_2 = link_2 - slab((elbow, -0.0655, 0.2), (elbow + 0.3, 0.0655, 0.6), 0.0)
    body.add("link_2", skin, link_2)
    body.add("link_2", BLACK, cap("y", -0.1255, -1, 0.056, 0.004).moved(elbow - 0.006, 0, top))
    body.add("link_2", BLACK, bolts("y", -0.1295, 0.069, 8, 0.004).moved(elbow - 0.006, 0, top))
    body.add("link_2", BLACK, cap("y", 0.1185, 1, 0.05, 0.003).moved(elbow, 0, top))

    # link_3: the elbow and the sleeve in which the forearm turns.
    sleeve_end = 0.685 if second else 0.588
    knee = drum("y", -0.064, 0.064, 0.0765, 0.014).moved(elbow, 0, top)
    sleeve = cone("x", elbow - 0.03, sleeve_end, (0.0585, 0.0565), 0.012).moved(0, 0, z4)
    body.add("link_3", skin, knee.blend(sleeve, 0.03))
    body.add(
        "link_3",
        RUBBER,
        drum("x", sleeve_end - 0.004, sleeve_end + 0.003, 0.052, 0).moved(0, 0, z4),
    )
    back = slab((elbow - 0.06, -0.05, z4 + 0.028), (elbow + 0.05, 0.05, z4 + 0.052), 0.012)
    body.add("link_3", BLACK, back)

    _wrist(body, skin, wrist, z4, sleeve_end + 0.003, 0.99 if second else 0.98, grip)
    if not second:
        bulge = drum("x", 0.6, 0.78, 0.056, 0.03).moved(0, 0, z4 + 0.016)
        fore = drum("x", 0.592, 0.80, 0.0595, 0.012).moved(0, 0, z4)
        body.add("link_4", skin, fore.blend(bulge, 0.02))
    else:
        body.add("link_4", skin, drum("x", 0.69, 0.80, 0.058, 0.014).moved(0, 0, z4))
    return body


def kr3_r540() -> Body:
    """KR 3 R540: the smallest; white, compact, with a square grey base."""
    body = Body()
    a, height, elbow, z4, wrist = 0.02, 0.345, 0.28, 0.365, 0.54
    outline = [
        (-0.15, 0.0),
        (0.093, 0.0),
        (0.093, 0.188),
        (0.08, 0.199),
        (-0.1, 0.199),
        (-0.15, 0.13),
    ]
    base = plate("y", outline, 0.15, 0.02, 0.012)
    for y in (-1, 1):
        lug = slab((-0.08, 0.06, 0.0), (0.085, 0.0932, 0.026), 0.008)
        base = base.blend(lug if y > 0 else lug.mirrored("y"), 0.01)
        pocket = slab((-0.06, 0.07, 0.06), (0.06, 0.2, 0.155), 0.015)
        base = base.cut(pocket if y > 0 else pocket.mirrored("y"), 0.004)
    body.add("base_link", GREY, base)
    _connectors(body, -0.16, 0.062, 0.05)
    body.add("base_link", BLACK, drum("z", 0.196, 0.2035, 0.07, 0.001))

    table = cone("z", 0.202, 0.262, (0.074, 0.082), 0.012)
    skirt = slab((-0.105, -0.075, 0.206), (0.105, 0.075, 0.275), 0.035)
    right = strap("y", (a, -0.08), (a, 0), (0.05, 0.0555), 0.044, 0.014).moved(0, -0.078, height)
    left = strap("y", (a, -0.08), (a, 0), (0.05, 0.0605), 0.044, 0.014).moved(0, 0.081, height)
    link_1 = table.blend(skirt, 0.02).blend(right, 0.022).blend(left, 0.022)
    link_1 = link_1.cut(drum("y", -0.0555, 0.0585, 0.0605, 0.0).moved(a, 0, height), 0.003)
    body.add("link_1", WHITE, link_1)
    body.add("link_1", GREY, cap("y", -0.0995, -1, 0.04, 0.003).moved(a, 0, height))
    body.add("link_1", GREY, cap("y", 0.1025, 1, 0.044, 0.003).moved(a, 0, height))

    hub = drum("y", -0.0535, 0.0565, 0.054, 0.012).moved(a, 0, height)
    spine = plate(
        "y",
        [
            (0.0, -0.045),
            (0.06, -0.05),
            (0.19, -0.03),
            (0.25, -0.03),
            (0.25, 0.06),
            (0.17, 0.076),
            (0.11, 0.076),
            (0.0, 0.05),
        ],
        0.108,
        0.026,
        0.02,
    ).moved(a, 0, height)
    prong = strap("y", (0.19, 0.022), (elbow, 0), (0.046, 0.0445), 0.04, 0.012)
    link_2 = hub.blend(spine, 0.02)
    link_2 = link_2.blend(prong.moved(0, -0.077, height), 0.02)
    link_2 = link_2.blend(prong.moved(0, 0.079, height), 0.02)
    link_2 = link_2.cut(drum("y", -0.0595, 0.0605, 0.0685, 0.0).moved(elbow, 0, height), 0.004)
    link_2 = link_2 - slab((elbow, -0.0595, 0.2), (elbow + 0.2, 0.0605, 0.5), 0.0)
    body.add("link_2", WHITE, link_2)
    body.add("link_2", GREY, cap("y", -0.097, -1, 0.032, 0.003).moved(elbow, 0, height))
    body.add("link_2", GREY, cap("y", 0.099, 1, 0.032, 0.003).moved(elbow, 0, height))

    knee = drum("y", -0.0585, 0.0585, 0.0625, 0.018).moved(elbow, 0, height)
    sleeve = cone("x", elbow - 0.02, 0.397, (0.0505, 0.05), 0.01).moved(0, 0, z4)
    body.add("link_3", WHITE, knee.blend(sleeve, 0.02))
    body.add("link_3", RUBBER, drum("x", 0.394, 0.4005, 0.0455, 0).moved(0, 0, z4))

    start = drum("x", 0.4, 0.445, 0.0495, 0.008).moved(0, 0, z4)
    trunk = slab((0.405, -0.0605, z4 - 0.038), (0.482, 0.0625, z4 + 0.044), 0.026)
    cheek = strap("y", (0.47, 0), (wrist, 0), (0.041, 0.0385), 0.0205, 0.008)
    link_4 = start.blend(trunk, 0.014)
    link_4 = link_4.blend(cheek.moved(0, -0.0535, z4), 0.012).blend(
        cheek.moved(0, 0.0555, z4), 0.012
    )
    room = drum("y", -0.0472, 0.0452, 0.053, 0.0).moved(wrist, 0, z4)
    body.add("link_4", WHITE, link_4.cut(room, 0.003))
    for way in (1, -1):
        body.add(
            "link_4", GREY, cap("y", way * 0.064 + 0.001, way, 0.026, 0.003).moved(wrist, 0, z4)
        )
    ridge = rod((0.45, 0.069, z4), (0.5, 0.069, z4), 0.006)
    body.add("link_4", GREY, ridge)

    hub = drum("y", -0.0455, 0.0435, 0.04, 0.012).moved(wrist, 0, z4)
    nose = drum("x", wrist, 0.6, 0.039, 0.008).moved(0, 0, z4)
    body.add("link_5", WHITE, hub.blend(nose, 0.01))
    flange = drum("x", 0.599, 0.615, 0.027, 0.0015) - drum("x", 0.609, 1.0, 0.01)
    body.add("link_6", STEEL, flange.moved(0, 0, z4))
    body.add("link_6", BLACK, bolts("x", 0.615, 0.02, 6, 0.0025).moved(0, 0, z4))
    return body
