"""Bodies of the end effectors; z points out of the flange, all fingers open."""

from __future__ import annotations

from body import Body, bolts, drum, slab
from materials import BLACK, COPPER, GREY, LIGHT_GREY, RUBBER, STEEL
from solids import block, disc, lathe, plate, ring


def parallel_gripper() -> Body:
    """Two fingers on a rail across a rounded housing, 85 mm apart when open."""
    body = Body()
    ring_part = drum("z", 0.0, 0.014, 0.0375, 0.002)
    house = plate(
        "x",
        [
            (-0.036, 0.01),
            (0.036, 0.01),
            (0.072, 0.06),
            (0.072, 0.092),
            (-0.072, 0.092),
            (-0.072, 0.06),
        ],
        0.062,
        0.012,
        0.014,
    )
    body.add("gripper_base_link", BLACK, ring_part.blend(house, 0.012))
    cover = slab((-0.0335, -0.02, 0.03), (0.0335, 0.02, 0.07), 0.004)
    body.add("gripper_base_link", LIGHT_GREY, cover)
    rail = slab((-0.017, -0.074, 0.088), (0.017, 0.074, 0.0985), 0.002)
    body.add("gripper_base_link", STEEL, rail)
    body.add("gripper_base_link", STEEL, bolts("z", 0.013, 0.031, 4, 0.003))
    for way in (1, -1):
        link = "gripper_left_finger_link" if way > 0 else "gripper_right_finger_link"
        slide = slab((-0.021, 0.041, 0.0945), (0.021, 0.07, 0.112), 0.003)
        outline = [(0.0455, 0.108), (0.068, 0.108), (0.066, 0.12), (0.056, 0.158), (0.0455, 0.158)]
        finger = plate("x", outline, 0.026, 0.003, 0.003)
        pad = slab((-0.0115, 0.0425, 0.128), (0.0115, 0.047, 0.157), 0.0015)
        for material, solid in ((STEEL, slide), (BLACK, finger), (RUBBER, pad)):
            body.add(link, material, solid if way > 0 else solid.mirrored("y"))
    return body


def centric_gripper() -> Body:
    """Three fingers that close on a common centre."""
    body = Body()
    house = drum("z", 0.0, 0.07, 0.052, 0.004)
    waist = ring("z", 0.056, 0.009).moved(0, 0, 0.035)
    house = house.cut(waist, 0.003)
    body.add("centric_base_link", LIGHT_GREY, house)
    body.add("centric_base_link", BLACK, drum("z", 0.066, 0.074, 0.03, 0.002))
    body.add("centric_base_link", STEEL, bolts("z", 0.0705, 0.042, 6, 0.003).turned("z", 30))
    for number, angle in enumerate((0, 120, 240), start=1):
        slide = slab((0.022, -0.013, 0.066), (0.058, 0.013, 0.082), 0.002)
        outline = [(0.03, 0.08), (0.055, 0.08), (0.055, 0.095), (0.041, 0.132), (0.03, 0.132)]
        jaw = plate("y", outline, 0.018, 0.002, 0.002)
        pad = slab((0.0275, -0.008, 0.1), (0.0315, 0.008, 0.131), 0.001)
        link = f"centric_finger_{number}_link"
        body.add(link, STEEL, slide.turned("z", angle))
        body.add(link, BLACK, jaw.turned("z", angle))
        body.add(link, RUBBER, pad.turned("z", angle))
    return body


def vacuum_cup() -> Body:
    """One bellows cup on a spring plunger with its vacuum ejector."""
    body = Body()
    foot = drum("z", 0.0, 0.012, 0.0375, 0.002)
    post = drum("z", 0.0, 0.06, 0.016, 0.002)
    body.add("vacuum_base_link", LIGHT_GREY, foot.blend(post, 0.008))
    body.add("vacuum_base_link", BLACK, block((0.03, 0.036, 0.04), 0.004).moved(0.028, 0, 0.034))
    body.add("vacuum_base_link", STEEL, disc("x", 0.005, 0.02, 0.001).moved(0.05, 0, 0.04))
    body.add("vacuum_base_link", STEEL, drum("z", 0.055, 0.085, 0.008, 0.001))
    body.add("vacuum_base_link", GREY, drum("z", 0.08, 0.093, 0.014, 0.002))
    bellows = lathe(
        "z",
        [
            (0.004, 0.09),
            (0.013, 0.09),
            (0.022, 0.098),
            (0.014, 0.103),
            (0.024, 0.111),
            (0.015, 0.116),
            (0.027, 0.13),
            (0.025, 0.13),
            (0.012, 0.117),
            (0.004, 0.114),
        ],
        0.0008,
    )
    body.add("vacuum_base_link", RUBBER, bellows)
    return body


def holding_magnet() -> Body:
    """A flat electromagnet: a steel pot with its winding cast in around the core, on a neck."""
    body = Body()
    link = "magnet_base_link"
    foot = drum("z", 0.0, 0.012, 0.0375, 0.002)
    neck = drum("z", 0.0, 0.03, 0.017, 0.002)
    body.add(link, LIGHT_GREY, foot.blend(neck, 0.006))
    pot = drum("z", 0.028, 0.06, 0.032, 0.0025)
    pot = pot - (drum("z", 0.0595, 0.07, 0.026, 0.0) - drum("z", 0.0, 0.1, 0.014, 0.0))
    body.add(link, STEEL, pot.cut(ring("z", 0.032, 0.0018).moved(0, 0, 0.036), 0.001))
    body.add(link, COPPER, drum("z", 0.057, 0.0598, 0.026, 0.0003))
    body.add(link, BLACK, block((0.016, 0.018, 0.016), 0.003).moved(0.033, 0, 0.044))
    body.add(link, STEEL, disc("x", 0.006, 0.014, 0.001).moved(0.046, 0, 0.044))
    body.add(link, STEEL, bolts("z", 0.0125, 0.03, 4, 0.003))
    return body
