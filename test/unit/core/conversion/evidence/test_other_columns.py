"""Dates as clock and datevec write them become times."""

import numpy as np
import pytest

from mrlab_ros.core.conversion.evidence.other_columns import is_datevec, seconds, with_times
from mrlab_ros.core.conversion.workspace import Variable, Workspace

DATES = np.array(
    [[2024, 2, 28, 23, 59, 59.5], [2024, 2, 29, 0, 0, 0.25], [2024, 3, 1, 0, 0, 0.25]], float
)


def test_times_go_on_past_midnight_and_leap_days():
    assert is_datevec(DATES)
    np.testing.assert_allclose(seconds(DATES)[:, 0], [0, 0.75, 86_400.75], atol=1e-9)


@pytest.mark.parametrize(("column", "value"), [(0, 3000), (1, 13), (2, 0), (3, 24), (4, 0.5)])
def test_other_numbers_are_no_dates(column, value):
    other = DATES.copy()
    other[:, column] = value
    assert not is_datevec(other)


def test_only_matrices_of_dates_are_changed():
    q = np.zeros((3, 6))
    variables = (
        Variable("t", "double", DATES.shape, DATES),
        Variable("q", "double", q.shape, q),
        Variable("empty", "double", (0, 6), np.zeros((0, 6))),
    )
    t, same, empty = with_times(Workspace("fake", variables)).variables
    assert (t.shape, t.units) == ((3, 1), ("s",))
    assert same is variables[1]
    assert empty is variables[2]
