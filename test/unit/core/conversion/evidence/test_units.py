"""Units as files spell them, with their multiples and parts."""

import math

import pytest

from mrlab_ros.core.conversion.evidence import units


@pytest.mark.parametrize(
    ("text", "degrees"),
    [
        ("Zehntelgrad", 0.1),
        ("tenths of a degree", 0.1),
        ("dixièmes de degré", 0.1),
        ("décimas de grado", 0.1),
        ("hundertstel Grad", 0.01),
        ("0.01°", 0.01),
        ("1/1000 deg", 0.001),
        ("圈", 360),
    ],
)
def test_parts_and_multiples_of_angles(text, degrees):
    assert units.parse(text).factor == pytest.approx(math.radians(degrees))


@pytest.mark.parametrize("text", ["decimal", "10 deg", "tenth", "0.1 s", "centimes"])
def test_what_only_looks_like_one_is_none(text):
    assert units.parse(text) is None
