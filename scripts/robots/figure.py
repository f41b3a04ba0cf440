"""A person of 1.8 m, for scale in pictures."""

from __future__ import annotations

from body import Material
from solids import Solid, ball, rod, union

SKIN = Material("figure", (0.36, 0.42, 0.5), 0.0, 0.75)


def figure() -> Solid:
    """Return a standing person, heels on z = 0, looking along -y."""
    torso = union(
        rod((-0.09, 0, 1.3), (0.09, 0, 1.3), 0.105),
        rod((-0.05, 0, 1.08), (0.05, 0, 1.08), 0.105),
        rod((-0.065, 0, 0.93), (0.065, 0, 0.93), 0.11),
        fillet=0.14,
    )
    limbs: Solid | None = None
    for side in (-1, 1):
        arm = union(
            rod((side * 0.175, 0, 1.37), (side * 0.235, 0.02, 1.1), 0.056, 0.044),
            rod((side * 0.235, 0.02, 1.1), (side * 0.25, -0.04, 0.86), 0.044, 0.032),
            rod((side * 0.25, -0.04, 0.84), (side * 0.25, -0.055, 0.74), 0.04, 0.028),
            fillet=0.03,
        )
        leg = union(
            rod((side * 0.085, 0, 0.88), (side * 0.1, -0.005, 0.5), 0.092, 0.06),
            rod((side * 0.1, -0.005, 0.5), (side * 0.105, 0.015, 0.1), 0.06, 0.042),
            rod((side * 0.105, 0.03, 0.043), (side * 0.115, -0.15, 0.038), 0.043, 0.038),
            fillet=0.05,
        )
        both = arm | leg
        limbs = both if limbs is None else limbs | both
    assert limbs is not None
    head = union(
        ball(0.095).moved(0, 0, 1.705),
        ball(0.075).moved(0, -0.02, 1.645),
        rod((0, 0, 1.42), (0, -0.005, 1.6), 0.058),
        fillet=0.04,
    )
    return torso.blend(limbs, 0.05).blend(head, 0.05)
