"""The ways of a class in few numbers; web/test/report/plot/way.test.ts reads the same text."""

from __future__ import annotations

import numpy as np
import pytest

from mrlab_ros.classroom.marks.ways import RIGHT, UP, drawn, telling

CORNERS = [(0.0, 0.0), (0.0, 1.0), (1.0, 1.0), (1.0, 0.2), (1.0, 1.0), (0.3, 1.0)]


def through(corners, each=12):
    at = np.linspace(0, len(corners) - 1, each * (len(corners) - 1) + 1)
    points = np.array(corners)
    return np.stack([np.interp(at, np.arange(len(points)), column) for column in points.T], axis=1)


def test_the_places_of_a_way_are_its_corners_there_and_back():
    assert telling(through(CORNERS), 30, 0.01).tolist() == [0, 12, 24, 36, 48, 60]
    assert len(telling(through(CORNERS), 4)) == 4


@pytest.mark.parametrize(
    ("way", "found"),
    [(np.zeros((0, 2)), []), (np.zeros((1, 2)), [0]), (np.zeros((50, 2)), [0, 49])],
)
def test_a_way_that_goes_nowhere_has_its_ends(way, found):
    assert telling(way, 9).tolist() == found


def test_a_way_is_written_as_an_encoded_polyline():
    assert drawn([], 9, 0.001) == ""
    way = np.array([(0.1, 0.2, 0.3), (0.1, 0.2, 0.4), (-0.3, 0.2, 0.4)])
    assert (way @ np.array([RIGHT, UP]).T).round(3).tolist() == [
        [0.1, 0.177], [0.1, 0.266], [0.34, 0.41],
    ]  # fmt: skip
    assert drawn(way.tolist(), 9, 0.001) == "?gEaJA?qDA_N_H"
