"""A person of 1.8 m, for scale in pictures: a plain mannequin of lofted sections.

Heights are those of the median man of DIN 33402-2:2005 (measured as ISO 7250-1 defines them):
stature 1750 mm, eyes 1630, shoulder 1450, elbow 1100, grip 765. Breadths, depths and girths follow
the means of men in ANSUR II (Natick/TR-15/007, 2014), to about 5 mm: crotch height 845, shoulder
breadth over the deltoids 510, hip breadth 345, chest depth 250, head 155 x 200, hand 193,
foot 271 x 102, girths of thigh 625, calf 390, ankle 228, wrist 176, neck 398. All of it is drawn
out to the stature of 1800 mm.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from scipy.interpolate import PchipInterpolator
from solids import Array, Solid, rod, union

STATURE, MEASURED = 1.8, 1.75  # m
SQUARE = 2.3  # exponent of the sections: 2 is an ellipse

# m, of a section across z: height, middle in x and y, half breadth, half depth.
TORSO = (
    (0.83, 0, 0.005, 0.120, 0.060),
    (0.855, 0, 0.008, 0.160, 0.098),
    (0.90, 0, 0.012, 0.174, 0.120),
    (0.98, 0, 0.008, 0.165, 0.113),
    (1.08, 0, 0.0, 0.150, 0.104),
    (1.18, 0, -0.002, 0.153, 0.110),
    (1.28, 0, 0.0, 0.168, 0.124),
    (1.36, 0, 0.008, 0.178, 0.116),
    (1.42, 0, 0.016, 0.170, 0.090),
    (1.455, 0, 0.020, 0.128, 0.072),
    (1.485, 0, 0.020, 0.075, 0.063),
    (1.515, 0, 0.014, 0.060, 0.062),
    (1.585, 0, 0.004, 0.059, 0.061),
)
HEAD = (
    (1.522, 0, -0.050, 0.022, 0.026),
    (1.532, 0, -0.046, 0.042, 0.046),
    (1.555, 0, -0.030, 0.058, 0.070),
    (1.59, 0, -0.016, 0.068, 0.088),
    (1.63, 0, -0.006, 0.075, 0.099),
    (1.67, 0, 0.0, 0.0775, 0.100),
    (1.705, 0, 0.002, 0.071, 0.090),
    (1.73, 0, 0.002, 0.055, 0.069),
    (1.743, 0, 0.002, 0.035, 0.044),
    (1.75, 0, 0.002, 0.010, 0.012),
)
ARM = (
    (0.662, 0.266, -0.046, 0.008, 0.014),
    (0.672, 0.267, -0.044, 0.013, 0.026),
    (0.70, 0.270, -0.040, 0.016, 0.036),
    (0.75, 0.273, -0.034, 0.019, 0.043),
    (0.80, 0.274, -0.028, 0.021, 0.043),
    (0.83, 0.273, -0.023, 0.022, 0.034),
    (0.858, 0.271, -0.018, 0.024, 0.031),
    (0.94, 0.265, -0.006, 0.034, 0.037),
    (1.03, 0.256, 0.008, 0.045, 0.047),
    (1.10, 0.246, 0.018, 0.042, 0.045),
    (1.22, 0.232, 0.018, 0.048, 0.056),
    (1.34, 0.214, 0.014, 0.056, 0.063),
    (1.40, 0.198, 0.015, 0.052, 0.058),
    (1.43, 0.180, 0.016, 0.036, 0.040),
    (1.442, 0.170, 0.016, 0.014, 0.016),
)
LEG = (
    (0.035, 0.104, 0.018, 0.032, 0.040),
    (0.075, 0.104, 0.020, 0.033, 0.043),
    (0.12, 0.104, 0.020, 0.034, 0.038),
    (0.22, 0.103, 0.020, 0.047, 0.050),
    (0.31, 0.103, 0.020, 0.059, 0.063),
    (0.40, 0.103, 0.008, 0.056, 0.060),
    (0.46, 0.102, -0.004, 0.058, 0.063),
    (0.55, 0.100, -0.006, 0.066, 0.072),
    (0.68, 0.097, -0.004, 0.077, 0.084),
    (0.79, 0.093, 0.0, 0.082, 0.094),
    (0.88, 0.090, 0.005, 0.078, 0.095),
    (0.93, 0.090, 0.006, 0.060, 0.070),
)
# m, of a section across y, from the toes to the heel: middle in x and z, half breadth and height.
FOOT = (
    (-0.203, 0.111, 0.012, 0.012, 0.008),
    (-0.195, 0.112, 0.014, 0.028, 0.013),
    (-0.165, 0.114, 0.018, 0.045, 0.018),
    (-0.12, 0.114, 0.024, 0.051, 0.024),
    (-0.06, 0.109, 0.035, 0.044, 0.035),
    (0.0, 0.105, 0.046, 0.036, 0.046),
    (0.045, 0.104, 0.038, 0.035, 0.038),
    (0.062, 0.104, 0.030, 0.026, 0.030),
    (0.068, 0.104, 0.026, 0.012, 0.016),
)


def figure() -> Solid:
    """Return a standing person, heels on z = 0, looking along -y."""
    nose = rod((0, -0.094, 1.628), (0, -0.112, 1.592), 0.007, 0.012)
    head = _loft("z", HEAD).blend(nose, 0.012)
    body = _loft("z", TORSO).blend(head, 0.02)
    for side in (-1, 1):
        leg = _loft("z", LEG, side).blend(_loft("y", FOOT, side), 0.025)
        thumb = rod((side * 0.268, -0.055, 0.815), (side * 0.262, -0.082, 0.755), 0.014, 0.009)
        arm = union(_loft("z", ARM, side), thumb, fillet=0.012)
        shoulder = rod((side * 0.10, 0.018, 1.415), (side * 0.186, 0.015, 1.388), 0.05, 0.054)
        body = body.blend(leg, 0.02).blend(shoulder, 0.05).blend(arm, 0.018)
    return _scaled(body, STATURE / MEASURED)


def _loft(axis: str, table: Sequence[Sequence[float]], side: int = 1) -> Solid:
    """Return the solid through sections across an axis; side: +1 or -1, of x."""
    rows = np.array(table)
    along = "xyz".index(axis)
    other = 3 - along  # x is the first of both, y or z the second
    course = PchipInterpolator(rows[:, 0], rows[:, 1:])
    start, end = rows[0, 0], rows[-1, 0]

    def distance(p: Array) -> Array:
        place = np.clip(p[:, along], start, end)
        u, v, a, b = course(place).T
        across = (np.abs(p[:, 0] - side * u) / a) ** SQUARE
        across = (across + (np.abs(p[:, other] - v) / b) ** SQUARE) ** (1 / SQUARE)
        beyond = np.maximum(start - p[:, along], p[:, along] - end)
        return np.maximum((across - 1) * np.minimum(a, b), beyond)

    middle = rows[:, 1:3] * [side, 1]
    low, high = np.empty(3), np.empty(3)
    low[[0, other]] = (middle - rows[:, 3:]).min(axis=0)
    high[[0, other]] = (middle + rows[:, 3:]).max(axis=0)
    low[along], high[along] = start, end
    return Solid(distance, low, high)


def _scaled(body: Solid, by: float) -> Solid:
    return Solid(lambda p: by * body.distance(p / by), body.low * by, body.high * by)
