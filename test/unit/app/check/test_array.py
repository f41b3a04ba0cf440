"""An array is checked as a file is, and shown without a script."""

from __future__ import annotations

import sys
from types import SimpleNamespace

import numpy as np
import pytest
from refusals import refused

import mrlab_ros
from mrlab_ros.adapters.diagnostics import (
    ARRAY_RATE,
    ARRAY_SHAPE,
    NOTHING_TO_SHOW,
    PANDAS_MISSING,
)
from mrlab_ros.core.base.errors import Misuse

TIMES = np.arange(101) / 100
GOOD = np.column_stack([np.sin(TIMES), *([-1.2 + 0 * TIMES] * 2), *([TIMES / 3] * 3)])


def test_an_array_is_checked_without_a_lab() -> None:
    found = mrlab_ros.check(GOOD, 100, robot="ur5e")
    assert found.trajectory is not None
    assert found.trajectory.positions.tobytes() == GOOD.tobytes()
    assert found.ok == (not any(each.refuses for each in found.findings))
    shown = found._repr_html_()
    assert shown.count("<polyline") == 6
    assert "<script" not in shown
    by_times = mrlab_ros.check(GOOD, TIMES, robot="ur5e").trajectory
    assert by_times is not None
    assert by_times.frame_rate == pytest.approx(100)


def test_what_refuses_it_is_named_with_joint_and_row() -> None:
    found = mrlab_ros.check(GOOD * [9, 1, 1, 1, 1, 1], 100, robot="ur5e")
    assert not found.ok
    (first,) = [each for each in found.findings if each.code == "joint_limit"]
    assert (first.joint, first.first_row > 0) == ("shoulder_pan_joint", True)
    assert first.joint in found._repr_html_()
    assert "joint" in str(found)


def test_what_is_no_matrix_of_numbers_is_refused() -> None:
    with refused(ARRAY_SHAPE):
        mrlab_ros.check(np.zeros(6), 100, robot="ur5e")
    with refused(ARRAY_SHAPE):
        mrlab_ros.check([["a"] * 6], 100, robot="ur5e")


@pytest.mark.parametrize("fs", [0, -1.0, np.nan, "fast", [0.0, 0.1], np.inf, 1j, True])
def test_what_is_no_rate_is_refused(fs: object) -> None:
    with refused(ARRAY_RATE):
        mrlab_ros.check(GOOD, fs, robot="ur5e")  # type: ignore[arg-type]


def test_a_table_of_pandas_has_a_column_a_joint(monkeypatch: pytest.MonkeyPatch) -> None:
    found = mrlab_ros.check(GOOD, 100, robot="ur5e")
    monkeypatch.setitem(sys.modules, "pandas", None)
    with refused(PANDAS_MISSING, Misuse):
        found.to_dataframe()
    made = SimpleNamespace(
        DataFrame=lambda values, index, columns: (values, index, columns),
        Index=lambda values, name: values,
    )
    monkeypatch.setitem(sys.modules, "pandas", made)
    values, index, columns = found.to_dataframe()
    assert values.shape == (101, 6)
    assert index == pytest.approx(TIMES)
    assert columns[0] == "shoulder_pan_joint"


def test_a_picture_shows_the_robot_at_a_time() -> None:
    found = mrlab_ros.check(GOOD, 100, robot="ur5e")
    pictures = [np.asarray(found.picture(time)) for time in (0.0, 1.0, 99.0)]
    assert pictures[0].ndim == 3
    assert (pictures[0] != pictures[1]).any()
    assert (pictures[1] == pictures[2]).all()


def test_a_page_needs_a_motion() -> None:
    assert "<html" in mrlab_ros.check(GOOD, 100, robot="ur5e").page()
    with refused(NOTHING_TO_SHOW):
        mrlab_ros.check(np.full((9, 6), np.nan), 100, robot="ur5e").page()
