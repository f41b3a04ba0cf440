"""Plots: long series keep their peaks, and one figure draws many results."""

import numpy as np
import pytest
from fakes import make_model, make_trajectory

from mrlab_ros.adapters.trajectories import formats
from mrlab_ros.core.conversion.candidates import Preview
from mrlab_ros.core.conversion.diagnostics import NON_FINITE


@pytest.mark.parametrize("rows", [2, 2000, 2001, 123_457])
def test_a_peak_of_one_frame_stays_in_the_picture(rows):
    values = np.zeros((rows, 3))
    values[rows // 2, 1], values[rows - 1, 2] = 7.0, -3.0
    drawn = formats._envelope(values)
    places = formats._envelope_places(np.arange(float(rows)))
    assert len(drawn) == len(places) <= 2 * formats.DOWNSAMPLED
    np.testing.assert_array_equal(drawn.max(axis=0), values.max(axis=0))
    np.testing.assert_array_equal(drawn.min(axis=0), values.min(axis=0))
    assert abs(places[drawn[:, 1].argmax()] - rows // 2) <= rows / formats.DOWNSAMPLED


@pytest.mark.slow
def test_a_picture_does_not_depend_on_what_was_drawn_before(tmp_path):
    robot = make_model(2)
    long = make_trajectory(np.linspace(0, 40, 5000).reshape(-1, 2))
    formats._figure.cache_clear()
    formats.plot(make_trajectory(), robot, tmp_path / "alone.png")
    formats.plot(long, robot, tmp_path / "other.png")
    formats.plot(make_trajectory(), robot, tmp_path / "after.png")
    alone, other, after = (
        (tmp_path / f"{name}.png").read_bytes() for name in ("alone", "other", "after")
    )
    assert alone == after
    assert alone != other


def test_refused_rows_are_marked(tmp_path):
    shown = Preview("q", np.arange(1, 51), np.zeros((50, 6)))
    found = NON_FINITE(variable="q", column=1, count=1, rows=1, of=50, first_row=7, last_row=9)
    formats.plot_refused(shown, [], "a.mat", make_model(6), tmp_path / "plain.png")
    formats.plot_refused(shown, [found], "a.mat", make_model(6), tmp_path / "marked.png")
    _, (axis,) = formats._figure(5, 1)
    assert [text.get_text() for text in axis.texts] == ["row 7: non_finite"]
    formats.plot_refused(shown, [], "a.mat", make_model(6), tmp_path / "again.png")
    assert not axis.texts
    plain = (tmp_path / "plain.png").read_bytes()
    assert plain == (tmp_path / "again.png").read_bytes()
    assert plain != (tmp_path / "marked.png").read_bytes()
