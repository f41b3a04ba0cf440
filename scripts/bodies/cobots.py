"""The body of the Universal Robots UR5e.

Sizes: robots/<id>/robot.yaml names the descriptions they were measured on.
"""

from __future__ import annotations

from body import Body, bolts, cone, drum
from materials import RUBBER, UR_BLUE, UR_DARK, UR_SILVER
from solids import Solid, disc, lathe


def _ur_joint(radius: float, low: float, high: float, stub: float, way: int) -> Solid:
    """A UR joint about the origin: a housing along z from low to high, a stub along way * y."""
    body = drum("z", low, high, radius, radius * 0.18)
    return body.blend(drum("y", 0.0, way * stub, radius * 0.98, 0.002), radius * 0.22)


def _blue_lid(axis: str, place: float, way: int, radius: float) -> Solid:
    """The domed lid that closes a UR joint."""
    start = place - way * radius * 0.3
    profile = [
        (-0.001, start),
        (radius, start),
        (radius, place - way * radius * 0.1),
        (radius * 0.86, place),
        (-0.001, place),
    ]
    return lathe(axis, profile, radius * 0.04)


def ur5e() -> Body:
    """UR5e: silver tubes, dark joint housings, blue lids. All zero: stretched along +x."""
    body = Body()
    z = 0.1625
    foot = cone("z", 0.0, 0.034, (0.0755, 0.0745), 0.006)
    pot = lathe(
        "z", [(-0.001, 0), (0.066, 0), (0.062, 0.05), (0.0595, 0.099), (-0.001, 0.099)], 0.002
    )
    for angle in (45, 135, 225, 315):
        foot = foot - disc("z", 0.0085, 0.2).moved(0.066, 0, 0).turned("z", angle)
    body.add("base_link_inertia", UR_DARK, pot.blend(foot, 0.012))
    body.add("base_link_inertia", RUBBER, drum("z", 0.0935, 0.0985, 0.0603, 0.001))

    shoulder = _ur_joint(0.0595, 0.1005 - z, 0.222 - z, 0.0685, 1).moved(0, 0, z)
    body.add("shoulder_link", UR_DARK, shoulder)
    body.add("shoulder_link", UR_BLUE, _blue_lid("z", 0.2345, 1, 0.0575))
    body.add("shoulder_link", RUBBER, drum("y", 0.0665, 0.0725, 0.0602, 0.001).moved(0, 0, z))

    elbow = 0.425
    hub = drum("y", 0.0755, 0.197, 0.0595, 0.01).moved(0, 0, z)
    neck = drum("x", 0.0, 0.088, 0.0585, 0.002).moved(0, 0.138, z)
    body.add("upper_arm_link", UR_DARK, hub.blend(neck, 0.012))
    body.add("upper_arm_link", UR_BLUE, _blue_lid("y", 0.2095, 1, 0.0575).moved(0, 0, z))
    body.add("upper_arm_link", RUBBER, drum("x", 0.083, 0.091, 0.0592, 0.002).moved(0, 0.138, z))
    tube = lathe(
        "x",
        [
            (-0.001, 0.088),
            (0.057, 0.088),
            (0.0455, 0.115),
            (0.0455, 0.33),
            (0.057, 0.357),
            (-0.001, 0.357),
        ],
        0.004,
    ).moved(0, 0.138, z)
    body.add("upper_arm_link", UR_SILVER, tube)
    far = drum("y", 0.068, 0.197, 0.0595, 0.01).moved(elbow, 0, z)
    far_neck = drum("x", 0.357, elbow, 0.0585, 0.002).moved(0, 0.138, z)
    body.add("upper_arm_link", UR_DARK, far.blend(far_neck, 0.012))
    body.add("upper_arm_link", UR_BLUE, _blue_lid("y", 0.2095, 1, 0.0575).moved(elbow, 0, z))
    body.add("upper_arm_link", RUBBER, drum("x", 0.354, 0.362, 0.0592, 0.002).moved(0, 0.138, z))
    ring = drum("y", 0.0615, 0.0685, 0.0602, 0.001)
    body.add("upper_arm_link", RUBBER, ring.moved(elbow, 0, z))

    wrist = 0.8172
    hub = drum("y", -0.042, 0.0605, 0.0575, 0.012).moved(elbow, 0, z)
    neck = drum("x", elbow, 0.494, 0.0475, 0.003).moved(0, 0.007, z)
    body.add("forearm_link", UR_DARK, hub.blend(neck, 0.014))
    body.add("forearm_link", UR_BLUE, _blue_lid("y", -0.0495, -1, 0.0555).moved(elbow, 0, z))
    tube = lathe(
        "x",
        [(-0.001, 0.494), (0.0465, 0.494), (0.0378, 0.522), (0.0378, 0.775), (-0.001, 0.775)],
        0.003,
    ).moved(0, 0.007, z)
    body.add("forearm_link", UR_SILVER, tube)
    body.add("forearm_link", RUBBER, drum("x", 0.49, 0.498, 0.0482, 0.002).moved(0, 0.007, z))
    far = drum("y", -0.035, 0.0545, 0.0385, 0.006).moved(wrist, 0, z)
    far_neck = drum("x", 0.771, wrist, 0.0376, 0.002).moved(0, 0.007, z)
    body.add("forearm_link", UR_DARK, far.blend(far_neck, 0.01))
    body.add("forearm_link", UR_BLUE, _blue_lid("y", -0.0465, -1, 0.037).moved(wrist, 0, z))
    body.add("forearm_link", RUBBER, drum("y", 0.0535, 0.0595, 0.0392, 0.001).moved(wrist, 0, z))

    y = 0.1333
    first = _ur_joint(0.0385, -0.045, 0.044, 0.072, -1).moved(wrist, y, z)
    body.add("wrist_1_link", UR_DARK, first)
    body.add("wrist_1_link", UR_BLUE, _blue_lid("z", 0.2185, 1, 0.037).moved(wrist, y, 0))
    body.add("wrist_1_link", RUBBER, drum("z", 0.1095, 0.1155, 0.0392, 0.001).moved(wrist, y, 0))
    z2 = z - 0.0997
    second = drum("y", 0.0885, 0.181, 0.0385, 0.006).moved(wrist, 0, z2)
    second = second.blend(drum("z", z2, 0.109, 0.0376, 0.002).moved(wrist, y, 0), 0.009)
    body.add("wrist_2_link", UR_DARK, second)
    body.add("wrist_2_link", UR_BLUE, _blue_lid("y", 0.0765, -1, 0.037).moved(wrist, 0, z2))
    body.add("wrist_2_link", RUBBER, drum("y", 0.18, 0.186, 0.0392, 0.001).moved(wrist, 0, z2))
    flange = drum("y", 0.187, 0.2269, 0.0375, 0.004) | drum("y", 0.22, 0.2329, 0.0315, 0.0015)
    flange = flange.blend(disc("z", 0.009, 0.03, 0.002).moved(0, 0.207, -0.034), 0.004)
    flange = flange - drum("y", 0.2269, 0.3, 0.0157, 0)
    body.add("wrist_3_link", UR_SILVER, flange.moved(wrist, 0, z2))
    body.add("wrist_3_link", RUBBER, bolts("y", 0.2325, 0.025, 4, 0.0033).moved(wrist, 0, z2))
    return body
