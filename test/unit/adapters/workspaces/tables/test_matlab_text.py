"""MATLAB code that is data: what is read, and the line that is not."""

import numpy as np
import pytest

from mrlab_ros.adapters.workspaces.matlab.elements import NotATable
from mrlab_ros.adapters.workspaces.tables.matlab_text import comments, statements

CODE = b"""%% a motion
clear all; clc
%{
q = [9 9];
%}
fs = 100; unit = 'rad';
% t = 5
data.q = [0.1, 0.2 ... first
  0.3
  1.0D-01 -2e-1 3]; turned = [1 2; 3 4]';
"""


def test_numbers_texts_and_matrices_are_read():
    found = dict(statements(CODE))
    assert found["unit"] == "rad"
    assert found["fs"].tolist() == [100.0]
    np.testing.assert_array_equal(found["data.q"], [[0.1, 0.2, 0.3], [0.1, -0.2, 3]])
    np.testing.assert_array_equal(found["turned"], [[1, 3], [2, 4]])


@pytest.mark.parametrize(
    ("code", "line"),
    [
        (b"q = [1 2];\nq = q * pi / 180;", 2),
        (b"q = [1 2\n3 pi];", 2),
        (b"fs = 1/0.01;", 1),
        (b"x = 1;\nfor i = 1:3\nend", 2),
        (b"q = [1 2\n3];", 2),
    ],
)
def test_code_that_computes_is_refused_with_its_line(code, line):
    with pytest.raises(NotATable) as caught:
        list(statements(code))
    assert caught.value.args[0].values["line"] == line


def test_comments_are_read_and_texts_are_none():
    code = (
        b"% joint angles in degrees\nq = [1 2]; % deg\nrobot = 'a % b';\n%{\nat 50 Hz\n%}\nw = q';"
    )
    assert comments(code) == ["at 50 Hz", "joint angles in degrees", "deg"]
