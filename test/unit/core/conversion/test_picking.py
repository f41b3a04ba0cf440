"""Arrays of more than two dimensions: what they are taken as, and what MATLAB does instead."""

import numpy as np
import pytest
from fakes import make_model

from mrlab_ros.core.conversion.picking import flattened, page_line
from mrlab_ros.core.conversion.workspace import Variable, Workspace

ARM = make_model(6)
ROWS = np.arange(240.0).reshape(40, 6)


def taken(values, path="q"):
    variable = Variable(path, "double", values.shape, values)
    workspace, squeezed = flattened(Workspace("fake", (variable,)), ARM)
    found = workspace.find(path)
    assert found is not None
    assert found.values is not None
    assert found.shape == found.values.shape
    return found.values, squeezed.get(path)


@pytest.mark.parametrize("order", ["C", "F"])
@pytest.mark.parametrize(
    ("stored", "line"),
    [
        (ROWS.T[:, None, :], "q = squeeze(q).';"),
        (ROWS.T[None, :, :], "q = squeeze(q).';"),
        (ROWS.T[None, None], "q = squeeze(q).';"),
        (ROWS[:, None, :], "q = squeeze(q);"),
        (ROWS[:, :, None], "q = squeeze(q);"),
    ],
)
def test_one_dimension_counts_the_joints_and_the_other_the_samples(stored, line, order):
    values, was = taken(np.asarray(stored, order=order))
    np.testing.assert_array_equal(values, ROWS)
    assert was is not None
    assert was.line == line
    assert was.size == "x".join(map(str, stored.shape))


def test_a_signal_of_one_number_is_a_vector():
    values, was = taken(np.arange(40.0)[None, None], "t")
    np.testing.assert_array_equal(values, np.arange(40.0)[:, None])
    assert was is not None
    assert was.line == "q = squeeze(t);"


def test_as_many_samples_as_joints_run_along_the_last_dimension():
    square = np.arange(36.0).reshape(6, 6)
    np.testing.assert_array_equal(taken(square.T[:, None])[0], square)


def test_other_arrays_stay_as_they_are():
    for values in (np.ones((4, 4, 40)), ROWS):
        kept, was = taken(values)
        assert kept is values
        assert was is None


@pytest.mark.parametrize(
    ("shape", "line"),
    [
        ((40, 6, 3), "q = q(:, :, 1);"),
        ((6, 40, 3), "q = q(:, :, 1).';"),
        ((3, 40, 6), "q = squeeze(q(1, :, :));"),
        ((40, 3, 6), "q = squeeze(q(:, 1, :));"),
        ((6, 3, 40), "q = squeeze(q(:, 1, :)).';"),
        ((40, 7, 3, 2), "q = q(:, :, 1, 1);"),
    ],
)
def test_the_line_takes_one_page_with_a_row_a_sample(shape, line):
    assert page_line(shape, "q", 6) == line
